"""Print a schedule as one C99 header that proves contacts: straight-line code in midpoint-radius arithmetic.

The operations are those of :mod:`derive.emit.certified`, which writes them as tables for the library's slower
arithmetics, of routines that are not fused. Residual at a point and Jacobian over a box are one function, so that the
compiler finds what midpoints of both share; the same text serves one point and as many as there are lanes. The header
needs ``sqrt`` only and has no heap and no writable data.

Where the Jacobian's radii are known for a whole domain (``runtime/c/certify/domain.h``), residual and Jacobian take a
function of midpoints, with radii only of what the residual reads. It has the operations of the table of both, one by
one.
"""

from collections import Counter

from derive.emit import embedded
from derive.emit.c99 import names_of, number
from derive.emit.certified import operations_of
from derive.emit.render import render


def _reached(steps, outputs):
    """What the outputs are computed from by these steps, and they themselves."""
    found = {*outputs}
    for _, results, args in reversed(steps):
        if found & {*results}:
            found |= {*args}
    return found


def _named(names, own):
    """Function: node → the name of its variable, which begins with ``own``; nobody reads what is no node."""
    apart = names.apart()
    return lambda i: f"{own}_unread_{apart(i[1])}" if isinstance(i, tuple) else f"{own}_{apart(i)}"


class _Text:
    """Statements of one function in one arithmetic; ``read`` maps leaves to what they are read by."""

    def __init__(self, names, prefix, type_, own, read):
        self.tape, self.prefix, self.type, self.read = names.tape, prefix, type_, read
        self.name, self.names, self.statements = _named(names, own), {}, []

    def of(self, made, outputs):
        """Operands of these ``outputs`` of a routine, once their statements are written."""
        steps = operations_of(made)
        wanted = _reached(steps, outputs)
        for op, results, args in steps:
            if wanted & {*results}:
                self._write(op, results, [self._operand(a) for a in args])
        return [self._operand(i) for i in outputs]

    def _operand(self, i):
        if i not in self.names:
            self.names[i] = name = self.name(i)
            self.statements.append(f"const {self.type} {name} = {self._leaf(i)};")
        return self.names[i]

    def _leaf(self, i):
        if self.tape.const_value(i) is None:
            return self.read[i]
        high, low, radius = map(number, self.tape.enclosure(i).parts())
        wide = f"mwc_wide({high}, {low}, {radius})"
        return wide if self.type == "mw_wide" else f"mwc_of_wide({wide})" if low != "0.0" else f"mwc_make({high}, 0.0)"

    def _write(self, op, results, args):
        names = [self.name(i) for i in results]
        self.names |= dict(zip(results, names, strict=True))
        if op == "sincos":
            self._turn(names, args[0])
        else:
            self.statements.append(f"const {self.type} {names[0]} = {self.prefix}{op}({', '.join(args)});")

    def _turn(self, names, angle):
        sine, cosine = names
        if self.type == "mw_wide":
            self.statements.append(f"mw_wide {sine}, {cosine};")
            self.statements.append(f"mwc_wide_sincos({angle}, &{sine}, &{cosine});")
        else:
            self.statements.append(f"const mwc_turn turn_{sine} = mwc_turned({angle});")
            self.statements.append(f"const mw_ball {sine} = turn_{sine}.sine, {cosine} = turn_{sine}.cosine;")


