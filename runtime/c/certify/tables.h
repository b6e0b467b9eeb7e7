/* Functions of a drive in doubles (MWC_BALLS), in double-double (MWC_WIDES), along paths (MWC_PATHS) or over flanks
 * (MWC_SHEETS).  SPDX-License-Identifier: MIT-0 */
#ifndef MWC_TABLES_H
#define MWC_TABLES_H

#include "../mw_certified.h"
#include "wide.h"

/* Most registers of a function and most numbers that it reads. */
enum { MWC_REGISTERS = 640, MWC_ARGUMENTS = 512 };

#ifdef MWC_BALLS
#define MWC_RUN mwc_run_ball
#define MWC_NUMBER mw_ball
#define MWC_DO(operation) mwc_##operation
#define MWC_CONSTANT(c) mwc_of_wide(c)
#include "run.h"
#endif

#ifdef MWC_WIDES
#define MWC_RUN mwc_run_wide
#define MWC_NUMBER mw_wide
#define MWC_DO(operation) mwc_wide_##operation
#define MWC_CONSTANT(c) (c)
#include "run.h"
#endif

#ifdef MWC_PATHS
#include "polynomial.h"
#define MWC_RUN mwc_run_polynomial
#define MWC_NUMBER mw_polynomial
#define MWC_DO(operation) mwc_poly_##operation
#define MWC_CONSTANT(c) mwc_poly_of_wide(c)
#define MWC_CHOICE mwc_sides
#include "run.h"
#endif

#ifdef MWC_SHEETS
#include "sheet.h"
#define MWC_RUN mwc_run_sheet
#define MWC_NUMBER mwc_sheet
#define MWC_DO(operation) mwc_sheet_##operation
#define MWC_CONSTANT(c) mwc_sheet_of_wide(c)
#define MWC_TO(operation, r, a, b) mwc_sheet_to_##operation(r, a, b)
#include "run.h"
#endif

#endif
