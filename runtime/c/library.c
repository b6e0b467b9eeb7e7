/* The shared library: every generated drive behind one table.  SPDX-License-Identifier: MIT-0 */
#include <string.h>
#include "meshwright.h"
#include "models.h"

int mw_model_count(void)
{
    return (int)(sizeof mw_models / sizeof mw_models[0]) - 1;
}

const mw_model *mw_model_at(int index)
{
    return index >= 0 && index < mw_model_count() ? mw_models[index] : NULL;
}

const mw_model *mw_find(const char *drive)
{
    for (int i = 0; i < mw_model_count(); i++)
        if (strcmp(mw_models[i]->drive, drive) == 0) return mw_models[i];
    return NULL;
}
