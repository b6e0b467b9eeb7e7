/* Status words and texts, from the one list in meshwright.h.  SPDX-License-Identifier: MIT-0 */
#include "meshwright.h"

int mw_abi(void)
{
    return MW_MODEL_ABI;
}

const char *mw_status_word(int status)
{
    switch (status) {
#define MW_STATUS_WORD(code, value, word, text) case value: return word;
        MW_STATUS_LIST(MW_STATUS_WORD)
#undef MW_STATUS_WORD
    default: return "unknown";
    }
}

const char *mw_status_text(int status)
{
    switch (status) {
#define MW_STATUS_TEXT(code, value, word, text) case value: return text;
        MW_STATUS_LIST(MW_STATUS_TEXT)
#undef MW_STATUS_TEXT
    default: return "no such status";
    }
}
