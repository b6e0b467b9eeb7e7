"""One page a drive: its chain drawn, the steps of its derivation as formulas with what they rest on, its program, and
the C functions that come of it, each with its line.

Input: the texts of the generated files (description, metadata, header). Nothing is read from the drive's Python.
"""

import json
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import PurePosixPath

from markupsafe import Markup

from derive.audit.render import MathML, symbol_text
from derive.prove.collect import as_tree, collected
from derive.prove.tree import Tree

#: What each step of the making of a surface is called.
STEPS = {
    "swept": "tool's edge, swept",
    "given": "tool's surface",
    "moved": "set into place",
    "envelope": "envelope of the motion",
    "merged": "one angle for a sum",
    "solved": "equation of meshing solved",
}
STAGES = {
    "setup": "once a design",
    "set_phi": "once an input angle",
    "residual": "contact equations",
    "residual_and_jacobian": "contact equations and Jacobian",
    "step": "one Newton step",
    "observe": "what is read from a contact",
}
AXES = "xyz"
FAMILIES = ("cylindrical_worm", "spherical_gears", "cylindrical_gears", "bevel")


@dataclass(frozen=True)
class Box:
    """One link of a chain: what it is, and its motion or formula."""

    words: str
    formula: Markup
    kind: str


@dataclass(frozen=True)
class Step:
    """One step of a derivation: words, formulas, the statements it rests on, the C function that computes it."""

    words: str
    formulas: tuple[Markup, ...]
    rests_on: tuple[str, ...]
    function: str


@dataclass(frozen=True)
class Function:
    """A C function of the header: its line, what it computes, the statements it rests on."""

    name: str
    line: int
    meaning: str
    rests_on: tuple[str, ...]


@dataclass(frozen=True)
class Page:
    """Everything that is shown of a drive."""

    name: str
    title: str
    family: str
    sources: tuple[str, ...]
    specification: str
    chains: tuple[tuple[str, tuple[Box, ...]], ...]
    steps: tuple[tuple[str, tuple[Step, ...]], ...]
    symbols: tuple[tuple[Markup, str, str], ...]
    definitions: tuple[tuple[Markup, str, str], ...]
    operations: tuple[tuple[str, int], ...]
    counts: tuple[tuple[str, str], ...]
    functions: tuple[Function, ...]
    open: tuple[tuple[str, str], ...]
    """Statements that the drive's page cites and that are not proved of it, with the reason."""


def file_name(drive: str) -> str:
    return f"drive-{drive}.html"


def drive_pages(generated: Mapping[str, str], functions: Mapping[str, Mapping[str, list[str]]]) -> list[Page]:
    """The pages of all drives among the generated files, by their names."""
    found = sorted(path for path in generated if path.startswith("descriptions/"))
    return [_page(PurePosixPath(path).stem, generated, functions) for path in found]


def _page(name: str, generated: Mapping[str, str], functions: Mapping[str, Mapping[str, list[str]]]) -> Page:
    described = json.loads(generated[f"descriptions/{name}.json"])
    metadata = json.loads(generated[f"c/{name}.json"])
    header = generated[f"c/{name}.h"]
    rests = {key.removeprefix(f"{name}_"): tuple(ids) for key, ids in functions.get(f"c/{name}.h", {}).items()}
    places = [*_places(described)]
    sources = (f"{s['author']}, {s['title']}" + (f", {s['year']}" if s["year"] else "") for s in described["sources"])
    counts = (
        ("parameters of a design", str(metadata["shapes"]["p"][0])),
        ("unknowns of a contact", str(metadata["shapes"]["x"][0])),
        ("values kept between calls", str(metadata["shapes"]["s"][0])),
        ("values read from a contact", str(metadata["shapes"]["o"][0])),
    )
    return Page(
        name, described["title"], described["family"], tuple(sources), metadata["specification_hash"],
        tuple((title, tuple(_chain(entry))) for title, _, entry in places),
        tuple((title, tuple(_steps(entry, function, rests))) for title, function, entry in places)
        + (("contact", tuple(_contact(described, rests))),),
        tuple(_symbols(described)), tuple(_definitions(described)),
        tuple((STAGES[key], count) for key, count in metadata["operations"].items()),
        counts, tuple(_functions(name, header, rests)), tuple(metadata["open"].items()),
    )  # fmt: skip


