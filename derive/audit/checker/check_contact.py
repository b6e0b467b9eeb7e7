"""Verify proofs of contact from the description alone: `python check_contact.py PROOF.json … [--descriptions FOLDER]`,
exit status 0 if each is accepted. `meshwright tca DESIGN --phi-deg A --certify --proof PROOF.json` writes one.

A proof says: of the exact decimals of the design at the exact angle, the equations of contact R(x) = 0 of the
description with this hash have exactly one zero in the box centre ± box, their Jacobian J is regular in all of it, the
zero lies in centre ± within, and the transmission error between the two decimals. That is Krawczyk's test (Computing 4,
1969; Neumaier, Interval Methods for Systems of Equations, 1990, 5.1): with any matrix C and M = |I - C J(box)|,

    |C R(centre)| + M box < box     and then     |C R(centre)| + M within <= within,

the first strictly: x -> x - C R(x) contracts. Of a design system, which finds further numbers of the design, the same
is shown before, and what follows from it is enclosed; that its zero is the one which is meant is not. Nothing of the
program that wrote the proof is trusted. That the contact is the first, and on both bounded flanks, is another claim;
that the description is that of the drive is what check_description.py shows.
"""

import hashlib
import json
import re
import sys
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any

from .command import ended
from .intervals import (
    OPERATIONS,
    UNIT,
    Enclosed,
    Pair,
    Undefined,
    enclosed,
    magnitude,
    minus,
    pi,
    plus,
    power,
    times,
)
from .refusal import UNREADABLE, Rejected, require

SCHEMA = "meshwright.contact-proof/1"
MEMBERS = {
    "schema", "drive", "description_sha256", "design", "pinion_angle_deg", "systems", "unknowns", "centre", "box",
    "within", "preconditioner", "transmission_error_arcsec",
}  # fmt: skip
PROVED = ("unknowns", "centre", "box", "within", "preconditioner")
DECIMAL = re.compile(r"[+-]?\d{1,40}(\.\d{1,400})?([eE][+-]?\d{1,3})?")
DOUBLE = re.compile(r"-?0x[01]\.[0-9a-f]{1,13}p[+-]\d{1,4}")
LARGEST_FILE = 2**20

#: Times that a zero is enclosed anew, for what follows from it; each takes some seven decimals off.
NARROWER = 4


class Open(Exception):
    """A number that the design leaves open."""


class Values:
    """Expressions of a description at given numbers by name; definitions are followed, each part evaluated once."""

    def __init__(self, description: Mapping, known: Mapping[str, Enclosed]):
        self.named = {entry["name"]: entry["value"] for entry in description["definitions"]}
        self.known = dict(known)
        self.made: dict[int, Enclosed] = {}

    def __call__(self, e: object) -> Enclosed:
        if isinstance(e, str):
            if e not in self.known:
                if e not in self.named:
                    raise Open(e)
                self.known[e] = self(self.named[e])
            return self.known[e]
        if isinstance(e, int):
            return Enclosed.of(e)
        require(isinstance(e, list), f"{str(e)[:40]} has no meaning in a description")
        if id(e) not in self.made:
            self.made[id(e)] = self.value(e)
        return self.made[id(e)]

    def value(self, e: Any) -> Enclosed:
        match e:
            case "/", int(p), int(q):
                return Enclosed.of(Fraction(p, q))
            case "^", base, int(n):
                return power(self(base), Fraction(n))
            case "^", base, ["/", int(p), int(q)]:
                return power(self(base), Fraction(p, q))
            case str(operation), *operands if operation in OPERATIONS:
                return OPERATIONS[operation](*map(self, operands))
        raise Rejected(f"{str(e)[:40]} has no meaning in a description")


def text(entry: object, form: re.Pattern, what: str) -> str:
    if not (isinstance(entry, str) and form.fullmatch(entry)):
        raise Rejected(f"{what}: {str(entry)[:40]!r} is not written as it must be")
    return entry


def double(entry: object, what: str) -> Fraction:
    return Fraction(float.fromhex(text(entry, DOUBLE, what)))


def entries(listed: object, count: int, what: str) -> list:
    if not (isinstance(listed, list) and len(listed) == count):
        raise Rejected(f"{what}: must have {count} entries")
    return listed


def once(pairs: Sequence[tuple[str, object]]) -> dict:
    """A JSON object whose keys are apart."""
    found = dict(pairs)
    require(len(found) == len(pairs), "a key stands twice")
    return found


def refuse_number(word: str) -> None:
    raise Rejected(f"a bare number, {word[:40]}: numbers are texts")


