"""A chain with real derivatives as Coq theorems: locus, normal and equation of meshing of the wheel cut by a ZN hob.

Input: the drive's own description (hob surface, cutting motion, envelope). Output: a Coq file in which partial
derivatives are limits (Coquelicot's `is_derive`), angles are real numbers and cos, sin, are the real functions. The
locus is the description's product of motions; that its partial derivatives, the cross product of two of them and the
product with the third are the description's normal and equation of meshing, Coq proves.
"""

from functools import reduce as fold

import sympy as sp

from derive.audit.kernel.translate import Term, collect, conjunction, reified, written
from derive.drives import cylindrical_worm
from derive.language import vectors as v
from derive.language.definitions import Definitions
from derive.language.envelope import envelope
from derive.language.symbols import Quantity
from derive.prove.normal_form import Relation, reduce

CHAIN = "zn_wheel"
AXES = "xyz"


def file_text() -> str:
    """The Coq file of the chain."""
    definitions = Definitions()
    _, hob = cylindrical_worm.helicoids("ZN", "ZN", definitions)
    phi = Quantity("phi", "rad", "angle of the hob")
    wheel = envelope(hob.flank, cylindrical_worm.cutting(phi), phi)
    t, psi, *_ = wheel.parameters
    plain = _Plain(definitions, keep={"r_t_hob"})
    locus = tuple(map(plain, wheel.body_point))
    normal = tuple(map(plain, hob.flank.placed(cylindrical_worm.cutting(phi)).body_normal))
    meshing = plain(wheel.conditions[-1])
    variables = {"t": plain(t), "psi": plain(psi), "phi": plain(phi)}
    symbols = sorted(set().union(*(e.free_symbols for e in (*locus, meshing))) - set(variables.values()), key=str)
    names = {symbol: str(symbol) for symbol in symbols} | {symbol: name for name, symbol in variables.items()}
    return _File(names, variables, sp.Symbol("s")).text(locus, normal, meshing)


class _Plain:
    """Names put in, down to those kept; the screw parameter and the ratio of the cutting become one symbol each."""

    def __init__(self, definitions: Definitions, keep: set[str]):
        self.definitions, self.keep = definitions, keep

    def __call__(self, expression: sp.Expr) -> sp.Expr:
        while known := {
            symbol: self.definitions[symbol]
            for symbol in expression.free_symbols
            if symbol in self.definitions and str(symbol) not in self.keep
        }:
            expression = expression.xreplace(known)
        lead, radius = cylindrical_worm.lam_h, cylindrical_worm.r_h
        expression = expression.subs({sp.tan(lead): sp.Symbol("p") / radius})
        expression = expression.subs({cylindrical_worm.T_h: sp.Symbol("m") * cylindrical_worm.T_2})
        return expression.xreplace({symbol: sp.Symbol(str(symbol)) for symbol in expression.free_symbols})


