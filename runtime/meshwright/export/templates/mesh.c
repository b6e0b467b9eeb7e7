/* @said@
 * Made by meshwright.  SPDX-License-Identifier: MIT-0
 *
 * One design; every state is the caller's, m[mesh_length()], and every result a row of plain numbers. */
#include "@drive@.h"
#define X(name) @drive@_##name

/* Factor of angles and errors: -1 where the design is the mirror image of the drive that is solved. */
static const double SIGN = @sign@;
static const double DRIVEN[] = { @driven@ };
static const double COASTING[] = { @coasting@ };
enum { HAS_COAST = @coast@, STATE = 0, LAST = X(NS), CYCLE = X(NS) + X(NX), LENGTH = CYCLE + X(NC) };

size_t mesh_length(void);
int mesh_begin(double *m);
int mesh_follow(double *m, double phi, double *row);
int mesh_cycle(double *m, double phi, double *row);
const char *mesh_status_word(int status);

size_t mesh_length(void)
{
    return LENGTH;
}

/* Before the first call: 0, or 1 + the guard of the design that does not hold. */
int mesh_begin(double *m)
{
    for (int i = 0; i < X(NX); i++) m[LAST + i] = NAN;
    const int guard = X(setup)(DRIVEN, m + STATE);
    return guard ? guard : X(cycle_setup)(DRIVEN, HAS_COAST ? COASTING : NULL, m + CYCLE);
}

/* row[4]: pair, its own angle, transmission error (not a number without a contact), status; returns that. */
int mesh_follow(double *m, double phi, double *row)
{
    mw_info info;
    X(follow)(m + STATE, SIGN * phi, m + LAST, &info);
    row[0] = SIGN * info.pair;
    row[1] = SIGN * info.angle;
    row[2] = SIGN * m[LAST + X(model).error];
    row[3] = (double)info.status;
    return info.status;
}

static void side(const mw_side *from, double *row)
{
    row[0] = SIGN * from->pair;
    row[1] = SIGN * from->error;
    row[2] = from->ratio;
    row[3] = (double)from->status;
    row[4] = (double)from->pairs;
    row[5] = (double)from->edge;
}

/* row[15]: pair, own angle, backlash; then of the driving flank and of the other: leading pair, error, ratio, status, pairs in
 * contact, whether an edge may touch first. Returns the status of the driving flank. */
int mesh_cycle(double *m, double phi, double *row)
{
    mw_cycle at;
    X(cycle)(m + CYCLE, SIGN * phi, &at);
    row[0] = SIGN * at.pair;
    row[1] = SIGN * at.angle;
    row[2] = at.backlash;
    side(&at.drive, row + 3);
    side(&at.coast, row + 9);
    return at.drive.status;
}

const char *mesh_status_word(int status)
{
    return X(status_word)(status);
}

#ifdef __wasm__
static double memory[LENGTH], result[15];

double *mesh_memory(void);
double *mesh_result(void);

double *mesh_memory(void)
{
    return memory;
}

double *mesh_result(void)
{
    return result;
}
#endif
