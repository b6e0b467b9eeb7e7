"""Generated functions that a drive offers beside its contact: placements, limit points, axes."""

from dataclasses import dataclass

import numpy as np

from meshwright.base.errors import UsageError
from meshwright.base.library import library, pointer
from meshwright.contact.model import DriveModel


@dataclass(frozen=True)
class Function:
    """One generated function of a drive; call it with its arguments (inner units, broadcast against each other)."""

    drive: DriveModel
    description: dict
    pointer: object

    @classmethod
    def of(cls, drive, name):
        """The function ``name``; raises :class:`~meshwright.base.errors.UsageError` if the drive has none such."""
        description = drive.design.description
        for k, function in enumerate(description["functions"]):
            if function["name"] == name:
                return cls(drive, function, drive.design.model.functions[k])
        names = ", ".join(function["name"] for function in description["functions"])
        raise UsageError(f"the drive {description['name']} has no function {name!r}; it has {names or 'none'}")

    @property
    def arguments(self):
        """Names of the arguments."""
        return tuple(argument["name"] for argument in self.description["arguments"])

    @property
    def results(self):
        """Names of the results."""
        return tuple(output["name"] for output in self.description["outputs"])

    @property
    def frames(self):
        """Frame of each result by its name."""
        return {output["name"]: output["frame"] for output in self.description["outputs"]}

    @property
    def recovered(self):
        """Results that are parameters which the derivation has removed, in the order of the wheel's description."""
        known = [name for body in self.drive.design.description["bodies"] for name in body["recovered"]]
        return tuple(name for name in known if name in self.results)

    def __call__(self, *arguments):
        """Results by name: arrays of the arguments' common shape, with a last axis where a result is a vector."""
        if len(arguments) != len(self.arguments):
            raise UsageError(
                f"{self.description['name']}: {len(arguments)} arguments; give {', '.join(self.arguments) or 'none'}"
            )
        grid = np.broadcast_arrays(*(np.asarray(a, dtype=float) for a in arguments)) if arguments else []
        shape = grid[0].shape if grid else ()
        q = np.ascontiguousarray(np.stack([g.ravel() for g in grid], axis=1)) if grid else np.empty((1, 0))
        rows = np.empty((len(q), self.pointer.outputs))
        buffers = (pointer(a) for a in (self.drive.design.state, q))
        results = pointer(rows)
        library().mw_flank(self.pointer.evaluate, q.shape[1], rows.shape[1], *buffers, len(q), results)
        return {o["name"]: _values(rows, o, shape) for o in self.description["outputs"]}


def _values(rows, output, shape):
    at, size = output["offset"], output["size"]
    if size == 1:
        return rows[:, at].reshape(shape)
    return rows[:, at : at + size].reshape(*shape, size)


def has(drive, name):
    """Whether the drive offers the function ``name``."""
    return any(function["name"] == name for function in drive.design.description["functions"])


def offered(drive, prefix):
    """What follows ``prefix`` in the names of the drive's functions that begin with it."""
    names = (function["name"] for function in drive.design.description["functions"])
    return [name.removeprefix(prefix) for name in names if name.startswith(prefix)]