def _places(described: dict) -> Iterator[tuple[str, str, dict]]:
    """What it is called, the C function that computes its points, and the entry of every surface."""
    for body in described["bodies"]:
        yield f"flank of the {body['name']}", f"flank_{body['name']}", body
    for region in described["regions"]:
        yield f"{region['region']} of the {region['member']}", f"{region['region']}_{region['member']}", region


_MATH = MathML()
#: Symbols and numbers of the longest formula that is shown.
LONGEST = 220


def _shown(data: object) -> Markup:
    """An expression or vector of a description as a formula."""
    tree = _readable(tuple(data) if isinstance(data, tuple) else data)
    small = isinstance(tree, Markup)
    return Markup('<span class="small">{}</span>').format(tree) if small else Markup(_MATH.formula(tree))


def _named(name: str, data: object) -> Markup:
    tree = _readable(data)
    if isinstance(tree, Markup):
        return Markup("<math>{}</math>, {}").format(Markup(_MATH.name(name)), tree)
    return Markup(_MATH.equation(name, tree))


def _readable(data: object) -> Tree | Markup:
    """The tree of an expression or vector, or words where it is not to be shown."""
    count = _size(data)
    if count > LONGEST:
        return Markup(f"a formula of {count} symbols and numbers, in the description")
    try:
        return ("vec", *map(as_tree, map(collected, data))) if isinstance(data, tuple) else as_tree(collected(data))
    except (KeyError, TypeError):
        return Markup("a formula with cases, in the description")


def _size(data: object) -> int:
    return sum(map(_size, data)) if isinstance(data, list | tuple) else 1


def _motion(motion: Sequence[Sequence]) -> Markup:
    """A product of factors, the one on the right acting first."""
    return Markup(" ").join(Markup('<span class="factor">{}</span>').format(_factor(*factor)) for factor in motion)


def _factor(kind: str, *data) -> Markup:
    match kind:
        case "rotation":
            return Markup("R<sub>{}</sub>({})").format(data[0], _shown(data[1]))
        case "swing":
            return Markup("R<sub>{}</sub>({}) about {}").format(data[0], _shown(data[1]), _shown(tuple(data[2])))
        case "placement":
            return Markup("frame of axes {}").format(Markup(", ").join(_shown(tuple(column)) for column in data[0]))
    along = [k for k, part in enumerate(data[0]) if part != 0]
    if len(along) == 1:
        return Markup("T<sub>{}</sub>({})").format(AXES[along[0]], _shown(data[0][along[0]]))
    return Markup("T{}").format(_shown(tuple(data[0])))


def _chain(entry: dict) -> Iterator[Box]:
    first, *steps = entry["surface"]["made"]
    yield Box("edge of the tool" if "curve" in first else "point of the tool", _edge(first), "edge")
    yield Box("sweep", _motion(first["motion"]), "motion")
    for step in steps:
        match step["step"]:
            case "moved":
                yield Box("set into place", _motion(step["motion"]), "motion")
            case "envelope":
                words = f"generating motion, over {symbol_text(step['variable'])}"
                yield Box(words, _motion(step["motion"]), "motion")
            case "merged":
                sides = as_tree(collected(["+", step["kept"], step["removed"]]))
                yield Box("one angle for a sum", Markup(_MATH.equation(step["total"], sides)), "reduced")
            case "solved":
                yield Box("meshing solved for", _shown(step["parameter"]), "reduced")
    if entry.get("motion"):
        yield Box("in mesh", _motion(entry["motion"]), "mesh")


def _edge(first: dict) -> Markup:
    return _shown(tuple(first.get("curve") or first["point"]))


