"""Trees as MathML and LaTeX. Terms stand in the order of the tree; nothing is rewritten but a - b for a + (-b).

A pseudo node ("mark", tree) sets off the part in which two expressions differ.
"""

import re
import unicodedata
from collections.abc import Callable, Mapping
from html import escape
from typing import ClassVar

from derive.prove.tree import Tree

GREEK = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "zeta": "ζ", "eta": "η", "theta": "θ", "lam": "λ", "lambda":
        "λ", "mu": "μ", "xi": "ξ", "pi": "π",
    "rho": "ρ", "sigma": "σ", "Sigma": "Σ", "tau": "τ", "phi": "φ", "psi": "ψ", "Psi": "Ψ", "omega": "ω", "epsilon":
    "ε", "kappa": "κ", "chi": "χ", "shaft": "Σ", "th": "θ", "dgh": "Δγh", "dgv": "Δγv", "dC": "ΔC", "dh": "Δh",
    "dv": "Δv", "slope": "slope",
}  # fmt: skip
SUM, PRODUCT, UNARY, POWER, ATOM = range(5)


def symbol_text(name: str) -> str:
    """A plain Unicode name: phi_hob -> φ_hob, r1 -> r1, phi3p -> φ3′."""
    base, index, prime = _split(name)
    return base + (f"{'_' if index and not index.isdigit() else ''}{index}") + prime


def _split(name: str) -> tuple[str, str, str]:
    """Letter, index and prime of a name."""
    if name in GREEK:
        return GREEK[name], "", ""
    match = re.fullmatch(r"([A-Za-z]+?)(\d+)(p?)", name)
    if match:
        return GREEK.get(match[1], match[1]), match[2], "′" * bool(match[3])
    head, _, tail = name.partition("_")
    head_text = "".join(_split(head)[:2]) if re.fullmatch(r"[A-Za-z]+\d+", head) else GREEK.get(head, head)
    return head_text, ", ".join("".join(_split(part)[:2]) for part in tail.split("_")) if tail else "", ""


def _parts(shown: str) -> tuple[str, str, str]:
    """Letter, index and prime of a symbol as a source shows it: α1, φ3′, R2j, ω⁽¹⁾."""
    match = re.fullmatch(r"(\D+?)(\d+[a-z]?)?(′?)", shown)
    return (escape(match[1]), match[2] or "", match[3]) if match else (escape(shown), "", "")


