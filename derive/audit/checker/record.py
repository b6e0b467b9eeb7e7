"""The objects of the record: their form, hashes and links."""

import hashlib
from pathlib import Path

from .lines import read_lines, sha256_of
from .refusal import require

_POINT = {"angles", "arcs", "point", "lhs", "rhs", "rounded"}
KEYS = {
    "source": {"id", "document", "document_sha256", "locator", "verbatim", "ocr_doubt", "reading", "figures"}
    | {"offset"},
    "step": {"id", "op", "tree", "inputs", "read"},
    "equation": {"id", "kind", "lhs", "rhs", "where", "jets", "signs", "side_conditions", "unit", "sources"},
    "verdict": {"id", "source", "status", "plain", "readings", "corrected", "contradiction", "change", "missing"}
    | {"damage", "drops", "described"},
    "ring_nf": {"kind", "outcome", "equation", "generators", "roots", "relations", "components", "degree"} | _POINT,
    "exact_point": {"kind", "outcome", "equation", "roots", "differs"} | _POINT,
    "undecided": {"kind", "outcome", "equation", "angles", "arcs"},
    "numeric": {"kind", "outcome", "equation", "value"},
}
#: Keys of any object whose value is text.
TEXTS = {
    "id", "kind", "document", "document_sha256", "locator", "verbatim", "ocr_doubt", "op", "unit", "source", "status",
    "plain", "missing", "damage", "drops", "outcome", "change",
}  # fmt: skip
EQUATIONS = ("printed", "derived", "corrected")
OPERATIONS_OF_STEPS = {"d": "diff", "cross": "cross", "dot": "dot", "triple": "dot", "@": "matmul"}


def read_record(folder: Path) -> dict[str, dict]:
    """Every object by its hash, after recomputing it."""
    objects: dict[str, dict] = {}
    for name in ("ledger.jsonl", "certificates.jsonl"):
        for number, item in enumerate(read_lines(folder / name), 1):
            kind = item.get("object")
            require((kind == "certificate") == (name == "certificates.jsonl"), f"{name} line {number}: a {kind} here")
            shape = KEYS.get(item.get("kind") if kind == "certificate" else kind)
            require(shape is not None, f"{name} line {number}: unknown object {kind!r}")
            require(set(item) == shape | {"object", "sha256"}, f"{name} line {number}: not the keys of a {kind}")
            require(all(type(item[key]) is str for key in TEXTS & set(item)), f"{name} line {number}: a text is none")
            require(FORMS.get(kind, bool)(item), f"{name} line {number}: not the form of a {kind}")
            require(item["sha256"] == sha256_of(item), f"{name} line {number}: the hash is not that of the line")
            require(item["sha256"] not in objects, f"{name} line {number}: repeated")
            objects[item["sha256"]] = item
    return objects


def formed_step(step: dict) -> bool:
    """Whether a definition is typed, or says where it was read."""
    return step["read"] is None or (type(step["read"]) is dict and set(step["read"]) == {"drive", "letters", "part"})


def formed_equation(equation: dict) -> bool:
    """Whether what an equation says of itself beside its two sides has the form that it must have."""
    jets, conditions = equation["jets"], equation["side_conditions"]
    return (
        equation["kind"] in EQUATIONS
        and type(jets) is dict
        and all(names and distinct_texts(names) for names in jets.values())
        and distinct_texts(conditions)
        and distinct_texts(equation["signs"])
        and all(name.isidentifier() for name in equation["signs"])
    )


def formed_verdict(verdict: dict) -> bool:
    """Whether its readings are lists of texts, each part with an equation and its certificate."""
    if not distinct_texts(verdict["described"]):
        return False
    readings = [verdict[role] for role in ("readings", "corrected", "contradiction")]
    return all(
        type(reading) is dict
        and set(reading) == {"label", "parts", "texts"}
        and type(reading["label"]) is str
        and type(reading["texts"]) is list
        and type(reading["parts"]) is list
        and all(type(part) is dict and set(part) == {"certificate", "equation"} for part in reading["parts"])
        and all(type(part[key]) is str for part in reading["parts"] for key in part)
        for reading in [each for role in readings if type(role) is list for each in role]
    ) and all(type(role) is list for role in readings)


