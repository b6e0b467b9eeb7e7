"""Three drives outside the tree through every command, each output against something that knows no equation of theirs.

Crossed involute helicoids, an hourglass worm, and a ZI worm whose crowned blade has a key of its own. What a flank is
and where it ends is written out once more here, in closed forms or as the envelope of a plane in mpmath.
"""

import csv
import ctypes
import json
import math
from collections.abc import Callable
from dataclasses import dataclass, fields, replace

import mpmath as mp
import numpy as np
import pytest

from meshwright import Drive
from meshwright.contact.results import ARCSEC
from meshwright.design import design as designs
from meshwright.fe.closed_body import solid_body
from meshwright.fe.tooth_patches import Rows
from meshwright.sensitivity import sensitivity
from tests.embedding import compile as c
from tests.independent.worm import Helicoid, WormDrive
from tests.outside import test_crossed_helicoids as crossed
from tests.outside import test_hourglass_worm as hourglass
from tests.outside import test_own_blades as blades
from tests.outside.folder import Commands

pytestmark = pytest.mark.validate


# -- the flanks once more: how far a place of them is off, and how far it is within each limit of its blank -----------


def off_helicoid(member, named, point, normal):
    """Of an involute helicoid: its polar angle, and lean and lever of its normal."""
    k = ("pinion", "wheel").index(member)
    x, y, z = point
    radius, base = math.hypot(x, y), crossed.R_B[k]
    inv = math.sqrt(radius**2 - base**2) / base - math.acos(base / radius)
    middle = math.pi / (2 * crossed.T[k]) + math.tan(crossed.ALPHA_T[k]) - crossed.ALPHA_T[k]
    off = math.atan2(y, x) - (middle - inv) - z * math.tan(crossed.BETA[k]) / crossed.R[k]
    lever = base * math.sqrt(1.0 - crossed.SIN_BASE[k] ** 2)
    return [
        radius * math.remainder(off, 2.0 * math.pi), abs(normal[2]) - crossed.SIN_BASE[k],
        (abs(x * normal[1] - y * normal[0]) - lever) / base,
    ]  # fmt: skip


def within_helicoids(member, contact):
    k = ("pinion", "wheel").index(member)
    x, y, z = contact[f"contact_point_{member}_mm"]
    radius = math.hypot(x, y)
    return {
        "tip": crossed.R[k] + crossed.M - radius, "face": 15.0 - abs(z),
        "root": radius - (crossed.R[k] - 0.9 * crossed.M),
    }  # fmt: skip


def off_hourglass(member, named, point, normal):
    """Of the envelope of a plane, and of a parabola on it: the place itself at its parameters, and its normal."""
    with mp.workdps(40):
        twin = hourglass.Twin(1, {})
        if member == "wheel":
            own, across = twin.wheel(*(mp.mpf(named[f"{q}_wheel"]) for q in "uw"), mp.mpf("0.001"))
        else:
            w, theta = mp.mpf(named["w_tool"]), mp.mpf(named["theta_worm"])
            zero, one = (twin.worm(mp.mpf(u), w, theta)[2] for u in (0, 1))
            own, inward, _ = twin.worm(zero / (zero - one), w, theta)
            across = -inward
        return _apart(own, across, point, normal)


def within_hourglass(member, contact):
    x, y, z = contact[f"contact_point_{member}_mm"]
    radius = math.hypot(x, y)
    if member == "pinion":
        from_circle = math.hypot(125.0 - radius, z)
        return {"tip": from_circle - 96.5, "root": 104.2 - from_circle, "face": 50.0 - abs(z)}
    return {"tip": 103.5 - radius, "root": radius - 95.8, "face": 12.5 - abs(z)}


def own_worm():
    """Worm and wheel of the crowned blade, their profiles positions alone."""
    twin = WormDrive.of(CASES["own_blades"].tables)
    for name, crown in (("worm", "0.002"), ("hob", "0.001")):
        body = getattr(twin, name)
        own = {f.name: getattr(body, f.name) for f in fields(Helicoid)}
        setattr(twin, name, blades.Own(**own, own=(mp.mpf(crown),)))
    return twin


