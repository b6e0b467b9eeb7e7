/* All that the page's C needs of <string.h>; WebAssembly has instructions for both.  SPDX-License-Identifier: MIT-0 */
#ifndef LIVE_STRING_H
#define LIVE_STRING_H
#define memcpy(to, from, n) __builtin_memcpy(to, from, n)
#define memset(to, value, n) __builtin_memset(to, value, n)
#endif
