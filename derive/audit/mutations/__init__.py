"""What the checkers of generated files notice: one change of a generated file at a time, counted by stage and function.

``python -m derive.audit.mutations [DRIVE…] [--each N] [--sample M] [--log FILE] [--write]`` changes each function of
every drive ``N`` times (scalar C, lanes, sensitivities, bounded flanks, certified tables, CasADi, description), or
``M`` of these a drive, and prints a table.
With a log, what stands in it is not run again, and the table is that of the whole log; ``--write`` keeps it in
``measured.json`` of this folder, from where the page of validation takes it. A changed function is put before those
checks alone that may read it; hashes are left out. A change that is not noticed counts as equal where the function,
evaluated at random inputs, returns what it returned.

``of_c``, ``of_descriptions`` and ``of_casadi`` make changes, ``checks`` are what may notice them, ``equality`` tells
those that change nothing, ``measure`` judges them all and ``table`` adds them up.
"""
