// SPDX-License-Identifier: MIT
import { blobs } from "./blobs.js";
import { balloon } from "./balloon.js";
import { carving } from "./carving.js";
import { tangles } from "./tangles.js";

export const scenes = { blobs, balloon, carving, tangles };