def off_crowned(member, named, point, normal):
    """Of the worm at its parameters; of the wheel, where the hob's equation of meshing holds at its rack angle."""
    with mp.workdps(30):
        twin = own_worm()
        if member == "pinion":
            own, across = twin.thread(mp.mpf(named["t_worm"]), mp.mpf(named["psi_worm"]))
            return _apart(own, across, point, normal)
        t, rack = mp.mpf(named["t_hob"]), mp.mpf(named["psi_fixed_hob"])
        turn = mp.findroot(lambda phi: twin.meshing(t, rack - phi, phi), (mp.mpf(0), mp.mpf("0.01")))
        own, across = twin.wheel(t, rack - turn, turn)
        return _apart(own, [-q for q in across], point, normal)


def within_crowned(member, contact):
    x, y, z = contact[f"contact_point_{member}_mm"]
    radius = math.hypot(x, y)
    if member == "pinion":
        return {"tip": 24.4 - radius, "root": radius - 15.6}
    # the throat is a circle about the worm's axis
    distance = 4.0 * 2 / (2.0 * math.sin(math.radians(11.31))) + 4.0 * 41 / (2.0 * math.cos(math.radians(11.31)))
    return {
        "tip": 89.66 - radius, "throat": math.hypot(distance - radius, z) - (distance - 87.62), "face": 16.0 - abs(z),
        "tool_end": 21.0 + 4.9 - contact["unknowns"]["t_hob"],
    }  # fmt: skip


def _apart(own, across, point, normal):
    size = mp.sqrt(sum(q * q for q in across))
    return [float(a - b) for a, b in zip([*own, *(q / size for q in across)], [*point, *normal], strict=True)]


# -- areas of the bodies in sections across the axis -------------------------------------------------------------------


def gear_area(bore, z):
    """The pinion of the crossed helicoids: involutes, arcs that touch them, root and bore."""
    base, rounding, form = crossed.R_B[0], 0.38 * crossed.M, crossed.R[0] - 0.9 * crossed.M
    roll = math.sqrt(form**2 - base**2) / base
    half = math.pi / (2 * crossed.T[0]) + math.tan(crossed.ALPHA_T[0]) - crossed.ALPHA_T[0]
    # on an involute that begins on the x axis and winds to larger azimuths; the tooth is its mirror image
    x = base * (math.cos(roll) + roll * math.sin(roll)) + rounding * math.sin(roll)
    y = base * (math.sin(roll) - roll * math.cos(roll)) - rounding * math.cos(roll)
    centre, azimuth = math.hypot(x, y), half - math.atan2(y, x)
    root = centre - rounding
    low, high = np.linspace(root, form, 40001), np.linspace(form, crossed.R[0] + crossed.M, 40001)
    below = azimuth - np.arccos(np.clip((low**2 + centre**2 - rounding**2) / (2.0 * low * centre), -1.0, 1.0))
    above = half - np.sqrt(high**2 - base**2) / base + np.arccos(base / high)
    teeth = sum(np.trapezoid(2.0 * r * angle, r) for r, angle in ((low, below), (high, above)))
    return math.pi * (root**2 - bore**2) + crossed.T[0] * teeth


