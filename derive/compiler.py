"""The compiler: six stages from a drive's page to generated files.

define    ``derive.drives``   → :class:`~derive.language.drive.Drive`: chains, keys, limits, sources, checked
derive    ``derive.passes``   → locus, normal, meshing and contact as equations on one tape (``derive.program``)
reduce    ``derive.passes``   → the equations' linear system solved: one fused Newton step in a fixed order of pivots
schedule  ``derive.passes``   → all that is read from them, with binding times, edges, curvature and guards
prove     ``derive.audit``    → the statements of the record on which each function rests (``derive.prove``)
emit      ``derive.emit``     → C99, CasADi, JSON, text, the description as data, of routines in the order of printing

A drive's page reads like the model section of a paper. Where the meshing equation is linear in a variable, the page's
own language has solved it, so that a generated surface is explicit before its equations are derived. The stages after
the first are common to all drives. What differentiates, substitutes, fuses or orders is a pass: printers read plans and
routines that are made, and add nothing to them. Statements are proved once for all drives; which ones a drive rests on
is looked up when its operations are known.
"""

import json
from dataclasses import replace
from functools import partial
from pathlib import Path

from derive.audit.provenance import provenance
from derive.emit import bounded, c99, certified, certify, lanes, metadata, sensitivity
from derive.language import description
from derive.language.validate import validate
from derive.language.validate_sample import (
    validate_limits,
    validate_normals,
    validate_place,
    validate_ratio,
    validate_regions,
)
from derive.passes import enclosed, guards
from derive.passes.arrange import arrange, side_by_side, unfused
from derive.passes.completion import at_end
from derive.passes.equations import derive
from derive.passes.joints import joints
from derive.passes.pivot_order import reduce
from derive.passes.sample import observation
from derive.passes.schedule import scheduled
from derive.passes.tangents import differentiate

ROOT = Path(__file__).resolve().parent.parent


def package():
    """Folder of the Python package that holds the core library."""
    from meshwright.base.drives import SHIPPED

    return SHIPPED


#: In a checkout; the installed package has both among its own files.
RECORD, RUNTIME = ROOT / "generated" / "audit", ROOT / "runtime" / "c"
if not RUNTIME.exists():
    RECORD, RUNTIME = ROOT / "derive" / "record", package() / "include"


def compile_drive(page, name, proved, log, open_=None, emitted=None, begun=lambda work: work):
    """All generated files of the drive ``name`` that the function ``page`` builds: relative path → text.

    The function ``proved`` returns what the audit record proves (:class:`~derive.audit.provenance.Proved`). A statement
    that it does not prove is an error or, where the mapping ``open_`` is given, entered there with the reason.
    ``emitted`` is called with path and text of each file as soon as it is made. ``begun`` (:func:`derive.beside.begun`)
    does half the work in a process of its own. Raises :class:`~derive.language.validate.DescriptionError` for a drive
    whose page contradicts itself.
    """
    with log("define", name):
        drive = define(page)
    with log("derive", name):
        plan = derive(drive)
    with log("reduce", name):
        plan = reduce(plan)
    with log("schedule", name):
        plan = scheduled(plan)
    apart = begun(partial(checked, plan))
    with log("prove", name):
        origin = provenance(proved(), plan, open_)
    files = {}
    with log("emit", name):
        for made in (lambda: emit(plan, origin), apart):
            for path, text in made():
                files[path] = text
                if emitted:
                    emitted(path, text)
    return files


def define(page):
    """The drive that a page builds, without contradictions."""
    drive = page()
    validate(drive)
    return drive


def checked(plan):
    """Files of a schedule that rest on no proof: path and text. An error unless its normals point out of both bodies,
    its flanks transmit its ratio, its limits have values and hold at the sample's contact, and its regions go on from
    the flanks.
    """
    from derive.emit import casadi  # CasADi and NumPy take as long to load as to use

    observed = observation(plan)
    validate_normals(plan.drive, observed, plan.sample)
    validate_ratio(plan.drive, observed, plan.sample)
    validate_limits(plan.drive, observed, plan.sample)
    validate_place(plan.drive, observed)
    validate_regions(plan.drive, joints(plan))
    c, functions = f"c/{plan.drive.name}", [f for f in guards.functions(plan) if f.key in lanes.KERNELS]
    kernels = arrange(plan, functions, often=lanes.KERNELS)
    ended = replace(plan, systems=tuple(map(at_end, plan.systems)))
    return [
        (f"descriptions/{plan.drive.name}.json", description.text(plan.drive)),
        (f"{c}_lanes.h", lanes.header(plan, kernels, side_by_side(plan), metadata.GENERATOR)),
        (f"{c}_bounded.h", bounded.header(plan, arrange(plan, guards.bounded(plan)), metadata.GENERATOR)),
        *((f"casadi/{name}.casadi", text) for name, text in casadi.texts(plan).items()),
        (f"{c}_certified.h", certified.header(ended, unfused(ended, enclosed.functions(ended)), metadata.GENERATOR)),
    ]


def emit(plan, origin):
    """What the other printers make of a schedule, file by file: path and text; what others include comes first."""
    drive, metadata_of = plan.drive, metadata.describe(plan, origin)
    c = f"c/{drive.name}"
    routines = arrange(plan, [*guards.functions(plan), *guards.moving(plan)])
    yield f"{c}.h", c99.header(plan, routines, metadata_of, RUNTIME)
    moved = differentiate(plan)
    tangents = [tangent.evaluated() for tangent in moved.tangents()]
    moving = arrange(moved, tangents, often={f.key for f in tangents})
    yield f"{c}_sensitivity.h", sensitivity.header(moved, moving, metadata.GENERATOR)
    proved = unfused(plan, [f for f in guards.functions(plan) if f.key in certify.FUNCTIONS])
    yield f"{c}_certify.h", certify.header(plan, proved, metadata_of, RUNTIME)
    evaluated = [*guards.functions(moved), *guards.moving(moved), *guards.bounded(moved), *tangents]
    metadata_of["side_conditions"] = guards.side_conditions(moved, evaluated)
    yield f"{c}.json", json.dumps(metadata_of, indent=1, ensure_ascii=False) + "\n"
