/* Numbers with an error bound.  SPDX-License-Identifier: MIT-0 */
#ifndef MW_ENCLOSURES_H
#define MW_ENCLOSURES_H

/* BEGIN INTERFACE (the Python package reads from here to END INTERFACE) */

/* Every number within radius of mid; with an infinite radius, any; not a number: undefined. */
typedef struct mw_ball {
    double mid, radius;
} mw_ball;

/* Every number within radius of hi + lo. */
typedef struct mw_wide {
    double hi, lo, radius;
} mw_wide;

/* Every function of t within radius of c[0] + c[1] t + ... + c[MW_ORDER] t^MW_ORDER for -1 <= t <= 1. */
enum { MW_ORDER = 8 };

typedef struct mw_polynomial {
    double c[9];
    double radius;
} mw_polynomial;

/* END INTERFACE */
#endif