def worm_area(bore, z):
    """The crowned worm: at each radius what grooves leave of the lead, with arcs in axial sections at the root."""
    lead = math.radians(11.31)
    radius = 4.0 * 2 / (2.0 * math.sin(lead))
    p, root, tip, rounding = radius * math.tan(lead), 15.6, 24.4, ROUNDING_OF_WORM * 4.0 / math.cos(lead)
    base = radius / math.sqrt(1.0 + (math.tan(math.radians(20.0)) / math.sin(lead)) ** 2)

    def groove(r):
        a, b = np.arccos(base / r), math.acos(base / radius)
        width = math.pi * 4.0 / (4.0 * math.cos(lead)) + p * (np.tan(a) - a - math.tan(b) + b)
        return width - 0.002 * (r - radius) ** 2

    def slope(r):
        return (groove(r + 1e-6) - groove(r - 1e-6)) / 2e-6

    def over(r):
        return r + rounding * slope(r) / np.hypot(1.0, slope(r)) - root - rounding

    low, high = root, root + rounding
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if over(middle) < 0.0 else (low, middle)
    foot = groove(low) - rounding / np.hypot(1.0, slope(low))
    r = np.concatenate([np.linspace(root, low, 20001), np.linspace(low, tip, 20001)])
    arc = foot + np.sqrt(np.maximum(rounding**2 - (r - root - rounding) ** 2, 0.0))
    half = np.where(r < low, arc, groove(r))
    angle = 2.0 * math.pi - 2.0 * 2.0 * half / p
    return math.pi * (root**2 - bore**2) + np.trapezoid(r * angle, r)


def hourglass_area(bore, z):
    """What the plane sides of a wedge leave between the tori of tip and root, and the root's circle below.

    Sampled on rings; an arc of 1 mm at either root adds about 1 mm² of 600.
    """
    ends = 125.0 - np.sqrt(np.array([104.2, 96.5]) ** 2 - z**2)
    squares = np.linspace(*ends**2, 61)
    radii = np.sqrt(0.5 * (squares[1:] + squares[:-1]))
    azimuths = 2.0 * math.pi * (np.arange(720) + np.linspace(0.0, 1.0, 60, endpoint=False)[:, None]) / 720
    places = np.stack([radii[:, None] * np.cos(azimuths), radii[:, None] * np.sin(azimuths), np.full((60, 720), z)])
    cut = np.concatenate([_in_wedge(ring.T) for ring in np.swapaxes(places, 0, 1)])
    return math.pi * (ends[0] ** 2 - bore**2 + (ends[1] ** 2 - ends[0] ** 2) * (1.0 - cut.mean())) + 1.0


def _in_wedge(points):
    """Whether the tooth of the tool ever takes points (N, 3) of the middle of the worm away."""
    facing = -np.arctan2(points[:, 1], points[:, 0])[:, None]
    theta = facing + (2.0 * math.pi * np.arange(-4, 5)[:, None] + np.linspace(-0.9, 0.9, 61)).ravel()
    x, y, z = points.T[:, :, None]
    cosine, sine = np.cos(theta), np.sin(theta)
    x, y, z = x * cosine - y * sine - 125.0, -z, x * sine + y * cosine
    cosine, sine = np.cos(theta / 40.0), np.sin(theta / 40.0)
    place = x * cosine - y * sine, x * sine + y * cosine, z
    inside = np.ones(theta.shape, dtype=bool)
    for side in (1, -1):
        twin = hourglass.Twin(side, {})
        inside &= sum(float(n) * (q - float(f)) for n, q, f in zip(twin.normal, place, twin.foot, strict=True)) < 0.0
    return inside.any(axis=1)


@dataclass(frozen=True)
class Case:
    """A drive: its name and a design, and what is known of it.

    ``angles`` of the pinion in degrees, at the second of which ``torque`` in N m loads it; ``off`` and ``within``: its
    flanks once more; ``sections`` of the pinion across its axis, of an ``area`` known to a share ``within_area``;
    ``pitch`` from tooth to tooth in degrees; the wheel's ``axis`` stands ``centre`` mm from the pinion's along x.
    """

    drive: str
    tables: dict
    angles: tuple[float, ...]
    torque: float
    off: Callable
    within: Callable
    area: Callable
    sections: tuple[float, ...]
    within_area: float
    pitch: float
    axis: np.ndarray
    centre: float


