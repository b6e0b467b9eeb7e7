"""Places of a generated flank from one face of its tooth to the other, each in the middle of what its section holds.

A place of a middle section is carried from section to section; a single profile parameter would not do, since the
flank may narrow towards a face to a strip beside a pole of the surface, on whose other side lie other solutions.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from meshwright.fe.followed import Bools, Generated, held, in_section, level
from meshwright.fe.hexahedra import Floats
from meshwright.flank.surface import FlankPoints

# Sections from face to face, and how much closer they may have to be; how often the step that holds an end of the flank
# is divided, and into how many parts; how far beyond its ends the profile is followed, in parts of it.
_SECTIONS, _CLOSEST, _ROUNDS, _PARTS, _BEYOND = 65, 2.0**-8, 3, 16, 0.05


@dataclass(frozen=True)
class Spine:
    """Sections z (K,), ascending, with a profile parameter and an angle of the flank in each, (K,) both; ``first`` and
    ``last`` (K,): the ends of its profile there, at root and tip. ``bounds``: the profile goes nowhere beyond them.
    """

    sections: Floats
    profile: Floats
    face: Floats
    first: Floats
    last: Floats
    bounds: tuple[float, float]

    @classmethod
    def along(
        cls, flank: Generated, faces: tuple[float, float], middle: float, ends: tuple[float, float],
        inside: Callable[[FlankPoints], Bools], steps: int,
    ) -> Spine:
        """From the profile parameter ``middle`` in the middle section; the flank lies between the ``ends`` of its
        profile, where it is regular and ``inside``, and is looked at in so many steps from one end to the other.

        Raises ValueError where it does not go from face to face.
        """
        here = _Section(flank, ends, inside, abs(ends[1] - ends[0]) / steps)
        centre, step = 0.5 * sum(faces), (faces[1] - faces[0]) / (_SECTIONS - 1)
        at = np.array([middle])
        begun = here.centred(centre, at, level(flank, np.array([centre]), at))
        if begun is None:
            raise ValueError("its middle section holds no flank below the tip")
        halves = [here.carried(begun, centre, face, step) for face in faces]
        places = [*reversed(halves[0]), (centre, *begun), *halves[1]]
        columns = np.array([[float(np.squeeze(v)) for v in place] for place in places]).T
        return cls(*columns, bounds=ends)

    def at(self, sections: Floats) -> tuple[Floats, Floats]:
        """Profile parameters and angles (K,) near the flank in other sections (K,)."""
        return np.interp(sections, self.sections, self.profile), np.interp(sections, self.sections, self.face)

    def rows(self, sections: Floats, count: int) -> Floats:
        """Profile parameters (count, K) from a little beyond the root end to a little beyond the tip."""
        first, last = (np.interp(sections, self.sections, ends) for ends in (self.first, self.last))
        low, high = sorted(self.bounds)
        beyond = _BEYOND * (last - first)
        whole = first == self.bounds[0]
        return np.linspace(np.where(whole, first, np.clip(first - beyond, low, high)), last + beyond, count)


@dataclass(frozen=True)
class _Section:
    flank: Generated
    ends: tuple[float, float]
    inside: Callable[[FlankPoints], Bools]
    step: float

    def carried(self, begun: tuple, centre: float, face: float, step: float) -> list[tuple]:
        """Sections with their places from a middle one to a face, the flank's middle foreseen from the last two."""
        places: list[tuple] = [(centre, *begun)]
        way, size = np.sign(face - centre), step
        while places[-1][0] != face:
            at, profile, angle = places[-1][:3]
            size = min(size, abs(face - at))
            section = face if size == abs(face - at) else at + way * size
            foreseen = profile, angle
            if len(places) > 1:
                before = places[-2]
                share = (section - at) / (at - before[0])
                foreseen = profile + share * (profile - before[1]), angle + share * (angle - before[2])
            found = self.centred(section, *foreseen) or self.centred(section, profile, angle)
            if found:
                places.append((section, *found))
                size = min(step, 2.0 * size)
                continue
            size *= 0.5
            if size < _CLOSEST * step:
                raise ValueError(f"the flank does not go from face to face: it ends near {at:.6g} mm along the axis")
        return places[1:]

    def centred(self, section: float, profile: Floats, face: Floats) -> tuple[Floats, Floats, Floats, Floats] | None:
        """The place (1,), (1,) in the middle of what a section holds about one near it, and the profile's ends; None
        where it holds nothing there.
        """
        start = profile, self._solved(section, profile, face)
        if not self._good(section, *start):
            return None
        ends = [self._end(section, *start, end) for end in self.ends]
        at = 0.5 * (ends[0][0] + ends[1][0])
        near = min((*ends, start), key=lambda place: abs(place[0] - at)[0])
        trial = at, self._solved(section, at, near[1])
        found = trial if self._good(section, *trial) else start
        return found[0], found[1], ends[0][0], ends[1][0]

    def _end(self, section: float, profile: Floats, face: Floats, end: float) -> tuple[Floats, Floats]:
        """The last place inside on the way to an end of the profile."""
        while profile[0] != end:
            further = profile + np.clip(end - profile, -self.step, self.step)
            trial = self._solved(section, further, face)
            if self._good(section, further, trial):
                profile, face = further, trial
                continue
            return self._last(section, profile, face, further)
        return profile, face

    def _last(self, section: float, profile: Floats, face: Floats, further: Floats) -> tuple[Floats, Floats]:
        """The last place (1,), (1,) inside on the way from one that is to a profile parameter (1,) that is not."""
        shares, here = np.arange(1, _PARTS) / _PARTS, np.full(_PARTS - 1, section)
        for _ in range(_ROUNDS):
            places = profile + shares * (further - profile)
            trials = in_section(self.flank, places, np.full(len(places), face[0]), here)
            found = self.flank(places, trials)
            outside = np.append(~(held(found, here) & self.inside(found)), True)
            first = int(np.argmax(outside))
            if first < len(places):
                further = places[first : first + 1]
            if first:
                profile, face = places[first - 1 : first], trials[first - 1 : first]
        return profile, face

    def _solved(self, section: float, profile: Floats, face: Floats) -> Floats:
        return in_section(self.flank, profile, face, np.array([section]))

    def _good(self, section: float, profile: Floats, face: Floats) -> bool:
        found = self.flank(profile, face)
        return bool((held(found, np.array([section])) & self.inside(found))[0])