class Format:
    """How the parts of an expression are written; subclasses say it for MathML and LaTeX: ``PATTERNS`` around what is
    given in braces, and in methods what no pattern says.
    """

    PATTERNS: ClassVar[Mapping[str, str]]

    def __init__(self, names: Mapping[str, str] | None = None):
        self.names = names or {}

    def __getattr__(self, part: str) -> Callable[..., str]:
        if part not in self.PATTERNS:
            raise AttributeError(part)
        return self.PATTERNS[part].format

    def write(self, tree: Tree) -> str:
        return self._write(tree)[0]

    def plain(self, name: str) -> str:
        """A symbol, or the cosine, sine or jet of one, as plain text in the letters of the source."""
        head, bracket, rest = name.partition("(")
        if bracket and head in ("cos", "sin"):
            return f"{head} {self.plain(rest.rstrip(')'))}"
        symbol, slash, divisor = name.partition("/")
        return self.names.get(symbol, symbol_text(symbol)) + slash + divisor

    def _write(self, tree: Tree) -> tuple[str, int]:
        if isinstance(tree, int):
            return self.number(str(tree)), ATOM
        if isinstance(tree, str):
            return self.name(tree), ATOM
        operation, *arguments = tree
        handler: Callable | None = getattr(self, f"_{HANDLERS[operation]}", None) if operation in HANDLERS else None
        if handler is None:
            raise KeyError(operation)
        return handler(operation, arguments)

    def _within(self, tree: Tree, level: int) -> str:
        text, own = self._write(tree)
        return self.parens(text) if own < level else text

    def _sum(self, _, arguments) -> tuple[str, int]:
        parts = []
        for position, term in enumerate(arguments):
            marked = isinstance(term, tuple) and term[0] == "mark"
            inner = term[1] if marked else term
            negative = isinstance(inner, tuple) and inner[0] == "-"
            signed = self._without_sign(inner[1] if negative else inner)
            body = self._within(inner[1] if negative else inner, PRODUCT) if signed is None else signed
            if signed is not None:
                sign = self.operator("∓" if negative else "±")
            else:
                sign = self.operator("−") if negative else (self.operator("+") if position else "")
            parts.append(self.mark(sign + body) if marked else sign + body)
        return self.row("".join(parts)), SUM

    def _without_sign(self, term: Tree) -> str | None:
        """What follows a printed ± in a term, or None if it has none."""
        if self.names.get(term if isinstance(term, str) else "") == "±":
            return ""
        if isinstance(term, tuple) and term[0] == "*" and self.names.get(str(term[1])) == "±":
            rest = term[2] if len(term) == 3 else ("*", *term[2:])
            return self._within(rest, PRODUCT)
        return None

    def _negative(self, _, arguments) -> tuple[str, int]:
        if (signed := self._without_sign(arguments[0])) is not None:
            return self.row(self.operator("∓") + signed), SUM
        return self.row(self.operator("−") + self._within(arguments[0], PRODUCT)), SUM

    def _product(self, _, arguments) -> tuple[str, int]:
        return self.row(self.times().join(self._within(argument, UNARY) for argument in arguments)), PRODUCT

    def _quotient(self, _, arguments) -> tuple[str, int]:
        return self.fraction(self.write(arguments[0]), self.write(arguments[1])), UNARY

    def _power(self, _, arguments) -> tuple[str, int]:
        base, exponent = arguments
        if isinstance(base, tuple) and base[0] in ("cos", "sin", "tan"):
            return self.row(
                self.power(self.function(base[0]), self.number(str(exponent))) + self._argument(base[1])
            ), UNARY
        return self.power(self._within(base, ATOM), self.number(str(exponent))), POWER

    def _argument(self, tree: Tree) -> str:
        text, level = self._write(tree)
        return self.space() + text if level == ATOM else self.parens(text)

    def _function(self, operation, arguments) -> tuple[str, int]:
        return self.row(self.function(operation) + self._argument(arguments[0])), UNARY

    def _call(self, operation, arguments) -> tuple[str, int]:
        return self.row(self.function(operation) + self.parens(self.comma().join(map(self.write, arguments)))), UNARY

    def _root(self, _, arguments) -> tuple[str, int]:
        return self.root(self.write(arguments[0])), ATOM

    def _jet(self, _, arguments) -> tuple[str, int]:
        name, *orders = arguments
        text = self.name(name)
        if len(orders) == 1:
            return (self.row(text + self.operator("′") * orders[0]) if orders[0] else text), ATOM
        return (self.index(text, ",".join(map(str, orders))) if any(orders) else text), ATOM

    def _rotation(self, operation, arguments) -> tuple[str, int]:
        return self.row(self.index(self.function("R"), operation[1]) + self.parens(self.write(arguments[0]))), UNARY

    def _infix(self, operation, arguments) -> tuple[str, int]:
        sign = {"dot": "·", "cross": "×", "@": "\u2062"}[operation]
        return self.row(self.operator(sign).join(self._within(argument, UNARY) for argument in arguments)), PRODUCT

    def _triple(self, _, arguments) -> tuple[str, int]:
        u, v, w = (self._within(argument, UNARY) for argument in arguments)
        return self.row(self.parens(u + self.operator("×") + v) + self.operator("·") + w), PRODUCT

    def _vector(self, _, arguments) -> tuple[str, int]:
        return self.matrix([[self.write(argument)] for argument in arguments]), ATOM

    def _matrix(self, _, arguments) -> tuple[str, int]:
        return self.matrix([[self.write(entry) for entry in row] for row in arguments]), ATOM

    def _transpose(self, _, arguments) -> tuple[str, int]:
        return self.power(self._within(arguments[0], ATOM), self.function("T")), POWER

    def _at(self, _, arguments) -> tuple[str, int]:
        return self.index(self._within(arguments[0], ATOM), "xyz"[arguments[1]]), ATOM

    def _entry(self, _, arguments) -> tuple[str, int]:
        return self.index(self._within(arguments[0], ATOM), f"{arguments[1] + 1}{arguments[2] + 1}"), ATOM

    def _derivative(self, _, arguments) -> tuple[str, int]:
        body, *directions = arguments
        if len(directions) == 1 and directions[0][1] == 1:
            return self.row(
                self.fraction(self.operator("∂"), self.operator("∂") + self.name(directions[0][0]))
                + self._within(body, UNARY)
            ), PRODUCT
        parts = []
        for symbol, rate in directions:
            factor = "" if rate == 1 else self._within(rate, UNARY) + self.times()
            parts.append(factor + self.fraction(self.operator("∂"), self.operator("∂") + self.name(symbol)))
        return self.row(self.parens(self.operator("+").join(parts)) + self._within(body, UNARY)), PRODUCT

    def _mark(self, _, arguments) -> tuple[str, int]:
        text, level = self._write(arguments[0])
        return self.mark(text), level


