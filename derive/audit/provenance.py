"""Which statements of the record each generated function rests on, as the derivation itself says.

Every step of :mod:`derive` names its statements where it is carried out; they travel with surfaces, motions,
definitions and the operations of the tape. The prove stage refuses one that the record does not hold or has not proved.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TypedDict

from derive.audit.checker.record import root_of
from derive.language.origin import ANGLES, CONTACT, ELIMINATION, SINGULAR, STEP_SIZE, UNIT, joined
from derive.passes.guards import functions, partial_operations
from derive.passes.plan import Schedule


class Provenance(TypedDict):
    """What a generated file says of its origin."""

    root_hash: str
    equations: list[str]
    equations_of: dict[str, list[str]]


@dataclass(frozen=True)
class Proved:
    """What a record proves: its root hash, and of each of its statements whether it is proved."""

    root_hash: str
    statements: Mapping[str, bool]

    @classmethod
    def by(cls, objects: dict[str, dict]) -> Proved:
        """By the objects of a record by their hash, just proved or read from where it was written."""
        verdicts = [item for item in objects.values() if item["object"] == "verdict"]
        return cls(root_of(objects), {verdict["id"]: _holds(objects, verdict) for verdict in verdicts})


def provenance(proved: Proved, plan: Schedule, open_: dict[str, str] | None = None) -> Provenance:
    """Root hash and equation ids of a drive, by function name without the drive's prefix.

    A statement that is not ``proved`` is refused or, where ``open_`` is given, left out and entered there with the
    reason.
    """
    steps = dict(_steps(plan))
    for f in functions(plan):
        operations = (f.tape.origins[i].statement for i in partial_operations(f))
        steps[f.name] = joined(steps.get(f.name, ()), operations)
    missing = dict(_not_proved(proved, {key for keys in steps.values() for key in keys}))
    if missing and open_ is None:
        name, reason = next(iter(missing.items()))
        raise ValueError(f"{plan.drive.name} rests on {name}, which {reason}")
    if open_ is not None:
        open_ |= missing
    held = {name: [key for key in keys if key not in missing] for name, keys in steps.items()}
    return {
        "root_hash": proved.root_hash,
        "equations": sorted({key for keys in held.values() for key in keys}),
        "equations_of": {name: keys for name, keys in held.items() if keys},
    }


def _steps(plan: Schedule) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Function name and the steps behind it, beside those of its single operations."""
    drive = plan.drive
    on_surface = (UNIT.statement, SINGULAR)
    for body in drive.bodies:
        yield f"flank_{body.name}", joined(body.surface.rests_on, on_surface)
        yield f"curvature_flank_{body.name}", joined(body.surface.rests_on, on_surface)
    for region in drive.regions:
        yield f"{region.name}_{region.member}", joined(region.surface.rests_on, on_surface)
        yield f"curvature_{region.name}_{region.member}", joined(region.surface.rests_on, on_surface)
    mesh = joined(*(body.placed.rests_on for body in drive.bodies), (CONTACT, ANGLES))
    yield "eval", mesh
    yield "along", mesh
    yield "step", joined(mesh, (ELIMINATION, STEP_SIZE.statement))
    yield "observe", joined(mesh, on_surface)
    yield from ((function.name, function.rests_on) for function in plan.functions)


def _not_proved(proved: Proved, names: set[str]) -> Iterator[tuple[str, str]]:
    """The statements that the record does not prove, each with what it says of it."""
    for name in sorted(names):
        if name not in proved.statements:
            yield name, "the record does not hold"
        elif not proved.statements[name]:
            yield name, "is not a proved statement of the record"


def _holds(objects: Mapping[str, dict], verdict: dict) -> bool:
    """Proved, or ambiguous with a proved reading (damaged print)."""
    return verdict["status"] in ("proved", "proved_with_correction") or any(
        reading["parts"] and all(_is_proof(objects.get(part["certificate"])) for part in reading["parts"])
        for reading in verdict["readings"]
    )


def _is_proof(certificate: Mapping | None) -> bool:
    return certificate is not None and certificate.get("outcome") == "proved"
