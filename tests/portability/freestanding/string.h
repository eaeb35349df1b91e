/* SPDX-License-Identifier: MIT */
/* All that the library wants of a platform without a C library. */
#ifndef TOPOADAPT_FREESTANDING_STRING_H
#define TOPOADAPT_FREESTANDING_STRING_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif
void* memcpy(void* to, const void* from, size_t bytes);
void* memmove(void* to, const void* from, size_t bytes);
void* memset(void* to, int value, size_t bytes);
int memcmp(const void* a, const void* b, size_t bytes);
#ifdef __cplusplus
}
#endif

#endif
