"""Choose hob radius and pitch line shift of the recess-action drive with IPOPT, under all misalignment corners.

Wanted: a contact ellipse of 10 mm length at 1500°, and from 0° to 2400° contact on the flanks and a relative
transmission error below 3.5″, however errors of ±0.1 mm centre distance and ±3′ horizontal and vertical combine.
Among the designs that do so, the one with the smallest largest error is chosen. The packaged hob cannot serve: with it
the corner (+0.1 mm, −3′, −3′) has no contact. The result is verified by the C solver.

    python runtime/examples/optimise_recess_action.py
"""

from dataclasses import dataclass
from itertools import product

import casadi
import numpy as np

from meshwright import Drive, differentiable
from meshwright.contact.results import ARCSEC

SEMI_MAJOR_MM = 5.0
ELLIPSE_AT = np.radians(1500.0)
LARGEST_ERROR = 3.5 * ARCSEC

#: Relative errors refer to the first angle; from the second one on contact must be inside every limit.
ANGLES = np.radians(np.arange(0.0, 2401.0, 300.0))

ERRORS = {"center_distance_mm": 0.1, "horizontal_deg": 0.05, "vertical_deg": 0.05}
CORNERS = [dict(zip(ERRORS, signs * np.array([*ERRORS.values()]), strict=True)) for signs in product((-1, 1), repeat=3)]
NOMINAL = dict.fromkeys(ERRORS, 0.0)

#: Free keys: lower bound, start, upper bound. At the start every corner has contact.
FREE = {"design.hob_pitch_radius_mm": (19.2, 21.5, 23.0), "design.pitch_line_shift_mm": (3.0, 4.0, 4.4)}


@dataclass(frozen=True)
class Optimum:
    """What IPOPT found: ``design`` values by key, semi-major axis (mm), largest relative error (rad), its counts.

    ``active`` names the constraints without slack.
    """

    status: str
    iterations: int
    design: dict
    semi_major: float
    largest_error: float
    active: tuple[str, ...]


@dataclass(frozen=True)
class Verified:
    """The C solver's word on a design: semi-major axis (mm), largest relative error (rad), flags raised on the way."""

    semi_major: float
    largest_error: float
    flags: frozenset


def optimised(drive):
    """The :class:`Optimum` for a recess-action drive."""
    low, start, high = (np.array(column) for column in zip(*FREE.values(), strict=True))
    design, largest = casadi.MX.sym("design", len(FREE)), casadi.MX.sym("largest")
    _, nominal = _contacts(drive, design, start, NOMINAL)
    semi_major = nominal["semi_axes"][0, int(np.argmin(np.abs(ANGLES - ELLIPSE_AT)))]
    constraints = {
        "ellipse": (semi_major, SEMI_MAJOR_MM, SEMI_MAJOR_MM),
        "guards": (nominal["guards"][:, 0], 0.0, np.inf),
    }
    for corner in (NOMINAL, *CORNERS):
        limits, contacts = _contacts(drive, design, start, corner)
        name = ", ".join(f"{key} {value:+g}" for key, value in corner.items())
        relative = (contacts["error"][1:] - contacts["error"][0]).T / ARCSEC
        constraints[f"error at {name}"] = casadi.vertcat(largest - relative, largest + relative), 0.0, np.inf
        constraints[f"limits at {name}"] = casadi.vec(contacts["observation"][limits, 1:]), 0.0, np.inf

    values, lower, upper = zip(*constraints.values(), strict=True)
    sizes = [value.numel() for value in values]
    problem = {"x": casadi.vertcat(design, largest), "f": largest, "g": casadi.vertcat(*values)}
    options = {"print_time": False, "ipopt": {"print_level": 0, "sb": "yes", "max_iter": 60}}
    solver = casadi.nlpsol("design", "ipopt", problem, options)
    found = solver(
        x0=[*start, LARGEST_ERROR / ARCSEC],
        lbx=[*low, 0.0],
        ubx=[*high, LARGEST_ERROR / ARCSEC],
        lbg=np.repeat(lower, sizes),
        ubg=np.repeat(upper, sizes),
    )
    *best, error = np.array(found["x"]).ravel()
    split = np.split(np.array(found["g"]).ravel(), np.cumsum(sizes)[:-1])
    slack = {
        **{name: np.abs(g - bound).min() for name, g, bound in zip(constraints, split, lower, strict=True)},
        **{key: min(v - a, b - v) for key, v, a, b in zip(FREE, best, low, high, strict=True)},
        "largest error": LARGEST_ERROR / ARCSEC - error,
    }
    return Optimum(
        status=solver.stats()["return_status"],
        iterations=solver.stats()["iter_count"],
        design=dict(zip(FREE, map(float, best), strict=True)),
        semi_major=float(split[0][0]),
        largest_error=float(error) * ARCSEC,
        active=tuple(name for name, gap in slack.items() if gap < 1e-5),
    )