ROUNDING_OF_WORM = 0.3
CASES = {
    "crossed_helicoids": Case(
        "crossed_helicoids", crossed.TABLES, (-6.0, 0.0, 5.0), 5.0, off_helicoid, within_helicoids, gear_area,
        (-10.0, 0.0, 7.0), 1e-6, 360.0 / 20, np.array([0.0, math.sin(sum(crossed.BETA)), math.cos(sum(crossed.BETA))]),
        sum(crossed.R),
    ),
    "hourglass_worm": Case(
        "hourglass_worm", hourglass.TABLES, (-120.0, 0.0, 60.0), 50.0, off_hourglass, within_hourglass, hourglass_area,
        (-20.0, 0.0, 20.0), 2e-3, 360.0, np.array([0.0, 1.0, 0.0]), 125.0,
    ),
    "own_blades": Case(
        "cylindrical_worm_zy_zy", blades.tables_of(blades.CROWNED), (-20.0, -10.0, 0.0), 10.0, off_crowned,
        within_crowned, worm_area, (-8.0, 0.0, 5.0), 1e-6, 180.0, np.array([0.0, 1.0, 0.0]), 104.01989760002536,
    ),
}  # fmt: skip


@pytest.fixture(params=CASES)
def case(request):
    return CASES[request.param]


@pytest.fixture
def run(case, request, derivation, tmp_path):
    """Commands on the design of the case."""
    path = tmp_path / "design.toml"
    path.write_text(designs.toml_text(case.tables), encoding="utf-8")
    return Commands(derivation(next(name for name, other in CASES.items() if other is case)), path)


@pytest.fixture
def drive(case, run):
    def made(backend="c", **tables):
        return Drive.from_tables(case.tables | tables, backend, run.folder)

    return made


def degrees(angles):
    return f"--phi-deg={','.join(map(repr, map(float, angles)))}"


@pytest.mark.parametrize("member", ["pinion", "wheel"])
def test_surface(case, run, member):
    """Points and normals are those of the own flank."""
    shown = run.json("surface", "--member", member, "--grid", "4x7")
    rows = [
        (dict(zip(shown["parameters"], values, strict=True)), point, normal)
        for values, point, normal in zip(shown["parameter_values"], shown["points_mm"], shown["normals"], strict=True)
        if point
    ]
    assert len(rows) > 20
    assert max(abs(off) for row in rows for off in case.off(member, *row)) < 1e-9


@pytest.mark.parametrize("member", ["pinion", "wheel"])
def test_limits(case, run, member):
    """No undercut on the flank: the normal of differences along a grid keeps its side."""
    found = run.json("limits")
    assert not any(line["on_flank"] for line in found["undercut"] if line["member"] == member)
    shown = run.json("surface", "--member", member, "--grid", "17x33")
    points, normals = (
        np.array([p or [math.nan] * 3 for p in shown[key]]).reshape(17, 33, 3) for key in ("points_mm", "normals")
    )
    across, along = points[1:, :-1] - points[:-1, :-1], points[:-1, 1:] - points[:-1, :-1]
    side = np.sum(np.cross(across, along) * normals[:-1, :-1], axis=2)
    side = side[np.isfinite(side) & (np.abs(side) > 1e-9)]
    assert len(side) > 300 and len(set(np.sign(side))) == 1


def test_ratio(case, run):
    """Contact begins and ends where an own limit is zero, and lies inside all of them between."""
    found = run.json("ratio")
    ends = [found[end]["pinion_angle_deg"] for end in ("begin", "end")]
    assert found["contact_ratio"] == pytest.approx(abs(ends[1] - ends[0]) / case.pitch, rel=1e-9)
    inner = ends[0] + (ends[1] - ends[0]) * np.linspace(0.01, 0.99, 9)
    points = run.json("tca", degrees([*ends, *inner]))["points"]
    for end, contact in zip(("begin", "end"), points, strict=False):
        member, event = found[end]["member"], found[end]["event"]
        assert case.within(member, contact)[event] == pytest.approx(0.0, abs=1e-6)
    for contact in points[2:]:
        assert min(value for member in ("pinion", "wheel") for value in case.within(member, contact).values()) > 0.0


