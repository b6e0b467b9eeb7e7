"""Generated C as text: straight-line functions, their tables of outputs, guards, lanes and constants."""

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from pathlib import Path

from .enclosure import number_of
from .refusal import foreseen

DIVISOR = 720
PI_ENCLOSED = number_of("pi").middle
STATEMENT = re.compile(
    r"const double (\w+) = (.+);|(\w+\[\d+\]) = (.+);|"
    r"double (\w+), (\w+); \w+_sincos\((.+), &\5, &\6(?:, at \+ \d+, &away)?\);"
)
SILENT = re.compile(r"\(void\)|double away = 0\.0;|if \(|int failed|return |[{}]|$")
OPERAND = r"\(?-?[\w.\[\]]+(?:e[+-]?\d+)?\)?"
BINARY = re.compile(rf"({OPERAND}) ([-+*/]) ({OPERAND})")
CALL = re.compile(r"(?:\w+_)?(sqrt|atan2|SIGN)\((.+)\)")
#: Lines of the lanes that hold no value of an instance: loops, guards and sizes of steps.
LANE_SILENT = re.compile(r"MW_LANE_(LOOP|PAIRS)|const int m = |(valid|size)\[[lm]\] = |}$")
#: A result that is no number where a value that it rests on does not exist.
TESTED = re.compile(r"\(.+\) \? (\S+) : NAN")
#: A product and a number: a b + c, a b - c, c - a b.
FUSED = re.compile(rf"MW_(FMA|FMS|FNMA)\(({OPERAND}), ({OPERAND}), ({OPERAND})\)")


@cache
def parsed(text: str) -> tuple[str, ...]:
    """A right-hand side: its operation and operands."""
    if match := TESTED.fullmatch(text):
        return ("value", match[1])
    if match := CALL.fullmatch(text):
        return (match[1], *match[2].split(", "))
    if match := FUSED.fullmatch(text):
        return match.groups()
    if match := BINARY.fullmatch(text):
        return (match[2], match[1], match[3])
    return ("value", text)


@cache
def literal_of(text: str) -> tuple[Fraction, dict | None] | None:
    """A decimal; one of all digits stands for the nearest simple multiple of pi, fraction or short decimal that it is a
    double of.
    """
    if not re.fullmatch(r"-?[\d.]+(e[+-]?\d+)?", text):
        return None
    exact = Fraction(text)
    if len(re.sub(r"e.*|\D", "", text)) >= 15:
        times = Fraction(float(exact) / math.pi).limit_denominator(DIVISOR)
        near = exact.limit_denominator(DIVISOR)
        if times and abs(float(times * PI_ENCLOSED) - float(exact)) <= math.ulp(float(exact)):
            return times, {"pi": times}
        short = Fraction(f"{float(exact):.6g}")
        if float(near) == float(exact):
            exact = near
        elif abs(float(short) - float(exact)) <= math.ulp(float(exact)):
            exact = short
    return exact, None


@dataclass(frozen=True)
class Function:
    """A straight-line function.

    Name -> ("expression", text) or ("sin" | "cos", text of the angle), and its table of outputs.
    """

    name: str
    definitions: dict[str, tuple[str, str]]
    outputs: dict[str, tuple[int, int]]

    @property
    def implicit(self) -> bool:
        """Does an equation of meshing stay beside the surface?"""
        return any(key.startswith("condition_") for key in self.outputs)

    def size_of(self, letter: str) -> int:
        """How many entries of an argument it reads."""
        text = " ".join(text for _, text in self.definitions.values())
        return 1 + max(map(int, re.findall(rf"\b{letter}\[(\d+)\]", text)), default=-1)


@dataclass(frozen=True)
class Header:
    """A generated header: its functions by their names without the prefix, and what they take."""

    functions: dict[str, Function]
    parameters: int
    frames: tuple[tuple[str, ...], ...]
    sizes: dict[str, int]
    unknowns: dict[str, tuple[int, ...]]
    guards: tuple[Function, dict[int, str]]
    lanes: str = ""
    tangents: str = ""
    anchored: tuple[str, str] = ("", "")  # what stands in the anchor, and in the residual by it


def read_header(text: str, lanes: str = "", tangents: str = "") -> Header:
    """The straight-line functions of a header, with the texts of its lanes and of its tangents."""
    prefix, text = re.search(r"static inline int (\w+)_setup\(", text)[1], numbered(text)
    wanted = (
        rf"{prefix}_(setup|set_phi|scale|eval|by_anchor|step|along|start_eval|observe|(?:curvature_)?(?:flank|fillet)_\w+)"
    )
    found = {}
    pattern = rf"((?:/\*(?:[^*]|\*(?!/))*\*/\s)*)(?:MW_DEVICE )?static inline \w+ {wanted}\([^)]*\)\n{{\n(.*?)\n}}"
    for match in re.finditer(pattern, text, re.DOTALL):
        table = {
            name: (int(at), int(size or 1))
            for at, name, size in re.findall(r"^ \* +(\d+) (\w+)(?:\[(\d+)\])?", match[1], re.M)
        }
        found[match[2]] = Function(match[2], read_body(match[3]), table)
    sizes = {name: function.size_of(letter_of(name)) for name, function in found.items()}
    unknowns = {
        body: tuple(map(int, places.split(",")))
        for body, places in re.findall(rf"int {prefix}_(\w+)_unknowns\[\] = {{ ([\d, ]+) }}", text)
    }
    parameters = max(function.size_of("p") for function in found.values())
    guards = guards_of(body_of(text, f"{prefix}_setup"))
    anchored = body_of(text, f"{prefix}_anchor"), body_of(text, f"{prefix}_by_anchor")
    return Header(found, parameters, read_frames(text), sizes, unknowns, guards, lanes, tangents, anchored)


