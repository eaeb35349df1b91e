// SPDX-License-Identifier: MIT
// growing: the limits of a config by number, and contexts in blocks with other limits.
#pragma once

#include <vector>

#include "blocks.h"

namespace fuzz {

// Limits beyond are not followed.
constexpr uint32_t most_elements = 1 << 18, most_substeps = 8;

uint32_t& LimitOf(tpa_config& config, int32_t limit);
// Four times as much as any call here wants.
tpa_config Ample(tpa_config config);
// A number made of the fields that decide results.
uint64_t FieldsOf(const tpa_config& config);
// The same state with another config; without a context where it does not fit.
Owner Grown(const Owner& o, const tpa_config& config);
std::vector<uint8_t> StateOf(const tpa_context* context);

}  // namespace fuzz
