"""Which component of a file is which of a family: found along the family's relations, from the stage."""

from meshwright.design import description as metadata
from meshwright.rexs.document import RexsError


def exchanges():
    """Exchange data by family, of the families that REXS has."""
    return {name: family.exchange for name, family in metadata.families().items() if family.exchange}


def stage_of(document, wanted=None):
    """(family, stage component) of a file; ``wanted`` is the id of one of several."""
    stages = {table["components"][0]["type"]: name for name, table in exchanges().items()}
    found = [c for c in document.components.values() if c.type in stages]
    if wanted is not None:
        if (chosen := document.components.get(wanted)) is None or chosen not in found:
            ids = ", ".join(str(c) for c in found) or "none"
            raise RexsError(f"{document.place}, component {wanted}", "no stage of a known kind", f"known here: {ids}")
        found = [chosen]
    if not found:
        others = ", ".join(str(c) for c in document.components.values() if c.type.endswith("_stage")) or "no stage"
        reason = f"there is no {' or '.join(stages)}: it has {others}"
        raise RexsError(document.place, reason, "name a file with one of these stages")
    if len(found) > 1:
        ids = ", ".join(map(str, found))
        raise RexsError(document.place, f"several stages: {ids}", "choose one by --stage ID")
    return stages[found[0].type], found[0]


def bound(document, table, stage):
    """Components of the file by the family's names for them."""
    kinds = {c["name"]: c["type"] for c in table["components"]}
    found = {table["components"][0]["name"]: stage}
    for relation in table["relations"]:
        match = next((m for r in document.relations if (m := _matched(relation, r, found, kinds))), None)
        if match is None and relation["required"]:
            raise _missing(document, relation, found, kinds)
        found |= match or {}
    return found


def _matched(relation, candidate, found, kinds):
    """The components of a relation of the file by their names, None if it is another relation."""
    if candidate.type != relation["type"]:
        return None
    match = {}
    for role, name in relation["refs"]:
        component = candidate.refs.get(role)
        if component is None or component.type != kinds[name] or found.get(name, component) is not component:
            return None
        match[name] = component
    return match


def _missing(document, relation, found, kinds):
    """Why a required relation is not in the file."""
    role, name = relation["refs"][0]
    near = [r for r in document.relations if r.type == relation["type"] and r.refs.get(role) is found[name]]
    wanted = ", ".join(f"{role} {kinds[name]}" for role, name in relation["refs"])
    place = f"{document.place}, {found[name]}"
    if not near:
        return RexsError(place, f"it has no relation {relation['type']}", f"add one with {wanted}")
    has = ", ".join(f"{role} {component}" for role, component in near[0].refs.items())
    return RexsError(
        f"{place}, relation {near[0].id} ({relation['type']})", f"has {has}", f"it must have {wanted}"
    )
