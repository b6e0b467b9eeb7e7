"""Write a set of certified contacts that other programs can be tested against: designs, tables, a manifest.

A folder of design files, one table of all contacts as CSV and JSON, and an RO-Crate manifest. Every packaged design is
a case, aligned and with each of its misalignments: a design file and the keys that the case changes. Each case is
enclosed at decimal angles over one pitch, and beside points where branches of contact cross. ``benchmark_cases.toml``
names further ones: angles of published tables, contact that is nearly a line, flanks that touch on an edge first. Exit
status 1 if a contact that floating point finds cannot be certified.
"""

import hashlib
import tomllib
from fractions import Fraction
from pathlib import Path

import numpy as np

from meshwright.base.files import write_csv, write_json, write_text
from meshwright.commands.progress import progress
from meshwright.contact import exact
from meshwright.contact.certificate import degrees_of
from meshwright.design.design import packaged_names, toml_text
from meshwright.drive import Drive

#: Shares of a pitch at which a case is enclosed, and decimals of its angles in degrees.
SHARES, DECIMALS = (-0.4, -0.2, 0.0, 0.2, 0.4), 4

#: Misalignment of a case in the unit of its key, mm or degrees, and how far beside a crossing it is enclosed, degrees.
MISALIGNED, BESIDE = 0.02, Fraction("0.01")

#: When this set was first made, which a manifest must say.
DATE = "2026-11-23"

#: Further cases, of which the file says what they are for.
FURTHER = Path(__file__).with_name("benchmark_cases.toml")


def add_arguments(parser):
    parser.add_argument("folder", metavar="FOLDER", help="folder to write")
    parser.add_argument("--design", action="append", default=[], help="packaged design; repeatable; default: all")


def run(options):
    folder, cases = Path(options.folder), []
    names, more = options.design or packaged_names(), tomllib.loads(FURTHER.read_text(encoding="utf-8"))["case"]
    (folder / "designs").mkdir(parents=True, exist_ok=True)
    with progress(len(names)) as step:
        for name in names:
            step(f"certifying {name}")
            drive = Drive.load(name)
            write_text(str(folder / "designs" / f"{name}.toml"), toml_text(drive.design.given()))
            cases += [case(words, name, drive, changes) for words, changes in variants(name, drive)]
            cases += [further(name, drive, entry) for entry in more if entry["from"] == name]
    header = list(dict.fromkeys(key for c in cases for p in c["points"] for key in row(c, p)))
    rows = [row(c, p) for c in cases for p in c["points"]]
    write_json(str(folder / "contacts.json"), {"schema": "meshwright.benchmark/2", "cases": cases})
    write_csv(str(folder / "contacts.csv"), header, [[r.get(key, "") for key in header] for r in rows])
    write_json(str(folder / "ro-crate-metadata.json"), manifest(folder, cases))
    shown = sum(p["outcome"] == "unique" for c in cases for p in c["points"])
    write_text("-", f"{len(cases)} cases, {shown} of {len(rows)} contacts certified, in {folder}\n")
    return 0 if all(p["outcome"] == "unique" or p["reason"] != "wide" for c in cases for p in c["points"]) else 1


def variants(name, drive):
    """Name and changes of a packaged design and of each of its misalignments."""
    yield name, {}
    for p in drive.design.description["parameters"]:
        if p["table"] == "misalignment" and p["key"].endswith(("_mm", "_deg")):
            yield f"{name}--{p['key']}", {"misalignment": {p["key"]: MISALIGNED}}


def degrees(drive):
    """The angles of a case, fractions of degrees."""
    middle, pitch = (np.degrees(a) for a in (drive.design.mirror.sign * drive.design.reference_angle, drive.pitch()))
    angles = {Fraction(f"{middle + share * pitch:.{DECIMALS}f}") for share in SHARES}
    for point in drive.limits().branch_points:
        at = Fraction(f"{np.degrees(point.angle):.{DECIMALS}f}")
        angles |= {at - BESIDE, at + BESIDE}
    return sorted(angles)


def further(name, drive, entry):
    """One case of the file of further ones, of the packaged design ``name``."""
    changes = {table: entry[table] for table in ("design", "misalignment", "blank") if table in entry}
    about, first = entry["about"], entry.get("first_contact", False)
    return case(entry["name"], name, drive, changes, degrees_of(entry["angles"]), about, first)


