"""Errors of machine settings, tool and pose of the part from measured deviations of its flanks.

Weighted least squares with exact columns n·∂r/∂q, robust against dirt and burr. A combination of parameters that is
less certain than what matters (--tolerance) is named and not estimated. Parameters that are named, and those after
--hold, do not follow the rules of the design; the others do. Exit status 1 if a parameter could not be told apart.
"""

import math

from meshwright.base.errors import UsageError
from meshwright.base.files import write_json, write_text
from meshwright.base.plain import finite_or_none
from meshwright.commands import options as common
from meshwright.commands.progress import progress
from meshwright.design import design as designs
from meshwright.design.description import table_and_key
from meshwright.shop.identify import POSE, Parameters, words
from meshwright.shop.located import other_design
from meshwright.shop.tables import read_csv


def add_arguments(parser):
    common.add_design(parser)
    parser.add_argument("--member", choices=("pinion", "wheel"), required=True)
    parser.add_argument("--measured", required=True, metavar="FILE.csv", help="points with deviation_um, as of `grid`")
    parser.add_argument(
        "--parameters", required=True, metavar="KEY,KEY,…", help=f"keys of the design, and of {', '.join(POSE)}"
    )
    parser.add_argument("--hold", metavar="KEY,…", help="keys that stay though rules would move them")
    parser.add_argument("--sigma-um", type=common.positive, metavar="S", help="standard deviation of one measurement")
    parser.add_argument(
        "--tolerance", action="append", default=[], metavar="KEY=SIZE",
        help="error of a key that matters, in its unit; default 0.1 mm, 0.1 degrees; repeatable",
    )  # fmt: skip
    parser.add_argument("--toml", metavar="FILE|-", help="write the design with settings corrected by what was found")
    parser.add_argument("--json", metavar="FILE|-", help="write as JSON (schema meshwright.identify/1)")


def run(options):
    drive = common.drive_of(options)
    points, _ = read_csv(options.measured)
    keys = [key.strip() for key in options.parameters.split(",") if key.strip()]
    held = [key.strip() for key in (options.hold or "").split(",") if key.strip()]
    if not keys:
        raise UsageError("--parameters: names no key; for example --parameters pose.rotation_arcsec")
    sigma = None if options.sigma_um is None else 1e-3 * options.sigma_um
    with progress(2) as step:
        step("measured places on the flanks")
        parameters = Parameters.at(drive, options.member, points, keys, held, _tolerances(options.tolerance))
        step(f"{len(keys)} parameters")
        found = parameters.fit(points.deviations, sigma)
    warnings = [*_warnings(drive, points, parameters.flanks)]
    if options.toml:
        write_text(options.toml, designs.toml_text(_corrected(parameters, found)))
    if options.json:
        write_json(options.json, document(parameters, found, points, warnings))
    elif options.toml != "-":
        write_text("-", _table(parameters, found, warnings))
    return 1 if found.estimate.undetermined else 0


def _tolerances(texts):
    found = {}
    for text in texts:
        key, size = common.key_and_size("--tolerance", text, "pose.axial_mm=0.02")
        table, name = table_and_key(key)
        found[f"{table}.{name}"] = size
    return found


def _warnings(drive, points, flanks):
    """What makes the measurement too poor or another one than is meant, whatever the numbers say."""
    if other := other_design(drive, points, flanks.off):
        yield other
    if len(set(points.flank)) == 1:
        apart = drive.design.description["flanks_apart"]
        remedy = "here each flank is a design of its own" if apart else "measure both flanks"
        yield f"one flank alone is measured: turns of the part and thicker or thinner teeth look alike; {remedy}"
    if len(set(points.tooth.tolist())) < 3:
        yield "fewer than three teeth are measured: errors of single teeth and of eccentricity count as settings"


def document(parameters, found, points, warnings=()):
    """The ``meshwright.identify/1`` document: values are errors, in the units of the keys; None for what is unknown."""
    fit = found.estimate
    rows = zip(found.keys, found.nominal, fit.values, fit.deviations, strict=True)
    return {
        "schema": "meshwright.identify/1",
        "estimates": [
            {
                "key": _short(key), "value": finite_or_none(value), "standard_deviation": finite_or_none(deviation),
                "nominal": nominal, "tolerance": float(parameters.tolerances[k]),
            }
            for k, (key, nominal, value, deviation) in enumerate(rows)
        ],
        "covariance": fit.covariance.tolist(),
        "inseparable": [
            {"keys": [_short(found.keys[k]) for k in lost.members()], "words": words(parameters, found, lost)}
            for lost in fit.undetermined
        ],
        "correlated": [
            {"keys": [_short(a), _short(b)], "correlation": share} for a, b, share in found.correlated()
        ],
        "distrusted": [
            {
                "tooth": int(points.tooth[k]), "flank": points.flank[k], "i": int(points.i[k]), "j": int(points.j[k]),
                "weight": float(fit.weights[k]), "residual_um": float(1e3 * fit.residuals[k]),
            }
            for k in fit.distrusted()
        ],
        "chi_square_per_degree": finite_or_none(fit.chi_square_per_degree),
        "sigma_um": 1e3 * fit.sigma,
        "predicted_residual_um": {"rms": 1e3 * found.rms, "largest": 1e3 * found.largest},
        "residuals_um": [finite_or_none(1e3 * r) for r in fit.residuals],
        "warnings": list(warnings),
    }  # fmt: skip


def _short(key):
    """A key as it may be given: those of [design] without their table."""
    return key.removeprefix("design.")


def _corrected(parameters, found):
    """The design with the determined errors of its keys taken off; what it leaves open stays open."""
    changes = {}
    for key, nominal, value in zip(found.keys, found.nominal, found.estimate.values, strict=True):
        if key not in POSE and math.isfinite(value):
            changes[key] = nominal - float(value)
    tables = designs.changed(parameters.drive.design.given(), changes)
    designs.check(tables, parameters.drive.design.places)  # a setting beyond its bounds is named here
    return tables


def _table(parameters, found, warnings):
    fit = found.estimate
    lines = [f"{'error of':<42}{'value':>15}{'standard deviation':>22}"]
    for key, value, deviation in zip(found.keys, fit.values, fit.deviations, strict=True):
        known = f"{value:>15.6g}{deviation:>22.2g}" if math.isfinite(value) else f"{'not told apart':>37}"
        lines.append(f"{_short(key):<42}{known}")
    lines += [words(parameters, found, lost) for lost in fit.undetermined]
    lines += [f"{_short(a)} and {_short(b)} are correlated by {share:.4f}" for a, b, share in found.correlated()]
    lines.append(f"left unexplained: {1e3 * found.rms:.3g} µm rms, {1e3 * found.largest:.3g} µm at most")
    if math.isfinite(fit.chi_square_per_degree):
        lines.append(f"chi-square per degree of freedom {fit.chi_square_per_degree:.3g}")
    if len(fit.distrusted()):
        lines.append(f"{len(fit.distrusted())} points are distrusted (dirt, burr); --json names them")
    return "\n".join([*lines, *(f"note: {w}" for w in warnings)]) + "\n"
