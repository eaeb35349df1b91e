// SPDX-License-Identifier: MIT
#include "wrong_calls.h"

#include <cstring>
#include <functional>

#include "growing.h"
#include "oracle/xxh64.h"
#include "target.h"

namespace fuzz {

namespace {

uint64_t wrong_calls = 0;

// Makes the hash of a state right again.
void Seal(std::vector<uint8_t>& state) {
  if (state.size() < 8) return;
  const size_t hashed = state.size() - 8;
  const uint64_t hash = support::Xxh64(state.data(), hashed);
  for (size_t i = 0; i < 8; ++i) state[hashed + i] = static_cast<uint8_t>(hash >> 8 * i);
}

void Damage(Bytes& in, std::vector<uint8_t>& state) {
  const auto size = static_cast<uint32_t>(state.size());
  switch (in.Below(4)) {
    case 0: state.resize(in.Below(size + 1)); break;
    case 1: state.push_back(in.Byte()); break;
    default:
      for (uint32_t i = 1 + in.Below(4); i > 0 && size > 0; --i)
        state[in.Once(2) ? in.Below(size) : in.Below(100) % size] ^= in.Byte();
  }
}

// A structure of the caller with a size that is no version's, or with bytes that are not zero beyond.
template <class T>
struct WrongSize {
  explicit WrongSize(Bytes& in, bool is_output) {
    std::memset(bytes, 0xA5, sizeof bytes);
    const uint32_t sizes[] = {0,    4,          static_cast<uint32_t>(sizeof(T)) + 2,
                              4100, 0xFFFFFFFC, static_cast<uint32_t>(sizeof(T)) + 8};
    const uint32_t size = sizes[in.Below(is_output ? 5 : 6)];  // beyond an output anything may stand
    std::memcpy(bytes, &size, sizeof size);
  }
  T* get() { return reinterpret_cast<T*>(bytes); }
  alignas(T) uint8_t bytes[sizeof(T) + 64];
};

void Refused(const char* call, const Owner& o, tpa_status expected, const std::function<tpa_status()>& make) {
  const uint64_t digest = DigestOf(o.context);
  const tpa_status status = make();
  ++wrong_calls;
  Demand(status == expected, call, " is refused with ", tpa_status_string(expected), ", not ",
         tpa_status_string(status));
  Demand(DigestOf(o.context) == digest, call, " changes nothing");
}

// Each function of a context, with another one.
void CallWithout(tpa_context* context, const Owner& o, Bytes& in) {
  tpa_issue issue;
  uint32_t count = 0;
  uint64_t digest = 0;
  size_t size = 0;
  const tpa_event* events = nullptr;
  const uint32_t* ids = nullptr;
  auto view = Sized<tpa_mesh_view>();
  auto output = Sized<tpa_mesh_output>();
  auto input = Sized<tpa_mesh_input>();
  auto move = Sized<tpa_move_input>();
  auto contacts = Sized<tpa_contacts>();
  auto validation = Sized<tpa_validation>();
  auto remesh = Sized<tpa_remesh_options>();
  auto smooth = Sized<tpa_smooth_options>();
  auto vertices = Sized<tpa_vertex_map_view>();
  auto triangles = Sized<tpa_triangle_map_view>();
  auto changes = Sized<tpa_change_list>();
  auto config = Sized<tpa_config>();
  float rows[4] = {};
  remesh.iterations = 1;
  remesh.target_length = 1;
  tpa_context* other = nullptr;
  const std::function<tpa_status()> calls[] = {
      [&] { return tpa_reset(context); },
      [&] { return tpa_memory_stats(context, nullptr, 0, &count); },
      [&] { return tpa_load(context, &input, &issue); },
      [&] { return tpa_view(context, &view); },
      [&] { return tpa_export(context, &output, &issue); },
      [&] { return tpa_move(context, &move, &issue); },
      [&] { return tpa_detect(context, nullptr, &contacts, &issue); },
      [&] { return tpa_validate(context, nullptr, &validation, &issue); },
      [&] { return tpa_step(context, nullptr, nullptr, &issue); },
      [&] { return tpa_advance(context, 1, nullptr, nullptr, &issue); },
      [&] { return tpa_adapt(context, nullptr, nullptr, &issue); },
      [&] { return tpa_remesh(context, &remesh, nullptr, nullptr, &issue); },
      [&] { return tpa_smooth(context, &smooth, nullptr, nullptr, &issue); },
      [&] { return tpa_reorder(context, &issue); },
      [&] { return tpa_events(context, &events, &count); },
      [&] { return tpa_components(context, nullptr, 0, nullptr, &count, &issue); },
      [&] { return tpa_rolled_back(context, &ids, &count); },
      [&] { return tpa_vertex_map(context, &vertices); },
      [&] { return tpa_triangle_map(context, &triangles); },
      [&] { return tpa_changes(context, &changes, &issue); },
      [&] { return tpa_carry_vertices(context, rows, 1, rows + 2); },
      [&] { return tpa_carry_triangles(context, rows, 1, rows + 2); },
      [&] { return tpa_save(context, nullptr, 0, &size, &issue); },
      [&] { return tpa_restore(context, rows, sizeof rows, &issue); },
      [&] { return tpa_digest(context, &digest); },
      [&] { return tpa_config_of(context, &config); },
      [&] { return tpa_targets(context, nullptr, nullptr, 0, &count); },
      [&] { return tpa_drop_targets(context); },
      [&] {
        config = ConfigOf(o.context);
        return tpa_grow(context, rows, sizeof rows, &config, &other, &issue);
      },
  };
  const auto which = in.Below(static_cast<uint32_t>(std::size(calls)));
  Refused("a call without a context", o, TPA_E_CONTEXT, calls[which]);
}

void CallWithWrongStructure(Bytes& in, const Owner& o) {
  tpa_context* c = o.context;
  tpa_issue issue;
  const bool is_loaded = [&] {
    auto view = Sized<tpa_mesh_view>();
    return tpa_view(c, &view) == TPA_OK;
  }();
  const auto refused = [&](const char* call, const std::function<tpa_status()>& make) {
    Refused(call, o, TPA_E_ARGUMENT, make);
  };
  switch (in.Below(is_loaded ? 14 : 3)) {
    case 0: {
      WrongSize<tpa_mesh_input> s(in, false);
      return refused("tpa_load", [&] { return tpa_load(c, s.get(), &issue); });
    }
    case 1: return refused("tpa_load", [&] { return tpa_load(c, nullptr, &issue); });
    case 2: {
      WrongSize<tpa_config> s(in, true);
      return refused("tpa_config_of", [&] { return tpa_config_of(c, s.get()); });
    }
    case 3: {
      WrongSize<tpa_mesh_view> s(in, true);
      return refused("tpa_view", [&] { return tpa_view(c, s.get()); });
    }
    case 4: {
      WrongSize<tpa_mesh_output> s(in, true);
      return refused("tpa_export", [&] { return tpa_export(c, s.get(), &issue); });
    }
    case 5: {
      WrongSize<tpa_move_input> s(in, false);
      return refused("tpa_move", [&] { return tpa_move(c, s.get(), &issue); });
    }
    case 6: {
      WrongSize<tpa_exec> s(in, false);
      return refused("tpa_step", [&] { return tpa_step(c, s.get(), nullptr, &issue); });
    }
    case 7: {
      WrongSize<tpa_report> s(in, true);
      return refused("tpa_adapt", [&] { return tpa_adapt(c, nullptr, s.get(), &issue); });
    }
    case 8: {
      WrongSize<tpa_contacts> s(in, true);
      return refused("tpa_detect", [&] { return tpa_detect(c, nullptr, s.get(), &issue); });
    }
    case 9: {
      WrongSize<tpa_validation> s(in, true);
      return refused("tpa_validate", [&] { return tpa_validate(c, nullptr, s.get(), &issue); });
    }
    case 10: {
      WrongSize<tpa_remesh_options> s(in, false);
      return refused("tpa_remesh", [&] { return tpa_remesh(c, s.get(), nullptr, nullptr, &issue); });
    }
    case 11: {
      WrongSize<tpa_smooth_options> s(in, false);
      return refused("tpa_smooth", [&] { return tpa_smooth(c, s.get(), nullptr, nullptr, &issue); });
    }
    case 12: {
      WrongSize<tpa_vertex_map_view> s(in, true);
      return refused("tpa_vertex_map", [&] { return tpa_vertex_map(c, s.get()); });
    }
    default: {
      WrongSize<tpa_change_list> s(in, false);
      return refused("tpa_changes", [&] { return tpa_changes(c, s.get(), &issue); });
    }
  }
}

}  // namespace

bool DamageState(Bytes& in, const Owner& o, std::vector<uint8_t> state) {
  if (state.empty() || in.Once(2)) state = StateOf(o.context);
  const std::vector<uint8_t> whole = state;
  Damage(in, state);
  const bool is_sealed = in.Once(2);
  if (is_sealed) Seal(state);
  if (state == whole) return false;
  const uint64_t digest = DigestOf(o.context);
  tpa_issue issue;
  const tpa_status status = tpa_restore(o.context, state.data(), state.size(), &issue);
  ++wrong_calls;
  if (status == TPA_OK) {
    // Another state, if the hash is right.
    Demand(is_sealed && StateOf(o.context) == state, "a state that is taken is as it was given");
    return true;
  }
  Demand(DigestOf(o.context) == digest, "a state that is refused changes nothing");
  Demand(is_sealed || status == TPA_E_DATA || status == TPA_E_CONFIG || status == TPA_E_LIMIT,
         "a damaged state is refused");
  return false;
}

void CallWrongly(Bytes& in, const Owner& o) {
  if (in.Once(2)) return CallWithWrongStructure(in, o);
  if (in.Once(2)) return CallWithout(nullptr, o, in);
  Block foreign(4096, 64);
  std::memset(foreign.get(), in.Byte(), foreign.bytes());
  CallWithout(reinterpret_cast<tpa_context*>(foreign.get()), o, in);
}

uint64_t WrongCalls() { return wrong_calls; }

}  // namespace fuzz
