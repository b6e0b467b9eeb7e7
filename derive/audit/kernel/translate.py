"""Certificates as Coq theorems.

Input: objects of the record. Output: the text of Coq files that need only Certificate.v. Every component of every proof
becomes one theorem over the reals: cosines, sines, roots and jets are variables, circle relations, root^2 = radicand
and sign^2 = 1 its hypotheses, as are the denominators other than zero. Derivatives are carried out here, by dual
numbers; the files of real derivatives state them by limits instead. The recorded cofactors are handed to Coq's
kernel, which expands both sides itself; where they are longer than ``LONGEST``, the kernel reduces the numerator by the
relations on its own instead.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from derive.audit.checker import certificates, numbers, points, polynomials, record, trees

#: Names that Coq or Certificate.v has.
RESERVED = frozenset(
    re.findall(
        r"\w+",
        """
        R I N Z S O C E Set Prop Type SProp as at by cofix else end exists exists2 fix for forall fun if in let match
        mod open return then using where with exp ln sin cos tan sqrt pow PI Var Int Add Mul Opp Inv value proved
        by_reduction
        """,
    )
)


class Term:
    """An expression as Coq sees it: ("Var", name), ("Int", n), ("Add", a, b), ("Mul", a, b), ("Opp", a), ("Inv", a)."""

    __slots__ = ("node",)

    def __init__(self, node: tuple):
        self.node = node

    def __add__(self, other: Term) -> Term:
        return Term(("Add", self.node, other.node))

    def __mul__(self, other: Term) -> Term:
        if self.node == ONE:
            return other
        return self if other.node == ONE else Term(("Mul", self.node, other.node))

    def __neg__(self) -> Term:
        return Term(self.node[1]) if self.node[0] == "Opp" else Term(("Opp", self.node))

    def inverse(self) -> Term:
        return self if self.node == ONE else Term(("Inv", self.node))


ONE = ("Int", 1)
#: Characters of the longest cofactors that a theorem hands over.
LONGEST = 100_000
#: Products of terms that the translator may take to compare denominators.
WORK = 10**7


class Written(points.Point):
    """Trees evaluated to expressions; an exact zero leaves no trace."""

    def constant(self, number: int):
        return Term(("Int", number)) if number else 0

    def drawn(self, name: str) -> Term:
        return Term(("Var", name))


@dataclass(frozen=True)
class Theorem:
    """Name, what it is of, and its text."""

    name: str
    text: str


def theorems(objects: dict[str, dict]) -> dict[str, list[Theorem]]:
    """Document -> its theorems, in the order of the record."""
    found: dict[str, list[Theorem]] = {}
    for item in filter(is_stated, objects.values()):
        equation = objects[item["equation"]]
        document = equation["id"].partition("/")[0]
        found.setdefault(document, []).extend(_theorems(item, equation, record.definitions_of(equation, objects)))
    return found


def is_stated(item: dict) -> bool:
    """Whether an object of the record is put to the kernel: a proof is, a table's number or a counterexample is not."""
    return item["object"] == "certificate" and item["kind"] == "ring_nf"


