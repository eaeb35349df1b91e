/* SPDX-License-Identifier: MIT */
/* The start of a program on a Cortex-M; newlib's start-up code goes on. */
#include <stdint.h>

extern char __stack;
void _start(void);
void reset(void);

__attribute__((section(".vectors"), used)) static void (*const vectors[])(void) = {(void (*)(void)) & __stack, reset};

void reset(void) {
  *(volatile uint32_t*)0xE000ED88 |= UINT32_C(15) << 20; /* the floating-point unit, where there is one */
  __asm__ volatile("dsb; isb");
  _start();
}
