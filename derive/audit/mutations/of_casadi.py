"""Changes of CasADi's functions: one instruction at a time."""

from collections.abc import Iterator
from types import ModuleType

SWAPPED = {"OP_ADD": "-", "OP_SUB": "+", "OP_MUL": "+", "OP_DIV": "*"}


def rebuilt(function, at: int, kind: str):
    """A CasADi function of the same instructions, the one at a place changed: operation, operands or constant."""
    import casadi

    codes = {getattr(casadi, name): name for name in dir(casadi) if name.startswith("OP_")}
    given = function.sx_in()
    made = [casadi.SX.zeros(function.sparsity_out(k)) for k in range(function.n_out())]
    work: dict = {}
    for k in range(function.n_instructions()):
        code = function.instruction_id(k)
        a, b = function.instruction_input(k), function.instruction_output(k)
        match codes[code]:
            case "OP_INPUT":
                work[b[0]] = given[a[0]].nz[a[1]]
            case "OP_CONST":
                constant = function.instruction_constant(k)
                work[b[0]] = casadi.SX(constant + 0.5 if k == at else constant)
            case "OP_OUTPUT":
                made[b[0]].nz[b[1]] = work[a[0]]
            case name:
                operands = [work[i] for i in a]
                if k == at and kind == "swap":
                    operands.reverse()
                if k == at and kind == "operation":
                    x, y = operands
                    work[b[0]] = {"-": x - y, "+": x + y, "*": x * y}[SWAPPED[name]]
                elif k == at and kind == "sign":
                    work[b[0]] = -_operation(casadi, code, operands)
                else:
                    work[b[0]] = _operation(casadi, code, operands)
    return casadi.Function(function.name(), given, made, function.name_in(), function.name_out())


def _operation(casadi: ModuleType, code: int, operands: list):
    return casadi.SX.binary(code, *operands) if len(operands) == 2 else casadi.SX.unary(code, *operands)


def of_casadi(function) -> Iterator[tuple[int, str]]:
    """Instructions and how they can be changed."""
    import casadi

    codes = {getattr(casadi, name): name for name in dir(casadi) if name.startswith("OP_")}
    for k in range(function.n_instructions()):
        match codes[function.instruction_id(k)]:
            case "OP_INPUT" | "OP_OUTPUT":
                continue
            case "OP_CONST":
                yield k, "constant"
            case name:
                if name in SWAPPED and k % 2:
                    yield k, "operation"
                else:
                    yield k, "swap" if name in ("OP_SUB", "OP_DIV") else "sign"
