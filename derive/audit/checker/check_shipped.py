"""Check that all of a drive's header is read: `python check_shipped.py [folder [drive …]] [--runtime FOLDER]`, exit
status 0 if everything holds; the runtime's text is that of runtime/c beside generated/, or of the folder.
check_code.py, check_description.py and check_bounded.py run the functions; here is what stands around them.

A header is cut into items, tokens without comments. Each of them, in its order, must be

  frame      text that all headers have, or the signature of a function that those checks run, as frame.py has it
  tables     names, units, factors, domains, flags, events, messages and places, made of the description: a number is
             the nearest double, a factor that which the key's ending says
  macros     places of keys, words, unknowns and outputs, sizes; each once, and no others
  runtime    the text of runtime/c, token by token: arithmetic, model table, statuses and solver; in _certify.h
             enclosures and the test of existence
  silence    what the runs pass over in a function: returns, and pointers that may be NULL
  proofs     the functions of _certify.h have the middles of the drive's own equations, each running error the rule of
             its operation, and what may vanish is looked at
  constants  a number that stands for a fraction or a multiple of pi is the double nearest to it
  sample     keys as given, what follows of them within some units of the last place, a zero of the equations of contact
  companion  <drive>.json has hash, names, domains and parities of the description and the header's sample
"""

import hashlib
import json
import math
import re
from fractions import Fraction
from pathlib import Path

from .any_root import kept_draws, with_any_root
from .check_contact import Open, Values
from .command import described, ended, folder_of
from .enclosing import check_enclosed, check_point, plain
from .frame import BEGINS, VERSIONS, Frame, check_texts, literal
from .intervals import UNIT, Enclosed, Pair, Undefined, enclosed
from .refusal import UNREADABLE, Rejected, require
from .shipped import Runtime, items, without
from .straight_line import SILENT, body_of, literal_of, parsed, read_header

TABLES = ("mw_device.h", "mw_arithmetic.h", "mw_model.h", "mw_status.h")
ROOTS = ("complete.h", "cycle.h", "self_test.h")
ENCLOSURES = ("circular.h", "mw_enclosures.h", "certify/ball.h", "certify/wide.h", "certify/units.h", "certify/lane.h")
#: What rounding may leave of a number of the sample, of its size or of one.
ROUNDED = 2.0**-40
SAMPLE = re.compile(r"static const double \w+_sample(_angle|_contact)? (?:\[ \] )?= .*;")
#: What a function says beside its statements, by the end of its name; of a setup after its guards.
SILENCE = {
    "eval": ["if (J == NULL) return;"],
    "along": ["if (d2 == NULL) return;"],
    "by_anchor": ["double away = 0.0;", "(void)at, (void)phi;", "return away;"],
    "start_eval": ["(void)s, (void)y, (void)R;", "if (J == NULL) return;"],
    "guess": ["(void)s, (void)y;"],
    "start_scale": ["(void)s, (void)y;"],
    "start_solution": ["(void)s, (void)y;"],
    "scale": ["(void)s;"],
    "size": [],
    "set_phi": [],
    "observe": [],
    "anchor": ["(void)s, (void)phi, (void)x, (void)at;"],
}