HANDLERS = {
    "+": "sum", "-": "negative", "*": "product", "/": "quotient", "^": "power", "sqrt": "root", "jet": "jet", "mark":
    "mark", "d": "derivative", "vec": "vector", "mat": "matrix", "T": "transpose", "at": "at", "entry": "entry",
    "triple": "triple", "atan2": "call", **dict.fromkeys(("cos", "sin", "tan", "asin", "acos", "atan", "degrees",
    "radians"), "function"), **dict.fromkeys(("Rx", "Ry", "Rz"), "rotation"), **dict.fromkeys(("dot", "cross", "@"),
    "infix"),
}  # fmt: skip


class MathML(Format):
    PATTERNS: ClassVar = {
        "number": "<mn>{}</mn>",
        "operator": "<mo>{}</mo>",
        "function": '<mi mathvariant="normal">{}</mi>',
        "row": "<mrow>{}</mrow>",
        "parens": "<mrow><mo>(</mo>{}<mo>)</mo></mrow>",
        "times": '<mspace width="0.17em"/>',
        "space": '<mspace width="0.17em"/>',
        "comma": "<mo>,</mo>",
        "fraction": "<mfrac><mrow>{}</mrow><mrow>{}</mrow></mfrac>",
        "power": "<msup>{}{}</msup>",
        "index": "<msub>{}<mi>{}</mi></msub>",
        "root": "<msqrt>{}</msqrt>",
        "mark": '<mrow class="mark">{}</mrow>',
    }

    def name(self, name: str) -> str:
        base, index, prime = _parts(self.names[name]) if name in self.names else _split(name)
        if prime:
            return (
                f"<msubsup><mi>{base}</mi><mi>{index}</mi><mo>′</mo></msubsup>"
                if index
                else f"<msup><mi>{base}</mi><mo>′</mo></msup>"
            )
        return f"<msub><mi>{base}</mi><mi>{index}</mi></msub>" if index else f"<mi>{base}</mi>"

    def matrix(self, rows: list[list[str]]) -> str:
        body = "".join("<mtr>" + "".join(f"<mtd>{entry}</mtd>" for entry in row) + "</mtr>" for row in rows)
        return f"<mrow><mo>(</mo><mtable>{body}</mtable><mo>)</mo></mrow>"

    def equation(self, left: Tree, right: Tree) -> str:
        """A displayed equation, in pieces between which its line may break."""
        return _line([*self.pieces(left), *_led(INFIX.format("="), self.pieces(right))])

    def formula(self, tree: Tree) -> str:
        """The same of an expression alone."""
        return _line(self.pieces(tree))

    def pieces(self, tree: Tree) -> list[str]:
        """A long sum term by term, and so a long product with a sum in it; anything else in one piece."""
        if not isinstance(tree, tuple) or _length(tree) < LONG:
            return [self.write(tree)]
        match tree:
            case ("mark", inner):
                return [self.mark(piece) for piece in self.pieces(inner)]
            case ("+", first, *rest):
                found = self.pieces(first)
                for term in rest:
                    marked = isinstance(term, tuple) and term[0] == "mark"
                    found += self._term(term[1] if marked else term, self.mark if marked else str)
                return found
            case ("-", inner) if self._without_sign(inner) is None:
                return _led(self.operator("−"), self._factor(inner, PRODUCT))
            case ("/", above, below) if _length(tree) >= QUOTIENT:
                first, second = self._factor(above, UNARY), self._factor(below, POWER)
                return [*first[:-1], first[-1] + self.operator("/"), *second]
            case ("vec", *parts):
                found = []
                for part in parts:
                    first, *more = self.pieces(part)
                    found += [first if found else BRACKET.format("(") + first, *more]
                    found[-1] += self.comma()
                return [*found[:-1], found[-1].removesuffix(self.comma()) + BRACKET.format(")")]
            case ("*", *factors):
                found = [""]
                for k, factor in enumerate(factors):
                    first, *more = self._factor(factor, UNARY)
                    found[-1] += (self.times() if k else "") + first
                    found += more
                return found
        return [self.write(tree)]

    def _term(self, term: Tree, around: Callable[[str], str]) -> list[str]:
        """A term of a sum with its sign."""
        if isinstance(term, tuple) and term[0] == "-" and self._without_sign(term[1]) is None:
            found = _led(INFIX.format("−"), self._factor(term[1], PRODUCT))
        elif (signed := self._without_sign(term)) is not None:
            found = [INFIX.format("±") + signed]
        elif isinstance(term, tuple) and term[0] == "-":
            found = [INFIX.format("∓") + (self._without_sign(term[1]) or "")]
        else:
            found = _led(INFIX.format("+"), self._factor(term, PRODUCT))
        return [around(piece) for piece in found]

    def _factor(self, tree: Tree, level: int) -> list[str]:
        """The pieces of a part, in parentheses where it binds more loosely."""
        if self._write(tree)[1] >= level:
            return self.pieces(tree)
        first, *more = self.pieces(tree)
        if not more:
            return [self.parens(first)]
        return [BRACKET.format("(") + first, *more[:-1], more[-1] + BRACKET.format(")")]

    def figure(self, formula: Tree, value: str, aside: str) -> str:
        """A displayed number with the formula it comes from and a remark."""
        body = f'{self.write(formula)}<mo>=</mo><mn>{value}</mn><mspace width="1em"/><mtext>{escape(aside)}</mtext>'
        return f'<math display="block"><mrow>{body}</mrow></math>'


