/* SPDX-License-Identifier: MIT */
/* A program that was compiled with the header of version 0.1. Neither the header of that time nor the present one is
 * included here: they share their names. */
#ifndef TOPOADAPT_TESTS_USER_OF_0_1_H
#define TOPOADAPT_TESTS_USER_OF_0_1_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Structures that may grow, in the order of the header. */
enum { structs_of_0_1 = 14 };
/* Their sizes in version 0.1. */
extern const uint32_t sizes_of_0_1[structs_of_0_1];

typedef struct outcome_of_0_1 {
  uint32_t pairs, vertices, triangles, handles;
  double volume, region_before;
} outcome_of_0_1;

/* Calls every function that takes such a structure: two octahedra merge, are remeshed and smoothed. NULL, or what went
 * wrong. */
const char* run_user_of_0_1(outcome_of_0_1* outcome);

#ifdef __cplusplus
}
#endif

#endif
