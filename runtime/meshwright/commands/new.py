"""Write a first design of a family from module and numbers of teeth: a commented TOML file to change from there.

Sizes follow proportions that the family declares; each is written with the reason. --set gives any key its own value,
or any size of a drawing from which keys follow; sizes of [design] and [blank] are options too, by their keys without
the unit: --offset 30, --cutter-radius 114.3, --hand right. Nothing is written where flanks do not touch, teeth are
undercut or pointed or the contact ratio is below 1, unless --force says so: sizes that would mend it are named.
Members of a family that a first design is not are among the packaged ones: `meshwright drives` lists these and all
keys, `meshwright show DESIGN` prints one to copy and change.
"""

import argparse
import difflib
import math
import re
import shlex
from collections import Counter
from functools import partial
from pathlib import Path

import numpy as np

from meshwright.base.errors import DesignError, UsageError
from meshwright.base.files import write_text
from meshwright.commands import options as common
from meshwright.contact.flags import not_first
from meshwright.contact.results import ON_EDGES, ON_FLANKS, impossible
from meshwright.cycle.search import Search
from meshwright.design import description, schema
from meshwright.design import design as designs
from meshwright.design.outline import first_design
from meshwright.design.relations import DERIVED, Completion
from meshwright.drive import Drive
from meshwright.flank.pointed import pointed
from meshwright.limits.results import Request
from meshwright.limits.undercut import undercut_lines


def add_arguments(parser):
    parser.add_argument("family", metavar="FAMILY", help="`meshwright drives` lists them")
    parser.add_argument("--m", type=common.positive, metavar="M", help="module, mm; may follow from sizes of --set")
    parser.add_argument("--z", type=_teeth, required=True, metavar="Z1:Z2", help="threads or teeth of pinion and wheel")
    parser.add_argument("--a", type=common.positive, default=math.nan, metavar="A", help="centre distance, mm")
    parser.add_argument("--profile", metavar="WORD[:WORD]", help="words that choose the drive, in the family's order")
    parser.add_argument(
        "--set", action="append", default=[], metavar="TABLE.KEY=VALUE", help="a value of your own; repeatable"
    )
    parser.add_argument("--name", help="name of the design and, unless --out says otherwise, of the file")
    parser.add_argument("--out", metavar="FILE|-", help="default: NAME.toml; it must not exist")
    for stem in sorted({stem for family in description.families().values() for stem in _stems(family)}):
        parser.add_argument(f"--{stem}", dest=f"{SIZE}{stem}", metavar="VALUE", help=argparse.SUPPRESS)
    parser.add_argument("--force", action="store_true", help="write a design that does not mesh, too")
    plain = parser.format_help
    parser.format_help = lambda: plain() + _offered()


#: Flanks that part by no more along what would be their line of contact, mm, are as good as in line: no drawing has a
#: tolerance so small.
LEVEL = 1e-4

#: What the names of options begin with that are sizes of a drawing, and the tables of these, the first before others.
SIZE = "size:"
SIZES_OF = ("design", "blank")


def _stems(family):
    """Place of every size of a family by the option that stands for it: its key without the unit.

    A radius is a diameter too, and a diameter a radius.
    """
    listed = [(place, p) for table in SIZES_OF for place, p in family.drawing.places.items() if p["table"] == table]
    found = {}
    for place, p in listed:
        found.setdefault(_option(p["key"].removesuffix(f"_{p['key_unit']}")), place)
    for c in family.drawing.table["conversions"]:
        for place, p in listed:
            if p["key"].endswith(c["of"]) and c["factor"] == 1.0:
                other = place.removesuffix(c["of"]) + c["ending"]
                found.setdefault(_option(other.partition(".")[2].removesuffix(f"_{p['key_unit']}")), other)
    return found | {"hand": "design.hand"} if family.handed else found


def _option(key):
    return key.replace("_", "-")


def _sizes(family, options):
    """The settings of --set and of options that are sizes, by "table.key"."""
    own = dict(common.setting(text) for text in options.set)
    stems = _stems(family)
    for name, text in vars(options).items():
        if name.startswith(SIZE) and text is not None:
            stem = name.removeprefix(SIZE)
            if stem not in stems:
                near = difflib.get_close_matches(stem, stems, n=1)
                remedy = f"did you mean --{near[0]}?" if near else "leave it out"
                raise UsageError(f"--{stem} {text}: no size of the family {family.name}; {remedy}")
            own |= [common.setting(f"{stems[stem]}={text}")]
    return own


