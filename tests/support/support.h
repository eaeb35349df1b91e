// SPDX-License-Identifier: MIT
// support: shared by the tests on the public interface. Sample meshes, oracles without code of the library, and a
// holder of an arena.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "oracle/mesh_oracle.h"
#include "support/mesh_on_failure.h"
#include "support/sample_meshes.h"
#include "topoadapt.h"

namespace support {

// A structure of the interface, zero but for its size.
template <class T>
T Sized() {
  T s{};
  s.struct_size = sizeof s;
  return s;
}

tpa_config DefaultConfig(uint32_t max_vertices);
// Room for the mesh three times over.
tpa_config ConfigFor(const Mesh& m);

class Arena {
 public:
  explicit Arena(const tpa_config& config);
  // With the mesh loaded; a failing test writes it, and the mesh at the end.
  Arena(const tpa_config& config, const Mesh& mesh);
  tpa_context* operator*() const { return context_; }
  char* block() const { return block_.get(); }
  const tpa_arena_size& size() const { return size_; }

 private:
  struct Free {
    void operator()(char* p) const;
  };
  tpa_arena_size size_{};
  std::unique_ptr<char, Free> block_;
  tpa_context* context_ = nullptr;
  std::optional<MeshOnFailure> loaded_;
  MeshOnFailure now_;
};

// Refers to the mesh.
tpa_mesh_input InputOf(const Mesh& mesh);
tpa_status Load(tpa_context* context, const Mesh& mesh, tpa_issue* issue = nullptr);
tpa_status MoveAll(tpa_context* context, const std::vector<double>& targets, tpa_issue* issue = nullptr);
tpa_status MoveSome(tpa_context* context, const std::vector<uint32_t>& vertices, const std::vector<double>& targets);
Mesh MeshOf(const tpa_context* context);
std::vector<tpa_event> EventsOf(const tpa_context* context);
std::vector<tpa_vertex_origin> VertexOriginsOf(const tpa_context* context);
std::vector<uint32_t> OldToNewOf(const tpa_context* context);
std::vector<uint32_t> TriangleOriginsOf(const tpa_context* context);
Pairs PairsOf(const tpa_contacts& contacts);
std::string Text(const tpa_issue& issue);

// Everything to be left alone by a failure: the bytes of view, maps, components, events and the list of
// rolled back vertices.
struct Observed {
  std::string bytes;
  bool operator==(const Observed& other) const { return bytes == other.bytes; }
};
Observed Observe(const tpa_context* context);

}  // namespace support