def _contacts(drive, design, start, errors):
    """Indices of the limits that apply, and the outputs of
    :func:`~meshwright.differentiable.differentiable_tca`, a column for each of the angles, of a drive with errors of
    assembly. Start values come from the C solver, at the start design.
    """
    here = _with_design(drive, start).with_(misalignment=errors)
    start_values, words = here.trace(ANGLES)
    if set(words) != {"converged"}:
        raise ValueError(f"no contact at the start with {errors}: {', '.join(words)}")
    description = here.design.description
    tca = differentiable.differentiable_tca(description)
    p = differentiable.parameters(here.design, tuple(FREE))(design)
    contacts = tca.map(len(ANGLES))(p=casadi.repmat(p, 1, len(ANGLES)), phi=casadi.DM(ANGLES).T, x0=start_values.T)
    seen = np.array(tca(p=here.design.parameters, phi=ANGLES[-1], x0=start_values[-1])["observation"]).ravel()
    places = [b["margin"] + k for b in description["bodies"] for k in range(-1, len(b["margins"]))]
    return [k for k in places if np.isfinite(seen[k])], contacts


def _with_design(drive, values):
    """The drive with the free keys set."""
    return drive.with_(design={key.removeprefix("design."): float(v) for key, v in zip(FREE, values, strict=True)})


def verified(drive, design):
    """:class:`Verified`: every corner solved in C from its own start values, at ten times as many angles."""
    drive = _with_design(drive, design.values())
    angles = np.linspace(ANGLES[0], ANGLES[-1], 10 * (len(ANGLES) - 1) + 1)
    nominal, *_ = results = [drive.with_(misalignment=corner).tca(angles) for corner in (NOMINAL, *CORNERS)]
    begin = np.searchsorted(angles, ANGLES[1])
    return Verified(
        semi_major=float(nominal.semi_axes[np.argmin(np.abs(angles - ELLIPSE_AT)), 0]),
        largest_error=float(max(np.abs(r.relative_error).max() for r in results)),
        flags=frozenset(flag for r in results for row in r.flags[begin:] for flag in row),
    )


def main():
    """Print the optimum and its verification."""
    drive = Drive.load("recess-action-full")
    best = optimised(drive)
    print(f"{best.status} after {best.iterations} iterations")
    for key, value in best.design.items():
        print(f"{key:32} {value:.6f}")
    print("active: " + "; ".join(best.active))
    seen = verified(drive, best.design)
    print(f"{'':32} {'CasADi':>12} {'C':>12}")
    print(f"{'semi-major axis, mm':32} {best.semi_major:12.8f} {seen.semi_major:12.8f}")
    errors = best.largest_error / ARCSEC, seen.largest_error / ARCSEC
    print(f"{'largest relative error, arcsec':32} {errors[0]:12.8f} {errors[1]:12.8f}")
    print(f"flags raised: {', '.join(sorted(seen.flags)) or 'none'}")


if __name__ == "__main__":
    main()
