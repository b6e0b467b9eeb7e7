"""Components of FMI 2.0 and 3.0: valid, the library's errors, one energy law, states that can be saved."""

import shutil
import zipfile
from types import SimpleNamespace

import numpy as np
import pytest

from meshwright import Drive
from meshwright.cli import main
from meshwright.commands import export
from tests.quick import quick

fmpy = pytest.importorskip("fmpy", reason="FMPy is not installed")

FAMILIES = (
    "helical-crowned", "plain-zi", "spherical-table-2-2-convex-20", "bevel-crowned-both", "face-worm-conical-convex",
)  # fmt: skip
STIFFNESS, INERTIA_A, INERTIA_B = 4e4, 2e-3, 1.5e-2


class Unit:
    """An instance of a component in initialised co-simulation: variables by name."""

    def __init__(self, path, **parameters):
        from fmpy.fmi2 import FMU2Slave
        from fmpy.fmi3 import FMU3Slave

        self.folder, self.description = fmpy.extract(str(path)), fmpy.read_model_description(str(path))
        self.version = int(self.description.fmiVersion[0])
        kind = FMU2Slave if self.version == 2 else FMU3Slave
        self.unit = kind(
            guid=self.description.guid, unzipDirectory=self.folder, modelIdentifier="mesh", instanceName="mesh"
        )
        self.unit.instantiate()
        self.variables = {v.name: v for v in self.description.modelVariables}
        if self.version == 2:
            self.unit.setupExperiment()
        self.set(**{name: value for name, value in parameters.items() if "." in name})
        self.unit.enterInitializationMode()
        self.set(**{name: value for name, value in parameters.items() if "." not in name})
        self.unit.exitInitializationMode()

    def set(self, **values):
        references = [self.variables[name].valueReference for name in values]
        numbers = [float(value) for value in values.values()]
        (self.unit.setReal if self.version == 2 else self.unit.setFloat64)(references, numbers)

    def get(self, *names):
        reals = [name for name in names if self.variables[name].type in ("Real", "Float64")]
        references = [self.variables[name].valueReference for name in reals]
        values = (self.unit.getReal if self.version == 2 else self.unit.getFloat64)(references)
        found = dict(zip(reals, values, strict=True))
        for name in set(names) - set(reals):
            get = {"Integer": "getInteger", "Int32": "getInt32", "Int64": "getInt64"}[self.variables[name].type]
            found[name] = getattr(self.unit, get)([self.variables[name].valueReference])[0]
        return [found[name] for name in names] if len(names) > 1 else found[names[0]]

    def step(self, at=0.0, step=1e-3):
        self.unit.doStep(currentCommunicationPoint=at, communicationStepSize=step)

    def close(self):
        self.unit.freeInstance()
        shutil.rmtree(self.folder, ignore_errors=True)


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """Where the component of a design is, written once."""
    folder, known = tmp_path_factory.mktemp("units"), {}

    def unit(design, version, *options):
        key = (design, version, *options)
        if key not in known:
            known[key] = folder / f"{len(known)}.fmu"
            words = ["export", design, "--fmu", str(known[key]), "--fmi", str(version), "--allow-jam", *options]
            assert main(words) == 0
        return known[key]

    return unit


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize("design", quick(FAMILIES, "helical-crowned"))
def test_a_validator_finds_no_problem(written, design, version):
    from fmpy.validation import validate_fmu

    assert validate_fmu(str(written(design, version))) == []


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize("design", quick(FAMILIES, "helical-crowned"))
def test_error_ratio_and_backlash_are_the_drives(written, design, version):
    """Over three pitches, and after 10⁵ turns."""
    drive, unit = Drive.load(design), Unit(written(design, version))
    angles = np.concatenate([np.linspace(-1.0, 2.0, 31) * drive.pitch(), 2e5 * np.pi + np.linspace(0.0, 1.0, 7)])
    known = drive.cycle(angles)
    for k, angle in enumerate(angles):
        unit.set(phi_a=angle, phi_b=drive.ratio * angle)
        unit.step()
        error, ratio, backlash, pair = unit.get("transmission_error", "ratio", "backlash", "leading_pair")
        assert error == pytest.approx(known.drive.errors[k], abs=1e-12)
        assert ratio == pytest.approx(known.drive.ratios[k], abs=1e-9)
        assert backlash == pytest.approx(known.backlash[k], abs=1e-12, nan_ok=True)
        assert pair == known.drive.pairs[k] or abs(error - known.drive.errors[k]) < 1e-14
    unit.close()


