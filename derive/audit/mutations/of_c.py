"""Changes of C: of functions in their text, of certified tables."""

import re
from collections.abc import Iterator

from derive.audit.checker.tables import CODE_OF

NUMBER = r"(?<![\w.])-?\d+\.\d+(?:e[+-]?\d+)?"
OPERAND = r"(?:MW_S\(\w+\)|\(?-?[\w.\[\]]+\)?)"
#: What stands in a right-hand side, and what it is changed into: signs, constants, operands, terms, indices.
CHANGES = (
    (r" \+ ", lambda m: " - "),
    (r" - ", lambda m: " + "),
    (r"MW_FMA\(", lambda m: "MW_FNMA("),
    (r"MW_FMS\(", lambda m: "MW_FMA("),
    (r"MW_FNMA\(", lambda m: "MW_FMA("),
    (NUMBER, lambda m: repr(float(m[0]) * 1.5 if float(m[0]) else 0.25)),
    (rf"({OPERAND}) ([-/]) ({OPERAND})(?=;)", lambda m: f"{m[3]} {m[2]} {m[1]}"),
    (r"(atan2)\(([^,()]+), ([^,()]+)\)", lambda m: f"{m[1]}({m[3]}, {m[2]})"),
    (rf"({OPERAND}) [-+] {OPERAND}(?=;)", lambda m: m[1]),
    (r"(?<=[= (])([psxqyv])\[(\d+)\]", lambda m: f"{m[1]}[{int(m[2]) + 1}]"),
    (r"MW_S\(\w+\)(?! =)", lambda m: "s[0]"),
    (r"&(m?sin_\w+), &(m?cos_\w+)\)", lambda m: f"&{m[2]}, &{m[1]})"),
)


def functions_of(drive: str, text: str) -> Iterator[tuple[str, int, int]]:
    """Name of each function of a header, and where its body stands."""
    names = rf"(?:static inline|MW_INLINE|MW_CALLED) \w+ (?:MW_LANE_NAME\()?{drive}_(\w+)\)?"
    for found in re.finditer(rf"{names}\([^)]*\)\n{{\n(.*?)\n}}", text, re.DOTALL):
        yield found[1], found.start(2), found.end(2)


def of_header(drive: str, text: str) -> Iterator[tuple[str, list[tuple[str, int, int, str]]]]:
    """Of each function what can be changed: words, place, and what to put there."""
    for function, start, end in functions_of(drive, text):
        found = []
        for line in re.finditer(r"[^\n]+", text[start:end]):
            code = line[0].partition("/*")[0]
            rows = re.search(r"chosen\[\] = {", code)
            if not (rows or re.search(r" = |sincos\(", code)) or re.match(r" *(if|for) ", code):
                continue
            for pattern, other in CHANGES if not rows else ((r"\b\d+\b", lambda m: str(int(m[0]) + 1)),):
                for match in re.finditer(pattern, code):
                    at = start + line.start()
                    words = f"{code.strip()[:60]} @{match.start()}: {match[0]} -> {other(match)}"
                    found.append((words, at + match.start(), at + match.end(), other(match)))
        if found:
            yield function, found


#: Number of an operation -> another: sum, difference, product.
OTHER_OPERATION = {0: 1, 1: 0, 2: 0, 3: 2, 4: 2}


def of_tables(drive: str, text: str) -> Iterator[tuple[str, list[tuple[str, int, int, str]]]]:
    """Of each table what can be changed: an operation, an operand, a constant, a place of an input or an output."""
    for code in re.finditer(rf"\b{drive}_certified_(\w+)_operation\[\] = {{([^}}]*)}};", text):
        name, at, found = code[1], code.start(2), []
        numbers = list(re.finditer(r"\d+", code[2]))
        for k in range(0, len(numbers) - 3, 4):
            operation, _, a, b = numbers[k : k + 4]
            words = f"instruction {k // 4}"
            if int(operation[0]) in OTHER_OPERATION:
                other = str(OTHER_OPERATION[int(operation[0])])
                found.append((f"{words}: operation", at + operation.start(), at + operation.end(), other))
            if int(operation[0]) in (1, 4, 8) and a[0] != b[0]:
                found.append((f"{words}: operands", at + a.start(), at + b.end(), f"{b[0]},{a[0]}"))
            found.append((f"{words}: register", at + a.start(), at + a.end(), str(int(a[0]) - 1 if int(a[0]) else 1)))
        for kind, pattern in (("constant", r"(?<={ )-?[\d.e+-]+"), ("input", r"\d+"), ("output", r"\d+")):
            table = re.search(rf"\b{drive}_certified_{name}_{kind}\[\] = {{(.*)}};", text)
            if table is None:
                continue
            size = _size_of(text, f"{drive}_certified_{name}", kind)
            for k, match in enumerate(list(re.finditer(pattern, table[1]))[:size]):
                value = float(match[0]) if kind == "constant" else int(match[0])
                other = repr(value * 1.5 or 0.25) if kind == "constant" else str(value + 1)
                found.append((f"{kind} {k}", table.start(1) + match.start(), table.start(1) + match.end(), other))
        if found:
            yield name, found


def _size_of(text: str, name: str, kind: str) -> int:
    sizes = next(m for m in CODE_OF.finditer(text) if m[7] == name)
    return int(sizes[{"input": 2, "constant": 3, "output": 6}[kind]])