def numbered(text: str) -> str:
    """A header with places of its state by number where it has names: MW_S(name) is s[k], for name k of its list."""
    prefix = re.search(r"static inline int (\w+)_setup\(", text)[1]
    listed = re.search(rf"^enum {{\n((?: +{prefix}_S_\w+,?\n)+)}};$", text, re.M)
    places = {name: k for k, name in enumerate(re.findall(rf" {prefix}_S_(\w+)", listed[1]))} if listed else {}
    defined = re.findall(r"#.*\bMW_S\b.*", text)
    foreseen(defined == [f"#define MW_S(name) s[{prefix}_S_##name]", "#undef MW_S"], "MW_S is another macro")
    text = re.sub(r"\bMW_S\((\w+)\)", lambda m: f"s[{places[m[1]]}]" if m[1] in places else m[0], text)
    count, slots = (int(re.search(rf"#define {prefix}_{size} (\d+)\n", text)[1]) for size in ("NP", "NS"))
    kept = "".join(f"    s[{slots - count + k}] = p[{k}];\n" for k in range(count))
    return text.replace(KEPT.replace("X", prefix), kept)


#: How a setup keeps the parameters, and forgets what was known of its pair.
KEPT = "    s[X_MEMORY] = NAN;\n    for (int k = 0; k < X_NP; k++) s[X_NS - X_NP + k] = p[k];\n"


def letter_of(name: str) -> str:
    """The argument along which a function is differentiated."""
    return "q" if "flank_" in name or "fillet_" in name else "y" if name == "start_eval" else "x"


def read_companion(path: Path, ending: str) -> str:
    """The text of a header's lanes or tangents; empty where there are none."""
    companion = path.with_name(f"{path.stem}_{ending}.h")
    return companion.read_text(encoding="utf-8") if companion.is_file() else ""


COMMENT = re.compile(r" */\*.*?\*/", re.DOTALL)


def body_of(text: str, name: str) -> str:
    """What stands between the braces of a function, by its name."""
    return COMMENT.sub("", re.search(rf"\b{name}\)?\([^)]*\)\n{{\n(.*?)\n}}", text, re.DOTALL)[1])


def read_lanes(text: str, name: str) -> Function:
    """A function over many instances as one over two: entry k of instance l is x[k], of its partner m mx[k]."""
    prefix = re.search(r"MW_LANE_NAME\((\w+)_setup_lanes\)", text)[1]
    body = re.sub(r"\b(\w)\[(\d+) \* MW_LANES \+ l\]", r"\1[\2]", body_of(text, f"{prefix}_{name}_lanes"))
    body = re.sub(r"\b(\w)\[(\d+) \* MW_LANES \+ m\]", r"m\1[\2]", body).replace("phi[l]", "phi")
    lines = [line for line in map(str.strip, body.splitlines()) if not LANE_SILENT.match(line)]
    return Function(name, read_body("\n".join(lines)), {})


def read_frames(text: str) -> tuple[tuple[str, ...], ...]:
    """Parameters that are the components of three axes: `..._axis_x_x` to `..._axis_z_z` in the table of parameters."""
    table = re.search(r"_parameter_names\[\] = {\n(.*?)\n};", text, re.DOTALL)[1]
    keys = [re.findall(r'"([^"]*)"', line)[3] for line in table.splitlines()]
    stems = sorted({key[: -len("_axis_x_x")] for key in keys if key.endswith("_axis_x_x")})
    return tuple(
        tuple(f"p[{keys.index(f'{stem}_axis_{axis}_{part}')}]" for axis in "xyz" for part in "xyz") for stem in stems
    )


def read_body(body: str) -> dict[str, tuple[str, str]]:
    definitions: dict[str, tuple[str, str]] = {}
    for line in without_blocks(body):
        statement = STATEMENT.fullmatch(line)
        if statement is None:
            foreseen(SILENT.match(line), f"not a straight-line statement: {line}")
        elif statement[5]:
            definitions[statement[5]], definitions[statement[6]] = ("sin", statement[7]), ("cos", statement[7])
        else:
            target = statement[1] or statement[3]
            # an argument that is also the result keeps its first value under its own name
            target = f"new {target}" if target.startswith(("x[", "mx[")) else target
            definitions[target] = ("expression", statement[2] or statement[4])
    return definitions


def without_blocks(body: str) -> Iterator[str]:
    """The lines outside inner braces, which hold the guards of the design."""
    depth = 0
    for line in map(str.strip, COMMENT.sub("", body).splitlines()):
        depth += line.count("{")
        if not depth:
            yield line
        depth -= line.count("}")


GUARD = re.compile(r"if \(!\((\S+) > 0\.0\)\) failed = (\d+);")


def guards_of(body: str) -> tuple[Function, dict[int, str]]:
    """The block of a setup that holds its guards, and place -> what must be positive."""
    block = re.search(r"^    {\n(.*?)^    }", body, re.DOTALL | re.M)[1]
    return Function("guards", read_body(block), {}), {int(place) - 1: name for name, place in GUARD.findall(block)}