def read(path: Path) -> dict:
    require(path.stat().st_size <= LARGEST_FILE, "the file is too large for a proof")
    proof = json.loads(
        path.read_text(encoding="utf-8"), object_pairs_hook=once, parse_int=refuse_number, parse_float=refuse_number,
        parse_constant=refuse_number,
    )  # fmt: skip
    require(isinstance(proof, dict) and set(proof) == MEMBERS, "other entries than those of a proof")
    require(proof["schema"] == SCHEMA, f"another schema than {SCHEMA}")
    return proof


def described(proof: Mapping, folder: Path) -> Mapping:
    name = text(proof["drive"], re.compile(r"\w{1,100}"), "drive")
    content = (folder / f"{name}.json").read_bytes()
    digest = hashlib.sha256(content).hexdigest()
    require(digest == proof["description_sha256"], f"the description of {name} has another hash, {digest}")
    return shared(json.loads(content), {})


def shared(e: object, known: dict) -> object:
    """The same, in which equal lists are one object, so that each is evaluated once."""
    if isinstance(e, dict):
        return {key: shared(value, known) for key, value in e.items()}
    if not isinstance(e, list):
        return e
    parts = [shared(part, known) for part in e]
    key = tuple((type(part), id(part) if isinstance(part, list | dict) else part) for part in parts)
    return known.setdefault(key, parts)


def place_of(key: Mapping) -> str:
    return key["key"] if key["table"] == key["key"] else f"{key['table']}.{key['key']}"


class Design:
    """Numbers of a design by symbol, first those that are given."""

    def __init__(self, description: Mapping, given: Mapping[str, str]):
        self.description, self.numbers, self.decimals = description, {}, {}
        require(isinstance(given, dict), "design: must be an object")
        left = dict(given)
        own = description["handed"]
        self.mirrored = bool(own) and left.pop("design.hand", own) != own
        require(given.get("design.hand", "left") in ("left", "right"), "design.hand: left or right")
        self.drive_is_chosen(left)
        for key in description["keys"]:
            place = place_of(key)
            if place in left:
                self.give(key, left.pop(place), place)
            else:
                require(not key["required"] or key["default"] is not None, f"{place} is missing")
        require(not left, f"{', '.join(left)}: no key of this drive")
        self.keys_agree(given)

    def drive_is_chosen(self, left: dict) -> None:
        """The words that choose a drive choose this one."""
        words = {}
        for place, allowed in self.description["variant"].items():
            words[place] = left.pop(place if "." in place else f"design.{place}", None)
            if words[place] is None:
                require(place in self.description["variant_defaults"], f"{place} is missing")
                words[place] = self.description["variant_defaults"][place]
                words[place] = str(words.get(words[place], words[place]))
            if isinstance(allowed, dict):
                number = Fraction(text(words[place], DECIMAL, place))
                within = allowed["least"] <= number and (allowed["most"] is None or number <= allowed["most"])
                require(within and number.denominator == 1, f"{place} = {number} is of another drive")
                # a number that chooses the drive may be one of the design's too
                if any(place_of(key).endswith(f".{place}") for key in self.description["keys"]):
                    left[f"design.{place}"] = words[place]
            else:
                require(words[place] == allowed, f"{place} = {words[place]} is of another drive")

    def give(self, key: Mapping, word: object, place: str) -> None:
        symbol = key["symbol"]["name"]
        if key["choices"]:
            known = isinstance(word, str) and word in key["choices"]
            require(known, f"{place}: not one of {', '.join(key['choices'])}")
            self.numbers[symbol] = Enclosed.of(key["choices"][word])
            return
        exact = Fraction(text(word, DECIMAL, place))
        require(not key["integer"] or exact.denominator == 1, f"{place}: must be a whole number")
        self.decimals[place] = exact
        factor = Values(self.description, {})(key["factor"])
        self.numbers[symbol] = OPERATIONS["*"](Enclosed.of(exact), factor)
        self.in_domain(self.numbers[symbol].pair, key["symbol"]["domain"], place, key["lower_included"])

    def in_domain(self, pair: Pair, domain: Sequence, place: str, lower_included: bool = False) -> None:
        low, high = (end if end is None else Values(self.description, {})(end).pair for end in domain)
        above = low is None or pair[0] > low[1] or (lower_included and pair[0] >= low[1])
        require(above and (high is None or pair[1] < high[0]), f"{place} is not in its domain")

    def keys_agree(self, given: Mapping) -> None:
        for group in self.description["exclusive"]:
            require(sum(f"design.{key}" in given for key in group) == 1, f"not exactly one of {', '.join(group)}")
        for group in self.description["together"]:
            require(sum(place in given for place in group) in (0, len(group)), f"{group[0]}: not all of its group")
        for key in self.description["keys"]:
            one, other = place_of(key), f"{key['table']}.{key['above']}"
            if key["above"] and one in self.decimals and other in self.decimals:
                require(self.decimals[one] > self.decimals[other], f"{one} must be above {other}")

    def fill(self) -> None:
        """Defaults and rules, in order, where what they read is known and gives a number."""
        defaults = [(key["symbol"]["name"], key["default"]) for key in self.description["keys"]]
        for symbol, value in [pair for pair in defaults if pair[1] is not None] + self.description["rules"]:
            if symbol not in self.numbers:
                try:
                    self.numbers[symbol] = Values(self.description, self.numbers)(value)
                except (Open, Undefined):
                    continue

    def complete(self, proofs: Mapping[str, Mapping]) -> None:
        """The design with all that follows; ``proofs`` by the names of the design systems that are needed."""
        self.fill()
        left = dict(proofs)
        for system in self.description["design_systems"]:
            if all(symbol in self.numbers for symbol in system["fills"]):
                continue
            require(system["name"] in left, f"systems: {system['name']} is missing")
            known = self.numbers | {"path": Enclosed.of(1)}
            fixed = {symbol: Values(self.description, known)(value) for symbol, value in system["fixed"].items()}
            found = solved(self.description, system, known | fixed, left.pop(system["name"]), system["name"])
            values = Values(self.description, known | fixed | found)
            for symbol, value in system["fills"].items():
                if symbol not in self.numbers:
                    self.numbers[symbol] = values(value)
            self.fill()
        require(not left, f"systems: {', '.join(left)} is not needed")
        values = Values(self.description, self.numbers)
        for guard in self.description["guards"]:
            require(values(guard["positive"]).above(), guard["message"])


