"""Stiffness of the mesh and of one of its pairs over a pitch, under load, as a torsion at the wheel: of ``loaded``."""

from dataclasses import dataclass

import numpy as np

from meshwright.base.errors import UsageError

#: Angles of a pitch, equally spaced.
SAMPLES = 12


@dataclass(frozen=True)
class Stiffness:
    """Under a ``torque``, N m, on one member, at pinion angles (N,), rad, of a pitch and its end: torque of the wheel
    per angle of the wheel, N m/rad, of the ``mesh`` (N,), and of a pair, the mean of all that carry; NaN where no pair
    does, or no figure is found.
    """

    torque: float
    torque_on: str
    angles: np.ndarray
    mesh: np.ndarray
    pair: float


def stiffnesses(drive, torques):
    """The :class:`Stiffness` of a drive under each of some torques, N m, of the member whose torque is usually stated.

    Raises :class:`~meshwright.base.errors.UsageError` where nothing carries at any angle, or the extra is missing.
    """
    from meshwright import fe

    try:
        fe.solids, fe.compliance, fe.loaded  # noqa: B018
    except ModuleNotFoundError as error:
        raise UsageError(f"{error.name} is not installed; `pip install 'meshwright[fe]'` brings it") from error
    described, sign = drive.as_described, drive.design.mirror.sign
    usual = fe.model.usual_loading(described.design.description)
    gear = fe.solids.gear_pair(described, None)
    beside = fe.compliance.neighbours_of(usual["pairs"])
    compliance = {name: fe.compliance.tooth_compliance(member, beside)
                  for name, member in (("pinion", gear.pinion), ("wheel", gear.wheel))}  # fmt: skip
    angles, found = np.arange(SAMPLES) / SAMPLES * drive.pitch(), []
    for torque in torques:
        load = fe.model.Load(1000.0 * torque, usual["torque_on"])
        at = [_at(fe, gear, sign * angle, usual["pairs"], load, compliance) for angle in angles]
        mesh = np.array([of_mesh for of_mesh, _ in at])
        if not np.isfinite(mesh).any():
            raise UsageError(f"--torque-nm {torque:g}: no figures under this torque; `meshwright loaded` says why")
        pairs = [each for _, of_pairs in at for each in of_pairs]
        whole = np.append(angles, drive.pitch()), np.append(mesh, mesh[0])
        found.append(Stiffness(torque, load.member, *whole, float(np.mean(pairs))))
    return found


def _at(fe, gear, angle, pairs, load, compliance):
    """Stiffness of the mesh at an angle, NaN if there is none, and of each pair that carries, N m/rad."""
    try:
        found = fe.loaded.loaded_contact(gear, angle, pairs, load, compliance)
    except (ArithmeticError, ValueError):  # no pair touches, or a section of a tooth is not whole
        return np.nan, []
    if found.unresolved or not abs(found.rotation) <= fe.gate.LARGEST_ROTATION:
        return np.nan, []
    ratio = 1.0 if load.member == "wheel" else abs(gear.ratio)
    torque, turned = load.torque / ratio, ratio * abs(found.rotation)
    forces = np.array([pair.force for pair in found.pairs])
    arm = torque / forces.sum()
    approaches = turned - np.array([pair.apart for pair in found.pairs]) / arm
    carrying = (forces > 0.0) & (approaches > 0.0)
    return torque / turned / 1000.0, (forces * arm / 1000.0)[carrying] / approaches[carrying]
