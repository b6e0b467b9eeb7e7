"""Functions that choose, loop or call the solver and compute nothing themselves: their text as it must stand.

X is a drive's name.
"""

from .refusal import require
from .straight_line import body_of

#: Of a drive's header: a design completed, a contact solved and looked at by the solver that is written there.
SOLVED = {
    "solve_design": """
    double work[X_NP + 1];
    mw_info unused;
    mw_info *const record = info ? info : &unused;
    X_derive(p);
    *record = mwi_ended(MW_BAD_INPUT, X_missing(p, 0));
    return record->guard ? 0 : mwi_complete(&X_model, p, work, record);""",
    "solve": """
    double p[X_NP], work[X_NP];
    mw_info unused;
    mw_info *const record = info ? info : &unused;
    for (int k = 0; k < X_NP; k++) p[k] = s[X_NS - X_NP + k];
    return mwi_solve(&X_model, p, phi, s, work, x, record);""",
    "reduce": """
    const double *const p = s + (X_NS - X_NP);
    return mwi_reduce(p[X_TEETH], X_REFERENCE < 0 ? 0.0 : p[X_REFERENCE], phi, pair);""",
    "follow": """
    double p[X_NP], work[X_NP];
    mw_info unused;
    mw_info *const record = info ? info : &unused;
    for (int k = 0; k < X_NP; k++) p[k] = s[X_NS - X_NP + k];
    return mwi_follow(&X_model, p, phi, s, work, x, record);""",
    "cycle_setup": """
    double other[X_NP];
    for (int k = 0; k < X_NP; k++) other[k] = k == X_OTHER_FLANK ? -p[k] : p[k];
    return mwi_cycle_setup(&X_model, p, coast || X_OTHER_FLANK < 0 ? coast : other, c);""",
    "cycle": """
    return mwi_cycle(&X_model, c, phi, out);""",
    "self_test": """
    double s[X_NS], work[X_NP], x[X_NX];
    const int unsound = mwi_unsound();
    return unsound ? unsound : mwi_finds(&X_model, X_sample, X_sample_angle, X_sample_contact, s, work, x);""",
    "geometry": """
    const int kind = mwi_contact_at(&X_model, s, x, o, contact), touch = mwi_touch(&X_model, x, o);
    return touch < 0 ? touch : kind;""",
}
#: Of the header of bounded flanks: those of all equations of edge contact that a system takes.
CHOSEN = {
    "edges_chosen": """
    double all[X_EDGE_EQUATIONS], slopes[X_EDGE_EQUATIONS * X_NX];
    X_edges(s, x, all, J ? slopes : NULL);
    for (int i = 0; i < X_NX; i++) {
        R[i] = all[chosen[i]];
        for (int j = 0; j < X_NX && J; j++) J[i * X_NX + j] = slopes[chosen[i] * X_NX + j];
    }"""
}


def check_as_they_stand(text: str, prefix: str, functions: dict[str, str]) -> None:
    """Each function, comments aside, is what it must be."""
    for name, body in functions.items():
        expected = body.lstrip("\n").replace("X_", f"{prefix}_")
        require(body_of(text, f"{prefix}_{name}") == expected, f"{name}: not the text that it must have")
