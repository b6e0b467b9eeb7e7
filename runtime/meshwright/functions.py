"""Generated functions that a drive offers beside its contact: placements, limit points, axes."""

from dataclasses import dataclass

import numpy as np

from meshwright._library import ffi


@dataclass(frozen=True)
class Function:
    """One generated function of a drive; call it with its arguments (inner units, broadcast against each other)."""

    drive: object
    description: dict
    pointer: object

    @classmethod
    def of(cls, drive, name):
        """The function ``name`` of the drive; raises ``KeyError`` if it has none of that name."""
        for k, description in enumerate(drive.design.description["functions"]):
            if description["name"] == name:
                return cls(drive, description, drive.model.functions[k])
        raise KeyError(f"the drive {drive.design.description['name']} has no function {name!r}")

    @property
    def arguments(self):
        """Names of the arguments."""
        return tuple(a["name"] for a in self.description["arguments"])

    def __call__(self, *arguments):
        """Results by name: arrays of the arguments' common shape, with a last axis where a result is a vector."""
        grid = np.broadcast_arrays(*(np.asarray(a, dtype=float) for a in arguments)) if arguments else []
        shape = grid[0].shape if grid else ()
        q = np.ascontiguousarray(np.stack([g.ravel() for g in grid], axis=1)) if grid else np.empty((1, 0))
        rows = np.empty((len(q), self.pointer.outputs))
        s = ffi.from_buffer("double[]", self.drive.state())
        for given, row in zip(q, rows, strict=True):
            self.pointer.evaluate(s, ffi.from_buffer("double[]", given), ffi.from_buffer("double[]", row))
        return {o["name"]: _values(rows, o, shape) for o in self.description["outputs"]}


def _values(rows, output, shape):
    at, size = output["offset"], output["size"]
    if size == 1:
        return rows[:, at].reshape(shape)
    return rows[:, at : at + size].reshape(*shape, size)