class Shipped:
    """A header beside its description, and the runtime's text."""

    def __init__(self, description: dict, text: str, runtime: Runtime):
        self.description, self.text, self.runtime = description, text, runtime
        self.prefix = description["name"]
        found = items(text)
        found = without(found, runtime.items(*TABLES), "arithmetic, model table and statuses")
        after = runtime.reached(*ROOTS)
        self.macros = [item for item in found if item.startswith(f"# define {self.prefix}_")]
        places = [item for item in found if item.startswith(f"enum {{ {self.prefix}_S_")]
        names = places[0][len("enum { ") : -len(" } ;")].split(" , ") if places else []
        require(len(places) <= 1 and len(set(names)) == len(names), "places in the state: not a list of names")
        taken = {*self.macros, *places}
        self.samples = [item for item in found if SAMPLE.fullmatch(item)]
        rest = [item for item in found if item not in taken and item not in self.samples]
        self.before = without(rest, after, "solver")
        self.frame = Frame(description, len(names), self.observed(), self.messages(), self.pose())

    def observed(self) -> list[tuple[str, str, int]]:
        """Outputs of the observation, as its comment lists them: name, unit, size."""
        comment = re.search(r"o\[\w+_NO\]\.\n(.*?)\*/", self.text, re.DOTALL)
        require(comment, "the observation lists no outputs")
        return [
            (name, unit or "", int(size or 1))
            for name, size, unit in re.findall(
                r"^ \* +\d+ (\w+)(?:\[(\d+)\])?(?:, (?!frame)([^,\n]+))?(?:, frame \w+)?$", comment[1], re.M
            )
        ]

    def pose(self) -> list[int]:
        """Places of the state that a misalignment reaches when it is set up."""
        setup = read_header(self.text).functions["setup"].definitions
        keys = enumerate(self.description["keys"])
        reached = {f"p[{k}]" for k, key in keys if key["table"] == "misalignment"}
        for name, (_, text) in setup.items():
            if reached & set(re.findall(r"\w+(?:\[\d+\])?", text)):
                reached.add(name)
        return sorted(int(name[2:-1]) for name in reached if name.startswith("s["))

    def messages(self) -> list[str]:
        table = re.search(r"_guard_texts\[\] = {\n(.*?)\n};", self.text, re.DOTALL)
        require(table, "the header has no messages of guards")
        return [line.strip().rstrip(",")[1:-1] for line in table[1].splitlines()]

    def check_frame(self) -> None:
        """Every item in its order; of a function that is run elsewhere, its signature."""
        upper = self.prefix.upper()
        abi = re.search(r"#define MW_MODEL_ABI (\d+)", self.runtime.text("mw_model.h"))[1]
        expected = items(BEGINS.replace("@", upper)) + items(VERSIONS.format(abi=abi))
        expected += self.frame.items() + self.frame.after()
        self.frame.compare(self.before, expected)
        check_texts(self.description, self.frame.texts)

    def check_macros(self) -> None:
        found = {item.split()[2]: " ".join(item.split()[3:]) for item in self.macros}
        require(len(found) == len(self.macros), "a macro is defined twice")
        own = {name: value for name, value in found.items() if name not in self.frame.macros()}
        for name, value in self.frame.macros().items():
            require(found.get(name) == value, f"{name} is {found.get(name)}, not {value}")
        x = f"{self.prefix}_"
        require(set(own) == {f"{x}NANCHOR", f"{x}NEAREST", f"{x}ABI", f"{x}SPEC_HASH"}, f"other macros: {sorted(own)}")
        written = len(re.findall(r"^    at\[\d+\] = ", body_of(self.text, f"{x}anchor"), re.M))
        require(own[f"{x}NANCHOR"] == str(3 * written), "NANCHOR is not what the anchor writes")
        abi = re.search(r"#define MW_MODEL_ABI (\d+)", self.runtime.text("mw_model.h"))[1]
        require(own[f"{x}ABI"] == abi, "ABI is not that of the model table")
        require(re.fullmatch(r'"[0-9a-f]{64}"', own[f"{x}SPEC_HASH"]), "SPEC_HASH is no hash")
        require(f"specification {self.hash}." in self.text[: self.text.find("#")], "the comment has another hash")

    @property
    def hash(self) -> str:
        return re.search(r'_SPEC_HASH "(\w+)"', self.text)[1]

    def check_silence(self) -> None:
        """Lines of the functions that are run which hold no statement."""
        pattern = rf"\nMW_DEVICE static inline \w+ {self.prefix}_(\w+)\([^)]*\)\n{{\n(.*?)\n}}"
        functions = re.findall(pattern, self.text, re.DOTALL)
        require({"setup", *SILENCE} <= {name for name, _ in functions}, "a function is not written as it must be")
        for name, body in functions:
            lines = [line.strip() for line in re.sub(r" */\*.*?\*/", "", body, flags=re.DOTALL).splitlines()]
            silent = [line for line in lines if SILENT.match(line)]
            if (expected := self.silence_of(name)) is not None:
                require(silent == expected, f"{name}: other lines around its statements than {expected}")
            elif name == "setup":
                guards = [line for line in silent if line.startswith("if ")]
                count = sum(not text.endswith(": give it a value") and not text.endswith(": give one a value")
                            for text in self.frame.texts)  # fmt: skip
                numbers = [int(re.fullmatch(r"if \(!\(\S+ > 0\.0\)\) failed = (\d+);", line)[1]) for line in guards]
                require(numbers == list(range(count, 0, -1)), "setup: not one line for each guard, the first last")
                returned = f"return failed ? {self.prefix}_missing(p, failed) : 0;"
                require(silent == ["int failed = 0;", "{", *guards, "}", returned], "setup: other lines")

    def silence_of(self, name: str) -> list[str] | None:
        for system in self.description["design_systems"]:
            if name.startswith(f"{system['name']}_"):
                kind = name[len(system["name"]) + 1 :]
                return {"guess": ["(void)q;"], "scale": ["(void)q;"], "eval": SILENCE["eval"]}.get(kind)
        surfaces = [f"flank_{body['name']}" for body in self.description["bodies"]]
        surfaces += [f"{region['region']}_{region['member']}" for region in self.description["regions"]]
        if name in surfaces or name.removeprefix("curvature_") in surfaces:
            return ["(void)s;"]
        if name in [entry for entry, *_ in self.frame.offered()]:
            return ["(void)s;", "(void)q;"]
        return SILENCE.get(name)

    def check_constants(self) -> None:
        """Numbers of all functions that are run: what is read as a fraction or a multiple of pi is nearest to it."""
        header = read_header(self.text)
        for function in header.functions.values():
            for kind, expression in function.definitions.values():
                if kind == "expression":
                    for operand in parsed(expression)[1:]:
                        check_constant(operand.strip("()"), function.name)


