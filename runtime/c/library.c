/* The drives that are built into this library: those of the header MW_DRIVES, a list MW_DRIVE_LIST(X) of their names.
 * Without it there is none, and every drive is an object of its own (see drive/drive.c).  SPDX-License-Identifier: MIT-0 */
#include <string.h>
#include "kernels.h"
#include "meshwright.h"
#include "mw_certify.h"
#include "solver/basics.h"
#ifdef MW_DRIVES
#include MW_DRIVES
#else
#define MW_DRIVE_LIST(X)
#endif

#define MW_DECLARED(drive) const mw_model *mw_drive_##drive(void); const mw_proofs *mw_proofs_##drive(void);
MW_DRIVE_LIST(MW_DECLARED)

#define MW_LISTED(drive) mw_drive_##drive,
static const mw_model *(*const drives[])(void) = { MW_DRIVE_LIST(MW_LISTED) NULL };
#define MW_LISTED_PROOFS(drive) mw_proofs_##drive,
static const mw_proofs *(*const built_proofs[])(void) = { MW_DRIVE_LIST(MW_LISTED_PROOFS) NULL };

int mw_model_count(void)
{
    return (int)(sizeof drives / sizeof drives[0]) - 1;
}

const mw_model *mw_model_at(int index)
{
    return index >= 0 && index < mw_model_count() ? drives[index]() : NULL;
}

const mw_model *mw_find(const char *drive)
{
    for (int i = 0; drive && i < mw_model_count(); i++)
        if (strcmp(mw_model_at(i)->drive, drive) == 0) return mw_model_at(i);
    return NULL;
}

typedef struct joined {
    mw_model model;
    mw_kernels kernels;
} joined;

size_t mw_joined_size(void)
{
    return sizeof(joined);
}

const mw_model *mw_joined(const mw_model *m, const mw_in_lanes *lanes, const mw_proofs *proofs, void *room)
{
    joined *j = room;
    if (!mwi_usable(m) || !m->kernels) return NULL;
    if (lanes && strcmp(lanes->drive, m->drive) != 0) return NULL;
    if (proofs && strcmp(proofs->drive, m->drive) != 0) return NULL;
    j->model = *m;
    j->kernels = *m->kernels;
    j->model.kernels = &j->kernels;
    if (lanes) memcpy(j->kernels.lanes, lanes->lanes, sizeof j->kernels.lanes);
    if (proofs) j->kernels.enclosing = proofs->enclosing;
    return &j->model;
}

const mw_proofs *mw_proofs_of(const mw_model *m)
{
    for (int i = 0; i < mw_model_count(); i++)
        if (mw_model_at(i) == m) return built_proofs[i]();
    return NULL;
}