def file_text(document: str, stated: Sequence[Theorem]) -> str:
    """One Coq file: its theorems, and the axioms that all of them together rest on."""
    names = [theorem.name for theorem in stated]
    gathered = "".join(f"\nDefinition gathered_{k} := ({', '.join(names[at : at + 20])}, tt)."
                       for k, at in enumerate(range(0, len(names), 20)))  # fmt: skip
    every = ", ".join(f"gathered_{k}" for k in range(-(-len(names) // 20)))
    return (
        f"(** Proofs of the chapter {document}. *)\n\n"
        "From Coq Require Import Reals ZArith NArith List Ring_polynom.\nFrom Meshwright Require Import Certificate.\n"
        "Import ListNotations.\nLocal Open Scope R_scope.\n\n"
        + "\n".join(theorem.text for theorem in stated)
        + f"{gathered}\nDefinition every_proof := ({every}, tt).\nPrint Assumptions every_proof.\n"
    )


def module_name(document: str) -> str:
    return re.sub(r"\W", "_", document).capitalize()


def _theorems(certificate: dict, equation: dict, definitions: dict) -> Iterator[Theorem]:
    scope = certificates.scope_of(certificate, equation, definitions)
    env = Written(scope)
    stem = re.sub(r"\W+", "_", equation["id"]).strip("_") + f"_{certificate['sha256'][:8]}"
    head = f"(* {equation['id'].replace('(*', '( *')}: certificate {certificate['sha256'][:16]} *)\n"
    for number, root in enumerate(certificate["roots"]):
        yield _root(f"{stem}_root{number}", head, root, certificate, env)
    left, right = (trees.flat(trees.evaluate(equation[side], env)) for side in ("lhs", "rhs"))
    for number, (a, b) in enumerate(zip(left, right, strict=True)):
        component = certificate["components"][number]
        scale = _scale(a, b, component, scope)
        yield _theorem(f"{stem}_{number}", head, a, b, _pairs(certificate, component), certificate["generators"], scale)


def _root(name: str, head: str, root: dict, certificate: dict, env: Written) -> Theorem:
    """The radicand is the square of the generator over the square of its divisor."""
    square = next((r["square"] for r in certificate["relations"] if r["generator"] == root["generator"]), None)
    divisor = env.polynomial(polynomials.read_polynomial(root["divisor"]))
    radicand = trees.evaluate(root["radicand"], env)
    over = numbers.inverse(numbers.mul(divisor, divisor))
    stated = radicand if square is None else numbers.mul(env.polynomial(polynomials.read_polynomial(square)), over)
    return _theorem(name, head, radicand, stated, [], certificate["generators"], [])


def _scale(left, right, component: dict, scope: dict) -> list[dict]:
    """Denominators of the certificate that the sides lack once exact zeros have left: 0 / cos is 0.

    The recorded numerator is that of the sides times these.
    """
    env = points.Expanded(scope, WORK)
    difference = numbers.add(_expanded(left, env), numbers.neg(_expanded(right, env)))
    have = {} if type(difference) is int else dict(difference.factors)
    missing: list[dict] = []
    for text, times in component["denominators"]:
        factor = polynomials.read_polynomial(text)
        key = tuple(sorted(env.named(factor).items()))
        missing += [factor] * max(0, times - have.get(key, 0))
    return missing


def _expanded(term: Any, env: points.Expanded) -> Any:  # noqa: ANN401  0, or a value of the checker's ring
    if not isinstance(term, Term):
        return 0
    match term.node:
        case ("Var", name):
            return env.generator(name)
        case ("Int", number):
            return env.constant(number)
        case ("Opp", a):
            return -_expanded(Term(a), env)
        case ("Inv", a):
            return _expanded(Term(a), env).inverse()
        case (operation, a, b):
            first, second = _expanded(Term(a), env), _expanded(Term(b), env)
            return first + second if operation == "Add" else first * second


def _pairs(certificate: dict, component: dict) -> list[tuple[dict, str, dict]]:
    """(cofactor, generator, square) of every relation that this component uses."""
    return [
        (polynomials.read_polynomial(cofactor), relation["generator"], polynomials.read_polynomial(relation["square"]))
        for relation, cofactor in zip(certificate["relations"], component["cofactors"], strict=True)
        if cofactor
    ]


def _theorem(name: str, head: str, left, right, pairs: list, generators: list[Any], scale: list[dict]) -> Theorem:
    sides = [part.node if isinstance(part, Term) else ("Int", 0) for part in (left, right)]
    variables: dict[str, int] = {}
    for side in sides:
        collect(side, variables)
    for cofactor, generator, square in pairs:
        for terms in (cofactor, square, {((generators.index(generator), 2),): 1}):
            for key in terms:
                for index, _ in key:
                    variables.setdefault(generators[index], len(variables) + 1)
    for terms in scale:
        for key in terms:
            for index, _ in key:
                variables.setdefault(generators[index], len(variables) + 1)
    divisors = [node for node in dict.fromkeys(d for side in sides for d in _divisors(side)) if node[0] != "Int"]
    names = _readable(variables)
    place = {index: variables[generator] for index, generator in enumerate(generators) if generator in variables}
    shown = {index: names[generators[index]] for index in place}
    hypotheses = [
        f"{names[generator]} * {names[generator]} - ({_polynomial(square, shown)}) = 0"
        for _, generator, square in pairs
    ]
    hypotheses += [f"{_shown(node, names)} <> 0" for node in divisors]
    hypotheses += [f"{_polynomial(terms, shown)} <> 0" for terms in scale]
    relations = "; ".join(
        f"({written(cofactor, place)}, PEsub (PEmul (PEX Z {variables[g]}) (PEX Z {variables[g]})) "
        f"({written(square, place)}))"
        for cofactor, g, square in pairs
    )
    lemma = "proved"
    if len(relations) > LONGEST:
        lemma = "by_reduction"
        relations = "; ".join(f"({variables[g]}%positive, {written(square, place)})" for _, g, square in pairs)
    given = " ".join(f"h{k}" for k in range(len(hypotheses)))
    held = conjunction([f"h{k}" for k in range(len(pairs))])
    split = len(pairs) + len(divisors)
    divided = conjunction([f"h{k}" for k in range(len(pairs), split)])
    scaled = conjunction([f"h{k}" for k in range(split, len(hypotheses))])
    quantified = f"forall ({' '.join(names.values())} : R), " if names else ""
    binder = " ".join([*names.values(), given]).strip()
    stated = " ->\n  ".join([*hypotheses, f"{_shown(sides[0], names)}\n  = {_shown(sides[1], names)}"])
    left_text, right_text = (reified(side, variables) for side in sides)
    divisor_text = "; ".join(reified(node, variables) for node in divisors)
    scale_text = "; ".join(written(terms, place) for terms in scale)
    return Theorem(
        name,
        f"{head}Theorem {name} : {quantified}\n  {stated}.\nProof.\n"
        + (f"  intros {binder}.\n" if binder else "")
        + f"  refine ({lemma} [{'; '.join(names.values())}]\n    ({left_text})\n    ({right_text})\n    [{relations}]\n"
        f"    [{divisor_text}]\n    [{scale_text}]\n"
        f"    {held} {divided} {scaled} _).\n  vm_cast_no_check (eq_refl true).\nQed.\n",
    )


def conjunction(names: Sequence[str]) -> str:
    text = "I"
    for name in reversed(names):
        text = f"(conj {name} {text})"
    return text


def collect(node: tuple, variables: dict[str, int]) -> dict[str, int]:
    """Numbers of the variables, from 1 on, with those that an expression adds."""
    if node[0] == "Var":
        variables.setdefault(node[1], len(variables) + 1)
    elif node[0] != "Int":
        for part in node[1:]:
            collect(part, variables)
    return variables


def _divisors(node: tuple) -> Iterator[tuple]:
    if node[0] in ("Add", "Mul", "Opp", "Inv"):
        if node[0] == "Inv":
            yield node[1]
        for part in node[1:]:
            yield from _divisors(part)


def _readable(variables: Mapping[str, int]) -> dict[str, str]:
    """Generator -> a Coq name: cos(a) is cos_a, xi[1] is xi_1."""
    names: dict[str, str] = {}
    for generator in variables:
        name = re.sub(r"\W+", "_", generator).strip("_")
        while name in RESERVED or name in names.values() or re.fullmatch(r"h\d+|gathered_\d+", name):
            name += "_"
        names[generator] = name
    return names


def _shown(node: tuple, names: Mapping[str, str]) -> str:
    match node:
        case ("Var", name):
            return names[name]
        case ("Int", number):
            return str(number) if number >= 0 else f"({number})"
        case ("Add", a, b):
            return f"({_shown(a, names)} + {_shown(b, names)})"
        case ("Mul", a, b):
            return f"({_shown(a, names)} * {_shown(b, names)})"
        case ("Opp", a):
            return f"(- {_shown(a, names)})"
        case ("Inv", a):
            return f"(/ {_shown(a, names)})"
        case _:
            raise ValueError(f"{node[0]} is no node of a term")


def reified(node: tuple, variables: Mapping[str, int]) -> str:
    match node:
        case ("Var", name):
            return f"Var {variables[name]}"
        case ("Int", number):
            return f"Int ({number})"
    return f"{node[0]} " + " ".join(f"({reified(part, variables)})" for part in node[1:])


def _monomials(terms: dict) -> list[tuple[tuple, int]]:
    return sorted(terms.items(), reverse=True)


def written(terms: dict, place: Mapping[int, int]) -> str:
    """A polynomial as an expression of Coq's ring tactic."""
    text = ""
    for key, amount in _monomials(terms):
        term = f"PEc ({amount})%Z"
        for index, exponent in key:
            factor = f"PEX Z {place[index]}"
            factor = factor if exponent == 1 else f"PEpow ({factor}) {exponent}%N"
            term = f"PEmul ({term}) ({factor})"
        text = f"PEadd ({text}) ({term})" if text else term
    return text or "PEc 0%Z"


def _polynomial(terms: dict, shown: Mapping[int, str]) -> str:
    """The same polynomial as a reader sees it."""
    text = ""
    for key, amount in _monomials(terms):
        term = str(amount) if amount >= 0 else f"({amount})"
        for index, exponent in key:
            term += f" * {shown[index]}" + (f" ^ {exponent}" if exponent > 1 else "")
        text = f"{text} + {term}" if text else term
    return text or "0"