def _steps(entry: dict, function: str, rests: Mapping[str, tuple[str, ...]]) -> Iterator[Step]:
    surface = entry["surface"]
    first, *steps = surface["made"]
    own = rests.get(function, ())
    yield Step(STEPS[first["step"]], (_edge(first),), _of(own, "derivation/swept", "derivation/revolved", "helicoids/",
               "spherical_gears/", "cylindrical_gears/", "bevel/", "face_worm/"), function)  # fmt: skip
    for step in steps:
        match step["step"]:
            case "envelope":
                yield Step(
                    "equation of meshing: the normal against the motion",
                    tuple(_shown(condition) for condition in surface["conditions"]),
                    _of(own, "derivation/envelope", "derivation/invariance", "derivation/pole", "rack-and-pinion/",
                        *(f"{family}/meshing" for family in FAMILIES)),
                    function,
                )  # fmt: skip
            case "merged":
                sides = as_tree(collected(["+", step["kept"], step["removed"]]))
                yield Step(STEPS["merged"], (Markup(_MATH.equation(step["total"], sides)),),
                           _of(own, "derivation/merge-sum", "cylindrical_worm/sum-angle"), function)  # fmt: skip
            case "solved":
                yield Step(
                    STEPS["solved"], (_named(step["parameter"], step["value"]),),
                    _of(own, "derivation/explicit", "derivation/both-turns", "cylindrical_worm/explicit",
                        "cylindrical_worm/linear", "spherical_gears/explicit", "cylindrical_gears/explicit"),
                    function,
                )  # fmt: skip
    yield Step("outward normal, in the frame of the edge", (_shown(tuple(surface["normal"])),), own, function)


def _of(ids: Sequence[str], *beginnings: str) -> tuple[str, ...]:
    return tuple(key for key in ids if key.startswith(beginnings))


def _contact(described: dict, rests: Mapping[str, tuple[str, ...]]) -> Iterator[Step]:
    contact = described["contact"]
    yield Step("angle of the wheel", (_shown(contact["wheel_angle"]),), (), "eval")
    rows = tuple(_shown(row) for row in contact["residual"])
    yield Step("both points are one, and one normal is square to two tangents of the other surface: all 0", rows,
               rests.get("eval", ()), "eval")  # fmt: skip
    yield Step(
        "Newton's step: their linear system, eliminated in a fixed order of pivots", (), rests.get("step", ()), "step"
    )


def _symbols(described: dict) -> Iterator[tuple[Markup, str, str]]:
    listed = [key["symbol"] for key in described["keys"]]
    listed += [p for _, _, entry in _places(described) for p in entry["surface"]["parameters"]]
    listed += [described["contact"]["instant"], *described["contact"]["unknowns"]]
    seen = {q["name"]: q for q in reversed(listed)}
    for name in sorted(seen, key=str.lower):
        yield Markup("<math>{}</math>").format(Markup(_MATH.name(name))), seen[name]["unit"], seen[name]["meaning"]


def _definitions(described: dict) -> Iterator[tuple[Markup, str, str]]:
    for entry in described["definitions"]:
        yield _named(entry["name"], entry["value"]), entry["unit"], entry["meaning"]


def _functions(name: str, header: str, rests: Mapping[str, tuple[str, ...]]) -> Iterator[Function]:
    pattern = re.compile(rf"((?:/\*(?:[^*]|\*(?!/))*\*/\s)*)(?:MW_DEVICE )?static inline \w+ {name}_(\w+)\(")
    for match in pattern.finditer(header):
        words = re.sub(r"/\* Equations:.*?\*/", "", match[1], flags=re.DOTALL)
        meaning = re.sub(r"\s*\n \* ?|/\* ?|\*/", " ", words).split(". ")[0].strip(" .")
        line = header.count("\n", 0, match.start(2)) + 1
        yield Function(match[2], line, re.sub(r"\s+", " ", meaning)[:160], rests.get(match[2], ()))
