"""One-token changes of an expression.

To find what a misprint should read, and to show that a derived equation tolerates none.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from derive.prove.evaluate import Evaluator, components
from derive.prove.normal_form import reduce
from derive.prove.prover import Outcome, decide
from derive.prove.statement import Statement
from derive.prove.tree import Tree, children, rebuild, symbols

Groups = Sequence[Sequence[str]]


@dataclass(frozen=True)
class Edit:
    """What was changed, and the expression after the change."""

    change: str
    tree: Tree


def edits(tree: Tree, confusable: Groups = (), signs: Sequence[str] = ()) -> Iterator[Edit]:
    """Every expression one change away.

    A sign, cos for sin, one symbol for another of its group, a factor or term left out.
    """
    yield Edit("sign of the whole", negated(tree))
    yield from _exchanges_throughout(tree, confusable)
    yield from _local(tree, confusable, signs)


def negated(tree: Tree) -> Tree:
    return tree[1] if isinstance(tree, tuple) and tree[0] == "-" else ("-", tree)


def _exchanges_throughout(tree: Tree, confusable: Groups) -> Iterator[Edit]:
    present = symbols(tree)
    for group in confusable:
        for wrong in group:
            for right in group:
                if wrong in present and right != wrong:
                    yield Edit(f"{right} for {wrong} throughout", _exchanged(tree, wrong, right))


def _exchanged(tree: Tree, wrong: str, right: str) -> Tree:
    if isinstance(tree, str):
        return right if tree == wrong else tree
    if isinstance(tree, int) or tree[0] == "jet":
        return tree
    return rebuild(tree, [_exchanged(child, wrong, right) for child in children(tree)])


def _local(tree: Tree, confusable: Groups, signs: Sequence[str]) -> Iterator[Edit]:
    yield from _at_node(tree, confusable, signs)
    if isinstance(tree, tuple) and tree[0] not in ("jet", "sqrt"):  # the ring of a statement holds its own roots alone
        below = list(children(tree))
        for position, child in enumerate(below):
            for edit in _local(child, confusable, signs):
                yield Edit(edit.change, rebuild(tree, [*below[:position], edit.tree, *below[position + 1 :]]))


def _at_node(tree: Tree, confusable: Groups, signs: Sequence[str]) -> Iterator[Edit]:
    if isinstance(tree, str):
        for group in confusable:
            if tree in group:
                yield from (Edit(f"{other} for {tree}", other) for other in group if other != tree)
    if not isinstance(tree, tuple):
        return
    match tree[0]:
        case "+" | "vec":
            for position, term in enumerate(tree[1:], 1):
                yield Edit("sign of a term", _with(tree, position, negated(term)))
                yield from (Edit(f"{sign} on a term", _with(tree, position, ("*", sign, term))) for sign in signs)
            if tree[0] == "+":
                yield from (Edit("a term left out", _without(tree, position)) for position in range(1, len(tree)))
        case "*":
            yield from (Edit("a factor left out", _without(tree, position)) for position in range(1, len(tree)))
        case "cos" | "sin":
            other = "sin" if tree[0] == "cos" else "cos"
            yield Edit(f"{other} for {tree[0]}", (other, *tree[1:]))


def _with(tree: tuple, position: int, part: Tree) -> Tree:
    return (*tree[:position], part, *tree[position + 1 :])


def _without(tree: tuple, position: int) -> Tree:
    rest = tree[:position] + tree[position + 1 :]
    return rest[1] if len(rest) == 2 else rest


def correction(statement: Statement, confusable: Groups = ()) -> tuple[Edit, Statement] | None:
    """The first one-token change of the right side, else of the left side, that makes a refuted statement true."""
    extra = tuple(name for group in confusable for name in group)
    roomy = replace(statement, lhs=("vec", statement.lhs, statement.rhs, ("+", 0, 0, *extra)))
    evaluator = Evaluator(roomy)
    for side, other in (("rhs", "lhs"), ("lhs", "rhs")):
        fixed = components(evaluator.value(getattr(statement, other)))
        for edit in edits(getattr(statement, side), confusable, sorted(statement.signs)):
            if _equal(evaluator, components(evaluator.value(edit.tree)), fixed):
                candidate = replace(statement, **{side: edit.tree})
                if decide(candidate).outcome is Outcome.PROVED:
                    return edit, candidate
    return None


def _equal(evaluator: Evaluator, left: list, right: list) -> bool:
    ring = evaluator.ring
    return len(left) == len(right) and all(
        not reduce(ring.terms((a - b).numerator), evaluator.relations, ring.index).remainder
        for a, b in zip(left, right, strict=True)
    )


def mutations(statement: Statement, confusable: Groups = ()) -> Iterator[Statement]:
    """The statement with its right side changed by one token; derivative directions are left alone."""
    for number, edit in enumerate(edits(statement.rhs, confusable)):
        yield replace(statement, id=f"{statement.id} mutation {number}: {edit.change}", rhs=edit.tree)
