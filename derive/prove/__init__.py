"""Exact decisions about identities between expression trees.

tree.py          the closed grammar and its compact notation
collect.py       sums and products collected; a description's expressions in the closed grammar
statement.py     lhs = rhs with the definitions of its names
polynomial.py fraction.py evaluate.py normal_form.py       the ring, and trees as elements of it
points.py        rational points for refutations and worked numbers
prover.py        proved, refuted, undecided
certificate.py   the evidence as canonical JSON
edits.py         one-token changes: corrections of a print, mutations of a derivation
"""

from derive.prove.certificate import certificate
from derive.prove.prover import Decision, Outcome, decide
from derive.prove.statement import Statement

__all__ = ["Decision", "Outcome", "Statement", "certificate", "decide"]
