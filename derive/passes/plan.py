"""The plan of a drive: what is known of it after each pass, immutable, each with all that the passes before it found.

:class:`Derived` → :class:`Reduced` → :class:`Observed` → :class:`Read` → :class:`Bound` → :class:`Schedule`, which the
printers read. Values are nodes of one tape, of which a pass that adds to it makes a copy; each table says which of them
a generated function returns, by name, unit and frame.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Self, TypeAlias

import mpmath
import sympy as sp

from derive.language.drive import Drive
from derive.language.symbols import Quantity, Table
from derive.passes.completion import ParameterTape, SystemTape
from derive.passes.linearise import Linear, Matrix
from derive.program.lowering import Lowering
from derive.program.tape import Tape

Nodes: TypeAlias = tuple[int, ...]
#: (function, part) → group of results → nodes; where one is zero they shall be "not a number".
Tests: TypeAlias = Mapping[tuple[str, int], Mapping[tuple[int, ...], list[int]]]


@dataclass(frozen=True)
class Output:
    """A named result: ``width`` consecutive numbers with one unit and frame."""

    name: str
    nodes: tuple[int, ...]
    unit: str = ""
    frame: str = ""


@dataclass(frozen=True)
class Flank:
    """A flank, or another region of a member, and its curvature: functions of its own parameters, body frame."""

    body: str
    parameters: tuple[Quantity, ...]
    outputs: tuple[Output, ...]
    curvature: tuple[Output, ...]
    region: str = "flank"

    @property
    def limits(self) -> list[int]:
        """Nodes of the regular function and of the margins: what must be positive on the surface."""
        return [o.nodes[0] for o in self.outputs if o.name == "regular" or o.name.startswith("margin_")]

    @property
    def conditions(self) -> list[int]:
        """Nodes of the surface's own conditions."""
        return [o.nodes[0] for o in self.outputs if o.name.startswith("condition_") and not o.name.endswith("_slopes")]


@dataclass(frozen=True)
class Expansion:
    """A surface beyond its tangents, nodes: ``slopes`` of each limit by each parameter; ``second`` derivatives of each
    coordinate of the point, of each limit and of each condition, by the pairs (1, 1), (1, 2), … (2, 2), … of
    parameters; none of a region, where nothing asks for them.
    """

    of: Flank
    slopes: tuple[int, ...]
    second: tuple[int, ...]


@dataclass(frozen=True)
class FunctionOutputs:
    """A function of its own arguments; ``rests_on`` are statements of the audit record."""

    name: str
    meaning: str
    parameters: tuple[Quantity, ...]
    outputs: tuple[Output, ...]
    rests_on: tuple[str, ...]


@dataclass(frozen=True)
class BodyOutputs:
    """Where the observation of one body is found: see :func:`_observe_body`."""

    parameters: int
    conditions: int
    at: int
    singular: int
    margins: tuple[int, ...]


@dataclass(frozen=True)
class Along:
    """First and second derivatives of the residual along a direction of (unknowns, instant), nodes.

    ``direction`` are the input nodes of that direction.
    """

    direction: tuple[int, ...]
    first: tuple[int, ...]
    second: tuple[int, ...]


@dataclass(frozen=True)
class EdgeSystem:
    """A system by the numbers of its ``equations``, as many as there are unknowns.

    ``margins``: of pinion and wheel the number of the margin that is zero, None where the flank itself touches.
    """

    name: str
    margins: tuple[int | None, int | None]
    equations: tuple[int, ...]


@dataclass(frozen=True)
class Edges:
    """Equations (nodes) and their Jacobian: three components of the distance, mm; the surfaces' own conditions; of each
    edge its margin, then of each edge its tangency to the mating flank. No equations where no margin is an edge.
    """

    equations: Nodes
    jacobian: Matrix
    systems: tuple[EdgeSystem, ...]


