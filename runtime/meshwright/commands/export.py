"""Write a design for other software: as a REXS 2 file, a table of its transmission error, a component or a package.

--rexs: with a report of what was mapped, what was not, and what was assumed. A design that came from a REXS file is put
back into it: what the design does not hold stays there as it was. --new writes a file of its own instead. --measured
adds measured deviations of a member (a file as of `grid`, filled in) as lists of points.

--table: error and ratio of the drive over one pitch, all pairs together, both flanks, as polynomials with a proved
bound (.c, .json, .npz) or as samples of them (.csv, .txt for Modelica). Exit status 1 where an edge may touch before
the pair that leads, or no pair touches within its limits: the table leaves edges out. With --torque-nm, the torques
of `loaded`, also the stiffness of the mesh under each over a pitch, as a torsion at the wheel (.json, .npz, .txt).

--fmu: a component for simulations by FMI 2.0 or 3.0 (--fmi), model exchange and co-simulation, with the torques of the
mesh on both shafts; compiled for this machine or for --platforms, by the names that FMI has for them. With --torque-nm
its stiffness starts with that of a pair under this torque, the mean over a pitch, as of `loaded`; without it with 0.

--crate, --npm: a crate of Rust with the drive's C, which needs a C compiler and no other crate; an ES module with
WebAssembly for Node and browsers. Both solve the pair in mesh and the whole drive at any angle, with the native bits.
"""

import sys

from meshwright.base.errors import UsageError
from meshwright.base.files import write_bytes, write_json
from meshwright.commands import options as common
from meshwright.contact.results import ARCSEC
from meshwright.design import design as designs
from meshwright.drive import Drive
from meshwright.export import packages, table_files
from meshwright.export.fmu import fmu
from meshwright.export.stiffness import stiffnesses
from meshwright.export.table import table
from meshwright.rexs.measurements import with_points
from meshwright.rexs.origin import origin_of
from meshwright.rexs.report import lines
from meshwright.rexs.writing import file_of
from meshwright.shop.tables import read_measured

NAME = "export"

#: Of a table, arcseconds.
TOLERANCE = 1e-6


def add_arguments(parser):
    parser.add_argument("design", metavar="DESIGN", help="packaged design or TOML file")
    kind = parser.add_mutually_exclusive_group(required=True)
    kind.add_argument("--rexs", metavar="OUT|-", help="where to write the REXS file")
    kind.add_argument("--table", metavar="FILE", help="where to write the table: .c, .json, .csv, .npz or .txt")
    kind.add_argument("--fmu", metavar="FILE", help="where to write the component of --fmi 2 or 3")
    kind.add_argument("--crate", metavar="DIR", help="new folder for a crate of Rust, which it names")
    kind.add_argument("--npm", metavar="DIR", help="new folder for an npm package, which it names")
    parser.add_argument("--json", metavar="REPORT|-", help="write the report (schema meshwright.rexs/1)")
    parser.add_argument("--new", action="store_true", help="a new file, not that from which the design came")
    parser.add_argument("--measured", metavar="FILE.csv", help="measured deviations to add as lists of points")
    parser.add_argument("--member", choices=("pinion", "wheel"), help="whose they are")
    parser.add_argument(
        "--tolerance-arcsec", type=common.positive, metavar="T", help="of the table's errors; default: 1e-6"
    )
    parser.add_argument(
        "--torque-nm", metavar="T1,T2,…", help="under which --table adds the mesh's stiffness, --fmu takes a pair's"
    )
    parser.add_argument("--coast", metavar="DESIGN", help="the other flank, where that has a design of its own")
    parser.add_argument("--fmi", choices=("2", "3"), help="version of --fmu; default: 3")
    parser.add_argument("--platforms", metavar="P1,P2,…", help="for which --fmu is compiled, such as linux64,win64")
    parser.add_argument("--sources", action="store_true", help="with its C in the archive of --fmu")
    parser.add_argument("--allow-jam", action="store_true", help="write --fmu of a drive without backlash, too")
    parser.add_argument(
        "--set", action="append", default=[], metavar="TABLE.KEY=VALUE", help="change a key of the design; repeatable"
    )