def solved(
    description: Mapping, system: Mapping, known: Mapping[str, Enclosed], proof: Mapping, words: str
) -> dict[str, Enclosed]:
    """Unknowns of a system within the radii that its proof gives, after Krawczyk's test; Rejected if that fails."""
    names = [unknown["name"] for unknown in system["unknowns"]]
    n = len(names)
    require(isinstance(proof, dict) and set(PROVED) <= set(proof), f"{words}: an entry is missing")
    require(proof["unknowns"] == names, f"{words}: the unknowns are {', '.join(names)}, in this order")
    centre, box, within = ([double(e, key) for e in entries(proof[key], n, key)] for key in ("centre", "box", "within"))
    matrix = [
        [enclosed(double(e, "preconditioner")) for e in entries(row, n, "preconditioner")]
        for row in entries(proof["preconditioner"], n, "preconditioner")
    ]
    for name, x, d, e in zip(names, centre, box, within, strict=True):
        require(0 < e <= d, f"{words}: {name}: the zero must lie in its box, and that have a width")
        lower, upper = next(u["domain"] for u in system["unknowns"] if u["name"] == name)
        ends = [None if end is None else Values(description, known)(end).pair for end in (lower, upper)]
        above = ends[0] is None or enclosed(x - d)[0] > ends[0][1]
        below = ends[1] is None or enclosed(x + d)[1] < ends[1][0]
        require(above and below, f"{words}: {name}: the box leaves the domain")
    at = {name: Enclosed.of(x) for name, x in zip(names, centre, strict=True)}
    values = Values(description, {**known, **at})
    residual = [values(row).pair for row in system["residual"]]
    directions = [tuple(enclosed(int(i == k)) for i in range(n)) for k in range(n)]
    over = {
        name: Enclosed((enclosed(x - d)[0], enclosed(x + d)[1]), along)
        for name, x, d, along in zip(names, centre, box, directions, strict=True)
    }
    values = Values(description, {**known, **over})
    slopes = [values(row).rates or ((0, 0),) * n for row in system["residual"]]
    shift = [magnitude(combined(row, residual))[1] for row in matrix]
    defect = [
        [
            magnitude(plus(enclosed(int(i == j)), minus(combined(matrix[i], [row[j] for row in slopes]))))[1]
            for j in range(n)
        ]
        for i in range(n)
    ]
    widths, nearer = ([enclosed(e)[0] for e in radii] for radii in (box, within))
    for i, name in enumerate(names):
        image = shift[i] + times_row(defect[i], [enclosed(d)[1] for d in box])
        require(image < widths[i], f"{words}: {name}: not shown to be one zero in the box")
        image = shift[i] + times_row(defect[i], [enclosed(e)[1] for e in within])
        require(image <= nearer[i], f"{words}: {name}: not shown to be so near its centre")
    pairs = [enclosed(x) for x in centre], [enclosed(e)[1] for e in within]
    ends = [(enclosed(x - d)[1], enclosed(x + d)[0]) for x, d in zip(centre, box, strict=True)]
    for _ in range(NARROWER):
        closer = narrowed(description, system, known, matrix, defect, *pairs)
        inside = all(low <= x[0] and x[1] <= high for x, (low, high) in zip(closer[0], ends, strict=True))
        if not (inside and all(map(int.__le__, closer[1], pairs[1]))):
            break
        pairs = closer
    return {name: Enclosed((x[0] - e, x[1] + e)) for name, x, e in zip(names, *pairs, strict=True)}


