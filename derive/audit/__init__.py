"""The audit record: what the sources print, what we derive, what was proved of it, which generated files rest on it.

claims.py        the words in which documents are encoded: scopes of definitions, claims, printed numbers
documents/       the four source documents as printed; identities/ what we claim of our own derivations
described.py     the derived side of both, read from the description of a drive
coverage.py      what the documents display, counted from their texts, beside the entries that judge it
ledger.py        every claim judged by the prover, every object hashed and linked, one root over all
provenance.py    which equations each generated function rests on
record.py        the whole record, and the files it is written to; store.py pages.py drive_pages.py render.py
                 validation.py their text
check.py         re-checks the record, check_code.py the generated C against calculus, check_description.py the C
                 against the descriptions of the drives, check_bounded.py edges, limits and CasADi, check_print.py the
                 descriptions against what their sources print (printed.txt) and the laws of enveloping; each runs
                 alone, all ship beside the record
kernel/          every proof as a theorem that Coq accepts
explain.py       from a C function or an equation back to the sources
"""