class _Point:
    """Statements of residual and Jacobian at a point.

    A number has the middle ``m_<name>`` and, if the residual reads it and it is not exact, the radius ``r_<name>`` in
    units of 2⁻⁵³. ``read`` maps leaves to what middle and radius are read by, ``most`` numbers of the design to what
    their largest size is read by. ``guards`` are what ``domain.h`` looks at, in the order of the operations.
    """

    def __init__(self, names, made, read, most, equations):
        residual, jacobian = made.outputs[:equations], made.outputs[equations:]
        self.tape, self.read, self.most, self.name = made.tape, read, most, _named(names, "m")
        self.steps = operations_of(made)
        self.wide = _reached(self.steps, residual)
        self.factor = Counter(a for op, _, args in self.steps if op == "mul" for a in args)
        self.names, self.radii, self.statements, self.guards = {}, {}, [], []
        quotients = {results[0] for op, results, _ in self.steps if op == "div"}
        for op, results, args in self.steps:
            names = [self._operand(a) for a in args]
            if op == "mul" and quotients & {*args}:
                self.guards.append(f"-mwc_abs({names[args[0] in quotients]})")
            self._write(op, results, names, args)
        self.residual = [(self._operand(i), self.radii.get(i, "0.0")) for i in residual]
        self.jacobian = [self._operand(i) for i in jacobian]

    def _say(self, node, middle, radius):
        """A name for a node, with the text of its radius, None where it is exact."""
        self.names[node] = name = self.name(node)
        self.statements.append(f"const double {name} = {middle};")
        if radius is not None and node in self.wide:
            self.radii[node] = of = f"r{name[1:]}"
            self.statements.append(f"const double {of} = {radius};")
        return name

    def _operand(self, i):
        if i in self.names:
            return self.names[i]
        if self.tape.const_value(i) is None:
            return self._say(i, *self.read[i])
        high, low, radius = self.tape.enclosure(i).parts()
        off = (abs(low) + radius) * 2.0**53 * (1.0 + 2.0**-40)
        return self._say(i, number(high), number(off) if off else None)

    def _write(self, op, results, names, args):
        node, first, last = results[0], names[0], names[-1]
        ra, rb = (self.radii.get(a) for a in (args[0], args[-1]))
        m = self.name(node)
        match op:
            case "add" | "sub":
                known = [r for r in (ra, rb) if r]
                radius = {0: f"mwc_abs({m})", 1: f"{' + '.join(known)} + mwc_abs({m})"}.get(
                    len(known), f"mwc_units_sum({ra}, {rb}, {m})"
                )
                self._say(node, f"{first} {'+' if op == 'add' else '-'} {last}", radius)
            case "mul":
                self._say(node, f"{first} * {last}", self._product(m, *zip(args, names, (ra, rb), strict=True)))
            case "sqr":
                radius = f"mwc_units_square({first}, {ra}, {m})" if ra else f"mwc_units_rounded({m})"
                self._say(node, f"{first} * {first}", radius)
            case "div":
                self.guards += [f"mwc_abs({last})", f"-mwc_abs({first})"]
                self._say(node, f"{first} / {last}", f"mwc_units_quotient({ra or 0.0}, {last}, {rb or 0.0}, {m})")
            case "neg":
                self._say(node, f"-{first}", ra)
            case "sqrt":
                self.guards.append(first)
                self._say(node, f"sqrt({first})", f"mwc_units_root({ra or 0.0}, {m})")
            case "sincos":
                self._turn(results, first, ra or 0.0)
            case "atan2":
                self.guards.append(f"mwc_uncut({first}, {last})")
                near = f"mwc_atan2(mwc_units_ball({first}, {ra or 0.0}), mwc_units_ball({last}, {rb or 0.0}))"
                self.statements.append(f"const mw_ball near_{m} = {near};")
                self._say(node, f"near_{m}.mid", f"MWC_UNITS * near_{m}.radius")
            case "magnitude":
                self._say(node, f"mwc_abs({first})", ra)
            case _:  # the sign, known where what is looked at says so
                self.guards.append(f"mwc_abs({first})")
                self._say(node, f"mwc_units_sign({first})", None)

    def _product(self, m, first, second):
        """Text of a product's radius. The factor whose largest size is known, or else wanted most, goes second."""
        (_, a, ra), (_, b, rb) = first, second
        if not (ra and rb):
            exact, other = (a, rb) if rb else (b, ra)
            return f"mwc_units_share({exact}, {other}, {m})" if other else f"mwc_units_rounded({m})"
        if max(first, second, key=self._rank) is first:
            (_, a, ra), (of, b, rb) = second, first
        else:
            of = second[0]
        if of in self.most:
            return f"mwc_units_scaled({a}, {ra}, {self.most[of]}, {rb}, {m})"
        return f"mwc_units_product({a}, {ra}, {b}, {rb}, {m})"

    def _rank(self, factor):
        return factor[0] in self.most, self.factor[factor[0]]

    def _turn(self, results, angle, radius):
        turn = f"turn_{angle}"
        sine, cosine = f"{turn}.sine.mid", f"{turn}.cosine.mid"
        self.statements.append(f"const mwc_turn {turn} = mwc_turned(mwc_make({angle}, 0.0));")
        size = f"mwc_units_size({angle}, {sine})"
        self._say(results[0], sine, f"mwc_units_turned({radius}, {cosine}, {size})")
        self._say(results[1], cosine, f"mwc_units_turned({radius}, {sine}, 1.0)")


