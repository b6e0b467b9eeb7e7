/* The drives that are built into this library: those of the header MW_DRIVES, a list MW_DRIVE_LIST(X) of their names.
 * Without it there is none, and every drive is an object of its own (see drive/drive.c).  SPDX-License-Identifier: MIT-0 */
#include <string.h>
#include "meshwright.h"
#ifdef MW_DRIVES
#include MW_DRIVES
#else
#define MW_DRIVE_LIST(X)
#endif

#define MW_DECLARED(drive) const mw_model *mw_drive_##drive(void);
MW_DRIVE_LIST(MW_DECLARED)

#define MW_LISTED(drive) mw_drive_##drive,
static const mw_model *(*const drives[])(void) = { MW_DRIVE_LIST(MW_LISTED) NULL };

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
    for (int i = 0; i < mw_model_count(); i++)
        if (strcmp(mw_model_at(i)->drive, drive) == 0) return mw_model_at(i);
    return NULL;
}