def check_constant(text: str, words: str) -> None:
    found = literal_of(text)
    if found is None:
        return
    exact, angle = found
    nearest = literal(["*", ["/", exact.numerator, exact.denominator], *([["pi"]] if angle else [])])
    require(float(nearest) == float(text), f"{words}: {text} is not the double nearest to what it stands for")


class Sample:
    """The sample design of a header and its contact, beside those of the description."""

    def __init__(self, shipped: Shipped):
        self.shipped, self.description = shipped, shipped.description
        self.parameters, self.contact = self.numbers("sample"), self.numbers("sample_contact")
        self.angle = float(re.search(r"_sample_angle = (\S+);", shipped.text)[1])

    def numbers(self, name: str) -> list[float]:
        found = re.search(rf"_{name}\[\] = {{ (.*?) }};", self.shipped.text)
        require(found, f"the header has no {name}")
        return [float(number) for number in found[1].split(", ")]

    def check(self) -> None:
        """Given numbers are those of the description, to the last digit; what follows by rules, within what rounding
        leaves; R at the contact is no further from zero than so many units.
        """
        description, known = self.description, {}
        keys = description["keys"]
        require(len(self.parameters) == len(keys), "sample: not a number for each key")
        require(self.angle == float(Fraction(description["sample_angle"])), "sample_angle: not the description's")
        for key, found in zip(keys, self.parameters, strict=True):
            if (given := self.given(key)) is not None:
                exact, factor = Fraction(given), key["factor"]
                parts = factor[1:] if isinstance(factor, list) and factor[0] == "*" else [factor]
                expected = literal(["*", ["/", exact.numerator, exact.denominator], *parts])
                require(found == float(expected), f"sample: {key['key']} is not {given}")
            if not math.isnan(found):
                known[key["symbol"]["name"]] = Enclosed.of(Fraction(found))
        self.check_rules(known)
        self.check_zero(known)

    def given(self, key: dict) -> str | None:
        """The text of the sample for a key, by its name, and by its table where that is not the design's."""
        own = key["table"] in ("design", "flank")
        return self.description["sample"].get(key["key"] if own else f"{key['table']}.{key['key']}")

    def check_rules(self, known: dict[str, Enclosed]) -> None:
        """What a default or rule would give is the number that is there, or another rule gave it."""
        keys = {key["symbol"]["name"]: key for key in self.description["keys"]}
        rules: dict[str, list] = {}
        defaults = [(key["symbol"]["name"], key["default"]) for key in self.description["keys"]]
        for symbol, value in [pair for pair in defaults if pair[1] is not None] + self.description["rules"]:
            rules.setdefault(symbol, []).append(value)
        for symbol, values in rules.items():
            if self.given(keys[symbol]) is not None or symbol not in known:
                continue
            found, near = middle(known[symbol].pair), []
            for value in values:
                try:
                    expected = middle(Values(self.description, known)(value).pair)
                except (Open, Undefined):
                    continue
                near.append(abs(found - expected) <= ROUNDED * max(abs(expected), 1))
            require(any(near) or not near, f"sample: {symbol} does not follow by its rule")

    def check_zero(self, known: dict[str, Enclosed]) -> None:
        """One Newton step from the contact is no longer than rounding leaves."""
        contact = self.description["contact"]
        names = [unknown["name"] for unknown in contact["unknowns"]]
        at = known | {contact["instant"]["name"]: Enclosed.of(Fraction(self.angle))}
        n = len(names)
        require(len(self.contact) == n, "sample_contact: not a number for each unknown")
        for k, (name, x) in enumerate(zip(names, self.contact, strict=True)):
            at[name] = Enclosed(enclosed(Fraction(x)), tuple(enclosed(int(i == k)) for i in range(n)))
        values = Values(self.description, at)
        rows = [values(row) for row in contact["residual"]]
        slopes = [[middle(rate) for rate in row.rates or ((0, 0),) * n] for row in rows]
        step = solved_by_pivots(slopes, [middle(row.pair) for row in rows])
        for name, change, x in zip(names, step, self.contact, strict=True):
            require(abs(change) <= ROUNDED * max(abs(x), 1), f"sample_contact: {name} is no zero of the equations")


