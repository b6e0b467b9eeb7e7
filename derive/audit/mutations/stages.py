"""The stages of generated files that are changed, and what becomes of a change."""

from pathlib import Path

GENERATED = Path(__file__).resolve().parents[3] / "generated"

#: Stage -> what a header's name ends in.
HEADERS = {"scalar C": "", "lanes": "_lanes", "sensitivity": "_sensitivity", "bounded": "_bounded"}
TABLES, CASADI, DESCRIPTION = "tables", "CasADi", "description"
STAGES = (*HEADERS, TABLES, CASADI, DESCRIPTION)

REFUSED, SURVIVED, EQUAL = "refused", "survived", "equal"

#: Seed of the changes that are drawn and of the inputs at which they are compared.
SEED = 18