def case(words, name, drive, changes, angles=None, about=None, first_contact=False):
    """One case as plain data: ``drive``, of the design file ``name``, with ``changes``, table → key → value.

    ``angles``: exact degrees; by default those of :func:`degrees`.
    """
    drive = drive.with_(**changes)
    angles = degrees(drive) if angles is None else angles
    result = drive.tca(np.radians([float(a) for a in angles]))
    found = drive.certify(result.angles, result, angles)
    points = [_point(found, k, angle, found.error_arcsec()[k]) for k, angle in enumerate(angles)]
    if first_contact:
        firsts, proofs = drive.first_contact(result.angles, result), drive.certify_first(result.angles, result, found)
        entries = zip(points, firsts.plain(result.error), proofs.to_plain(result), strict=True)
        for point, first, proof in entries:
            point["first_contact"] = first
            point["tangency_comes_first"] = proof["outcome"]
    return {"name": words, "about": about, "design": f"designs/{name}.toml", "changes": changes, "points": points}


def _point(found, k, angle, error):
    plain, curvature = found.to_plain()[k], found.records["curvature"][k]
    shown = plain["outcome"] == "unique"
    ends = [exact.bounds(ball) for ball in curvature] if shown else []
    return {
        "pinion_angle_deg": str(float(angle)),
        "outcome": plain["outcome"],
        "reason": plain["reason"],
        "transmission_error_arcsec": [float(error[0]), float(error[1])] if shown else None,
        "contact_point_mm": plain["contact_point_mm"],
        "contact_point_radius_mm": plain["contact_point_radius_mm"],
        "relative_curvature_per_mm": [[exact.downwards(low), exact.upwards(high)] for low, high in ends] or None,
        "flags": [name for name, word in plain["flags"].items() if word == "yes"],
        "undecided": [name for name, word in plain["flags"].items() if word == "undecided"],
    }


def row(named, point):
    """A point as a flat row of the table."""
    flat = {"case": named["name"]}
    for key, value in point.items():
        if key in ("flags", "undecided"):
            flat[key] = " ".join(value)
        elif key == "relative_curvature_per_mm":
            for which, pair in zip(("min", "max"), value or (("", ""), ("", "")), strict=True):
                name = f"relative_curvature_{which}_per_mm"
                flat |= {f"{name}_low": pair[0], f"{name}_high": pair[1]}
        elif key == "transmission_error_arcsec":
            flat |= dict(zip((f"{key}_low", f"{key}_high"), value or ("", ""), strict=True))
        elif key == "first_contact":
            flat |= {f"first_contact_{part}": value[part] for part in ("kind", "member")}
            flat["first_contact_transmission_error_arcsec"] = value["transmission_error_arcsec"]
        elif key == "contact_point_mm":
            flat |= dict(zip((f"{key}_{axis}" for axis in "xyz"), value or ("", "", ""), strict=True))
        else:
            flat[key] = "" if value is None else value
    return flat


def manifest(folder, cases):
    """The RO-Crate 1.1 manifest of what was written."""
    kinds = {".toml": "application/toml", ".json": "application/json", ".csv": "text/csv"}
    names = dict.fromkeys(("contacts.json", "contacts.csv", *(c["design"] for c in cases)))
    files = [_file(folder / name, name, kinds) for name in names]
    root = {
        "@id": "./", "@type": "Dataset", "name": "Certified contacts of gear drives", "datePublished": DATE,
        "description": "Transmission error, contact point and relative curvatures of gear drives at decimal pinion "
        "angles, each between proved bounds, for testing programs of tooth contact analysis. Angles in degrees, "
        "lengths in millimetres, fixed frame of the drive; a point is within its radius in each coordinate.",
        "license": {"@id": "https://spdx.org/licenses/MIT-0"}, "hasPart": [{"@id": f["@id"]} for f in files],
    }  # fmt: skip
    about = {
        "@id": "ro-crate-metadata.json", "@type": "CreativeWork", "about": {"@id": "./"},
        "conformsTo": {"@id": "https://w3id.org/ro/crate/1.1"},
    }  # fmt: skip
    return {"@context": "https://w3id.org/ro/crate/1.1/context", "@graph": [about, root, *files]}


def _file(path, name, kinds):
    content = path.read_bytes()
    return {
        "@id": name, "@type": "File", "encodingFormat": kinds[path.suffix], "contentSize": str(len(content)),
        "sha256": hashlib.sha256(content).hexdigest(),
    }  # fmt: skip
