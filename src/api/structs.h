// SPDX-License-Identifier: MIT
// structs: structures of callers that were compiled with an older or a newer header. A shorter structure is read with
// zeros for the fields it lacks, so zero must mean the former behaviour in each new field. A longer structure is read
// if the rest is zero.
#pragma once

#include <stddef.h>

#include "base/base.h"
#include "topoadapt.h"

namespace tpa {

// Arguments of public functions, and fields of structures, for issues. Names in English: api_text.cpp.
enum class Subject : u8 {
  unnamed,
  bigger,
  changes,
  changes_triangles,
  changes_vertices,
  components,
  components_capacity,
  config,
  contacts,
  context,
  count,
  data,
  exec,
  exec_flags,
  map,
  memory,
  mesh,
  mesh_index_type,
  mesh_position_stride,
  mesh_position_type,
  mesh_positions,
  mesh_triangle_capacity,
  mesh_triangle_count,
  mesh_triangle_stride,
  mesh_triangles,
  mesh_vertex_capacity,
  mesh_vertex_count,
  move,
  move_position_stride,
  move_position_type,
  move_positions,
  options,
  options_collapse_ratio,
  options_iterations,
  options_lengths,
  options_relaxation,
  options_reserved,
  options_split_ratio,
  options_target_length,
  report,
  size,
  thickness,
  validation,
  view
};

// What is wrong with a subject.
enum class Rule : u8 {
  unnamed,  // no fault, or a fault without a name
  not_null,
  apart,
  as_saved,
  struct_size,   // issue.available: as given, issue.needed: in this version
  zeros_beyond,  // issue.element: offset of a byte that is not zero, issue.available: bytes that are known
  zero,
  exec_flags,
  float_type,
  index_type,
  stride,
  four_or_more,
  positive_coordinate,
  sweeps,
  rounds,
  split_ratio,
  collapse_ratio,
  fraction,
  capacity,    // issue.needed and .available
  short_index  // likewise, vertices
};

// A fault as tpa_issue.defect tells it.
constexpr i32 fault_number(Subject subject, Rule rule) {
  return static_cast<i32>(subject) << 8 | static_cast<i32>(rule);
}

constexpr Subject subject_of(i32 fault) { return static_cast<Subject>(fault >> 8 & 0xFF); }
constexpr Rule rule_of(i32 fault) { return static_cast<Rule>(fault & 0xFF); }

// The size of a structure in its first version, the least that is taken, and its name as an argument.
struct Growth {
  u32 first_size = 0;
  Subject name = Subject::unnamed;
};

template <class T>
inline constexpr Growth growth{};
#define TPA_END_OF(type, member) static_cast<u32>(offsetof(type, member) + sizeof(type::member))
template <>
inline constexpr Growth growth<tpa_config>{TPA_END_OF(tpa_config, smooth_mu), Subject::config};
template <>
inline constexpr Growth growth<tpa_mesh_input>{TPA_END_OF(tpa_mesh_input, triangles), Subject::mesh};
template <>
inline constexpr Growth growth<tpa_mesh_view>{TPA_END_OF(tpa_mesh_view, opposites), Subject::view};
template <>
inline constexpr Growth growth<tpa_mesh_output>{TPA_END_OF(tpa_mesh_output, triangles), Subject::mesh};
template <>
inline constexpr Growth growth<tpa_validation>{TPA_END_OF(tpa_validation, area), Subject::validation};
template <>
inline constexpr Growth growth<tpa_move_input>{TPA_END_OF(tpa_move_input, vertices), Subject::move};
template <>
inline constexpr Growth growth<tpa_exec>{TPA_END_OF(tpa_exec, parallel_for), Subject::exec};
template <>
inline constexpr Growth growth<tpa_contacts>{TPA_END_OF(tpa_contacts, pairs), Subject::contacts};
template <>
inline constexpr Growth growth<tpa_report>{TPA_END_OF(tpa_report, region_reach), Subject::report};
template <>
inline constexpr Growth growth<tpa_remesh_options>{TPA_END_OF(tpa_remesh_options, relaxation), Subject::options};
template <>
inline constexpr Growth growth<tpa_smooth_options>{TPA_END_OF(tpa_smooth_options, vertices), Subject::options};
template <>
inline constexpr Growth growth<tpa_vertex_map_view>{TPA_END_OF(tpa_vertex_map_view, origins), Subject::map};
template <>
inline constexpr Growth growth<tpa_triangle_map_view>{TPA_END_OF(tpa_triangle_map_view, origins), Subject::map};
template <>
inline constexpr Growth growth<tpa_change_list>{TPA_END_OF(tpa_change_list, triangle_count), Subject::changes};
template <>
inline constexpr Growth growth<tpa_handle_info>{TPA_END_OF(tpa_handle_info, complete), Subject::unnamed};
#undef TPA_END_OF

// A struct_size above is taken for uninitialized memory.
inline constexpr u32 largest_struct = 4096;

// The outcome of a look at a caller's structure.
struct StructFault {
  Rule rule = Rule::unnamed;
  u64 element = 0, needed = 0, available = 0;  // as in tpa_issue
  explicit operator bool() const { return rule != Rule::unnamed; }
};

StructFault check_struct_size(u64 size, Growth g, u32 known);
StructFault check_struct(const void* caller, Growth g, u32 known);
// `to` stays as it was if there is a fault.
StructFault read_bytes(const void* caller, Growth g, void* to, u32 known);
void write_bytes(const void* from, u32 known, void* caller);

// Reads a caller's structure into the form of this version, with this version's struct_size.
template <class T>
[[nodiscard]] StructFault read_struct(const T* caller, T& to) {
  static_assert(growth<T>.first_size >= sizeof(u32));
  return read_bytes(caller, growth<T>, &to, sizeof(T));
}

// Can a caller's structure be written to?
template <class T>
[[nodiscard]] StructFault check_struct(const T* caller) {
  static_assert(growth<T>.first_size >= sizeof(u32));
  return check_struct(caller, growth<T>, sizeof(T));
}

// Fills a caller's structure as far as it goes, with zeros in fields unknown to this version. struct_size stays.
// Pre: check_struct().
template <class T>
void write_struct(const T& from, T* caller) {
  write_bytes(&from, sizeof(T), caller);
}

}  // namespace tpa
