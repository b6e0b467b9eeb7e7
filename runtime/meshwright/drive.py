"""A drive ready to be analysed: a design, the compiled model that solves it, and its results.

An analysis is imported when it is first asked for: a command does not wait for those that it does not use.
"""

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from numbers import Rational

import numpy as np

from meshwright.base.drives import folders
from meshwright.base.errors import UsageError
from meshwright.base.library import library, pointer, text
from meshwright.contact import analysis, flags
from meshwright.contact.functions import Function
from meshwright.design import design as designs
from meshwright.design.design import Design
from meshwright.flank.surface import Flank


def _compiled(design):
    return design.model


def _casadi(design):
    from meshwright.contact.casadi_backend import model_of

    try:
        return model_of(design)
    except ModuleNotFoundError as error:
        remedy = "`pip install 'meshwright[casadi]'` brings it"
        raise UsageError(f"backend = 'casadi': {error.name} is not installed; {remedy}") from error


BACKENDS = {"c": _compiled, "casadi": _casadi}


@dataclass(frozen=True, repr=False)
class Drive:
    """A checked design and the backend that solves it. Angles in rad, lengths in mm."""

    design: Design
    backend: str = "c"

    @classmethod
    def load(cls, name_or_path, backend="c", drives=None):
        """The drive of a packaged design or a TOML file; raises :class:`~meshwright.base.errors.DesignError`.

        ``drives`` is a folder of drives that is searched first, for this drive and those made from it.
        """
        return cls.from_tables(designs.read(name_or_path), backend, drives)

    @classmethod
    def from_tables(cls, tables, backend="c", drives=None):
        """The drive of a design given as nested dictionaries, as in a TOML file; ``drives`` as in :meth:`load`."""
        places = folders() if drives is None else folders(drives)
        if backend not in [*BACKENDS]:
            raise UsageError(f"backend = {backend!r}: no such backend; use one of {', '.join(BACKENDS)}")
        return cls(designs.check(tables, places), backend)

    def with_(self, **tables):
        """A new drive with keys changed: ``drive.with_(misalignment={"center_distance_mm": -0.1})``."""
        changes = {}
        for table, entries in tables.items():
            if isinstance(entries, dict):
                changes |= {f"{table}.{key}": value for key, value in entries.items()}
            else:
                changes[table] = entries
        tables = designs.changed(self.design.drawn or self.design.given(), changes)
        return Drive(designs.check(tables, self.design.places), self.backend)

    def of_design(self, design):
        """The drive of another checked design."""
        return Drive(design, self.backend)

    def __repr__(self):
        return f"<{type(self).__name__} {self.design.label}, backend {self.backend}>"

    def drawing(self):
        """What a drawing of the design states: :class:`~meshwright.design.drawing.Sheet`."""
        from meshwright.design.drawing import sheet

        return sheet(self.design)

    @cached_property
    def as_described(self):
        """This drive, or its mirror image if that has the hand for which the drive's equations are written."""
        return self.with_(design={"hand": self.design.description["handed"]}) if self.design.mirrored else self

    @cached_property
    def model(self):
        """The model table, as a cffi pointer."""
        return BACKENDS[self.backend](self.design)

    @property
    def ratio(self):
        """Wheel turns per pinion turn: pinion teeth over wheel teeth, the inverse of the gear ratio."""
        return self.design.sizes["ratio"]

    def teeth(self, member):
        """Number of teeth or threads of ``"pinion"`` or ``"wheel"``."""
        if member not in (members := [body["name"] for body in self.design.description["bodies"]]):
            raise UsageError(f"this drive has no member {member!r}; use {' or '.join(members)}")
        pinion = self.design.value(self.design.description["pinion_teeth"])
        return round(pinion if member == "pinion" else pinion / self.ratio)

    def pitch(self):
        """Pinion angle from one tooth pair to the next, rad."""
        return 2 * math.pi / self.design.value(self.design.description["pinion_teeth"])

    def about_the_middle(self, pitches):
        """Pinion angles (N,), rad, so many ``pitches`` (N,) from the one to which relative errors refer."""
        pitch = self.pitch()
        middle = self.design.mirror.sign * self.design.reference_angle
        return middle + analysis.checked_pitches(pitches, pitch) * pitch

    @cached_property
    def path_start(self):
        """The path of contact of a tooth pair as far as its first solution, and a status word: see
        :meth:`~meshwright.cycle.path.Path.start`.
        """
        from meshwright.cycle.path import Path

        return Path.start(self)

    @cached_property
    def window(self):
        """Contact of one tooth pair from begin to end: :class:`~meshwright.cycle.windows.Window`."""
        from meshwright.cycle.windows import contact_window

        return contact_window(self)

    @cached_property
    def past_the_tips(self):
        """Whether the teeth do not reach each other at any angle."""
        from meshwright.cycle.windows import past_the_tips

        return past_the_tips(self)

    @cached_property
    def edge_window(self):
        """Window of a pair that runs on an edge, where the drive's error is designed to avoid that; else None."""
        if not self.design.description["absorbs_errors"]:
            return None
        from meshwright.cycle.edge import edge_window

        return edge_window(self if self.backend == "c" else Drive(self.design))

    @cached_property
    def searched_flank(self):
        """The wheel's flank about the contacts in the middle, None if there is none within its limits:
        :class:`~meshwright.cycle.searched_flank.SearchedFlank`.
        """
        from meshwright.cycle.searched_flank import SearchedFlank

        return SearchedFlank.of(self)

    def flank(self, member, region="flank"):
        """The generated flank of ``"pinion"`` or ``"wheel"``, or another region that the drive has of a member."""
        return Flank.of(self, member, region)

    def function(self, name):
        """A generated function of the drive by name: see :class:`~meshwright.contact.functions.Function`."""
        return Function.of(self, name)

    def state(self, angle=0.0):
        """The model's state for this design at an input angle: what generated functions read."""
        s = np.empty(self.model.ns)
        self.model.setup(pointer(self.design.parameters), pointer(s))
        self.model.set_phi(pointer(s), angle)
        return s

    def tca(self, angles):
        """Tooth contact analysis at pinion angles (rad), in any order; see :class:`~meshwright.contact.results.TCA`.

        Where no tangency of the flanks is found, or one along a line: the extreme of the wheel's turn over both bounded
        flanks, which is a line, an edge, a corner or nothing.
        """
        from meshwright.cycle.bounded import rigid_contact

        return flags.flagged(rigid_contact(self, analysis.checked_angles(angles)), self.edge_window)

    def turn(self, angles):
        """The pair in mesh and its contact at pinion angles (rad) of any size, for a drive that turns on:
        :class:`~meshwright.contact.turning.Turning`.
        """
        from meshwright.contact.turning import turning

        return turning(self, angles)

    def cycle(self, angles, coast=None, edges=False):
        """The whole drive, all pairs and both flanks, at pinion angles (rad) of any size:
        :class:`~meshwright.cycle.turning_drive.Cycle`. ``coast``: the drive of the other flank, where that has a design
        of its own; ``edges``: search for edges and corners where they may touch first.
        """
        from meshwright.cycle.turning_drive import cycle

        return cycle(self, angles, coast, edges)

    @cached_property
    def enclosed(self):
        """The design's state enclosed: :class:`~meshwright.contact.certificate.EnclosedDesign`."""
        from meshwright.contact.certificate import EnclosedDesign

        return EnclosedDesign.of(self.design, _compiled(self.design))

    def certify(self, angles, result=None, degrees=None):
        """Proofs of the contacts at pinion angles (rad): :class:`~meshwright.contact.certificate.Certificates`.

        ``result``: a TCA of these angles, if there is one. Each angle is the exact double that it is or, where
        ``degrees`` are given, exactly so many degrees (fractions).
        """
        from meshwright.contact.certificate import certify_contacts

        angles = analysis.checked_angles(angles)
        result = self.tca(angles) if result is None else analysis.checked_result(self, result, angles)
        return certify_contacts(self, result, degrees)

    def proof(self, degrees):
        """A proof of the contact at one pinion angle that other programs verify, as plain data: see
        :func:`~meshwright.contact.proof.proof`. ``degrees``: a whole number, a fraction, or a decimal as text.
        """
        from meshwright.contact.proof import proof

        if isinstance(degrees, float) or not isinstance(degrees, Rational | str):
            remedy = 'give a whole number, a fraction or a text such as "1.5"'
            raise UsageError(f"degrees = {degrees!r}: not exact; {remedy}")
        try:
            angle = Fraction(degrees)
        except ValueError as error:
            raise UsageError(f'degrees = {degrees!r}: no number; give a text such as "1.5"') from error
        return proof(self, angle, self.tca([np.radians(float(angle))]).solutions[0])

    def refined(self, result, certificates=None):
        """A TCA with transmission errors to the last digit, from the proofs of its contacts where these are shown; see
        :func:`~meshwright.contact.certificate.refined`. ``certificates``: its proofs, if there are any.
        """
        from meshwright.contact.certificate import checked_certificates, refined

        return refined(self, analysis.checked_result(self, result), checked_certificates(self, result, certificates))

    def certify_first(self, angles, result=None, certificates=None, **how):
        """Proofs that nothing touches before the contacts at pinion angles (rad), or where something does:
        :class:`~meshwright.cycle.certified_first.FirstCertificates`. ``result``, ``certificates``: a TCA and the proofs
        of these contacts, if there are any. ``neighbours``: on either side, 1 unless given.
        """
        from meshwright.contact.certificate import checked_certificates
        from meshwright.cycle.certified_first import certify_first

        angles = analysis.checked_angles(angles)
        result = self.tca(angles) if result is None else analysis.checked_result(self, result, angles)
        return certify_first(self, result, checked_certificates(self, result, certificates), **how)

    def certify_extremes(self, angles, result=None):
        """Proofs of where flanks that touch along a line, on an edge or at a corner do at pinion angles (rad), and of
        the line: :class:`~meshwright.cycle.certified_extreme.Extremes`. ``result``: as of :meth:`certify_first`.
        """
        from meshwright.cycle.certified_extreme import enclosed_extremes

        angles = analysis.checked_angles(angles)
        result = self.tca(angles) if result is None else analysis.checked_result(self, result, angles)
        return enclosed_extremes(self, result)

    def certify_first_path(self, begin, end, **how):
        """The same at every angle from one to another (rad, of the right-hand drive) at once:
        :class:`~meshwright.cycle.certified_first_path.FirstAlongPath`. ``neighbours``: on either side, 1 unless given.
        """
        from meshwright.cycle.certified_first_path import certify_first_path

        return certify_first_path(self, begin, end, **how)

    def certify_path(self, begin, end, **how):
        """Proof of one branch of contact from one pinion angle (rad) to another, of the right-hand drive:
        :class:`~meshwright.contact.certified_path.CertifiedPath`.
        """
        from meshwright.contact.certified_path import certified_path

        return certified_path(self, begin, end, **how)

    def first_contact(self, angles, result=None):
        """Where the bounded flanks of a pair touch first at pinion angles (rad), tangency, edge or corner:
        :class:`~meshwright.cycle.first_results.FirstContacts`. ``result``: a TCA of these angles, if there is one.
        """
        from meshwright.cycle.first_contact import first_contacts

        result = None if result is None else analysis.checked_result(self, result)
        return first_contacts(self, analysis.checked_angles(angles), result)

    def contacts(self, angle):
        """Every contact of one tooth pair at a pinion angle (rad), one row of the result each."""
        from meshwright.limits import contacts_of

        return contacts_of(self, analysis.checked_angle(angle))

    def limits(self, request=None):
        """Undercut, edges of regression, limit points, axes: see :class:`~meshwright.limits.results.Limits`."""
        from meshwright.limits import limits_of

        return limits_of(self, request)

    def contact_ratio(self):
        """Ends, teeth in contact, transmission error: :class:`~meshwright.cycle.contact_ratio.ContactRatio`."""
        from meshwright.cycle.contact_ratio import contact_ratio

        return contact_ratio(self)

    def surface(self, member, shape=(21, 41), region="flank", inset=0.0):
        """Points and normals over a flank, N across × M along the tooth: :class:`~meshwright.flank.grids.Grid`.

        ``inset`` is the share of the lengths by which the points stay off the ends of the flank.
        """
        from meshwright.flank.grids import grid

        return grid(self, member, shape, region, inset)

    @cached_property
    def other_side(self):
        """The drive of the same design whose flank is the other side of the teeth; None where a side has its own."""
        apart = self.design.description["flanks_apart"]
        return None if apart else self.with_(flank=self.design.other_flank)

    @cached_property
    def uses(self):
        """What contact uses of the flanks: see :class:`~meshwright.flank.uses.Uses`."""
        from meshwright.pattern.used import uses

        return uses(self)

    def region(self, member, name="flank"):
        """A surface of a member with the limits that bound it: :class:`~meshwright.flank.region.Region`.

        Flank and fillet of undercut teeth end where they cross.
        """
        from meshwright.flank.region import region

        if (member, name) not in self._regions:
            self._regions[member, name] = self._bounded(member, region(self, member, name, self.uses))
        return self._regions[member, name]

    @cached_property
    def _regions(self):
        return {}

    def _bounded(self, member, found):
        if found.empty or found.flank.region not in ("flank", "fillet"):
            return found
        crossing = self.crossing(member)
        return found if crossing is None else crossing.bounds(found)

    def crossing(self, member):
        """Where the fillet of a member cuts off its flank: :class:`~meshwright.flank.undercut.Crossing`, or None."""
        from meshwright.flank.undercut import crossing

        known = self._crossings
        if member not in known:
            known[member] = crossing(self, member)
        return known[member]

    def crossings(self):
        """Those of both members, by name."""
        return {body["name"]: self.crossing(body["name"]) for body in self.design.description["bodies"]}

    def know(self, crossings):
        """Take over what :meth:`crossings` of an equal drive found, elsewhere."""
        self._crossings.update(crossings)

    @cached_property
    def _crossings(self):
        return {}

    def trace(self, angles):
        """Unknowns (N, nx) and status words of a bare trace, without contact geometry: the fast way."""
        x, records = analysis.trace(self, analysis.checked_angles(angles))
        return x, [text(library().mw_status_word(code)) for code in records["status"]]
