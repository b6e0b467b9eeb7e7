"""A drive: its description beside its functions, and inputs for both."""

import re
from fractions import Fraction
from random import Random

from .description import Reader
from .draws import once
from .machine import Machine, machine
from .modular import PRIME, Number
from .refusal import require
from .straight_line import Function, numbered, read_body, read_header


class Drive:
    """What is compared: the description, the header, and inputs for both."""

    def __init__(self, description: dict, text: str, tangents: str = ""):
        self.description, self.text, self.tangents = description, numbered(text), tangents
        self.functions: dict[str, Function] = {}
        self.tables: dict[str, str] = {}
        self.header = read_header(text)
        self.prefix = re.search(r"static inline int (\w+)_setup\(", text)[1]
        self.named = {entry["name"]: entry["value"] for entry in description["definitions"]}
        self.parameters = self._names("parameter")
        self.unknowns = self._names("unknown")

    def _names(self, kind: str) -> list[str]:
        return re.findall(r'^\s*{ "([^"]*)"', self.table(f"{kind}_names"), re.M)

    def table(self, name: str) -> str:
        """The lines of a table of the header by the end of its name."""
        if name not in self.tables:
            self.tables[name] = re.search(rf"_{name}\[\] = {{\n(.*?)\n}};", self.text, re.DOTALL)[1]
        return self.tables[name]

    def function(self, name: str) -> Function:
        """A function of the header by its name without the prefix; what it returns is o[0]."""
        if name not in self.functions:
            self.functions[name] = self._read(name)
        return self.functions[name]

    def _read(self, name: str) -> Function:
        signature = rf"(?:MW_DEVICE )?static inline \w+ {self.prefix}_{name}\([^)]*\)\n{{\n(.*?)\n}}"
        found = re.search(signature, self.text, re.DOTALL)
        require(found, f"the header has no function {name}")
        before = self.text[self.text.rfind("\n}\n", 0, found.start()) + 1 : found.start()]
        comments = re.search(r"((?:/\*(?:[^*]|\*(?!/))*\*/\s)*)\Z", before)[1]
        table = {
            key: (int(at), int(size or 1))
            for at, key, size in re.findall(r"^ \* +(\d+) (\w+)(?:\[(\d+)\])?", comments, re.M)
        }
        body = re.sub(r"if \(q\[(\d+)\] != q\[\1\]\) (?=q\[\1\] = )", "", found[1])
        return Function(name, read_body(re.sub(r"\breturn (-?t_\w+);", r"o[0] = \1;", body)), table)

    def base(self, rng: Random) -> Machine:
        """Parameters, input angle and unknowns of one draw, after setup and set_phi."""
        return once(rng, "base", lambda: machine(self.header, "eval", rng, True))

    def design(
        self, name: str, rng: Random, symbols: list[str], filled: tuple[str, ...] = ()
    ) -> tuple[Machine, Reader]:
        """A function of a design system at random q (parameters, share of the path) and y; rates are those along y."""

        def made() -> tuple[Machine, Reader]:
            base = self.base(rng)
            names = [*self.parameters, "path"]
            path = once(rng, "path", lambda: Number(rng.randrange(1, PRIME)))
            values = {name: path if name == "path" else base.inputs[f"p[{k}]"] for k, name in enumerate(names)}
            inputs = {f"q[{k}]": values[name] for k, name in enumerate(names) if name not in filled}
            for k, symbol in enumerate(symbols):
                rates = tuple(int(j == k) for j in range(len(symbols)))
                number = Number(rng.randrange(1, PRIME), rates, {f"{name} {k}": Fraction(1)})
                inputs[f"y[{k}]"] = values[symbol] = number
            machine = Machine(inputs, self.function(name), None, base.circle)
            return machine, Reader(self.named, values, machine)

        return once(rng, ("design", name), made)

    def share(self, run: Machine) -> Number:
        """How much of the path of a design system is done."""
        return run.inputs[f"q[{len(self.parameters)}]"]

    def run(self, name: str, rng: Random, letter: str, symbols: list[str]) -> tuple[Machine, Reader]:
        """A function at random inputs, and the description at the same; rates are those along its own arguments."""

        def made() -> tuple[Machine, Reader]:
            base = self.base(rng)
            inputs = {key: number for key, number in base.inputs.items() if key[:2] != "x["}
            own = {}
            for k in range(len(symbols)):
                key = f"{letter}[{k}]"
                rates = tuple(int(j == k) for j in range(len(symbols)))
                own[key] = Number(rng.randrange(1, PRIME), rates, {f"{name} {key}": Fraction(1)})
            machine = Machine(inputs | own, self.function(name), base.earlier, base.circle)
            values = {symbol: inputs[f"p[{k}]"] for k, symbol in enumerate(self.parameters)}
            values[self.description["contact"]["instant"]["name"]] = inputs["phi"]
            values |= dict(zip(symbols, own.values(), strict=True))
            return machine, Reader(self.named, values, machine)

        return once(rng, ("run", name), made)


def same(found: Number, expected: Number, words: str) -> None:
    require((found.value - expected.value) % PRIME == 0, f"{words} is not that of the description")


def rate(number: Number, place: int) -> Number:
    """Derivative along an argument."""
    return Number(number.rates[place] if number.rates else 0)


def read(run: Machine, key: str) -> list[Number]:
    require(key in run.function.outputs, f"{run.function.name}: no output {key}")
    at, size = run.function.outputs[key]
    return [run.value(f"o[{at + k}]") for k in range(size)]
