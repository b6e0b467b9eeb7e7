"""List what CasADi's ``external`` interface needs to know of every drive."""


def table(plans):
    """C source with one ``MW_CASADI(drive, np, ns, nx)`` a drive; ``plans`` are (name, shapes) of the metadata."""
    rows = "".join(f"MW_CASADI({name}, {s['p'][0]}, {s['s'][0]}, {s['x'][0]})\n" for name, s in plans)
    return (
        "/* Every drive for CasADi's external functions. Generated; do not edit.  SPDX-License-Identifier: MIT-0 */\n"
        + rows
    )