def narrowed(
    description: Mapping, system: Mapping, known: Mapping[str, Enclosed], matrix: Sequence, defect: Sequence,
    centre: Sequence[Pair], within: Sequence[int],
) -> tuple[list[Pair], list[int]]:  # fmt: skip
    """The zero once more, for a centre in the box: it is within M within of the centre's image."""
    names = [unknown["name"] for unknown in system["unknowns"]]
    values = Values(description, {**known, **dict(zip(names, map(Enclosed, centre), strict=True))})
    residual = [values(row).pair for row in system["residual"]]
    image = [plus(x, minus(combined(row, residual))) for x, row in zip(centre, matrix, strict=True)]
    middles = [(low + high) // 2 for low, high in image]
    radii = [
        times_row(row, within) + max(high - middle, middle - low)
        for row, middle, (low, high) in zip(defect, middles, image, strict=True)
    ]
    return [(m, m) for m in middles], radii


def combined(row: Sequence[Pair], numbers: Sequence[Pair]) -> Pair:
    total = 0, 0
    for a, b in zip(row, numbers, strict=True):
        total = plus(total, times(a, b))
    return total


def times_row(row: Sequence[int], widths: Sequence[int]) -> int:
    """A sum of products of bounds that are not negative, rounded upwards."""
    return -(-sum(a * b for a, b in zip(row, widths, strict=True)) // UNIT)


def check(path: Path, folder: Path) -> str:
    """What is shown of one proof, in words."""
    proof = read(path)
    description = described(proof, folder)
    design = Design(description, proof["design"])
    require(isinstance(proof["systems"], dict), "systems: must be an object")
    for name, entry in proof["systems"].items():
        require(isinstance(entry, dict) and set(entry) == set(PROVED), f"systems: {name}: other entries than a proof's")
    design.complete(proof["systems"])
    contact = description["contact"]
    degrees = Fraction(text(proof["pinion_angle_deg"], DECIMAL, "pinion_angle_deg"))
    sense = -1 if design.mirrored else 1
    instant = times(enclosed(sense * degrees / 180), pi()) if degrees else (0, 0)
    known = design.numbers | {contact["instant"]["name"]: Enclosed(instant)}
    found = solved(description, contact, known, proof, "contact")
    low, high = found[contact["error"]].pair
    low, high = (low, high) if sense > 0 else (-high, -low)
    ends = entries(proof["transmission_error_arcsec"], 2, "transmission_error_arcsec")
    ends = [Fraction(text(end, DECIMAL, "transmission_error_arcsec")) for end in ends]
    for end, beyond in ((ends[0], low), (-ends[1], -high)):
        limit = times(enclosed(end / 648000), pi())
        require(limit[1] <= beyond, "the transmission error is not shown to lie between these two")
    return f"{path.name}: one contact of {description['title']} at {proof['pinion_angle_deg']} degrees"


def said(arguments: Sequence[str]) -> Iterator[str]:
    folder = Path(__file__).parents[2] / "descriptions"
    paths = list(arguments)
    if "--descriptions" in paths:
        at = paths.index("--descriptions")
        require(len(paths) > at + 1, "--descriptions: name the folder")
        folder = Path(paths[at + 1])
        del paths[at : at + 2]
    require(paths, "name the files of proofs")
    for path in paths:
        try:
            yield check(Path(path), folder)
        except Rejected as reason:
            raise Rejected(f"{path}: {reason}") from reason
        except (*UNREADABLE, Open, Undefined, OSError) as error:
            raise Rejected(f"{path}: {type(error).__name__}: {error}") from error


def main(arguments: list[str]) -> int:
    return ended(lambda: "\n".join(said(arguments)))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
