"""The compiler: six stages from a drive's page to generated files.

define    ``derive.drives``   → :class:`~derive.language.drive.Drive`: chains, keys, limits, sources, checked
derive    ``derive.passes``   → locus, normal, meshing and contact as equations on one tape (``derive.program``)
reduce    ``derive.passes``   → the equations' linear system solved: one fused Newton step in a fixed order of pivots
schedule  ``derive.passes``   → all that is read from them, with binding times, edges, curvature and guards
prove     ``derive.audit``    → the statements on which each function rests, decided anew (``derive.prove``)
emit      ``derive.emit``     → C99, CasADi, JSON, text, the description as data, of routines in the order of printing

A drive's page reads like the model section of a paper. Where the meshing equation is linear in a variable, the page's
own language has solved it, so that a generated surface is explicit before its equations are derived. The stages after
the first are common to all drives. What differentiates, substitutes, fuses or orders is a pass: printers read plans and
routines that are made, and add nothing to them. Proving goes on beside the other stages and never in their way: what
is false or not decided of today's definitions is open, said, and cited nowhere.
"""

import json
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import TypeAlias, TypeVar

from derive.audit import provenance
from derive.audit.provenance import Decide, Provenance
from derive.emit import bounded, c99, certified, certify, families, lanes, metadata, sensitivity
from derive.language import description
from derive.language.drive import Drive
from derive.language.validate import validate
from derive.language.validate_sample import (
    validate_limits,
    validate_normals,
    validate_place,
    validate_play,
    validate_ratio,
    validate_regions,
)
from derive.pages import Page
from derive.passes import enclosed, guards
from derive.passes.arrange import arrange, side_by_side, unfused
from derive.passes.completion import at_end
from derive.passes.equations import derive
from derive.passes.joints import joints
from derive.passes.other_flank import on_other_flank
from derive.passes.pivot_order import reduce
from derive.passes.plan import Schedule
from derive.passes.sample import observation
from derive.passes.schedule import scheduled
from derive.passes.similar import similar
from derive.passes.tangents import differentiate
from derive.refusals import told
from meshwright.base import worker

T = TypeVar("T")
#: How work is done beside this process, if at all.
Submit: TypeAlias = Callable[[Callable[[], T]], Callable[[], T]]
#: What is told of a stage, by its word, and a drive.
Log: TypeAlias = Callable[[str, str], AbstractContextManager[None]]

ROOT = Path(__file__).resolve().parent.parent


def package():
    """Folder of the Python package that holds the core library."""
    from meshwright.base.drives import SHIPPED

    return SHIPPED


#: In a checkout; the installed package has it among its own files.
RUNTIME = ROOT / "runtime" / "c"
if not RUNTIME.exists():
    RUNTIME = package() / "include"


@dataclass(frozen=True)
class Compiled:
    """A drive's generated files, relative path → text; the statements that are open, with the reason; and what it
    shares with its family (:func:`derive.emit.families.shared`).
    """

    name: str
    files: dict[str, str]
    open: dict[str, str]
    shared: dict[str, object]


def compile_drive(
    page: Page,
    decide: Decide,
    log: Log,
    emitted: Callable[[str, str], None] = lambda path, text: None,
    submit: Submit = worker.at_once,
) -> Compiled:
    """Take one page through the six stages.

    ``decide`` says how statements stand (:func:`derive.audit.standing.standings`). ``emitted`` is called with path
    and text of each file as soon as it is made. ``submit`` (:func:`meshwright.base.worker.submit`) does half
    the work in processes of their own. Raises :class:`~derive.refusals.Refused` for what cannot be compiled, in words.
    """
    name = page.name

    @contextmanager
    def stage(word: str) -> Iterator[None]:
        with log(word, name), told(word, name):
            yield

    def apart(word: str, work: Callable[[], T]) -> Callable[[], T]:
        return submit(partial(_in_words, word, name, work))

    with stage("define"):
        drive = define(page.build)
    with stage("derive"):
        plan = derive(drive)
    with stage("reduce"):
        plan = reduce(plan)
    with stage("schedule"):
        plan = scheduled(plan)
        steps = provenance.cited(plan)
    proof = apart("prove", partial(decide, {key for keys in steps.values() for key in keys}))
    unproved = apart("emit", partial(checked, plan))
    open_: dict[str, str] = {}

    def origin() -> Provenance:
        with stage("prove"):
            found = provenance.provenance(proof(), steps)
        open_.update(found["open"])
        return found

    files: dict[str, str] = {}
    with stage("emit"):
        for made in (lambda: emit(plan, origin), unproved):
            for path, text in made():
                files[path] = text
                emitted(path, text)
    return Compiled(name, files, open_, families.shared([drive]))


def _in_words(stage: str, name: str, work: Callable[[], T]) -> T:
    with told(stage, name):
        return work()


def define(build: Callable[[], Drive]) -> Drive:
    """The drive that a page builds, without contradictions."""
    drive = build()
    validate(drive)
    return drive


def sound(plan: Schedule) -> None:
    """Raise an error unless a drive is the same for all sizes, its normals point out of both bodies and its flanks
    transmit its ratio, both flanks those of a tooth that does not jam, its limits have values and hold at the sample's
    contact, and its regions go on from the flanks.
    """
    observed = observation(plan)
    similar(plan)
    contacts = [(observed, plan.sample)]
    if other := on_other_flank(plan):
        contacts.append((observation(other), other.sample))
    for of_flank, values in contacts:
        validate_normals(plan.drive, of_flank, values)
        validate_ratio(plan.drive, of_flank, values)
    if other:
        validate_play(plan.drive, contacts)
    validate_limits(plan.drive, observed, plan.sample)
    validate_place(plan.drive, observed)
    validate_regions(plan.drive, joints(plan))


def checked(plan):
    """Files of a schedule that rest on no proof: path and text. An error unless it is :func:`sound`."""
    from derive.emit import casadi  # CasADi and NumPy take as long to load as to use

    sound(plan)
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


def emit(plan: Schedule, origin: Callable[[], Provenance]) -> Iterator[tuple[str, str]]:
    """What the other printers make of a schedule, file by file: path and text. ``origin`` says what its statements
    are, and is not asked before that is printed.
    """
    c = f"c/{plan.drive.name}"
    moved = differentiate(plan)
    tangents = [tangent.evaluated() for tangent in moved.tangents()]
    moving = arrange(moved, tangents, often={f.key for f in tangents})
    yield f"{c}_sensitivity.h", sensitivity.header(moved, moving, metadata.GENERATOR)
    routines = arrange(plan, [*guards.functions(plan), *guards.moving(plan)])
    metadata_of = metadata.describe(plan, origin())
    yield f"{c}.h", c99.header(plan, routines, metadata_of, RUNTIME)
    proved = unfused(plan, [f for f in guards.functions(plan) if f.key in certify.FUNCTIONS])
    yield f"{c}_certify.h", certify.header(plan, proved, metadata_of, RUNTIME)
    evaluated = [*guards.functions(moved), *guards.moving(moved), *guards.bounded(moved), *tangents]
    metadata_of["side_conditions"] = guards.side_conditions(moved, evaluated)
    yield f"{c}.json", json.dumps(metadata_of, indent=1, ensure_ascii=False) + "\n"
