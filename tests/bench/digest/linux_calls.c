/* SPDX-License-Identifier: MIT */
/* What newlib wants of a system, from Linux: so that QEMU runs Thumb code for Cortex-M as a process. */
#include <stddef.h>

int main(void);
void _start(void);
int _write(int file, const void* data, int bytes);
void* _sbrk(ptrdiff_t more);

static int call(int number, int a, int b, int c) {
  register int r0 __asm__("r0") = a;
  register int r1 __asm__("r1") = b;
  register int r2 __asm__("r2") = c;
  register int r7 __asm__("r7") = number;
  __asm__ volatile("svc 0" : "+r"(r0) : "r"(r1), "r"(r2), "r"(r7) : "memory");
  return r0;
}

int _write(int file, const void* data, int bytes) { return call(4, file, (int)data, bytes); }

/* The buffer of stdout. */
void* _sbrk(ptrdiff_t more) {
  static char heap[1 << 14];
  static ptrdiff_t used;
  used += more;
  return heap + used - more;
}

int fflush(void* file);

void _start(void) {
  const int result = main();
  fflush(NULL);
  call(1, result, 0, 0);
  for (;;) {
  }
}
