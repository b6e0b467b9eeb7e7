"""What is printed of drives, read from its text."""

import ast
import re
from dataclasses import dataclass, replace
from fnmatch import fnmatch
from fractions import Fraction

from .refusal import Rejected, require


@dataclass(frozen=True)
class Statement:
    """One printed statement: what it is about, its two sides (or one), and where it stands."""

    kind: str
    about: tuple[str, ...]
    sides: tuple[object, ...]
    source: str
    text: str


#: An abbreviation of a section without statements: it holds in all sections that follow.
LET_ALONE = "let"
LET = re.compile(r"let (\w+): (.*)")
LINE = re.compile(r"(\w+)((?: [\w/]+)*): (.*?) *\| (.+)")


def read_printed(text: str) -> list[tuple[list[str], list[Statement]]]:
    """Sections: patterns of the names of drives, and what is printed of them; abbreviations, where there is nothing
    else.
    """
    sections: list[tuple[list[str], list[Statement]]] = []
    for part in re.split(r"^(?=\[)", re.sub(r"\n +", " ", text), flags=re.M)[1:]:
        head, *lines = part.splitlines()
        names = head.strip("[]").split()
        words = [name.split(":") for name in names if ":" in name or not PATTERN.search(name)]
        patterns = [p for name in names if ":" not in name and PATTERN.search(name) for p in alternatives(name)]
        for word, other, *without in [[*word, *word[:1]][:2] + word[2:] for word in words or [["$", "%"]]]:
            found: dict[str, Statement] = {}
            let: dict[str, object] = {}
            for line in lines:
                if line and not line.startswith("#"):
                    _read_line(line.replace("$", word).replace("%", other), let, found)
            shared = [Statement(LET_ALONE, (name,), (value,), "", "") for name, value in let.items()]
            sections.append(([*patterns, *without], list(found.values()) or shared))
    return sections


def alternatives(pattern: str) -> list[str]:
    """``a_{b,c}`` is ``a_b`` and ``a_c``."""
    match = re.search(r"{([^{}]*)}", pattern)
    if not match:
        return [pattern]
    words = (pattern[: match.start()] + word + pattern[match.end() :] for word in match[1].split(","))
    return [found for word in words for found in alternatives(word)]


def is_about(name: str, patterns: list[str]) -> bool:
    """Is a drive among those named? A pattern after an exclamation mark leaves drives out."""
    left_out = [pattern[1:] for pattern in patterns if pattern.startswith("!")]
    return any(fnmatch(name, p) for p in patterns) and not any(fnmatch(name, p) for p in left_out)


def _read_line(line: str, let: dict[str, object], found: dict[str, Statement]) -> None:
    """An abbreviation, or a statement."""
    if match := LET.fullmatch(line):
        let[match[1]] = replaced(read_expression(match[2]), let)
        return
    match = LINE.fullmatch(line)
    require(match, f"printed.txt: not a statement: {line[:60]}")
    sides = tuple(replaced(read_expression(side), let) for side in match[3].split(" = "))
    found[line] = Statement(match[1], tuple(match[2].split()), sides, match[4], line)


def replaced(e: object, values: dict[str, object]) -> object:
    """An expression, vector or motion with abbreviations written out."""
    if isinstance(e, str):
        return values.get(e, e)
    if isinstance(e, tuple):
        return tuple(replaced(part, values) for part in e)
    if not isinstance(e, list):
        return e
    return [e[0] if isinstance(e[0], str) else replaced(e[0], values), *(replaced(part, values) for part in e[1:])]


#: A pattern of names of drives; any other word stands for $.
PATTERN = re.compile(r"[*_]")
OPERATORS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/", ast.Pow: "^", ast.MatMult: "@"}


def read_expression(text: str) -> object:
    """An expression as a description writes it: prefix lists; a vector as a tuple, a motion as a list of factors."""
    return _node(ast.parse(text, mode="eval").body)


def _node(node: ast.expr) -> object:
    match node:
        case ast.Name(name):
            return ["pi"] if name == "pi" else name
        case ast.Constant(int() as value):
            return value
        case ast.Constant(float() as value):
            exact = Fraction(str(value))
            return ["/", exact.numerator, exact.denominator]
        case ast.Tuple(elements):
            return tuple(map(_node, elements))
        case ast.UnaryOp(ast.USub(), operand):
            return ["*", -1, _node(operand)]
        case ast.BinOp(left, ast.Pow(), ast.Constant(int() as power)):
            return ["^", _node(left), power]
        case ast.BinOp(left, operator, right):
            a, b = _node(left), _node(right)
            match OPERATORS[type(operator)]:
                case "@":
                    return [*a, *b]
                case "-":
                    return ["+", a, ["*", -1, b]]
                case "/" if isinstance(a, int) and isinstance(b, int):
                    return ["/", a, b]
                case "/" if isinstance(b, int):
                    return ["*", ["/", 1, b], a]
                case "/":
                    return ["*", a, ["^", b, -1]]
                case sign:
                    return [sign, a, b]
        case ast.Call(ast.Name("T"), parts):
            return [["translation", [_node(part) for part in parts]]]
        case ast.Call(ast.Name("F"), columns):
            return [["placement", [list(_node(column)) for column in columns]]]
        case ast.Call(ast.Name("Rx" | "Ry" | "Rz" as name), [angle]):
            return [["rotation", name[1], _node(angle)]]
        case ast.Call(ast.Name(name), parts):
            return [name, *map(_node, parts)]
    raise Rejected(f"printed.txt: {ast.unparse(node)[:60]} has no meaning")


def statements_of(name: str, printed: list) -> list[Statement]:
    """What is printed of a drive."""
    common: dict[str, object] = {}
    chosen: list[Statement] = []
    for statement in (s for patterns, found in printed if is_about(name, patterns) for s in found):
        sides = tuple(replaced(side, common) for side in statement.sides)
        if statement.kind == LET_ALONE:
            common[statement.about[0]] = sides[0]
        else:
            chosen.append(replace(statement, sides=sides))
    return chosen