#: Symbols and numbers of an expression, and of a quotient, that is written in pieces.
LONG = 9
QUOTIENT = 24
INFIX = '<mo form="infix">{}</mo>'
BRACKET = '<mo stretchy="false">{}</mo>'


def _length(tree: Tree) -> int:
    """Symbols and numbers of an expression."""
    return sum(map(_length, tree[1:])) if isinstance(tree, tuple) else 1


def _led(operator: str, pieces: list[str]) -> list[str]:
    return [operator + pieces[0], *pieces[1:]]


def _line(pieces: list[str]) -> str:
    return '<div class="formula">' + " ".join(f"<math><mrow>{piece}</mrow></math>" for piece in pieces) + "</div>"


class LaTeX(Format):
    PATTERNS: ClassVar = {
        "number": "{}",
        "row": "{}",
        "parens": r"\left({}\right)",
        "times": r"\,",
        "space": " ",
        "comma": ", ",
        "fraction": r"\frac{{{}}}{{{}}}",
        "power": "{{{}}}^{{{}}}",
        "index": "{{{}}}_{{{}}}",
        "root": r"\sqrt{{{}}}",
        "mark": r"\boxed{{{}}}",
    }

    def name(self, name: str) -> str:
        base, index, prime = _parts(self.names[name]) if name in self.names else _split(name)
        text = LATEX_GREEK.get(base, _letters(base) if len(base) == 1 else rf"\mathrm{{{_letters(base)}}}")
        body = f"{text}_{{{_letters(index)}}}" if index else text
        return body + (r"^{\prime}" if prime else "")

    def operator(self, sign: str) -> str:
        return LATEX_SIGNS.get(sign, sign)

    def function(self, name: str) -> str:
        return rf"\{name}" if name in ("cos", "sin", "tan") else rf"\mathrm{{{name}}}"

    def matrix(self, rows: list[list[str]]) -> str:
        return r"\begin{pmatrix}" + r" \\ ".join(" & ".join(row) for row in rows) + r"\end{pmatrix}"

    def equation(self, left: Tree, right: Tree) -> str:
        return f"{self.write(left)} = {self.write(right)}"


