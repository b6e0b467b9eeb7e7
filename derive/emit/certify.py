"""Print a schedule as one C99 header that proves contacts: straight-line code in midpoint-radius arithmetic.

The operations are those of :mod:`derive.emit.certified`, which writes them as tables for the library's slower
arithmetics. Residual at a point and Jacobian over a box are one function, so that the compiler finds what midpoints of
both share; the same text serves one point and as many as there are lanes. The header needs ``sqrt`` only and has no
heap and no writable data.
"""

from derive.emit import embedded
from derive.emit.c99 import number
from derive.emit.certified import operations_of
from derive.emit.render import render


class _Text:
    """Statements of one function in one arithmetic; ``read`` maps leaves to what they are read by."""

    def __init__(self, tape, prefix, type_, suffix, read):
        self.tape, self.prefix, self.type, self.suffix, self.read = tape, prefix, type_, suffix, read
        self.names, self.statements = {}, []

    def of(self, outputs):
        """Operands of ``outputs``, once their statements are written."""
        for op, results, args in operations_of(self.tape, outputs, self.read.keys()):
            self._write(op, results, [self._operand(a) for a in args])
        return [self._operand(i) for i in outputs]

    def _operand(self, i):
        if i not in self.names:
            self.names[i] = name = f"{self.suffix}{len(self.names)}"
            self.statements.append(f"const {self.type} {name} = {self._leaf(i)};")
        return self.names[i]

    def _leaf(self, i):
        if self.tape.const_value(i) is None:
            return self.read[i]
        high, low, radius = map(number, self.tape.enclosure(i).parts())
        wide = f"mwc_wide({high}, {low}, {radius})"
        return wide if self.type == "mw_wide" else f"mwc_of_wide({wide})" if low != "0.0" else f"mwc_make({high}, 0.0)"

    def _write(self, op, results, args):
        names = [f"{self.suffix}{len(self.names) + k}" for k in range(len(results))]
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


def _balls(tape, suffix, read, outputs):
    text = _Text(tape, "mwc_", "mw_ball", suffix, read)
    return {"results": text.of(outputs), "statements": text.statements}


def header(plan, description, runtime):
    """The text of the drive's header.

    ``description`` is the drive's metadata, ``runtime`` the folder of the C runtime.
    """
    tape, lower, slots = plan.tape, plan.lower, list(plan.state)
    shared = {n: f"MWC_SHARED(s, {k})" for n, k in plan.state.items() if k < plan.design_slots}
    own = {n: f"MWC_OWN(t, {k - plan.design_slots})" for n, k in plan.state.items() if k >= plan.design_slots}
    at = {lower(u): f"mwc_make(x[{k} * MW_LANES + l], 0.0)" for k, u in enumerate(plan.unknowns)}
    about = {lower(u): f"mwc_make(x[{k} * MW_LANES + l], d[{k}])" for k, u in enumerate(plan.unknowns)}
    given = {lower(p.symbol): f"p[{k}]" for k, p in enumerate(plan.drive.parameters)}
    setup = _Text(tape, "mwc_wide_", "mw_wide", "w", given)
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
        slots=len(slots),
        setup={"results": setup.of(slots[: plan.design_slots]), "statements": setup.statements},
        instant=_balls(tape, "b", shared | {lower(plan.drive.instant): "MWC_OWN(phi, 0)"}, slots[plan.design_slots :]),
        residual=_balls(tape, "p", shared | own | at, plan.residual),
        jacobian=_balls(tape, "b", shared | own | about, [e for row in plan.jacobian for e in row]),
        scales=_balls(tape, "b", shared | own, plan.scales),
    )
