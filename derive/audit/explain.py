"""Walk through the record as written: generated function -> equations -> definitions -> source lines."""

import difflib
import json
from pathlib import Path

from derive.audit.plain_text import text, words_of
from derive.passes.guards import GUARDS


class Unknown(Exception):
    """A name that neither the record nor the generated headers hold."""


def explain(generated: Path, name: str) -> list[str]:
    """Lines of text for an equation id (`cylindrical_worm.meshing`, `recess-action/eq-7`), a function of a generated
    header, or a drive: its side conditions and what guards them.
    """
    objects = _objects(generated / "audit")
    verdicts = {item["id"]: item for item in objects.values() if item["object"] == "verdict"}
    key = name if name in verdicts else name.replace(".", "/", 1)
    if key in verdicts:
        return _verdict(generated, objects, verdicts[key])
    functions = _functions(generated)
    if name in functions:
        path, line, keys = functions[name]
        lines = [f"{name}   {path}:{line}", ""]
        for each in keys:
            verdict = verdicts[each]
            lines.append(f"{each:<36} {verdict['status']:<24} {verdict['plain']}")
        return lines + _side_conditions(generated, path, name)
    drives = sorted(path.stem for path in (generated / "c").glob("*.json"))
    if name in drives:
        return [name, *_open(generated, f"{name}.json"), *_side_conditions(generated, f"{name}.json")]
    close = difflib.get_close_matches(key, [*verdicts, *functions, *drives], 5, 0.4)
    raise Unknown(f"no equation or generated function {name!r}" + (f"; close: {', '.join(close)}" if close else ""))


def _open(generated: Path, file: str) -> list[str]:
    """The statements that a drive cites and that are not proved of it."""
    found = json.loads((generated / "c" / file).read_text(encoding="utf-8"))["open"]
    return ["", "open statements", *(f"  {name}: {reason}" for name, reason in found.items())] if found else []


def _side_conditions(generated: Path, header: str, function: str = "") -> list[str]:
    """What the divisions, roots and arcs of a function, or of the whole drive, need and what answers otherwise."""
    description = json.loads((generated / "c" / Path(header).name).with_suffix(".json").read_text(encoding="utf-8"))
    own = function.removeprefix(description["prefix"] + "_")
    lines = ["", "side conditions"]
    for entry in description["side_conditions"]:
        uses = {name: use for name, use in entry["functions"].items() if not function or name == own}
        if uses:
            lines.append(f"  {entry['operation']:<10} {entry['condition']}   [{', '.join(entry['equations'])}]")
        for name, use in uses.items():
            for guard in use["guards"]:
                lines.append(f"    {name} ({use['count']}×): {_guard(description, guard)}")
    return lines if len(lines) > 2 else []


def _guard(description: dict, guard: str) -> str:
    kind, _, number = guard.partition(" ") if guard.startswith("setup ") else (guard, "", "")
    told = f" {number}, {description['guards'][int(number) - 1]['message']}" if number else ""
    return f"{kind}{told}: {GUARDS[kind]}"


def _carried(generated: Path, equation: str) -> list[str]:
    """The side conditions of the generated code that a statement carries."""
    found: dict[str, set[str]] = {}
    for path in sorted((generated / "c").glob("*.json")):
        for entry in json.loads(path.read_text(encoding="utf-8"))["side_conditions"]:
            if equation in entry["equations"][:1]:
                found.setdefault(f"{entry['operation']:<10} {entry['condition']}", set()).add(path.stem)
    lines = [f"  {text}   ({len(drives)} drive{'s' * (len(drives) > 1)})" for text, drives in found.items()]
    return ["", "side conditions of the generated code that it carries", *lines] if lines else []


def _objects(folder: Path) -> dict[str, dict]:
    objects: dict[str, dict] = {}
    for name in ("ledger.jsonl", "certificates.jsonl"):
        try:
            text = (folder / name).read_text(encoding="utf-8")
        except FileNotFoundError as error:
            raise Unknown(f"there is no record at {folder}; run python -m derive first") from error
        objects |= {item["sha256"]: item for item in map(json.loads, text.splitlines())}
    return objects


def _functions(generated: Path) -> dict[str, tuple[str, int, list[str]]]:
    """Function -> header, line and equation ids."""
    from derive.audit.record import functions_of

    found = {}
    for path in sorted((generated / "c").glob("*.h")):
        text = path.read_text(encoding="utf-8")
        for function, keys in functions_of(text).items():
            found[function] = (
                path.relative_to(generated.parent).as_posix(),
                text[: text.index(f" {function}(")].count("\n") + 1,
                keys,
            )
    return found


def _verdict(generated: Path, objects: dict[str, dict], verdict: dict) -> list[str]:
    source = objects[verdict["source"]]
    lines = [
        f"{verdict['id']}: {verdict['status']}",
        verdict["plain"],
        "",
        f"source     {source['document']}, {source['locator']}",
    ]
    if source["verbatim"]:
        told = "transliterated" if source["offset"] is None else f"character {source['offset']}"
        lines.append(f"printed    {source['verbatim']}   ({told})")
    if source["ocr_doubt"]:
        lines.append(f"extraction {source['ocr_doubt']}")
    for role in ("readings", "corrected", "contradiction"):
        for reading in verdict[role]:
            lines += ["", reading["label"]]
            for part in reading["parts"]:
                lines += _part(objects, part)
    users = [
        f"{function}   {path}:{line}"
        for function, (path, line, keys) in _functions(generated).items()
        if verdict["id"] in keys
    ]
    if users:
        lines += ["", "generated functions that rest on it", *(f"  {user}" for user in users)]
    for path in sorted((generated / "c").glob("*.json")):
        if reason := json.loads(path.read_text(encoding="utf-8"))["open"].get(verdict["id"]):
            lines += ["", f"open for {path.stem}: {reason}"]
    return lines + _carried(generated, verdict["id"])


def _part(objects: dict[str, dict], part: dict) -> list[str]:
    equation, certificate = objects[part["equation"]], objects[part["certificate"]]
    lines = [
        f"  {text(equation['lhs'])} = {text(equation['rhs']) if certificate['kind'] != 'numeric' else equation['rhs']}"
    ]
    for name, key in equation["where"].items():
        step = objects[key]
        lines.append(f"    {name} := {text(step['tree'])}    [{step['op']} {key[:12]}]")
        if step["read"]:
            lines.append(f"      read: {step['read']['drive']}, {words_of(step['read']['part'])}")
    shown, stated = certificate["sha256"][:12], equation["sha256"][:12]
    lines.append(f"    {certificate['outcome']} by {certificate['kind']} {shown}, equation {stated}")
    if certificate["outcome"] == "refuted" and "point" in certificate:
        values = {
            **certificate["point"]["symbols"],
            **{f"tan({name}/2)": value for name, value in certificate["point"]["half_tangents"].items()},
        }
        lines.append("    at " + ", ".join(f"{name} = {value}" for name, value in values.items()))
        lines.append(f"    left {', '.join(certificate['lhs'])}; right {', '.join(certificate['rhs'])}")
    return lines