def _offered():
    """What --m, --z and --a mean and which words --profile takes, by family; read only when help is asked for."""
    lines = ["", "families:"]
    for name, family in description.families().items():
        if family.outline is None:
            continue
        lines.append(f"  {name}")
        lines += [f"    --{option:<9} {text}" for option, text in family.outline["options"].items()]
        offered = _offers(family)
        lines += [f"    --profile   {':'.join(offered)}"] if offered else []
        lines += [f"      {key:<13} {', '.join(words)}" for key, words in offered.items()]
        lines += [f"      not {_together(entry['words'])}: {entry['why']}" for entry in family.outline.get("apart", ())]
    return "\n".join(lines) + "\n"


def _together(words):
    return " with ".join(f"{key} {' or '.join(meant)}" for key, meant in words.items())


def _offers(family):
    """The words that each key of --profile takes, in its order."""
    drives = family.variants.values()
    return {key: sorted({w for variant in drives for w in variant.get(key, ())}) for key in family.outline["words"]}


def _teeth(text):
    match = re.fullmatch(r"([1-9]\d*):(-?[1-9]\d*|[a-z]+)", text)
    if not match:
        raise argparse.ArgumentTypeError(f"{text}: not two whole numbers Z1:Z2, for example 2:40")
    return int(match[1]), match[2] if match[2].isalpha() else int(match[2])


def run(options):
    asked = {"m": options.m or math.nan, "z_1": options.z[0], "z_2": options.z[1], "a": options.a}
    family = _belongs(_family(options.family), asked)
    words = _words(family, options.profile)
    own = _sizes(family, options)
    given, determined, sizes = _determined(family, asked, own)
    if math.isfinite(options.a) and "a" not in family.outline["options"]:
        raise UsageError(f"--a {options.a:g}: the centre distance of this family follows from its teeth; leave it out")
    numbered = "-".join([family.name, *words.values(), f"{options.z[0]}-{options.z[1]}"])
    name = options.name or numbered.lower().replace("--", "-")
    follow = partial(_followed, family, sizes, own) if own else None
    try:
        first = first_design(family, name, words, given, own, determined, follow)
        drive = _drive(first)
    except DesignError as error:
        asked = " ".join(f"--{key}" for key in family.outline["options"])
        refused = f"no design follows from {asked} by the family's proportions, unless --set changes them"
        raise UsageError(f"{refused}: {error}") from None
    place = options.out or f"{name}.toml"
    if place != "-" and Path(place).exists():
        raise UsageError(f"{place}: exists already; name another file with --out, or another --name")
    touch, seen = _contact(drive)
    faults = [*([] if touch else [seen]), *_pointed(drive), *_undercut(drive), *(_short(drive) if touch else [])]
    faults = faults or _interfering(drive)
    if faults:
        made = partial(first_design, family, name, words, given, determined=determined)
        blamed = [] if touch else [*_blamed(family, own, lambda kept: made(own=kept))]
        mended = [*_mended(first, lambda size: made(own=own | size))]
        seen = "\n".join([*faults, *blamed, *(mended or (common.beside_proportions(drive) if not blamed else []))])
        if not options.force:
            raise UsageError(f"{place}: nothing written, --force writes it all the same\n{seen}")
    write_text(place, first.text)
    if place != "-":
        write_text("-", _next_steps(place, first, seen, options.drives))
    return 0


def _asked(family, asked):
    """The places of options that are sizes, and the sizes that these give, by "table.key".

    A word in the place of a number is the size of which it is a choice; nothing where the family has no such size.
    """
    places = {s["values"][0]: s["place"] for s in family.outline["suggestions"]
              if len(s["values"]) == 1 and s["values"][0] in [*asked]}  # fmt: skip
    sizes = {}
    for option, place in places.items():
        if isinstance(word := asked[option], str):
            chosen = [size for size, p in family.drawing.places.items() if word in p["choices"]]
            sizes |= dict.fromkeys(chosen[:1], word)
        elif word == word:
            sizes[place] = word
    return places, sizes


def _belongs(family, asked):
    """The family itself, or that of which its drawing says that a drive with these options is.

    Raises :class:`UsageError` where the family has no such wheel, :class:`DesignError` where no family has.
    """
    tables = designs.changed({"drive": family.name}, _asked(family, asked)[1])
    if other := family.drawing.other_family(tables):
        return _family(other)
    if error := family.drawing.refused(tables):
        raise error
    if not _has_wheel(family, asked):
        found = [name for name, f in description.families().items() if f.outline and _takes(f, asked)]
        remedy = " or ".join(f"use `meshwright new {name}`" for name in found) or "give its number of teeth"
        raise UsageError(f"--z {asked['z_1']}:{asked['z_2']}: no wheel of the family {family.name}; {remedy}")
    return family