def test_the_wheel_is_free_for_the_backlash(written):
    drive, angle = Drive.load("helical-crowned"), 0.05
    at, unit = drive.cycle([angle]), Unit(written("helical-crowned", 2), stiffness=STIFFNESS)
    for wheel, sign in ((at.drive.errors[0], 1), (at.coast.errors[0], -1)):
        unit.set(phi_a=angle, phi_b=drive.ratio * angle + wheel - sign * 1e-7)
        unit.step()
        torque, contact = unit.get("tau_b", "contact")
        assert sign * torque > 0.0 and contact == sign
    unit.set(phi_b=drive.ratio * angle + 0.5 * (at.drive.errors[0] + at.coast.errors[0]))
    unit.step()
    assert unit.get("tau_a", "tau_b", "potential_energy", "contact") == [0.0, 0.0, 0.0, 0]
    unit.close()


@pytest.mark.parametrize("version", [2, 3])
def test_a_component_starts_with_the_stiffness_of_a_pair_under_a_torque(tmp_path, monkeypatch, version):
    """As ``loaded`` has it, which is another test's: here 4e4 N m/rad."""
    monkeypatch.setattr(export, "stiffnesses", lambda _, torques: [SimpleNamespace(pair=STIFFNESS) for _ in torques])
    path = tmp_path / "stiff.fmu"
    words = ["export", "helical-crowned", "--fmu", str(path), "--fmi", str(version), "--torque-nm", "20", "--allow-jam"]
    assert main(words) == 0
    unit, drive = Unit(path), Drive.load("helical-crowned")
    assert float(unit.variables["stiffness"].start) == STIFFNESS
    unit.set(phi_a=0.05, phi_b=drive.ratio * 0.05 + drive.cycle([0.05]).drive.errors[0] - 1e-6)
    assert unit.get("stiffness") == STIFFNESS and unit.get("tau_b") > 0.0
    unit.close()


@pytest.mark.validate
def test_flanks_along_a_line_are_one_spring(written):
    """δ = 10⁻⁶ rad of the wheel: K δ, m K δ and K δ²/2."""
    drive = Drive.load("spur-profile-shift")
    unit = Unit(written("spur-profile-shift", 3), stiffness=STIFFNESS)
    error = drive.cycle([0.3]).drive.errors[0]
    unit.set(phi_a=0.3, phi_b=drive.ratio * 0.3 + error - 1e-6)
    a, b, energy, inflow = unit.get("tau_a", "tau_b", "potential_energy", "flange_a.tau")
    assert [a, b, energy] == pytest.approx([-drive.ratio * 4e-2, 4e-2, 2e-8], rel=1e-9)
    assert inflow == -a
    unit.close()


@pytest.mark.parametrize("design", quick(("helical-crowned", "plain-zi"), "helical-crowned"))
def test_power_of_the_torques_is_energy_and_loss(written, design):
    """dV/dt + loss = −(τ_a w_a + τ_b w_b) at random places, with damping and friction."""
    generator, drive = np.random.default_rng(5), Drive.load(design)
    unit = Unit(written(design, 2), stiffness=STIFFNESS, damping=0.3, friction=0.08)
    for _ in range(20):
        angle, (w_a, w_b) = generator.uniform(-1.0, 1.0) * drive.pitch(), generator.normal(size=2) * [1.0, drive.ratio]
        wheel = drive.ratio * angle + drive.cycle([angle]).drive.errors[0] - generator.uniform(1e-5, 1e-4)

        def energy(time):
            unit.set(phi_a=angle + w_a * time, phi_b=wheel + w_b * time, w_a=w_a, w_b=w_b)  # noqa: B023
            return unit.get("potential_energy")

        tau_a, tau_b, loss = (energy(0.0), unit.get("tau_a", "tau_b", "loss"))[1]
        h = 1e-7
        rate = (8.0 * (energy(h) - energy(-h)) - (energy(2.0 * h) - energy(-2.0 * h))) / (12.0 * h)
        scale = abs(tau_a * w_a) + abs(tau_b * w_b) + abs(loss)
        assert rate + loss == pytest.approx(-(tau_a * w_a + tau_b * w_b), abs=2e-6 * scale + 1e-9)
        assert loss >= 0.0
    unit.close()


