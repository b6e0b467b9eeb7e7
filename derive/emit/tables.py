"""Tables of every drive, for the shared library: C sources that list what each generated header offers.

With ``MW_DRIVES`` defined only the drives with ``MW_DRIVE_<name>`` are built in.
"""


def tables(descriptions):
    """Relative path → text of each table; ``descriptions`` are the drives' metadata by name."""
    return {
        "c/models.h": _models(descriptions),
        "c/lane_models.h": _lane_models(descriptions),
        "c/sensitivity_models.h": _sensitivity_models(descriptions),
        "c/casadi_models.h": _casadi_models(descriptions),
    }


def _head(what):
    return f"/* {what} Generated; do not edit.  SPDX-License-Identifier: MIT-0 */\n"


def _chosen(lines):
    """The lines of each drive (name → C text), for drives that are built in."""
    return "".join(
        f"#if !defined(MW_DRIVES) || defined(MW_DRIVE_{name})\n{text}#endif\n" for name, text in lines.items() if text
    )


def _models(descriptions):
    includes = _chosen({name: f'#include "{name}.h"\n' for name in descriptions})
    rows = _chosen({name: f"    &{name}_model,\n" for name in descriptions})
    return (
        _head("Every generated drive, for runtime/c.")
        + f"{includes}\nstatic const mw_model *const mw_models[] = {{\n{rows}    NULL\n}};\n"
    )


def _lane_models(descriptions):
    """For one width: see ``runtime/c/lane_kernels.h``."""
    includes = _chosen({name: f'#include "{name}_lanes.h"\n' for name in descriptions})
    rows = _chosen({name: f"    MW_LANE_MODEL({name}),\n" for name in descriptions})
    return (
        _head("The lane kernels of every drive.")
        + f"{includes}\nstatic const mw_lane_model mw_lane_models[] = {{\n{rows}}};\n"
    )


def _sensitivity_models(descriptions):
    names = {name: [system["name"] for system in d["systems"]] for name, d in descriptions.items()}
    includes = _chosen({name: f'#include "{name}_sensitivity.h"\n' for name in descriptions})
    systems = _chosen({name: _system_tangents(name, own) for name, own in names.items()})
    rows = _chosen({name: _sensitivity_row(name, own) for name, own in names.items()})
    return (
        _head("The sensitivity functions of every drive.")
        + f"{includes}\n{systems}static const mw_tangents mw_tangent_models[] = {{\n{rows}}};\n"
    )


def _system_tangents(name, systems):
    rows = "".join(f"    {{ {name}_{system}_tangent, {name}_{system}_fill_tangent }},\n" for system in systems)
    return f"static const mw_system_tangents {name}_system_tangents[] = {{\n{rows}}};\n" if systems else ""


def _sensitivity_row(name, systems):
    of_systems = f"{name}_system_tangents" if systems else "NULL"
    return f'    {{ "{name}", {name}_derive_tangent, {of_systems}, {name}_tangent }},\n'


def _casadi_models(descriptions):
    """One ``MW_CASADI(drive, np, ns, nx)`` a drive: see ``runtime/c/casadi_entry.c``."""
    shapes = {name: d["shapes"] for name, d in descriptions.items()}
    rows = {name: f"MW_CASADI({name}, {s['p'][0]}, {s['s'][0]}, {s['x'][0]})\n" for name, s in shapes.items()}
    return _head("Every drive for CasADi's external functions.") + _chosen(rows)