def test_solid(case, drive):
    """Areas of the pinion in sections across its axis."""
    body = solid_body(drive(), "pinion")
    for z in case.sections:
        one = replace(body.tooth, faces=(z, z + 1e-3), parted=np.empty(0))
        grid = one.grid(Rows(1, 400, 800, 400, 400))
        area, bore = 0.0, float(np.hypot(*grid._below(grid.low[0][:, 0])[0, :2]))
        low, high = (np.concatenate([side[0][0], side[1][0][1:]]) for side in (grid.low, grid.high))
        tip = grid._across(grid.low[1][:, -1], grid.high[1][:, -1], 400)[0]
        land = grid._across(grid.high[0][:, 0], grid.low[0][:, 0] @ _turn(one.pitch), 400)[0]
        for line in (low, tip, high[::-1], land):
            area += 0.5 * float(np.sum(line[:-1, 0] * line[1:, 1] - line[:-1, 1] * line[1:, 0]))
        area = area * body.whole - math.pi * bore**2
        assert area == pytest.approx(case.area(bore, z), rel=case.within_area)


@pytest.mark.parametrize("case", [CASES[name] for name in ("crossed_helicoids", "own_blades")], ids=lambda c: c.drive)
def test_solid_file(case, run):
    """The volume within the facets of a screw's body is its area in any section times its length, but for their
    departure of 1 µm.
    """
    path = run.design.with_suffix(".stl")
    run("surface", "--member", "pinion", "--solid", "--stl", path)
    facets = np.frombuffer(path.read_bytes()[84:], dtype=np.dtype([("values", "<f4", 12), ("of", "<u2")]))
    corners = facets["values"][:, 3:].reshape(-1, 3, 3).astype(float)
    volume = np.sum(np.cross(corners[:, 0], corners[:, 1]) * corners[:, 2]) / 6.0
    bore = np.hypot(corners[..., 0], corners[..., 1]).min()
    surface = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum()
    assert volume == pytest.approx(case.area(bore, 0.0) * np.ptp(corners[..., 2]), abs=1e-3 * surface)


def _turn(angle):
    """Rows turned about z."""
    cosine, sine = math.cos(angle), math.sin(angle)
    return np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])


def test_loaded(case, run):
    """Forces times the levers of the rigid contacts are the torque; under next to none the error is the rigid one."""
    on = run.json("loaded", "--torque-nm", case.torque, "--phi-deg", case.angles[1])
    (point,) = on["points"]
    pairs = [pair for pair in point["pairs"] if pair["force_n"] > 0.0]
    contacts = run.json("tca", degrees([case.angles[1] - case.pitch * p["pairs_later"] for p in pairs]))["points"]
    origin = np.array([case.centre, 0.0, 0.0]) if on["torque_on"] == "wheel" else np.zeros(3)
    axis = case.axis if on["torque_on"] == "wheel" else np.array([0.0, 0.0, 1.0])
    moment = sum(
        pair["force_n"] * abs(np.cross(np.array(at["contact_point_mm"]) - origin, at["contact_normal"]) @ axis)
        for pair, at in zip(pairs, contacts, strict=True)
    )
    assert moment == pytest.approx(1000.0 * case.torque, rel=1e-3)
    (light,) = run.json("loaded", "--torque-nm", 1e-4 * case.torque, "--phi-deg", case.angles[1])["points"]
    errors = [at["transmission_error_arcsec"] for at in contacts]
    assert min(abs(light["unloaded_transmission_error_arcsec"] - e) for e in errors) < 1e-6
    stiff = abs(light["loaded_transmission_error_arcsec"] - light["unloaded_transmission_error_arcsec"])
    assert stiff < 0.02 * abs(point["loaded_transmission_error_arcsec"] - point["unloaded_transmission_error_arcsec"])


