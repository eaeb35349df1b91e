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

const char* limit_name(i32 limit) {
  switch (limit) {
    case TPA_LIMIT_VERTICES: return "max_vertices";
    case TPA_LIMIT_TRIANGLES: return "max_triangles";
    case TPA_LIMIT_CONTACTS: return "max_contacts";
    case TPA_LIMIT_CUT: return "max_cut_edges";
    case TPA_LIMIT_EVENTS: return "max_events";
    case TPA_LIMIT_COMPONENTS: return "max_components";
    case TPA_LIMIT_PIECES: return "max_pieces";
    default: return "?";
  }
}

void say_defect(Line& line, const tpa_issue& i) {
  switch (i.defect) {
    case TPA_DEFECT_NOT_FINITE: line << "vertex " << i.element << " has a coordinate that is not finite"; return;
    case TPA_DEFECT_MAGNITUDE:
      line << "vertex " << i.element << " has a coordinate of magnitude outside [2^-100, 2^100]";
      return;
    case TPA_DEFECT_INDEX_RANGE:
      line << "element " << i.element << " uses vertex " << i.other << ", which does not exist";
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
  line << tpa_status_string(i.status);
  switch (i.status) {
    case TPA_E_ARGUMENT: line << ": argument " << static_cast<u64>(i.argument); return;
    case TPA_E_CONFIG: line << ": field " << static_cast<u64>(i.argument) << " of tpa_config"; return;
    case TPA_E_ARENA: line << ": needs " << i.needed << ", has " << i.available; return;
    case TPA_E_LIMIT:
      line << ": " << limit_name(i.limit) << " is " << i.available << ", needs at least " << i.needed;
      return;
    case TPA_E_MESH:
      line << ": ";
      say_defect(line, i);
      return;
    case TPA_E_TANGLED:
      line << ": triangles " << i.element << " and " << i.other << " meet, the first of " << i.needed << " pairs";
      return;
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
    case TPA_E_ARENA: return "memory block too small or misaligned";
    case TPA_E_CONTEXT: return "not a context of this library";
    case TPA_E_STATE: return "no mesh is loaded";
    case TPA_E_LIMIT: return "limit reached";
    case TPA_E_MESH: return "not a closed oriented 2-manifold";
    case TPA_E_TANGLED: return "mesh intersects itself";
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
