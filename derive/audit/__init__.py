"""The audit record: what the sources print, what we derive, what was proved of it, which generated files rest on it.

claims.py        the words in which documents are encoded: scopes of definitions, claims, printed numbers;
                 paragraphs.py reads them from text
documents/       the four source documents as printed; identities/ what we claim of our own derivations
described.py     the derived side of both, read from the description of a drive
coverage.py      what the documents display, beside the entries that judge it; displayed.py counts it from their texts
ledger.py        every claim judged by the prover, every object hashed and linked, one root over all
provenance.py    which equations each generated function rests on
record.py        the whole record, and the files it is written to; store.py pages.py drive_pages.py render.py
                 validation.py their text
checker/         re-checks the record, the generated C against calculus and against the descriptions of the drives,
                 edges, limits and CasADi, and the descriptions against what their sources print (printed.txt) and the
                 laws of enveloping; imports nothing else of the compiler, ships beside the record with its commands
                 check.py, check_code.py, check_description.py, check_bounded.py, check_shipped.py and check_print.py;
                 check_contact.py verifies proofs of contacts that the runtime writes
kernel/          every proof as a theorem that Coq accepts
explain.py       from a C function or an equation back to the sources
"""