def middle(pair: Pair) -> float:
    return float(Fraction(pair[0] + pair[1], 2 * UNIT))


def solved_by_pivots(rows: list[list[float]], right: list[float]) -> list[float]:
    """Solution of a small linear system (Gauss, Jordan), in doubles: for how large a step is, not for its digits."""
    table = [[*row, b] for row, b in zip(rows, right, strict=True)]
    for k in range(len(table)):
        best = max(range(k, len(table)), key=lambda i: abs(table[i][k]))
        table[k], table[best] = table[best], table[k]
        require(table[k][k] != 0.0, "sample_contact: the equations are singular there")
        table[k] = [entry / table[k][k] for entry in table[k]]
        for i, row in enumerate(table):
            if i != k:
                table[i] = [a - row[k] * b for a, b in zip(row, table[k], strict=True)]
    return [row[-1] for row in table]


def check_companion(shipped: Shipped, sample: Sample, path: Path, description: Path) -> None:
    """Names, domains and parities of <drive>.json, its hash of the description and its sample."""
    told, own = json.loads(path.read_text(encoding="utf-8")), shipped.description
    digest = hashlib.sha256(description.read_bytes()).hexdigest()
    require(told["description_sha256"] == digest, f"{path.name}: made of another description")
    require(told["specification_hash"] == shipped.hash, f"{path.name}: another specification than the header's")
    for key in ("name", "family", "title", "handed", "pinion_teeth", "exclusive", "together", "variant_defaults"):
        require(told[key] == own[key], f"{path.name}: {key} is not the description's")
    for entry, key in zip(told["parameters"], own["keys"], strict=True):
        kept = {**key, "name": key["symbol"]["name"], "unit": key["symbol"]["unit"]}
        for name in ("key", "table", "name", "unit", "required", "integer", "lower_included", "above", "choices"):
            require(entry[name] == kept[name], f"{path.name}: {name} of {key['key']} is not the description's")
        require(entry["factor"] == float(literal(key["factor"])), f"{path.name}: another factor of {key['key']}")
        check_domain(entry, key["symbol"], path.name)
    for entry, symbol in zip(told["unknowns"], own["contact"]["unknowns"], strict=True):
        require(entry["name"] == symbol["name"], f"{path.name}: other unknowns")
        check_domain(entry, symbol, path.name)
    symbols = [own["contact"]["instant"], *own["contact"]["unknowns"]]
    for symbol in symbols:
        told_of = told["quantities"][symbol["name"]]
        require(told_of["parity"] == symbol["parity"], f"{path.name}: parity of {symbol['name']}")
    test = {name: [float.fromhex(x) for x in told["self_test"][name]] for name in ("p", "x")}
    same = all(a == b or (math.isnan(a) and math.isnan(b)) for a, b in zip(test["p"], sample.parameters, strict=True))
    require(same and test["x"] == sample.contact, f"{path.name}: another self_test than the header's sample")
    require(float.fromhex(told["self_test"]["phi"]) == sample.angle, f"{path.name}: another angle of the self_test")