def _has_wheel(family, asked):
    """Whether a wheel's number of teeth lies in the domain of its key, or its word is a choice of the family."""
    places, sizes = _asked(family, asked)
    if isinstance(asked["z_2"], str):
        return asked["z_2"] in sizes.values()
    p = family.drawing.places[places["z_2"]]
    return (p["lower"] is None or asked["z_2"] > p["lower"]) and (p["upper"] is None or asked["z_2"] < p["upper"])


def _takes(family, asked):
    """Whether drives of this family, and not of another, have such a wheel."""
    tables = designs.changed({"drive": family.name}, _asked(family, asked)[1])
    drawing = family.drawing
    return _has_wheel(family, asked) and not (drawing.other_family(tables) or drawing.refused(tables))


def _determined(family, asked, own):
    """The options as they are, the keys that follow from them and from one's ``own`` sizes, by "table.key", and the
    sizes that the options are.
    """
    drawing = family.drawing
    places, sizes = _asked(family, asked)
    tables = designs.changed({"drive": family.name}, sizes | own)
    if error := drawing.refused(tables):
        raise error
    completion = Completion.of(drawing, schema.drawn(family.name, tables))
    determined = completion.determined()
    options = {option: determined.get(places.get(option), number) for option, number in asked.items()}
    if math.isnan(options["m"]):
        raise UsageError("--m: no module; give it, or a size from which it follows")
    return options, {place: number for place, number in determined.items() if place not in own}, sizes


def _followed(family, sizes, own, chosen):
    """The keys that relations derive from one's ``own`` sizes with those of options and ``chosen``, by "table.key"."""
    drawing = family.drawing
    tables = designs.changed({"drive": family.name}, chosen | sizes | own)
    completion = Completion.of(drawing, schema.drawn(family.name, tables))
    theirs = {name for name, size in completion.given.items() if size["place"] in own}
    by_own = {place for place, p in drawing.places.items()
              if (known := completion.known.get(p["name"])) and known.provenance == DERIVED and known.ends & theirs}
    return {place: number for place, number in completion.determined().items() if place in by_own}


def _drive(first):
    return Drive.from_tables(designs.parsed(first.text, "the first design"))


def _blamed(family, own, design):
    """A line that names the settings of one's ``own``, each alone or else all together, without which ``design(the
    others)`` has flanks that touch, and the packaged designs that have the same keys.
    """

    def touches(without):
        try:
            return _contact(_drive(design({place: own[place] for place in own if place not in without})))[0]
        except (DesignError, UsageError):
            return False

    blamed = [place for place in own if touches({place})] or ([*own] if touches(own) else [])
    if not blamed:
        return
    values = ", ".join(f"{place} = {own[place]}" for place in blamed)
    yield f"without {values} the flanks touch: the sizes that go with it are yours to give"
    if also := [name for name in designs.packaged_names() if _gives(designs.read(name), family, blamed)]:
        yield f"packaged designs that give it: {', '.join(also)} (`meshwright show DESIGN`)"


def _gives(tables, family, places):
    """Whether a design of the family gives each of these keys a value, not zero."""
    found = [tables.get(table, {}).get(key) for table, key in map(description.table_and_key, places)]
    return tables["drive"] == family.name and all(found)


def _pointed(drive):
    """A line for every member whose teeth end in a point."""
    return [f"careful: {member}: change a size first (`meshwright explain pointed`)" for member in pointed(drive)]


def _undercut(drive):
    """A line for every member that its tool undercuts within the limits of its flank."""
    cut = Counter(line.member for line in undercut_lines(drive, Request()) if line.on_flank)
    return [
        f"careful: the tool undercuts the flank of the {member}, at {count} places looked at: give it more teeth or "
        "another profile shift or pressure angle (`meshwright explain undercut`, `meshwright limits` says where)"
        for member, count in cut.items()
    ]


def _interfering(drive):
    """A line for each check of the drawing by which something occurs that should not."""
    found = [check for check in drive.drawing().checks.values() if check.word == "occurs" and check.holds]
    return [f"careful: {check.meaning} {check.margin:.3g}" for check in found]


def _short(drive):
    """A line if the next pair of teeth comes into contact only after one has left it."""
    ratio = drive.contact_ratio().contact_ratio
    if ratio is None or not ratio < 1.0:
        return []
    return [f"careful: contact ratio {ratio:.3g} is below 1: change a size first"]


#: What assumed sizes are changed by, relative (of one that is 0: as it is), where a design does not mesh.
CHANGES = (0.25, -0.25, 0.1, -0.1)

#: Sizes that mend a design are named at most so many, and designs looked at for them.
MOST_MENDS = 2
MOST_LOOKS = 12