def test_two_inertias_keep_their_energy(written):
    """Undamped, over some pitches with changes of pairs, by the classical method of Runge and Kutta."""
    drive, unit = Drive.load("helical-crowned"), Unit(written("helical-crowned", 2), stiffness=STIFFNESS)
    pressed, torque = drive.cycle([0.0]).drive.errors[0] - 2e-4, np.array([20.0, -20.0 / drive.ratio])
    state, inertia, h = np.array([0.0, pressed, 30.0, 30.0 * drive.ratio]), np.array([INERTIA_A, INERTIA_B]), 1e-5

    def slope(y):
        unit.set(phi_a=y[0], phi_b=y[1], w_a=y[2], w_b=y[3])
        return np.concatenate([y[2:], (np.array(unit.get("tau_a", "tau_b")) + torque) / inertia])

    def energy(y):
        slope(y)
        return unit.get("potential_energy") + 0.5 * inertia @ y[2:] ** 2 - torque @ y[:2]

    start, most = energy(state), 0.0
    for _ in range(2000):
        a = slope(state)
        b = slope(state + 0.5 * h * a)
        c = slope(state + 0.5 * h * b)
        d = slope(state + h * c)
        state = state + h / 6.0 * (a + 2.0 * b + 2.0 * c + d)
        most = max(most, unit.get("potential_energy"))
    assert state[0] > 2.0 * drive.pitch() and most > 1e-4
    assert energy(state) == pytest.approx(start, abs=1e-6 * (0.5 * inertia @ state[2:] ** 2))
    unit.close()


def _derivatives(unit, outputs, of):
    """Of outputs by one input."""
    references = [unit.variables[name].valueReference for name in outputs]
    known, one = [unit.variables[of].valueReference], [1.0]
    if unit.version == 2:
        return np.array(unit.unit.getDirectionalDerivative(references, known, one))
    return np.array(unit.unit.getDirectionalDerivative(references, known, one, nSensitivity=len(references)))


@pytest.mark.parametrize("version", [2, 3])
@pytest.mark.parametrize("design", quick(("helical-crowned", "plain-zi"), "helical-crowned"))
def test_torques_have_the_derivatives_of_one_energy(written, design, version):
    """Undamped: symmetric, and along the rotation that keeps every approach nothing but the change of stiffness; by the
    wheel's angle less by K for each pair that is pressed; of damping, c K δ ρ², of the energy, the torques.
    """
    drive, generator = Drive.load(design), np.random.default_rng(6)
    unit, angles = Unit(written(design, version), stiffness=STIFFNESS), generator.uniform(-1.0, 1.0, 5) * drive.pitch()
    torques = ("tau_a", "tau_b")
    for angle in angles:
        wheel = drive.ratio * angle + drive.cycle([angle]).drive.errors[0] - generator.uniform(2e-6, 1e-4)
        unit.set(phi_a=angle, phi_b=wheel, w_a=1.0, w_b=drive.ratio, damping=0.0)
        by_a, by_b = (_derivatives(unit, (*torques, "potential_energy"), of) for of in ("phi_a", "phi_b"))
        assert by_a[1] == pytest.approx(by_b[0], rel=1e-6)
        assert [-by_a[2], -by_b[2]] == pytest.approx(unit.get(*torques), rel=1e-7)
        assert np.sign(by_b[1]) == -1.0 and abs(by_b[1]) <= 8 * STIFFNESS
        shift, near = 1e-9, []
        for turned in (-shift, shift):
            unit.set(phi_b=wheel + turned)
            near.append(unit.get(*torques))
        assert by_b[:2] == pytest.approx((np.array(near[1]) - near[0]) / (2.0 * shift), rel=1e-5)
        unit.set(phi_b=wheel, damping=0.3)
        by_speed = [_derivatives(unit, torques, of) for of in ("w_a", "w_b")]
        assert by_speed[0][1] == pytest.approx(by_speed[1][0], rel=1e-6) and by_speed[1][1] < 0.0
    assert _derivatives(unit, ("transmission_error", "ratio"), "phi_a")[0] == pytest.approx(
        unit.get("ratio") - drive.ratio, abs=1e-8
    )
    with pytest.raises(Exception, match="status 3|failed"):
        _derivatives(unit, ("tau_a",), "stiffness")
    unit.close()