def check_domain(entry: dict, symbol: dict, name: str) -> None:
    for end, bound in zip(("lower", "upper"), symbol["domain"], strict=True):
        expected = None if bound is None else float(literal(bound))
        require(entry[end] == expected, f"{name}: {end} end of {symbol['name']} is not the description's")


def check_certify(shipped: Shipped, path: Path) -> None:
    """The header of proofs: the runtime's text, what all of them have, and its functions beside the drive's own."""
    text = path.read_text(encoding="utf-8")
    found = without(items(text), shipped.runtime.items(*ENCLOSURES), "enclosures")
    found = without(found, shipped.runtime.items("certify/point.h"), "test of existence")
    sizes = [
        sum(key.startswith(letter) for key in plain(text, f"{shipped.prefix}_{name}").definitions)
        for name, letter in (("certify_setup", "s["), ("enclose_instant", "t["))
    ]
    shipped.frame.compare(found, shipped.frame.certify(sum(sizes), sizes[0]))
    header, draws = read_header(shipped.text), kept_draws()
    for check in (check_enclosed, check_point):
        with_any_root(check, (header, text, shipped.prefix), draws)


def check_drive(description: Path, header: Path, runtime: Runtime) -> int:
    """All checks of one drive; how many items were read."""
    try:
        text = header.read_text(encoding="utf-8")
        shipped = Shipped(json.loads(description.read_text(encoding="utf-8")), text, runtime)
        shipped.check_frame()
        shipped.check_macros()
        shipped.check_silence()
        shipped.check_constants()
        sample = Sample(shipped)
        sample.check()
        if (companion := header.with_name(f"{header.stem}_certify.h")).is_file():
            check_certify(shipped, companion)
        if (companion := header.with_suffix(".json")).is_file():
            check_companion(shipped, sample, companion, description)
    except (Rejected, *UNREADABLE) as error:
        raise Rejected(f"{header.name}: {error}") from error
    return len(items(text))


def main(arguments: list[str]) -> int:
    def said() -> str:
        named, own = list(arguments), None
        if "--runtime" in named:
            at = named.index("--runtime")
            require(len(named) > at + 1, "--runtime: name the folder")
            own = Path(named[at + 1])
            del named[at : at + 2]
        folder = folder_of(named)
        runtime = Runtime(own or folder.resolve().parents[1] / "runtime" / "c")
        paths = described(folder, named[1:])
        read = sum(check_drive(path, folder.parent / "c" / f"{path.stem}.h", runtime) for path in paths)
        return f"{read} items of {len(paths)} headers are read: frame, tables, macros, runtime, constants, sample"

    return ended(said)