def _mended(first, design):
    """A line for each of the sizes, of those that ``first`` assumes, whose change alone makes ``design`` of it mesh.

    What is assumed last, with most of the rest known, is tried first.
    """
    assumed = [(place, size) for place, size, why in reversed(first.assumed) if why and "." in place]
    sizes = [(place, size) for place, size in assumed if isinstance(size, float)]
    looks = [(place, number, by) for by in CHANGES for place, number in sizes]
    named = set()
    for place, number, by in looks[:MOST_LOOKS]:
        changed = float(f"{number * (1.0 + by) or by:.4g}")
        if place not in named and _meshes(lambda size={place: changed}: _drive(design(size))):
            named.add(place)
            yield f"with {place} = {changed:g}, not {number:g}, the pair meshes"
        if len(named) == MOST_MENDS:
            return


def _meshes(made):
    """Whether nothing is wrong with a drive that is yet to be made."""
    try:
        drive = made()
        return _contact(drive)[0] and not (_pointed(drive) or _undercut(drive) or _short(drive) or _interfering(drive))
    except (DesignError, UsageError):
        return False


def _contact(drive):
    """Whether the flanks touch first over the pitch about the middle, and what they do there."""
    result = drive.tca(drive.about_the_middle(np.linspace(-0.5, 0.5, 5)))
    result = not_first(result, drive.first_contact(result.angles, result))
    touching = (*ON_FLANKS, *ON_EDGES) if _out_of_line(drive, result) <= LEVEL else ON_FLANKS
    for k, (status, flags) in enumerate(zip(result.status, result.flags, strict=True)):
        word = next((flag for flag in flags if impossible(flag)), None if status in touching else status)
        if word:
            angle = np.degrees(result.angles[k])
            return False, f"careful: {word} at {angle:.4g} degrees: change a size first (`meshwright explain {word}`)"
    along = " along a line" if {"line_contact", *ON_EDGES}.intersection(result.status) else ""
    return True, f"looked at over one pitch: the flanks touch{along}, and nothing else before them"


def _out_of_line(drive, result):
    """The most by which flanks that touch on edges part along what would be their line of contact, mm; infinity where
    none do, or they touch in points.
    """
    search, _ = Search.of(drive) if set(ON_EDGES).intersection(result.status) else (None, None)
    if search is None or not search.flank.pointless:
        return np.inf
    own = drive.design.mirror.sign * result.angles
    rises = [search.rise(*at) for at in zip(own, search.at(own), strict=True)]
    return max(filter(np.isfinite, rises), default=np.inf)


def _family(name):
    known = description.families()
    if name not in known:
        near = difflib.get_close_matches(name, known, n=1)
        remedy = f"did you mean {near[0]!r}?" if near else f"use one of {', '.join(known)}"
        raise UsageError(f"FAMILY = {name!r}: no such family of drives; {remedy}")
    if known[name].outline is None:
        raise UsageError(f"FAMILY = {name!r}: declares no first design; copy one: `meshwright show` prints any")
    return known[name]


def _words(family, text):
    """The words that choose the drive: those given, in the family's order, the outline's for the rest."""
    asked = text.split(":") if text else []
    keys = family.outline["words"]
    if len(asked) > len(keys):
        raise UsageError(f"--profile {text}: more words than {', '.join(keys) or 'this family has'}; give fewer")
    words = dict(zip(keys, asked, strict=False)) | {key: word for key, word in [*keys.items()][len(asked) :] if word}
    if words:
        # a key that may be left out follows another, or is a word of its own
        defaults = family.variant_defaults.items()
        whole = words | {key: words.get(key, words.get(other, other)) for key, other in defaults}
        if family.chosen(whole) is None:
            listed = "; ".join(f"{key}: {', '.join(found)}" for key, found in _offers(family).items())
            raise UsageError(f"--profile {text}: no drive of this family has these words; {listed}")
        for entry in family.outline.get("apart", ()):
            if all(whole[key] in meant for key, meant in entry["words"].items()):
                named = ", ".join(f"{key} = {whole[key]}" for key in entry["words"])
                raise UsageError(f"--profile {text}: {named}: {entry['why']}; change one of these words")
    return words


def _next_steps(place, first, seen, folders):
    meshwright = shlex.join(["meshwright", *(word for folder in folders for word in ("--drives", str(folder)))])
    lines = [f"{place} written; assumed:"]
    lines += [f"  {key} = {value}: {why}" for key, value, why in first.assumed if why]
    lines += [seen, "go on with", f"  {meshwright} tca {place}", f"  {meshwright} report {place} --html report.html"]
    return "\n".join(lines) + "\n"
