"""Verdicts: bound to their source and text, and following from the certificates that they name."""

import re

from .certificates import CHECKS, OUTCOME_OF_KIND
from .notation import read_equation, read_formula
from .record import definitions_of, linked
from .refusal import UNREADABLE, Rejected, require


def check_certificate(certificate: dict, objects: dict[str, dict]) -> dict:
    equation = linked(objects, certificate["equation"], "equation")
    require(certificate["kind"] in CHECKS, f"unknown kind of certificate {certificate['kind']!r}")
    require(
        certificate["kind"] == "numeric" or OUTCOME_OF_KIND[certificate["kind"]] == certificate["outcome"],
        f"{equation['id']}: kind and outcome contradict",
    )
    try:
        return CHECKS[certificate["kind"]](certificate, equation, definitions_of(equation, objects)) or {}
    except (Rejected, *UNREADABLE) as error:
        raise Rejected(f"{equation['id']}: {error}") from error


def arranged(tree):
    """The tree with nested sums and products made one and their operands in one order."""
    if type(tree) is not list or not tree:
        return tree
    head, operands = tree[0], [arranged(part) for part in tree[1:]]
    if head not in ("+", "*"):
        return [head, *operands]
    flat = [
        part
        for operand in operands
        for part in (operand[1:] if type(operand) is list and operand[:1] == [head] else [operand])
    ]
    return [head, *sorted(flat, key=repr)]


def status_of(readings: list[str], corrected: list[str], contradiction: list[str], damaged: bool) -> str:
    """The status that outcomes imply. Several readings stand for several ways in which a text can be read."""
    if contradiction:
        return "undecided" if contradiction != ["proved"] else "ambiguous" if damaged else "false"
    if len(set(readings)) > 1:
        return "ambiguous"
    if readings[0] != "refuted":
        return readings[0]
    return "proved_with_correction" if corrected == ["proved"] else "false"


def outcome_of(reading: dict, verdict: dict, objects: dict[str, dict]) -> str:
    """A reading is proved if all its equations are, refuted if one is."""
    outcomes = set()
    for part in reading["parts"]:
        certificate = linked(objects, part["certificate"], "certificate")
        require(
            certificate["equation"] == part["equation"], f"{verdict['id']}: the certificate is for another equation"
        )
        outcomes.add(certificate["outcome"])
    require(outcomes, f"{verdict['id']}: nothing is judged")
    return next(outcome for outcome in ("refuted", "undecided", "proved") if outcome in outcomes)


def check_verdict(verdict: dict, objects: dict[str, dict]) -> None:
    """What is judged is what the source says, and the status follows from the certificates."""
    source = linked(objects, verdict["source"], "source")
    require(source["id"] == verdict["id"], f"{verdict['id']}: the verdict is on another source")
    require(verdict["damage"] == source["ocr_doubt"], f"{verdict['id']}: another damage than that of the source")
    printed = source["document_sha256"]
    require(source["locator"] and verdict["plain"], f"{verdict['id']}: words are missing")
    require(source["verbatim"] or not printed, f"{verdict['id']}: the print is missing")
    check_bindings(verdict, source, objects)
    require(
        verdict["described"] == drives_read(verdict, objects),
        f"{verdict['id']}: not the drives whose descriptions its equations read",
    )
    roles = ("readings", "corrected", "contradiction")
    outcomes = [[outcome_of(reading, verdict, objects) for reading in verdict[role]] for role in roles]
    if outcomes[0] or outcomes[2]:
        require(
            verdict["status"] == status_of(*outcomes, bool(verdict["damage"])),
            f"{verdict['id']}: the status does not follow from the certificates",
        )
    else:
        judged_by_words = ("not_mathematical", "definition") + (("ambiguous",) if verdict["missing"] else ())
        require(verdict["status"] in judged_by_words, f"{verdict['id']}: nothing is judged")


def drives_read(verdict: dict, objects: dict[str, dict]) -> list[str]:
    """The drives that the definitions of a verdict's equations were read from."""
    found = set()
    for reading in (*verdict["readings"], *verdict["corrected"], *verdict["contradiction"]):
        for part in reading["parts"]:
            for key in linked(objects, part["equation"], "equation")["where"].values():
                if (origin := linked(objects, key, "step")["read"]) is not None:
                    found.add(origin["drive"])
    return sorted(found)


def check_bindings(verdict: dict, source: dict, objects: dict[str, dict]) -> None:
    """Every equation belongs to this verdict and says what the source's reading, or the correction, says."""
    name = verdict["id"]
    said = dict(source["reading"])
    if source["figures"]:
        require(not said, f"{name}: both a reading and printed numbers")
        said = {"as printed": source["figures"]}
    readings = {reading["label"]: reading for reading in verdict["readings"]}
    require(
        sorted(said) == sorted(readings) and len(readings) == len(verdict["readings"]),
        f"{name}: the readings are not those of the source",
    )
    for label, reading in readings.items():
        require(reading["texts"] == said[label], f"{name}: {label!r} is not what the source reads")
    for role in ("corrected", "contradiction"):
        require(len(verdict[role]) <= 1, f"{name}: more than one {role}")
        require(all(reading["label"] == role for reading in verdict[role]), f"{name}: a {role} has another label")
    printed = [part["equation"] for reading in verdict["readings"] for part in reading["parts"]]
    for reading in (*verdict["readings"], *verdict["corrected"], *verdict["contradiction"]):
        texts = reading["texts"] or [None] * len(reading["parts"])
        require(len(texts) == len(reading["parts"]), f"{name}: an equation is missing or added")
        for number, (part, text) in enumerate(zip(reading["parts"], texts, strict=True), 1):
            equation = linked(objects, part["equation"], "equation")
            if part["equation"] in printed and reading["label"] == "corrected":
                continue  # a part that is right as printed
            require(equation["id"] == f"{name}/{reading['label']}/{number}", f"{name}: an equation of another verdict")
            require(equation["sources"] == [verdict["source"]], f"{name}: an equation of another source")
            try:
                check_content(equation, text, source, [objects[key] for key in printed])
            except (Rejected, *UNREADABLE) as error:
                raise Rejected(f"{name}: {error}") from error


def check_content(equation: dict, text, source: dict, printed: list[dict]) -> None:
    """The trees are those of the text; the statement is not its own left side."""
    sides = [equation["lhs"], equation["rhs"]]
    corrected = equation["kind"] == "corrected"
    if type(text) is list:
        require(sides == [read_formula(text[0]), text[1]], "a formula is not that of the source")
        print_ = re.sub("[\ufffd\u2212]", "-", source["verbatim"])  # glyphs that stand for minus
        stated = corrected or text[1] in (">0", "<0") or re.search(rf"(?<![\d.]){re.escape(text[1])}(?!\d)", print_)
        require(stated, f"the number {text[1]} does not stand in the print")
        return
    if text is None:
        require(corrected, "an equation has no text")
        require(
            any((sides[0] == p["lhs"]) != (sides[1] == p["rhs"]) for p in printed),
            "a correction changes more than one side of what is printed",
        )
    else:
        require(sides == read_equation(text, equation["jets"]), f"the equation is not {text!r}")
    require(arranged(sides[0]) != arranged(sides[1]), "both sides of the statement are the same expression")
    require(not corrected or sides not in [[p["lhs"], p["rhs"]] for p in printed], "nothing is corrected")


def is_proved(verdict: dict, objects: dict[str, dict]) -> bool:
    """Proved as printed, or in one reading of a damaged print."""
    return any(outcome_of(reading, verdict, objects) == "proved" for reading in verdict["readings"])
