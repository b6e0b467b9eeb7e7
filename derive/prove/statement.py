"""A statement: two expression trees claimed to be equal, with the definitions of the names in them."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property

from derive.prove.angles import BaseAngle, base_angles, linear_form
from derive.prove.tree import FUNCTIONS, ROTATIONS, Tree, children, symbols, walk

ANGLE_NODES = tuple(name for name in FUNCTIONS if name != "sqrt") + ROTATIONS


@dataclass(frozen=True)
class Statement:
    """lhs = rhs, for all values of the free symbols.

    `definitions` (name -> tree, later ones may use earlier ones) are substituted; `jets` (name -> variables) are
    unspecified functions of those variables; `signs` are symbols with square 1, such as the flank sign.
    """

    id: str
    lhs: Tree
    rhs: Tree
    definitions: Mapping[str, Tree] = field(default_factory=dict)
    jets: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    signs: frozenset[str] = frozenset()

    @cached_property
    def used(self) -> dict[str, Tree]:
        """The definitions that the two sides need, in the order given."""
        needed = set()
        pending = symbols(self.lhs) | symbols(self.rhs)
        while pending:
            name = pending.pop()
            if name in self.definitions and name not in needed:
                needed.add(name)
                pending |= symbols(self.definitions[name])
        return {name: tree for name, tree in self.definitions.items() if name in needed}

    def trees(self) -> Iterator[Tree]:
        """Both sides and every definition in use."""
        yield self.lhs
        yield self.rhs
        yield from self.used.values()

    @cached_property
    def free_symbols(self) -> list[str]:
        names = set().union(*map(symbols, self.trees())) - set(self.used)
        for name in self.used_jets:
            names |= set(self.jets[name])
        return sorted(names)

    @cached_property
    def angles(self) -> list[BaseAngle]:
        forms = [
            linear_form(node[1], self.used)
            for tree in self.trees()
            for node in walk(tree)
            if isinstance(node, tuple) and node[0] in ANGLE_NODES
        ]
        return base_angles(forms)

    @cached_property
    def used_jets(self) -> dict[str, int]:
        """Name -> highest total order that can occur once every derivative is carried out."""
        highest: dict[str, int] = {}
        for tree in self.trees():
            for node in walk(tree):
                if isinstance(node, tuple) and node[0] == "jet":
                    highest[node[1]] = max(highest.get(node[1], 0), sum(node[2:]))
        depth = max(self._depth(tree, {}) for tree in self.trees())
        return {name: order + depth for name, order in sorted(highest.items())}

    def _depth(self, tree: Tree, known: dict[str, int]) -> int:
        """How many derivatives can act on one leaf."""
        if isinstance(tree, str) and tree in self.used:
            if tree not in known:
                known[tree] = self._depth(self.used[tree], known)
            return known[tree]
        below = max((self._depth(child, known) for child in children(tree)), default=0)
        return below + (isinstance(tree, tuple) and tree[0] == "d")

    @cached_property
    def dependent_generators(self) -> list[tuple[str, Tree]]:
        """("root", radicand), ("arc", atan2 node) and ("angle", defined name), each after those that its value
        contains.
        """
        opaque = {angle.symbol for angle in self.angles} & set(self.used)
        found: list[tuple[str, Tree]] = []
        for name, tree in (*self.used.items(), ("", self.lhs), ("", self.rhs)):
            for node in reversed(list(walk(tree))):
                if isinstance(node, tuple) and node[0] in ("sqrt", "atan2"):
                    entry = ("root", node[1]) if node[0] == "sqrt" else ("arc", node)
                    if entry not in found:
                        found.append(entry)
            if name in opaque:
                found.append(("angle", name))
        return found
