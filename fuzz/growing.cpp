// SPDX-License-Identifier: MIT
#include "growing.h"

#include <cstring>

#include "oracle/xxh64.h"
#include "target.h"

namespace fuzz {

uint32_t& LimitOf(tpa_config& config, int32_t limit) {
  switch (limit) {
    case TPA_LIMIT_VERTICES: return config.max_vertices;
    case TPA_LIMIT_TRIANGLES: return config.max_triangles;
    case TPA_LIMIT_CONTACTS: return config.max_contacts;
    case TPA_LIMIT_CUT: return config.max_cut_edges;
    case TPA_LIMIT_EVENTS: return config.max_events;
    case TPA_LIMIT_COMPONENTS: return config.max_components;
    case TPA_LIMIT_SUBSTEPS: return config.max_substeps;
    default: return config.max_pieces;
  }
}

tpa_config Ample(tpa_config config) {
  config.max_vertices = 1 << 13;
  config.max_triangles = 0;
  config.max_contacts = config.max_cut_edges = 1 << 13;
  config.max_events = config.max_components = 1 << 10;
  config.max_pieces = 1 << 17;
  config.max_substeps = most_substeps;
  return config;
}

uint64_t FieldsOf(const tpa_config& config) {
  tpa_config fields = config;
  fields.max_vertices = fields.max_triangles = fields.max_contacts = fields.max_cut_edges = 0;
  fields.max_events = fields.max_components = fields.max_pieces = fields.max_substeps = 0;
  return support::Xxh64(reinterpret_cast<const uint8_t*>(&fields), sizeof fields);
}

Owner Grown(const Owner& o, const tpa_config& config) {
  const tpa_arena_size size = ArenaSize(config);
  const uint64_t digest = DigestOf(o.context);
  Owner grown{Block(size.bytes, size.alignment)};
  tpa_issue issue;
  const tpa_status status = tpa_grow(o.context, grown.block.get(), size.bytes, &config, &grown.context, &issue);
  Demand(DigestOf(o.context) == digest, "tpa_grow leaves the context alone");
  Demand(status == TPA_OK || (status == TPA_E_LIMIT && issue.needed > issue.available),
         "tpa_grow fails for want of room only");
  if (status != TPA_OK) grown.context = nullptr;
  return grown;
}

std::vector<uint8_t> StateOf(const tpa_context* context) {
  size_t size = 0;
  Demand(tpa_save(context, nullptr, 0, &size, nullptr) == TPA_OK, "the size of a state");
  std::vector<uint8_t> bytes(size);
  Demand(tpa_save(context, bytes.data(), size, &size, nullptr) == TPA_OK && size == bytes.size(), "a state is saved");
  return bytes;
}

}  // namespace fuzz
