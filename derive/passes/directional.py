"""Derivatives along a direction: the tangent of every value on a tape, by the chain rule."""

from collections.abc import Mapping

from derive.program.tape import Tape


class Derivatives:
    """Tangent nodes on a tape: those of the ``seeds`` (input node → node) are given, all others follow."""

    def __init__(self, tape: Tape, seeds: Mapping[int, int]) -> None:
        self.tape, self._done = tape, dict(seeds)

    def __call__(self, i: int) -> int:
        for k in [*self.tape.needed([i], self._done), i]:
            if k not in self._done:
                args, zero = self.tape.arguments[k], self.tape.constant(0)
                self._done[k] = self.tape.rule(k, [self._done.get(a, zero) for a in args]) if args else zero
        return self._done[i]
