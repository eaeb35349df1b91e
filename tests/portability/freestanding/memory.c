/* SPDX-License-Identifier: MIT */
/* Compiled with -fno-builtin, or these loops would call the functions that they are. */
#include <string.h>

void* memcpy(void* to, const void* from, size_t bytes) {
  unsigned char* t = to;
  const unsigned char* f = from;
  while (bytes-- > 0) *t++ = *f++;
  return to;
}
void* memmove(void* to, const void* from, size_t bytes) {
  unsigned char* t = to;
  const unsigned char* f = from;
  if ((size_t)(t - f) >= bytes) return memcpy(to, from, bytes);
  while (bytes-- > 0) t[bytes] = f[bytes];
  return to;
}
void* memset(void* to, int value, size_t bytes) {
  unsigned char* t = to;
  while (bytes-- > 0) *t++ = (unsigned char)value;
  return to;
}
int memcmp(const void* a, const void* b, size_t bytes) {
  const unsigned char *p = a, *q = b;
  for (; bytes > 0; --bytes, ++p, ++q)
    if (*p != *q) return *p < *q ? -1 : 1;
  return 0;
}