class _File:
    """Writes expressions in Coq's words; every cosine and sine is a generator of its own."""

    def __init__(self, names: dict, variables: dict, sign: sp.Symbol):
        self.names, self.variables, self.sign = names, variables, sign
        self.binder = " ".join(names.values())
        self.typed = f"({self.binder} : R)"

    def real(self, e: sp.Expr) -> str:
        match e:
            case sp.Symbol():
                return self.names[e]
            case sp.Integer():
                return str(e) if int(e) >= 0 else f"({e})"
            case sp.cos() | sp.sin():
                return f"({type(e).__name__} {self.real(e.args[0])})"
            case sp.Add():
                return "(" + " + ".join(map(self.real, e.args)) + ")"
            case sp.Mul():
                return "(" + " * ".join(map(self.real, e.args)) + ")"
            case sp.Pow() if isinstance(e.exp, sp.Integer) and int(e.exp) > 0:
                return "(" + " * ".join([self.real(e.base)] * int(e.exp)) + ")"
        raise ValueError(f"{e} has no place in the chain")

    def term(self, e: sp.Expr) -> Term:
        """The same as an expression over generators, whose names are Coq's words for them."""
        match e:
            case sp.Symbol() | sp.cos() | sp.sin():
                return Term(("Var", self.real(e)))
            case sp.Integer():
                return Term(("Int", int(e)))
            case sp.Add():
                return fold(Term.__add__, map(self.term, e.args))
            case sp.Mul():
                return fold(lambda a, b: Term(("Mul", a.node, b.node)), map(self.term, e.args))
            case sp.Pow():
                return fold(lambda a, b: Term(("Mul", a.node, b.node)), [self.term(e.base)] * int(e.exp))
        raise ValueError(f"{e} has no place in the chain")

    def text(self, locus, normal, meshing) -> str:
        rates = {
            (axis, name): sp.diff(component, symbol)
            for axis, component in zip(AXES, locus, strict=True)
            for name, symbol in self.variables.items()
        }
        tangent, sweep, velocity = (tuple(rates[axis, name] for axis in AXES) for name in ("t", "psi", "phi"))
        cross = v.cross(tangent, sweep)
        parts = [_HEAD]
        for axis, component in zip(AXES, locus, strict=True):
            parts.append(f"Definition locus_{axis} {self.typed} : R :=\n  {self.real(component)}.\n")
        for (axis, name), rate in rates.items():
            parts.append(self.derivative(axis, name, rate))
        for axis, component in zip(AXES, normal, strict=True):
            parts.append(f"Definition normal_{axis} {self.typed} : R :=\n  {self.real(component)}.\n")
        for k, axis in enumerate(AXES):
            stated = f"normal_{axis} {self.binder} =\n    {self.real(-self.sign)} * ({self.crossed(k)})"
            slopes = [(other, name) for other in AXES if other != axis for name in ("t", "psi")]
            parts.append(self.theorem(f"the_normal_{axis}", stated, normal[k], -self.sign * cross[k], slopes))
        power = " + ".join(f"normal_{axis} {self.binder} * {self.slope(axis, 'phi')}" for axis in AXES)
        parts.append(f"Definition meshing {self.typed} : R :=\n  {self.real(meshing)}.\n")
        moved = sum((n * r for n, r in zip(normal, velocity, strict=True)), sp.Integer(0))
        stated = f"meshing {self.binder} =\n    {power}"
        slopes = [(axis, "phi") for axis in AXES]
        parts.append(self.theorem("the_equation_of_meshing", stated, meshing, moved, slopes))
        return "\n".join(parts) + _FOOT

    def derivative(self, axis: str, name: str, rate: sp.Expr) -> str:
        """One partial derivative of the locus, as a limit."""
        return (
            f"Lemma {axis}_{name} {self.typed} :\n"
            f"  is_derive {self.along(axis, name)} {name}\n"
            f"    {self.real(rate)}.\nProof. unfold locus_{axis}; auto_derive; [repeat split | ring]. Qed.\n"
        )

    def slope(self, axis: str, name: str) -> str:
        return f"Derive {self.along(axis, name)} {name}"

    def along(self, axis: str, name: str) -> str:
        """A component of the locus as a function of one variable."""
        return f"(fun x : R => locus_{axis} {' '.join('x' if k == name else k for k in self.names.values())})"

    def crossed(self, k: int) -> str:
        a, b = AXES[(k + 1) % 3], AXES[(k + 2) % 3]
        return f"{self.slope(a, 't')} * {self.slope(b, 'psi')}\n      - {self.slope(b, 't')} * {self.slope(a, 'psi')}"

    def theorem(self, name: str, stated: str, left: sp.Expr, right: sp.Expr, slopes: list) -> str:
        """An equality in which every Derive has been rewritten, decided on the circles of its angles."""
        sides = [self.term(left), self.term(right)]
        generators = sorted(collect(sides[1].node, collect(sides[0].node, {})))
        generators += [g.replace("(sin ", "(cos ") for g in generators if g.startswith("(sin ")]
        generators = list(dict.fromkeys(generators))
        place = {g: k for k, g in enumerate(generators)}
        relations = [
            Relation("circle", g, _terms(place, {(): 1, ((g.replace("(sin ", "(cos "), 2),): -1}))
            for g in generators
            if g.startswith("(sin ")
        ]
        relations.append(Relation("sign", "s", _terms(place, {(): 1})))
        difference = _polynomial(left - right, self, place)
        reduction = reduce(difference, tuple(relations), place)
        if reduction.remainder:
            raise ValueError(f"{name} is not an identity of the description")
        numbered = {k: k + 1 for k in place.values()}
        squares = {g: f"PEmul (PEX Z {k + 1}) (PEX Z {k + 1})" for g, k in place.items()}
        pairs = "; ".join(
            f"({written(_sparse(cofactor), numbered)}, "
            f"PEsub ({squares[r.generator]}) ({written(_sparse(r.square), numbered)}))"
            for r, cofactor in zip(relations, reduction.cofactors, strict=True)
        )
        held = conjunction(["h" if r.kind == "sign" else f"(circle {r.generator[5:-1]})" for r in relations])
        left_text, right_text = (reified(side.node, {g: k + 1 for g, k in place.items()}) for side in sides)
        rewritten = "".join(
            f"  rewrite (is_derive_unique _ _ _ ({axis}_{variable} {self.binder})).\n" for axis, variable in slopes
        )
        return (
            f"Theorem {name} {self.typed} : s * s - 1 = 0 ->\n  {stated}.\nProof.\n  intros h.\n{rewritten}"
            f"  unfold normal_x, normal_y, normal_z{', meshing' if stated.startswith('meshing') else ''}.\n"
            f"  transitivity ({self.real(right)}); [|ring].\n"
            f"  refine (proved [{'; '.join(generators)}]\n    ({left_text})\n    ({right_text})\n    [{pairs}] [] []\n"
            f"    {held} I I _).\n  vm_cast_no_check (eq_refl true).\nQed.\n"
        )


