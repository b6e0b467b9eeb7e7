"""Every status, every flag and every guard that a drive declares is reached: none is there for show."""

import numpy as np
import pytest

from meshwright import Drive
from meshwright.base.library import SHIPPED, ffi, library, model, pointer, text
from meshwright.contact import analysis
from meshwright.design import description as metadata

BUILT = [name for name in metadata.drives() if (SHIPPED / f"{name}.json").exists()]

#: Beginnings of the guards that follow from an operation of the equations and are not declared by the drive: some are
#: behind a declared one that refuses the same values first.
DERIVED = ("a division by zero", "a root of a negative number")

#: Packaged designs of all families, of a line of contact and of branches that end.
DESIGNS = (
    "recess-action-full", "zk-zn-90", "plain-zi", "plain-zc", "spherical-table-2-1", "spherical-table-2-3",
    "face-worm-conical-concave", "helical-crowned", "bevel-formate",
)  # fmt: skip


def _middle(drive):
    """A contact of the drive."""
    x, found = analysis.trace(drive, np.array([0.05]))
    return x[0] if found["status"][0] >= 0 else np.zeros(drive.model.nx)


def _near(drive, middle, generator, sizes):
    """The state at a random angle, and random unknowns about a contact."""
    m, scale = drive.model, np.empty(drive.model.nx)
    state = drive.state(generator.uniform(-2.0, 2.0))
    m.scale(pointer(state), pointer(scale))
    return state, middle + generator.normal(size=m.nx) * scale * generator.choice(sizes)


def _statuses(drive, generator):
    """Statuses of a trace far to both sides, and of Newton's method from a hundred starts that mislead."""
    info = ffi.new("mw_info *")
    found = set(analysis.trace(drive, np.array([-4.0, -1.0, 0.0, 1.0, 4.0, 1e13]))[1]["status"].tolist())
    middle = _middle(drive)
    for _ in range(100):
        state, x = _near(drive, middle, generator, [0.1, 1.0, 10.0])
        found.add(library().mw_refine(drive.model, pointer(state), pointer(x), info))
    return found


def _of_bounded_flanks():
    """Words of helical gears with a lead slope, over their window and beyond."""
    plain = {
        "normal_module_mm": 1.0, "pressure_angle_deg": 20.0, "face_width_mm": 10.0, "pinion_teeth": 17,
        "wheel_teeth": 43, "pinion_helix_angle_deg": 20.0, "wheel_lead_slope_um": 5.0,
    }  # fmt: skip
    helical = Drive.from_tables({"drive": "cylindrical-gears", "flank": "left", "design": plain})
    return helical.tca(np.radians(np.linspace(-36.0, 36.0, 19))).status


def test_every_status_is_reached():
    generator, found = np.random.default_rng(1), set()
    for name in DESIGNS:
        found |= _statuses(Drive.load(name), generator)
    folding = Drive.load("zk-zn-60").with_(
        design={"hob_pitch_radius_mm": 12.996704, "shaft_angle_deg": 75.5278},
        misalignment={"center_distance_mm": -0.042, "vertical_deg": 0.019, "horizontal_deg": -0.1448},
    )
    found |= set(analysis.trace(folding, np.radians([-200.0, -80.0, 0.0, 80.0, 200.0]))[1]["status"].tolist())
    full = Drive.load("recess-action-full")
    radius = full.design.as_solved()["design"]["worm_pitch_radius_mm"]
    for share in (1e-9, 1e-8, 1e-7):
        near_a_line = full.with_(design={"hob_pitch_radius_mm": radius * (1.0 + share)})
        found |= set(analysis.trace(near_a_line, np.linspace(-2.0, 2.0, 9))[1]["status"].tolist())
    found |= set(analysis.status_codes(*_of_bounded_flanks()))
    assert found == set(analysis.statuses()), set(analysis.statuses()) ^ found


FLAGGED = (*(name for name in DESIGNS if name != "zk-zn-90"), "plain-zk", "plain-zn", "plain-za")


@pytest.mark.parametrize("name", FLAGGED)
def test_every_flag_of_a_drive_is_reached(name):
    """By the geometry of places about a contact; a limit that the design leaves open has no flag."""
    drive, generator = Drive.load(name), np.random.default_rng(2)
    m, contact, o, seen, open_ = drive.model, ffi.new("mw_contact *"), np.empty(drive.model.no), set(), set()
    middle = _middle(drive)
    for _ in range(400):
        state, x = _near(drive, middle, generator, [0.1, 1.0, 10.0])
        library().mw_contact_at(m, pointer(state), pointer(x), pointer(o), contact)
        seen |= {k for k in range(32) if contact.flags >> k & 1}
        margins = np.concatenate([o[m.bodies[b].margin :][: m.bodies[b].margins] for b in range(2)])
        open_ = {2 + int(k) for k in np.flatnonzero(np.isnan(margins))}
    named = {k for k in range(32) if library().mw_flag(m, k) != ffi.NULL}
    assert seen == named - open_, [text(library().mw_flag(m, k)) for k in named - open_ - seen]


#: Values at which one operation or another ends.
EXTREME = (0.0, np.nan, -1.0, 1e-9, 1e3, 1e9, -1e9, np.pi / 2, np.pi, 5.0)


@pytest.mark.parametrize("name", BUILT)
def test_every_guard_that_a_drive_declares_is_reached(name):
    """By one parameter changed at a time, then by up to three."""
    m, told = model(name), metadata.described(name)
    base = np.array([float.fromhex(v) for v in told["self_test"]["p"]])
    generator, s, reached = np.random.default_rng(0), np.empty(m.ns), set()
    room = pointer(s)

    def tried(p):
        reached.add(m.setup(pointer(p), room))

    for i in range(m.np):
        for value in (*EXTREME, *(base[i] * np.array([0.1, 0.5, 0.9, 1.1, 2.0, 10.0, -1.0]))):
            p = base.copy()
            p[i] = value
            tried(p)
    for _ in range(4000):
        p = base.copy()
        for i in generator.choice(m.np, generator.integers(1, 4)):
            random = base[i] * generator.normal(1.0, 1.0) + 0.1 * generator.normal()
            p[i] = generator.choice(EXTREME) if generator.random() < 0.4 else random
        tried(p)
    missing = [g["message"] for k, g in enumerate(told["guards"], 1) if k not in reached]
    assert m.nguards == len(told["guards"]) and 0 in reached
    assert not [words for words in missing if not words.startswith(DERIVED)]