def _letters(text: str) -> str:
    """Each letter in LaTeX's own words."""

    def written(letter: str) -> str:
        plain = raised(letter) or letter
        shown = f"{LATEX_GREEK[plain]} " if plain in LATEX_GREEK else LATEX_SIGNS.get(plain, plain)
        return shown if plain == letter else rf"{{}}^{{{shown}}}"

    return "".join(map(written, text)).strip()


def raised(letter: str) -> str:
    """What a superscript letter raises; "" for any other."""
    kind, *codes = unicodedata.decomposition(letter).split() or [""]
    return "".join(chr(int(code, 16)) for code in codes) if kind == "<super>" else ""


LATEX_GREEK = {
    "α": r"\alpha", "β": r"\beta", "γ": r"\gamma", "δ": r"\delta", "ζ": r"\zeta", "η": r"\eta", "θ": r"\theta", "λ":
    r"\lambda", "μ": r"\mu", "ν": r"\nu", "ξ": r"\xi", "π": r"\pi", "ρ": r"\rho", "σ": r"\sigma", "Σ": r"\Sigma", "τ":
    r"\tau", "φ": r"\varphi", "ψ": r"\psi", "Ψ": r"\Psi", "ω": r"\omega", "ε": r"\varepsilon", "κ": r"\kappa", "χ":
    r"\chi", "Δγh": r"\Delta\gamma_h", "Δγv": r"\Delta\gamma_v", "ΔC": r"\Delta C", "Δh": r"\Delta_h", "Δv":
    r"\Delta_v",
}  # fmt: skip
LATEX_SIGNS = {
    "±": r"\pm ", "∓": r"\mp ", "−": "-", "·": r"\cdot ", "×": r"\times ", "\u2062": r"\,", "∂": r"\partial ",
    "′": "'", "₀": "_0", "⇒": r"\Rightarrow ",
}  # fmt: skip


def difference(tree: Tree, other: Tree) -> Tree:
    """The tree with the smallest parts marked in which it differs from the other."""
    if tree == other:
        return tree
    alike = isinstance(tree, tuple) and isinstance(other, tuple) and tree[0] == other[0] and len(tree) == len(other)
    if not alike or tree[0] in ("jet", "d", "mat", "entry", "at"):
        return _marked_matrix(tree, other) if alike and tree[0] == "mat" else ("mark", tree)
    if tree[0] == "^":
        return ("^", difference(tree[1], other[1]), tree[2]) if tree[2] == other[2] else ("mark", tree)
    return (tree[0], *(difference(a, b) for a, b in zip(tree[1:], other[1:], strict=True)))


def _marked_matrix(tree: tuple, other: tuple) -> Tree:
    return (
        "mat",
        *(
            tuple(difference(a, b) for a, b in zip(row, others, strict=True))
            for row, others in zip(tree[1:], other[1:], strict=True)
        ),
    )
