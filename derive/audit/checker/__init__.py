"""The checkers of what is generated: Python's standard library alone, nothing of the compiler that they judge.

This package stands beside the record, where ``python check.py`` and its like run one of its commands:

check_record.py        the record: hashes, links, bindings, every certificate, the seal (``check.py``)
check_code.py          generated C against calculus
check_description.py   generated C against the descriptions of the drives
check_bounded.py       edges, limits, certified tables, CasADi where it can be imported
check_shipped.py       headers whole: frame, tables, macros, the runtime's text, functions of proofs, constants, sample
check_print.py         descriptions against what their sources print and the laws of enveloping

refusal.py, command.py  what they all end in that do not accept; what the commands have in common

of the record: numbers, enclosure, polynomials (arithmetic); trees, points, notation (expressions and what symbols are
worth); lines, record (objects); certificates, verdicts, seal

of the C: modular (arithmetic modulo a random prime); straight_line (C as text), machine (C run), as_they_stand (what is
no straight line), attempts; calculus, lanes, kernels; shipped (a header's items), frame (what they must be), enclosing
(functions of proofs)

of descriptions: description (expressions and motions), surfaces, drive (description beside C), draws; design, contact;
edges, tables, casadi_functions, any_root

of the print: printed (statements as read), described (a description at random values), statements, laws
"""
