/* A design completed in balls: its rules, its systems of equations, what the contact problem reads of it. See mw_certify.h.
 * SPDX-License-Identifier: MIT-0 */
#include "certify/problem.h"
#include "solver/complete.h"

int mw_encloses(const mw_model *m)
{
    return mwc_tables_of(m) && mwc_arithmetic();
}

int mw_enclosed_slots(const mw_model *m)
{
    return mwc_tables_of(m) ? mwc_tables_of(m)->slots : 0;
}

static void apply_rules(const mw_certified *t, mw_wide *p)
{
    mw_wide registers[MWC_REGISTERS];
    for (const mw_certified_rule *rule = t->rules; rule->target >= 0; rule++) {
        mw_wide *target = p + rule->target;
        const mw_code *value = &rule->value;
        if (target->hi == target->hi || value->registers > MWC_REGISTERS) continue;
        mwc_run_wide(value, value->instructions, p, registers);
        *target = registers[value->output[0]];
        for (int i = 1; i < value->outputs; i++)
            if (!(mwc_wide_least(registers[value->output[i]]) > 0.0)) target->hi = NAN;
    }
}

/* proof: unless NULL, what shows its solution. */
static int system_solved(const mw_model *m, int k, mw_wide *p, double *q, mw_proof *proof)
{
    const mw_system *system = &m->systems[k];
    const mw_certified_system *t = &mwc_tables_of(m)->systems[k];
    const int np = m->np, n = system->n;
    double y[MW_MAX_UNKNOWNS] = { 0.0 };
    mw_wide arguments[MWC_ARGUMENTS], registers[MWC_REGISTERS];
    mwc_problem equations;
    mwc_solution found;
    mw_info info;
    if (!mwc_fits(&t->equations, np + 1 + n) || !mwc_fits(&t->values, np + 1 + n)) return 0;
    for (int i = 0; i < np; i++) q[i] = p[i].hi;
    if (mwi_solve_system(m, system, q, y, &info) < 0) return 0;
    system->scale(q, equations.sizes);
    memcpy(arguments, p, sizeof(mw_wide) * (size_t)np);
    arguments[np] = mwc_wide_of(1.0);
    equations.equations = &t->equations;
    equations.n = n;
    mwc_known(&equations, arguments, np + 1);
    for (int i = 0; i < n; i++) found.x[i] = mwc_wide_of(y[i]);
    if (mwc_enclose(&equations, &found) != MW_REASON_NONE) return 0;
    if (proof && mwc_shown(&equations, &found, proof) != MW_REASON_NONE) return 0;
    for (int i = 0; i < n; i++) {
        arguments[np + 1 + i] = found.x[i];
        arguments[np + 1 + i].radius = found.within[i];
    }
    mwc_run_wide(&t->values, t->values.instructions, arguments, registers);
    for (int i = 0; t->fills[i] >= 0; i++)
        if (p[t->fills[i]].hi != p[t->fills[i]].hi) p[t->fills[i]] = registers[t->values.output[i]];
    return 1;
}

int mw_prove_design(const mw_model *m, mw_wide *p, double *q, mw_proof *systems)
{
    const mw_certified *t = mwc_tables_of(m);
    double open[MW_MAX_PARAMETERS];
    if (!mw_encloses(m) || m->np + 1 > MWC_ARGUMENTS || m->np > MW_MAX_PARAMETERS) return 1 + m->nsystems;
    for (int i = 0; i < m->np; i++) {
        const int zero = p[i].hi == 0.0 && p[i].radius == 0.0; /* in any unit */
        if (p[i].hi == p[i].hi && !zero) p[i] = mwc_wide_mul(mwc_bounded(p[i]), t->factors[i]);
    }
    apply_rules(t, p);
    for (int k = 0; k < m->nsystems; k++) {
        if (systems) memset(systems + k, 0, sizeof *systems);
        for (int i = 0; i < m->np; i++) open[i] = p[i].hi;
        if (m->systems[k].open(open) == 0) continue;
        if (!system_solved(m, k, p, q, systems ? systems + k : NULL)) return 1 + k;
        apply_rules(t, p);
    }
    return 0;
}

int mw_enclose_design(const mw_model *m, mw_wide *p, double *q)
{
    return mw_prove_design(m, p, q, NULL);
}

void mw_enclose_setup(const mw_model *m, const mw_wide *p, mw_wide *s)
{
    const mw_certified *t = mwc_tables_of(m);
    mw_wide registers[MWC_REGISTERS];
    const int possible = mw_encloses(m) && mwc_fits(&t->setup, m->np) && mwc_fits(&t->observed, t->slots + m->nx)
                         && mwc_fits(&t->equations, t->slots + m->nx) && mwc_fits(&t->instant, t->slots + 1);
    if (possible) mwc_run_wide(&t->setup, t->setup.instructions, p, registers);
    for (int i = 0; i < mw_enclosed_slots(m); i++)
        s[i] = possible && i < t->design_slots ? registers[t->setup.output[i]] : mwc_wide(NAN, 0.0, 0.0);
}
