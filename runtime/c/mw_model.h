/* The model table: what runtime/c needs to know of a drive. Each generated header repeats this block under the
 * same guard, so that it can be used alone.  SPDX-License-Identifier: MIT-0 */
#ifndef MW_MODEL_ABI
#define MW_MODEL_ABI 7

/* A named number. unit is the one used inside ("mm", "rad", ...); key is the design file's key ("" if none), factor
 * turns the key's unit into the inner unit, table is the design file's table. The number lies between lower and
 * upper (inner unit; +-HUGE_VAL where there is no bound). */
typedef struct mw_name {
    const char *name, *unit, *meaning, *key, *table;
    double factor, lower, upper;
} mw_name;

/* A surface: q[parameters] -> point, unit outward normal, tangents (3 each), regular, margins, conditions with slopes. */
typedef void (*mw_surface)(const double *s, const double *q, double *o);

/* A member. In the observation o of a solution: its point, body frame, at o[point]; at o[at], for each surface
 * parameter, d(point)/d(parameter), fixed frame; then the slopes of each implicit condition; o[regular] < 0 beyond a
 * singular line; its margins, negative outside, NaN where the design sets no limit, at o[margin]. curvature() writes an
 * orthonormal tangent basis (6), the second fundamental form in it (11, 12, 22) and the two principal curvatures. */
typedef struct mw_body {
    const char *name;
    int parameters, conditions;
    int point, at, regular, margin, margins;
    const int *unknowns;         /* which unknowns are the surface parameters */
    const char *const *flags;    /* flag of each margin */
    const char *const *events;   /* event of each margin */
    int outputs;                 /* length of what flank() writes */
    mw_surface flank, curvature;
} mw_body;

/* Equations solved once per design: their solution y[n] fills in open parameters. q[np + 1] are the parameters followed
 * by the share of a path, 0 to 1, along which the solution is followed from the guess. */
typedef struct mw_system {
    const char *name;
    int n;
    void (*guess)(const double *q, double *y);
    void (*scale)(const double *q, double *y);                  /* natural size of each unknown */
    void (*eval)(const double *q, const double *y, double *R, double *J);
    double (*watch)(const double *q, const double *y);          /* must stay positive along the path; or NULL */
    int (*open)(const double *p);                               /* number of parameters it would fill in */
    void (*fill)(const double *y, double *q);
} mw_system;

/* A surface of a member beside its flank, or a surface from which the design was derived. */
typedef struct mw_region {
    const char *member, *name;
    int parameters, conditions, outputs;
    mw_surface flank, curvature;
} mw_region;

/* A function that a drive offers beside its contact: o[outputs] at q[arguments] for the design in s. */
typedef struct mw_function {
    const char *name;
    int arguments, outputs;
    mw_surface evaluate;
} mw_function;

/* A drive. p[np] parameters (NaN: open), s[ns] state, x[nx] unknowns, R[nx], J[nx*nx] row-major dR/dx,
 * o[no] observation, d[nd] derived sizes, y[nstart] unknowns of the start system. */
typedef struct mw_model {
    int abi;
    const char *drive, *family, *title, *hash;
    int nx, np, ns, no, nd, nstart, nguards;
    int error;                   /* index of the transmission error among the unknowns */
    int wheel_angle;             /* index of the wheel angle in the observation */
    int reference;               /* index in p of the reference angle, where the start values lead; -1: angle 0 */
    int teeth;                   /* index in p of the number of the pinion's teeth or threads */
    int memory;                  /* index in s from which X_follow keeps what it knows of the pair; -1: nowhere */
    int geometry;                /* in the observation: an orthonormal basis of the tangent plane (6), fixed frame; in it
                                    second fundamental forms (11, 12, 22) of pinion and wheel along their own outward
                                    normals and of the gap along the pinion's; the gap's principal curvatures, the smaller
                                    first; lever arms of pinion and wheel; their quotient, the instantaneous ratio */
    const mw_name *unknowns, *parameters, *sizes, *outputs;
    int noutputs;
    const int *output_sizes;     /* how many numbers each named output of the observation has */
    const char *const *guards;
    const mw_body *bodies;       /* pinion, wheel */
    void (*derive)(double *p);                                  /* fill in defaults and derived values */
    void (*size)(const double *p, double *d);
    int (*setup)(const double *p, double *s);                   /* 0, or 1 + index of the guard that fails; beyond: of what is missing */
    void (*set_phi)(double *s, double phi);
    void (*eval)(const double *s, const double *x, double *R, double *J);
    double (*step)(const double *s, double *x);                 /* one Newton step; sum of |change|/scale */
    /* The residual once more, for points close together: anchor() writes at[nanchor] of one; by_anchor() gives R at another
     * by that and returns how far it is away: where no more than `nearest`, R is as exact as of eval(). s: set up, any angle.
     * NULL where a table has neither. */
    int nanchor;
    double nearest;
    void (*anchor)(const double *s, double phi, const double *x, double *at);
    double (*by_anchor)(const double *s, const double *at, double phi, const double *x, double *R);
    /* first and, unless d2 is NULL, second derivative of R along v[nx + 1], a direction of (x, phi); s: set up, any angle */
    void (*along)(const double *s, double phi, const double *x, const double *v, double *d1, double *d2);
    void (*guess)(const double *s, double *y);
    void (*start_scale)(const double *s, double *y);            /* natural size of the start system's unknowns */
    void (*start_eval)(const double *s, const double *y, double *R, double *J);
    void (*start_solution)(const double *s, const double *y, double *x);
    void (*observe)(const double *s, const double *x, double *o);
    void (*scale)(const double *s, double *x);                  /* natural size of each unknown */
    int nsystems;
    const mw_system *systems;    /* in the order in which they are solved, derive() before and after each */
    int nregions;
    const mw_region *regions;
    int nfunctions;
    const mw_function *functions;
    const struct mw_kernels *kernels; /* lane kernels and tangents: of a drive's object; NULL in the header alone */
} mw_model;

#endif
