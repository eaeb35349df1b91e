// SPDX-License-Identifier: MIT
// Statuses and issues in English.
#include "api/api.h"

namespace tpa {

namespace {

// Appends to the caller's buffer up to its end, and counts every character.
struct Line {
  char* text;
  size_t size;
  size_t length = 0;

  Line& operator<<(const char* s) {
    for (; *s != 0; ++s) put(*s);
    return *this;
  }
  Line& operator<<(u64 n) {
    char digits[20];
    u32 count = 0;
    do digits[count++] = static_cast<char>('0' + n % 10);
    while ((n /= 10) != 0);
    while (count > 0) put(digits[--count]);
    return *this;
  }
  void put(char c) {
    if (length + 1 < size) text[length] = c;
    ++length;
  }
  void end() {
    if (size > 0) text[min_of(length, size - 1)] = 0;
  }
};

const char* name_of(Subject subject) {
  switch (subject) {
    case Subject::unnamed: break;
    case Subject::bigger: return "bigger";
    case Subject::changes: return "changes";
    case Subject::changes_triangles: return "changes.triangles";
    case Subject::changes_vertices: return "changes.vertices";
    case Subject::components: return "components";
    case Subject::components_capacity: return "capacity of components";
    case Subject::config: return "config";
    case Subject::contacts: return "contacts";
    case Subject::context: return "context";
    case Subject::count: return "count";
    case Subject::data: return "data";
    case Subject::exec: return "exec";
    case Subject::exec_flags: return "exec.flags";
    case Subject::map: return "map";
    case Subject::memory: return "memory";
    case Subject::mesh: return "mesh";
    case Subject::mesh_index_type: return "mesh.index_type";
    case Subject::mesh_position_stride: return "mesh.position_stride";
    case Subject::mesh_position_type: return "mesh.position_type";
    case Subject::mesh_positions: return "mesh.positions";
    case Subject::mesh_triangle_capacity: return "mesh.triangle_capacity";
    case Subject::mesh_triangle_count: return "mesh.triangle_count";
    case Subject::mesh_triangle_stride: return "mesh.triangle_stride";
    case Subject::mesh_triangles: return "mesh.triangles";
    case Subject::mesh_vertex_capacity: return "mesh.vertex_capacity";
    case Subject::mesh_vertex_count: return "mesh.vertex_count";
    case Subject::move: return "move";
    case Subject::move_position_stride: return "move.position_stride";
    case Subject::move_position_type: return "move.position_type";
    case Subject::move_positions: return "move.positions";
    case Subject::options: return "options";
    case Subject::options_collapse_ratio: return "options.collapse_ratio";
    case Subject::options_iterations: return "options.iterations";
    case Subject::options_lengths: return "options.lengths";
    case Subject::options_relaxation: return "options.relaxation";
    case Subject::options_reserved: return "options.reserved";
    case Subject::options_split_ratio: return "options.split_ratio";
    case Subject::options_target_length: return "options.target_length";
    case Subject::report: return "report";
    case Subject::size: return "size";
    case Subject::thickness: return "thickness";
    case Subject::validation: return "validation";
    case Subject::view: return "view";
  }
  return "an argument";
}

// What follows the name of the subject.
void say_rule(Line& line, Rule rule, const tpa_issue& i) {
  switch (rule) {
    case Rule::unnamed: line << " is refused"; return;
    case Rule::not_null: line << " must not be NULL"; return;
    case Rule::apart: line << " must lie apart from the block of the context"; return;
    case Rule::as_saved: line << " must be as in the saved state"; return;
    case Rule::struct_size:
      line << ".struct_size is " << i.available << ", must be the sizeof of the structure, " << i.needed
           << " in this version";
      return;
    case Rule::zeros_beyond:
      line << " must be zero beyond the " << i.available << " bytes of this version, is not at byte " << i.element;
      return;
    case Rule::zero: line << " must be 0"; return;
    case Rule::exec_flags: line << " must be 0 or TPA_EXEC_KEEP"; return;
    case Rule::float_type: line << " must be TPA_FLOAT32 or TPA_FLOAT64"; return;
    case Rule::index_type: line << " must be TPA_UINT16 or TPA_UINT32"; return;
    case Rule::stride: line << " must be 0 or at least the bytes of three numbers"; return;
    case Rule::four_or_more: line << " must be at least 4"; return;
    case Rule::positive_coordinate: line << " must be 2^-100 .. 2^100"; return;
    case Rule::sweeps: line << " must be 1 .. 100"; return;
    case Rule::rounds: line << " must be 0 .. 1000"; return;
    case Rule::split_ratio: line << " must be above 0 and at most 10^6"; return;
    case Rule::collapse_ratio: line << " must be above 0 and at most split_ratio / 1.5"; return;
    case Rule::fraction: line << " must be 0 .. 1"; return;
    case Rule::capacity: line << " is " << i.available << ", needs at least " << i.needed; return;
    case Rule::short_index:
      line << " must be TPA_UINT32: TPA_UINT16 numbers " << i.available << " vertices of " << i.needed;
      return;
  }
}

// The fields that decide results.
const char* name_of_field(i32 position) {
  switch (position) {
    case field_detect_mode: return ".detect_mode";
    case field_cell_size: return ".cell_size";
    case field_region: return ".region";
    case field_max_passes: return ".max_passes";
    case field_max_candidates: return ".max_candidates";
    case field_smooth_iterations: return ".smooth_iterations";
    case field_smooth_lambda: return ".smooth_lambda";
    case field_smooth_mu: return ".smooth_mu";
    default: return "";
  }
}

// The structure as a whole, or a field by its position.
void say_config(Line& line, const tpa_issue& i) {
  line << "config";
  if (rule_of(i.defect) == Rule::as_saved) {
    line << name_of_field(i.argument);
    say_rule(line, Rule::as_saved, i);
    return;
  }
  switch (i.argument) {
    case field_struct_size: say_rule(line, rule_of(i.defect), i); return;
    case field_cookie: line << ".cookie must be as tpa_config_init sets it"; return;
    case field_max_vertices: line << ".max_vertices must be 4 .. 2^29"; return;
    case field_max_triangles: line << ".max_triangles must be 0 or 4 .. 2^30 + 1024"; return;
    case field_max_contacts: line << ".max_contacts must be 0 or 1 .. 2^30"; return;
    case field_max_cut_edges: line << ".max_cut_edges must be 0 or 3 .. 2^28"; return;
    case field_max_events: line << ".max_events must be 0 or 1 .. 2^28"; return;
    case field_max_components: line << ".max_components must be 0 or 1 .. 2^28"; return;
    case field_max_pieces: line << ".max_pieces must be 0 or 1 .. 2^28"; return;
    case field_detect_mode: line << ".detect_mode must be TPA_DETECT_COMPLETE or TPA_DETECT_VERTEX_HASH"; return;
    case field_cell_size: line << ".cell_size must be 2^-100 .. 2^100"; return;
    case field_region: line << ".region must be TPA_REGION_INSIDE or TPA_REGION_OUTSIDE"; return;
    case field_max_passes: line << ".max_passes must be 1 .. 64"; return;
    case field_max_candidates: line << ".max_candidates must be 1 .. 256"; return;
    case field_smooth_iterations: line << ".smooth_iterations must be 0 .. 1000"; return;
    case field_smooth_lambda: line << ".smooth_lambda must be 2^-20 .. 1"; return;
    case field_smooth_mu: line << ".smooth_mu must be at least -1.5 and below -smooth_lambda"; return;
    case field_max_substeps: line << ".max_substeps must be 0 .. 2^20"; return;
    default: line << " is refused"; return;
  }
}

const char* limit_name(i32 limit) {
  switch (limit) {
    case TPA_LIMIT_VERTICES: return "max_vertices";
    case TPA_LIMIT_TRIANGLES: return "max_triangles";
    case TPA_LIMIT_CONTACTS: return "max_contacts";
    case TPA_LIMIT_CUT: return "max_cut_edges";
    case TPA_LIMIT_EVENTS: return "max_events";
    case TPA_LIMIT_COMPONENTS: return "max_components";
    case TPA_LIMIT_PIECES: return "max_pieces";
    case TPA_LIMIT_SUBSTEPS: return "max_substeps";
    default: return "?";
  }
}

const char* defect_class(i32 defect) {
  switch (defect) {
    case TPA_DEFECT_NOT_FINITE:
    case TPA_DEFECT_MAGNITUDE: return "unusable coordinate";
    case TPA_DEFECT_INDEX_RANGE: return "unknown vertex id";
    default: return "not a closed oriented 2-manifold";
  }
}

// A vertex with an unusable coordinate; in the list of tpa_move, its target.
void say_coordinate(Line& line, const tpa_issue& i) {
  if (i.argument != 0) line << "place " << i.other << " of the list, the target of ";
  line << "vertex " << i.element << (i.argument != 0 ? ", has" : " has") << " a coordinate ";
}

void say_defect(Line& line, const tpa_issue& i) {
  switch (i.defect) {
    case TPA_DEFECT_NOT_FINITE:
      say_coordinate(line, i);
      line << "that is not finite";
      return;
    case TPA_DEFECT_MAGNITUDE:
      say_coordinate(line, i);
      line << "of magnitude outside [2^-100, 2^100]";
      return;
    case TPA_DEFECT_INDEX_RANGE:
      line << (i.argument != 0 ? "place " : "triangle ") << i.element << (i.argument != 0 ? " of the list" : "")
           << " names vertex " << i.other << " of " << i.available << " vertices";
      return;
    case TPA_DEFECT_REPEATED_VERTEX: line << "triangle " << i.element << " uses vertex " << i.other << " twice"; return;
    case TPA_DEFECT_ORIENTATION:
      line << "two triangles run through edge " << i.element << "-" << i.other << " in the same direction";
      return;
    case TPA_DEFECT_NON_MANIFOLD_EDGE:
      line << "edge " << i.element << "-" << i.other << " has more than two triangles";
      return;
    case TPA_DEFECT_BOUNDARY_EDGE: line << "edge " << i.element << "-" << i.other << " has only one triangle"; return;
    case TPA_DEFECT_NON_MANIFOLD_VERTEX:
      line << "the triangles at vertex " << i.element << " form more than one fan";
      return;
    case TPA_DEFECT_ISOLATED_VERTEX: line << "vertex " << i.element << " belongs to no triangle"; return;
    default: line << "unknown defect"; return;
  }
}

void say(Line& line, const tpa_issue& i) {
  line << (i.status == TPA_E_MESH ? defect_class(i.defect) : tpa_status_string(i.status));
  switch (i.status) {
    case TPA_E_ARGUMENT:
      line << ": " << name_of(subject_of(i.defect));
      say_rule(line, rule_of(i.defect), i);
      return;
    case TPA_E_CONFIG:
      line << ": ";
      say_config(line, i);
      return;
    case TPA_E_ARENA: line << ": needs " << i.needed << ", has " << i.available; return;
    case TPA_E_LIMIT:
      line << ": ";
      if (i.argument == 0) {
        line << limit_name(i.limit) << " is " << i.available << ", needs at least " << i.needed;
      } else {
        line << name_of(subject_of(i.defect));
        say_rule(line, rule_of(i.defect), i);
      }
      return;
    case TPA_E_MESH:
      line << ": ";
      say_defect(line, i);
      return;
    case TPA_E_TANGLED:
      line << ": ";
      if (i.element != i.other)
        line << "triangles " << i.element << " and " << i.other << " meet, the first of " << i.needed << " pairs";
      else
        line << i.needed << " pairs of triangles meet, more than max_contacts";
      return;
    case TPA_E_BUDGET:
      line << ": " << i.available << " units";
      if (i.needed != 0) line << ", needs " << i.needed;
      return;
    case TPA_E_DATA: line << ": byte " << i.element; return;
    default: return;
  }
}

}  // namespace

}  // namespace tpa

extern "C" {

const char* tpa_status_string(tpa_status status) {
  switch (status) {
    case TPA_OK: return "ok";
    case TPA_E_ARGUMENT: return "invalid argument";
    case TPA_E_CONFIG: return "invalid configuration";
    case TPA_E_OVERFLOW: return "size overflow";
    case TPA_E_ARENA: return "memory block too small";
    case TPA_E_CONTEXT: return "not a context of this library";
    case TPA_E_STATE: return "no mesh is loaded";
    case TPA_E_LIMIT: return "limit reached";
    case TPA_E_MESH: return "unusable mesh, coordinate or id";
    case TPA_E_TANGLED: return "mesh intersects itself";
    case TPA_E_ENVIRONMENT: return "floating-point environment not as needed";
    case TPA_E_BUDGET: return "budget of work spent";
    case TPA_E_CANCELLED: return "cancelled";
    case TPA_E_DATA: return "not a saved state of this version, or damaged";
    default: return "unknown status";
  }
}

size_t tpa_issue_text(const tpa_issue* issue, char* text, size_t size) {
  if (issue == nullptr || (text == nullptr && size > 0)) return 0;
  tpa::Line line{text, size};
  tpa::say(line, *issue);
  line.end();
  return line.length;
}

}  // extern "C"