def test_sweep(case, run, tmp_path):
    """Every row is that of a single analysis."""
    run("sweep", "--vary", "misalignment.center_distance_mm=-0.02:0.02", "--grid", 3, "--out", tmp_path / "rows",
        "--format", "csv", degrees(case.angles))  # fmt: skip
    (part,) = (tmp_path / "rows").glob("slice-*.csv")
    with part.open(encoding="utf-8") as stream:
        errors = [float(row["transmission_error_arcsec"]) for row in csv.DictReader(stream)]
    single = []
    for change in (-0.02, 0.0, 0.02):
        words = degrees(case.angles), "--set", f"misalignment.center_distance_mm={change}"
        single += [point["transmission_error_arcsec"] for point in run.json("tca", *words)["points"]]
    assert errors == pytest.approx(single, abs=1e-9)


def test_report(case, run, tmp_path):
    """The page states the contact ratio and the errors of the JSON."""
    found = run.json("ratio")
    run("report", "--html", tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert f"{found['contact_ratio']:.3f}" in page
    assert found["begin"]["event"] in page and found["end"]["event"] in page


def test_sensitivities(case, drive):
    """By every error of assembly: central differences of the errors of single analyses."""
    made, angle = drive(), np.radians(case.angles[:1])
    found = sensitivity(made, angle)
    for key in made.design.tables["misalignment"]:
        step = 1e-4
        ends = [drive(misalignment={key: h}).tca(angle).error[0] for h in (-step, step)]
        slope = (ends[1] - ends[0]) / (2.0 * (step if key.endswith("_mm") else math.radians(step)))
        assert found.error[0, found.of(f"misalignment.{key}")] == pytest.approx(slope, rel=1e-4, abs=1e-9)


def test_casadi_and_the_left_hand(case, drive):
    angles = np.radians(case.angles)
    right = drive().tca(angles)
    assert drive("casadi").tca(angles).error == pytest.approx(right.error, abs=1e-9 * ARCSEC)
    left = drive(design=case.tables["design"] | {"hand": "left"}).tca(-angles)
    assert left.error == pytest.approx(-right.error, abs=1e-9 * ARCSEC)
    assert left.points == pytest.approx(right.points * [1.0, -1.0, 1.0], abs=1e-9)


def test_the_header_alone_has_the_librarys_bits(case, run, drive, tmp_path):
    name, output, source = case.drive, tmp_path / "solve.so", tmp_path / "solve.c"
    source.write_text(
        f'#include "{name}.h"\nint solve(const double *p, double phi, double *x)\n{{\n    double s[{name}_NS];\n'
        f"    return {name}_setup(p, s) ? -1000 : {name}_solve(s, phi, x, NULL);\n}}\n"
    )
    c.run(*c.compilers()["clang"][0], "-std=c99", "-O1", *c.STRICT, *c.EXACT, "-shared", "-fPIC",
          f"-I{run.folder / 'include'}", source, "-o", output, "-lm")  # fmt: skip
    made = drive(misalignment={"center_distance_mm": 0.01})
    solve, parameters = ctypes.CDLL(str(output)).solve, np.ascontiguousarray(made.design.parameters)
    for angle in np.radians(case.angles):
        contact = made.tca([angle])
        x = np.empty(5)
        pointers = (a.ctypes.data_as(ctypes.c_void_p) for a in (parameters, x))
        assert solve(next(pointers), ctypes.c_double(angle), next(pointers)) >= 0
        known = contact.unknowns | {"transmission_error": contact.error}
        assert x.tolist() == [float(known[u["name"]][0]) for u in made.design.description["unknowns"]]


def test_the_audit_entry_has_nothing_open(case, run):
    entry = json.loads((run.folder / "audit" / f"{case.drive}.json").read_text(encoding="utf-8"))
    assert set(entry["checked"].values()) == {"holds"} and entry["not_proved"] == {} and entry["proved"]