def formed_certificate(certificate: dict) -> bool:
    texts = (certificate["equation"], certificate.get("value", ""))
    return (
        all(type(text) is str for text in texts)
        and type(certificate.get("rounded", False)) is bool
        and certificate["outcome"] in ("proved", "refuted", "undecided")
    )


def formed_source(source: dict) -> bool:
    """Whether a text is said to stand at a place of its document, or nowhere: then it is a transliteration."""
    at = source["offset"]
    return at is None or (type(at) is int and at >= 0 and source["verbatim"] != "")


FORMS = {
    "source": formed_source,
    "step": formed_step,
    "equation": formed_equation,
    "verdict": formed_verdict,
    "certificate": formed_certificate,
}


def distinct_texts(items: list) -> bool:
    return type(items) is list and all(type(item) is str for item in items) and len(items) == len(set(items))


def root_of(objects: dict[str, dict]) -> str:
    """One hash over all objects."""
    return hashlib.sha256("\n".join(sorted(objects)).encode()).hexdigest()


def linked(objects: dict[str, dict], key: str, kind: str) -> dict:
    require(key in objects and objects[key]["object"] == kind, f"a link to a {kind} leads nowhere")
    return objects[key]


def definitions_of(equation: dict, objects: dict[str, dict]) -> dict:
    """Name -> tree, each step under its own name."""
    found = {}
    for name, key in equation["where"].items():
        step = linked(objects, key, "step")
        require(step["id"].rpartition(".")[2] == name, f"{equation['id']}: {name} is another step's name")
        found[name] = step["tree"]
    return found


def check_step(step: dict, objects: dict[str, dict]) -> None:
    """A definition rests on the steps whose names it uses, and on no other; its operation is that of its tree."""
    used = {linked(objects, key, "step")["id"].rpartition(".")[2] for key in step["inputs"]}
    require(used <= names_in(step["tree"]), f"{step['id']}: an input is not used")
    require(step["inputs"] == sorted(set(step["inputs"])), f"{step['id']}: inputs are not in order")
    operation = step["tree"][0] if type(step["tree"]) is list else ""
    require(step["op"] == OPERATIONS_OF_STEPS.get(operation, "define"), f"{step['id']}: not the operation of its tree")


def names_in(tree) -> set:
    if type(tree) is list:
        return set().union(*map(names_in, tree))
    return {tree} if type(tree) is str else set()


def check_use(objects: dict[str, dict]) -> None:
    """One certificate an equation, and nothing in the record that no verdict rests on."""
    certificates = [item for item in objects.values() if item["object"] == "certificate"]
    require(len({item["equation"] for item in certificates}) == len(certificates), "an equation has two certificates")
    require(any(item["object"] == "verdict" for item in objects.values()), "the record holds no verdict")
    identifiers = [item["id"] for item in objects.values() if item["object"] in ("verdict", "equation", "source")]
    verdicts = [item["id"] for item in objects.values() if item["object"] == "verdict"]
    require(len(set(verdicts)) == len(verdicts), "two verdicts have one name")
    require(len(set(identifiers)) == len(identifiers) - len(verdicts), "two objects have one name")
    reached: set = set()
    pending = [item["sha256"] for item in objects.values() if item["object"] == "verdict"]
    while pending:
        key = pending.pop()
        if key not in reached:
            reached.add(key)
            pending += [link for link in names_in(listed(objects[key])) if link in objects]
    require(reached == set(objects), "the record holds an object that no verdict rests on")


def listed(value):
    """Lists for dictionaries."""
    if type(value) is dict:
        return [listed(part) for part in value.values()]
    return [listed(part) for part in value] if type(value) is list else value