#: Options that each kind of file has beside those of all.
OPTIONS = {
    "rexs": ("json", "new", "measured", "member"), "table": ("tolerance_arcsec", "torque_nm", "coast"),
    "fmu": ("fmi", "platforms", "sources", "allow_jam", "torque_nm", "coast"), "crate": ("coast",), "npm": ("coast",),
}  # fmt: skip


def run(options):
    kind = next(kind for kind in OPTIONS if getattr(options, kind) is not None)
    for name in sorted({name for names in OPTIONS.values() for name in names} - {*OPTIONS[kind]}):
        if getattr(options, name):
            raise UsageError(f"--{name.replace('_', '-')}: --{kind} has no use for it; leave it out")
    if kind == "rexs":
        return _rexs(options)
    changes = dict(common.setting(t) for t in options.set)
    drive = Drive.from_tables(designs.changed(designs.read(options.design), changes))
    coast = drive.other_side if options.coast is None else Drive.load(options.coast)
    return {"table": _table, "fmu": _fmu, "crate": _package, "npm": _package}[kind](options, drive, coast)


def _fmu(options, drive, coast):
    platforms = () if options.platforms is None else tuple(options.platforms.split(","))
    torques = _torques(options)
    if len(torques) > 1:
        raise UsageError(f"--torque-nm {options.torque_nm}: a component has one stiffness; give one torque")
    (stiffness,) = [under.pair for under in stiffnesses(drive, torques)] or [0.0]
    fmu(drive, coast, options.fmu, int(options.fmi or 3), platforms, options.sources, options.allow_jam, stiffness)
    return 0


def _torques(options):
    """Torques, N m, of ``T1,T2,…``; none where the option is not given."""
    if options.torque_nm is None:
        return []
    try:
        torques = [float(word) for word in options.torque_nm.split(",")]
    except ValueError:
        torques = [0.0]
    if any(not torque > 0.0 or common.beyond_arithmetic(torque) for torque in torques):
        raise UsageError(f"--torque-nm {options.torque_nm}: not torques above zero; for example --torque-nm 20,50")
    return torques


def _package(options, drive, coast):
    drive.cycle([0.0], coast)  # what is no other flank is refused
    if options.crate is not None:
        packages.crate(drive, coast, options.crate)
    else:
        packages.npm(drive, coast, options.npm)
    return 0


def _table(options, drive, coast):
    table_files.writer(options.table, bool(options.torque_nm))
    torques = _torques(options)
    found, asked = table(drive, (options.tolerance_arcsec or TOLERANCE) * ARCSEC, coast), options.tolerance_arcsec
    bound = found.bound / ARCSEC
    if asked and bound > asked:
        raise UsageError(f"--tolerance-arcsec {asked:g}: the errors are proved to {bound:.2g} only; give that or more")
    stiffness = stiffnesses(drive, torques) if torques else ()
    write_bytes(options.table, table_files.content(found, options.table, drive.design.label, stiffness))
    pieces = len(found.drive) + len(found.coast)
    print(f"{options.table} written: {pieces} pieces, errors proved to {bound:.2g} arcseconds", file=sys.stderr)
    for flank in found.edges:
        print(f"{flank}: an edge may touch before the pair that leads; `meshwright ratio` has edges", file=sys.stderr)
    for flank in found.open:
        print(f"{flank}: at some angles no pair touches within its limits", file=sys.stderr)
    return 1 if found.edges or found.open else 0


def _rexs(options):
    from importlib.metadata import version

    text = designs.text_of(options.design)
    tables = designs.changed(designs.parsed(text, options.design), dict(common.setting(t) for t in options.set))
    into, stage = (None, None) if options.new else origin_of(text, options.design)
    written = file_of(tables, version("meshwright"), into, stage)
    content, report = written.content, written.report
    if (points := _measured(options)) is not None:
        added = with_points(content, options.member, points, options.rexs, stage)
        content = added.content
        report |= {kind: report[kind] + getattr(added, kind) for kind in ("assumed", "unmapped")}
    write_bytes(options.rexs, content)
    if options.json:
        write_json(options.json, report)
    else:
        print(*lines(report), sep="\n", file=sys.stderr)
    return 0


def _measured(options):
    """The measured points that are to be added, None if none are."""
    if (options.measured is None) != (options.member is None):
        raise UsageError("--measured and --member belong together: whose deviations are they? give both or neither")
    return None if options.measured is None else read_measured(options.measured)