def _balls(names, made, own, read, outputs=None):
    text = _Text(names, "mwc_", "mw_ball", own, read)
    return {"results": text.of(made, made.outputs if outputs is None else outputs), "statements": text.statements}


#: Functions that are printed in this arithmetic.
FUNCTIONS = ("setup", "set_phi", "eval", "scale")


def header(plan, routines, description, runtime):
    """The text of the drive's header.

    ``description`` is the drive's metadata, ``runtime`` the folder of the C runtime.
    """
    names, lower = names_of(plan), plan.lower
    shared = {n: f"MWC_SHARED(s, {k})" for n, k in plan.state.items() if k < plan.design_slots}
    own = {n: f"MWC_OWN(t, {k - plan.design_slots})" for n, k in plan.state.items() if k >= plan.design_slots}
    at = {lower(u): f"mwc_make(x[{k} * MW_LANES + l], 0.0)" for k, u in enumerate(plan.unknowns)}
    about = {lower(u): f"mwc_make(x[{k} * MW_LANES + l], d[{k}])" for k, u in enumerate(plan.unknowns)}
    shared_3 = {n: (f"s[{3 * k}]", f"s[{3 * k + 1}]") for n, k in plan.state.items() if k < plan.design_slots}
    most = {n: f"s[{3 * k + 2}]" for n, k in plan.state.items() if k < plan.design_slots}
    turned = {n: (f"({ball}).mid", f"MWC_UNITS * ({ball}).radius") for n, ball in own.items()}
    point = {lower(u): (f"x[{k} * MW_LANES + l]", None) for k, u in enumerate(plan.unknowns)}
    given = {lower(p.symbol): f"p[{k}]" for k, p in enumerate(plan.drive.parameters)}
    (_, kept), [turning], [both], [scales] = (routines[name] for name in FUNCTIONS)
    setup, count = _Text(names, "mwc_wide_", "mw_wide", "w", given), len(plan.residual)
    return render(
        "certify.h.jinja",
        drive=plan.drive,
        X=plan.drive.name,
        generator=description["generator"],
        unknowns=description["unknowns"],
        literal=number,
        arithmetic=embedded.arithmetic(runtime),
        test=embedded.test(runtime),
        design_slots=plan.design_slots,
        slots=len(plan.state),
        setup={"results": setup.of(kept, kept.outputs), "statements": setup.statements},
        instant=_balls(names, turning, "b", shared | {lower(plan.drive.instant): "MWC_OWN(phi, 0)"}),
        residual=_balls(names, both, "p", shared | own | at, both.outputs[:count]),
        jacobian=_balls(names, both, "b", shared | own | about, both.outputs[count:]),
        point=_Point(names, both, shared_3 | turned | point, most, count),
        columns=[*(k for k in range(len(plan.unknowns)) if k != description["error"]), description["error"]],
        scales=_balls(names, scales, "b", shared | own),
    )