@pytest.mark.parametrize("version", [2, 3])
def test_states_are_saved_and_instances_are_apart(written, version):
    path = written("helical-crowned", version)
    one, other = Unit(path, stiffness=STIFFNESS), Unit(path)
    one.set(phi_a=0.1, phi_b=0.0)
    saved, before = one.unit.getFMUState() if version == 3 else one.unit.getFMUstate(), one.get("tau_b")
    one.set(phi_a=0.2)
    assert one.get("tau_b") != before and other.get("tau_b") == 0.0
    (one.unit.setFMUState if version == 3 else one.unit.setFMUstate)(saved)
    assert one.get("tau_b") == before
    one.close()
    other.close()


@pytest.mark.parametrize("version", [2, 3])
def test_misalignments_are_fixed_parameters(written, version):
    drive = Drive.load("helical-crowned").with_(misalignment={"vertical_deg": 0.02})
    unit = Unit(written("helical-crowned", version), **{"misalignment.vertical_deg": 0.02})
    unit.set(phi_a=0.1)
    assert unit.get("transmission_error") == pytest.approx(drive.cycle([0.1]).drive.errors[0], abs=1e-13)
    with pytest.raises(Exception, match="status 3|failed"):
        unit.set(**{"misalignment.vertical_deg": 0.0})
    unit.close()


@pytest.mark.validate
def test_where_no_pair_touches_the_status_is_an_error(written):
    unit = Unit(written("bevel-hypoid-formate", 2))
    angles = np.linspace(0.0, 1.0, 41) * Drive.load("bevel-hypoid-formate").pitch()
    none = np.isnan(Drive.load("bevel-hypoid-formate").cycle(angles).drive.errors)
    assert none.any()
    unit.set(phi_a=angles[none][0])
    with pytest.raises(Exception, match="status 3|failed"):
        unit.get("tau_a")
    unit.close()


@pytest.mark.validate
def test_sources_lie_in_the_archive_and_it_has_the_same_bytes_again(written, tmp_path):
    path = written("helical-crowned", 3, "--sources")
    again = tmp_path / "again.fmu"
    words = ["export", "helical-crowned", "--fmu", str(again), "--fmi", "3", "--sources", "--allow-jam"]
    assert main(words) == 0
    names = zipfile.ZipFile(path).namelist()
    assert {"sources/fmu.c", "sources/cylindrical_gears.h", "sources/buildDescription.xml"} <= set(names)
    assert again.read_bytes() == path.read_bytes()


@pytest.mark.validate
def test_a_component_for_other_machines(written):
    names = zipfile.ZipFile(written("helical-crowned", 2, "--platforms", "linux64,win64,darwin64")).namelist()
    assert {"binaries/linux64/mesh.so", "binaries/win64/mesh.dll", "binaries/darwin64/mesh.dylib"} <= set(names)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["recess-action-full"], "the drive jams"),
        (["helical-crowned", "--fmi", "2", "--platforms", "amiga"], "FMI 2 has linux64"),
        (["helical-crowned", "--torque-nm", "20,50"], "a component has one stiffness"),
        (["helical-crowned", "--json", "-"], "--json: --fmu has no use for it"),
    ],
)
def test_what_makes_no_component_is_refused(tmp_path, capsys, words, said):
    assert main(["export", *words, "--fmu", str(tmp_path / "a.fmu")]) == 2
    assert said in capsys.readouterr().err
    assert not [*tmp_path.iterdir()]