def _terms(place: dict, terms: dict) -> dict:
    """Generator powers as exponent tuples."""
    found = {}
    for key, amount in terms.items():
        powers = [0] * len(place)
        for name, exponent in key:
            powers[place[name]] = exponent
        found[tuple(powers)] = amount
    return found


def _sparse(terms: dict) -> dict:
    return {tuple((k, e) for k, e in enumerate(powers) if e): amount for powers, amount in terms.items()}


def _polynomial(e: sp.Expr, file: _File, place: dict) -> dict:
    """An expression as a polynomial in its generators."""
    atoms = {a: sp.Symbol(f"g{place[file.real(a)]}") for a in (*e.atoms(sp.cos, sp.sin),)}
    flat = e.xreplace(atoms)
    flat = flat.xreplace({a: sp.Symbol(f"g{place[file.real(a)]}") for a in flat.free_symbols if a in file.names})
    generators = [sp.Symbol(f"g{k}") for k in range(len(place))]
    return {powers: int(amount) for powers, amount in sp.Poly(flat, *generators).terms()}


_HEAD = """(** The wheel cut by a ZN hob: locus of the hob in the wheel's body, its normal, its equation of meshing.

    t along the blade's edge, psi the screw angle, phi the angle of the hob in cutting; m wheel turns per hob turn, p
    the screw parameter, s the flank. Derivatives are limits. *)

From Coq Require Import Reals ZArith NArith List Ring_polynom.
From Coquelicot Require Import Coquelicot.
From Meshwright Require Import Certificate.
Import ListNotations.
Local Open Scope R_scope.

Lemma circle x : sin x * sin x - (-1 * cos x ^ 2 + 1) = 0.
Proof. generalize (sin2_cos2 x); unfold Rsqr; intros <-; ring. Qed.
"""

_FOOT = """
Definition every_proof := (the_normal_x, the_normal_y, the_normal_z, the_equation_of_meshing).
Print Assumptions every_proof.
"""
