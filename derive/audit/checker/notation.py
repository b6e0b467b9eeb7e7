"""The notation in which readings are written, read anew from their text."""

import ast
import re

from .refusal import Rejected, require

ARITY = {
    **dict.fromkeys(("cos", "sin", "tan", "sqrt", "Rx", "Ry", "Rz", "T"), 1),
    **dict.fromkeys(("dot", "cross", "atan2"), 2),
    **dict.fromkeys(("triple", "vec"), 3),
}
FORMULA_ARITY = ARITY | dict.fromkeys(("asin", "acos", "atan", "degrees", "radians"), 1)


def read_equation(text: str, jets: dict) -> list:
    """Both sides of `left = right` as trees."""
    left, right = re.sub(r"(\w)('+)", lambda m: f"{m[1]}[{len(m[2])}]", text).split(" = ")
    return [read_text(left, jets, ARITY), read_text(right, jets, ARITY)]


def read_formula(text: str) -> object:
    """A formula with numbers put in; decimals become quotients."""
    exact = re.sub(r"(\d+)\.(\d+)", lambda m: f"({int(m[1] + m[2])}/{10 ** len(m[2])})", text)
    return read_text(exact, {}, FORMULA_ARITY)


def read_text(text: str, jets: dict, arity: dict) -> object:
    try:
        return translated(ast.parse(" ".join(text.split()), mode="eval").body, jets, arity)
    except SyntaxError as error:
        raise Rejected(f"a reading is no formula: {text!r}") from error


def translated(node, jets: dict, arity: dict) -> object:
    """Python's syntax tree as a tree of the record."""
    again = lambda part: translated(part, jets, arity)  # noqa: E731
    match node:
        case ast.Constant(value=int(value)):
            return value
        case ast.Name(id=name):
            return ["jet", name, *(0 for _ in jets[name])] if name in jets else name
        case ast.UnaryOp(op=ast.USub(), operand=operand):
            return ["-", again(operand)]
        case ast.BinOp(left=left, op=operator, right=right):
            return joined_by(operator, again(left), again(right))
        case ast.Subscript(value=ast.Name(id=name), slice=place):
            orders = ast.literal_eval(place)
            return ["jet", name, *(orders if type(orders) is tuple else (orders,))]
        case ast.Attribute(value=value, attr=("x" | "y" | "z") as axis):
            return ["at", again(value), "xyz".index(axis)]
        case ast.Call(func=ast.Name(id="d"), args=[expression, *directions]):
            moved = [[n.elts[0].id, again(n.elts[1])] if isinstance(n, ast.Tuple) else [n.id, 1] for n in directions]
            return ["d", again(expression), *moved]
        case ast.Call(func=ast.Name(id="mat"), args=rows):
            return ["mat", *([again(entry) for entry in row.elts] for row in rows)]
        case ast.Call(func=ast.Name(id="entry"), args=[matrix, row, column]):
            return ["entry", again(matrix), row.value - 1, column.value - 1]
        case ast.Call(func=ast.Name(id=name), args=arguments) if arity.get(name) == len(arguments):
            return [name, *map(again, arguments)]
    raise Rejected(f"a reading holds {type(node).__name__}, which is not part of the notation")


def joined_by(operator, left, right):
    if isinstance(operator, ast.Add | ast.Sub):
        right = right if isinstance(operator, ast.Add) else ["-", right]
        return ["+", *(left[1:] if left_is(left, "+") else [left]), right]
    if isinstance(operator, ast.Mult | ast.Div):
        if left_is(left, "-"):  # -a b is printed and meant as -(a b)
            return ["-", joined_by(operator, left[1], right)]
        if isinstance(operator, ast.Div):
            return ["/", left, right]
        return ["*", *(left[1:] if left_is(left, "*") else [left]), right]
    if isinstance(operator, ast.MatMult):
        return ["@", left, right]
    exponent = -right[1] if left_is(right, "-") else right
    require(isinstance(operator, ast.Pow) and type(exponent) is int, "a reading holds an operator out of the notation")
    return ["^", left, exponent]


def left_is(tree, operation: str) -> bool:
    return type(tree) is list and tree[0] == operation
