/* SPDX-License-Identifier: MIT */
#ifndef TOPOADAPT_SCENES_H
#define TOPOADAPT_SCENES_H

#include "topoadapt.h"

uint32_t scene_count(void);
/* Runs a scene. A line with its name and digest, in static memory. */
const char* scene_line(uint32_t scene);

#endif