@dataclass(frozen=True)
class DesignGuard:
    """A node that must be positive, the reason, and the design's keys that meet in it; ``of`` is the node guarded."""

    node: int
    message: str
    keys: tuple[str, ...]
    of: int | None = None


@dataclass(frozen=True)
class Derived:
    """The equations of a drive on a tape: see :func:`derive.passes.equations.derive`.

    ``rules`` are the defaults and rules that complete a design, in the order in which they run, each on a tape of its
    own; ``completion`` has them together. ``turns_about_z``: :func:`derive.passes.geometry.turns_about_z`.
    """

    drive: Drive
    turns_about_z: bool
    tape: Tape
    lower: Lowering
    rules: tuple[ParameterTape, ...]
    completion: ParameterTape
    systems: tuple[SystemTape, ...]
    sizes: ParameterTape
    residual: Nodes
    linear: Linear
    jacobian: Matrix
    scales: Nodes
    start_residual: Nodes
    start_jacobian: Matrix
    start_scales: Nodes
    start_guess: Nodes
    start_solution: Nodes

    @property
    def unknowns(self) -> list[Quantity]:
        return [u.symbol for u in self.drive.unknowns]

    def copy(self) -> Self:
        """The same on a copy of the tape, for a pass that adds to it."""
        lower = self.lower.copy()
        return replace(self, tape=lower.tape, lower=lower)


@dataclass(frozen=True)
class Reduced(Derived):
    """Newton's step too: see :func:`derive.passes.pivot_order.reduce`.

    ``sample`` is the contact of the sample design (symbol → number), ``beside`` a start for Newton's method close by:
    see :mod:`derive.passes.sample`.
    """

    sample: Mapping[sp.Symbol, mpmath.mpf]
    step: Nodes
    change: Nodes
    weight: Nodes
    beside: tuple[float, ...]

    @property
    def newton_step(self) -> list[int]:
        """Results of the fused Newton step: the unknowns after it, their changes, and one over their natural sizes.

        The size of the step is the sum of the changes' magnitudes by these weights.
        """
        return [*self.step, *self.change, *self.weight]


@dataclass(frozen=True)
class Observed(Reduced):
    """What is read of a solved contact too: see :func:`derive.passes.observation.observe`."""

    observed: tuple[Output, ...]
    bodies: Mapping[str, BodyOutputs]


@dataclass(frozen=True)
class Read(Observed):
    """What is read anywhere else too: see :func:`derive.passes.schedule.read`."""

    flanks: tuple[Flank, ...]
    regions: tuple[Flank, ...]
    functions: tuple[FunctionOutputs, ...]
    along: Along
    edges: Edges
    expansions: tuple[Expansion, ...]

    @property
    def placement(self) -> FunctionOutputs:
        """The function that places both bodies: see :func:`derive.passes.geometry.placement`."""
        return self.functions[0]


@dataclass(frozen=True)
class Bound(Read):
    """Binding times too: ``state`` numbers the nodes kept between stages, design slots first."""

    state: Mapping[int, int]
    design_slots: int

    @property
    def angles(self) -> list[int]:
        """Nodes of the angles beyond those of the design of which the residual takes sine and cosine."""
        nodes, design = self.tape.nodes, set(list(self.state)[: self.design_slots])
        turned = (i for i in self.tape.needed(self.residual, design) if nodes[i].op in ("sin", "cos"))
        return list(dict.fromkeys(nodes[i].args[0] for i in turned))

    @property
    def pose(self) -> list[int]:
        """Numbers of the state's values of the design that a misalignment changes."""
        moved = {p.symbol for p in self.drive.parameters if p.table == Table.MISALIGNMENT}
        design = list(self.state)[: self.design_slots]
        return [k for k, node in enumerate(design) if moved & self.tape.inputs_of([node])]


@dataclass(frozen=True)
class Schedule(Bound):
    """All functions of a drive, with what answers where they are not defined: see :mod:`derive.passes.guards`."""

    guards: tuple[DesignGuard, ...]
    tests: Tests
