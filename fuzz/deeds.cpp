// SPDX-License-Identifier: MIT
#include "deeds.h"

#include <atomic>
#include <cstddef>
#include <numeric>
#include <thread>

#include "blocks.h"
#include "padded.h"
#include "target.h"
#include "tool/result.h"
#include "tool/surface.h"

namespace fuzz {

Host HostFrom(Bytes& in) {
  static const std::vector<support::HostEnvironment> environments = support::HostEnvironments();
  Host host;
  host.environment = environments[in.Below(static_cast<uint32_t>(environments.size()))];
  host.tasks = static_cast<decltype(host.tasks)>(in.Below(6));
  host.unknown_bytes = 4 * in.Below(17);
  host.asks_nothing = in.Once(8);
  host.has_old_exec = in.Once(4);
  return host;
}

bool IsWork(DeedKind kind) { return kind >= DeedKind::adapt; }
bool IsCommit(DeedKind kind) { return IsWork(kind) || kind == DeedKind::load || kind == DeedKind::reorder; }

std::string NameOf(DeedKind kind) {
  static const char* const names[] = {"load",  "move", "drop_targets", "reset",  "reorder",
                                      "adapt", "step", "advance",      "remesh", "smooth"};
  return names[static_cast<size_t>(kind)];
}

std::string Text(const Outcome& o) {
  char text[256];
  tpa_issue_text(&o.issue, text, sizeof text);
  return tool::text_of(tpa_status_string(o.status), " (", text, "), digest ", o.digest, ", ", o.units, " units");
}

namespace {

using Task = void (*)(void* data, uint32_t index);

// The tasks of a call, in the order or on the threads of a host.
struct Tasks {
  const Host& host;
  std::atomic<bool> is_changed = false;
  uint32_t calls = 0;
  int32_t is_cancelled = host.cancels_at == 0 ? 1 : 0;

  void Some(uint32_t first, uint32_t by, uint32_t count, Task task, void* data) {
    const support::Hosted hosted(host.environment);
    for (uint32_t i = first; i < count; i += by) task(data, i);
    if (!hosted.Unchanged()) is_changed = true;
  }
  static void Run(void* user, uint32_t count, Task task, void* data) {
    Tasks& t = *static_cast<Tasks*>(user);
    if (++t.calls == t.host.cancels_at) t.is_cancelled = 1;
    switch (t.host.tasks) {
      case Host::backwards:
        for (uint32_t i = count; i-- > 0;) task(data, i);
        return;
      case Host::shuffled:
        // Each index once: 7919 has no factor in common with a count below it, or takes the indices in turn.
        for (uint32_t i = 0; i < count; ++i) task(data, count < 7919 ? i * 7919u % count : i);
        return;
      case Host::two_threads: {
        std::thread other([&] { t.Some(1, 2, count, task, data); });
        t.Some(0, 2, count, task, data);
        other.join();
        return;
      }
      default:
        for (uint32_t i = 0; i < count; ++i) task(data, i);
    }
  }
};

// The structures of a call.
struct Call {
  const Deed& deed;
  const Host& host;
  Tasks tasks{host};
  std::vector<float> floats{};
  Padded<tpa_mesh_input> mesh{tpa_mesh_input{}, 0};
  Padded<tpa_move_input> move{tpa_move_input{}, 0};
  Padded<tpa_remesh_options> remesh{tpa_remesh_options{}, 0};
  Padded<tpa_smooth_options> smooth{tpa_smooth_options{}, 0};
  Padded<tpa_exec> exec{tpa_exec{}, 0};
  Padded<tpa_report> report{tpa_report{}, 0};
  tpa_issue issue{};
  uint64_t units = 0;

  Call(const Deed& d, const Host& h) : deed(d), host(h) {
    mesh = {tool::input_of(deed.mesh), host.unknown_bytes};
    tpa_move_input to{};
    to.count = deed.count;
    to.position_type = deed.as_floats ? TPA_FLOAT32 : TPA_FLOAT64;
    const std::vector<double>& numbers = deed.kind == DeedKind::load ? deed.mesh.positions : deed.positions;
    if (deed.as_floats) floats.assign(numbers.begin(), numbers.end());
    to.positions = deed.as_floats ? static_cast<const void*>(floats.data()) : deed.positions.data();
    to.vertices = deed.ids.empty() ? nullptr : deed.ids.data();
    move = {to, host.unknown_bytes};
    if (deed.as_floats) {
      mesh.get()->position_type = TPA_FLOAT32;
      mesh.get()->positions = floats.data();
    }
    SetOptions();
    tpa_exec threads{};
    threads.flags = host.flags;
    threads.user = &tasks;
    threads.parallel_for = host.tasks == Host::no_tasks ? nullptr : Tasks::Run;
    threads.budget = host.budget;
    threads.cancel = &tasks.is_cancelled;
    threads.progress = &units;
    exec = {threads, host.unknown_bytes};
    if (host.has_old_exec) ShortenExec();
    report = {tpa_report{}, host.unknown_bytes};
  }
  Call(const Call&) = delete;

  // Nothing beyond may be read.
  void ShortenExec() {
    tpa_exec& e = *exec.get();
    e.struct_size = offsetof(tpa_exec, budget);
    e.budget = 1;
    e.cancel = reinterpret_cast<const int32_t*>(uintptr_t{8});
    e.progress = reinterpret_cast<uint64_t*>(uintptr_t{8});
  }

  void SetOptions() {
    tpa_remesh_options r{};
    r.iterations = deed.iterations;
    r.target_length = deed.length;
    r.split_ratio = deed.split_ratio;
    r.collapse_ratio = deed.collapse_ratio;
    r.relaxation = deed.relaxation;
    remesh = {r, host.unknown_bytes};
    tpa_smooth_options s{};
    s.iterations = deed.iterations;
    s.count = deed.count;
    s.vertices = deed.ids.empty() ? nullptr : deed.ids.data();
    smooth = {s, host.unknown_bytes};
  }

  tpa_status Run(tpa_context* context) {
    const tpa_exec* how = host.tasks == Host::no_exec ? nullptr : exec.get();
    tpa_report* told = host.asks_nothing ? nullptr : report.get();
    tpa_issue* why = host.asks_nothing ? nullptr : &issue;
    switch (deed.kind) {
      case DeedKind::load: return tpa_load(context, mesh.get(), why);
      case DeedKind::move: return tpa_move(context, move.get(), why);
      case DeedKind::drop_targets: return tpa_drop_targets(context);
      case DeedKind::reset: return tpa_reset(context);
      case DeedKind::reorder: return tpa_reorder(context, why);
      case DeedKind::adapt: return tpa_adapt(context, how, told, why);
      case DeedKind::step: return tpa_step(context, how, told, why);
      case DeedKind::advance: return tpa_advance(context, deed.length, how, told, why);
      case DeedKind::remesh: return tpa_remesh(context, remesh.get(), how, told, why);
      case DeedKind::smooth: return tpa_smooth(context, smooth.get(), how, told, why);
    }
    return TPA_E_ARGUMENT;
  }
};

}  // namespace

Outcome Do(const Deed& deed, tpa_context* context, const Host& host) {
  Call call(deed, host);
  Outcome o;
  bool is_unchanged = false;
  {
    const support::Hosted hosted(host.environment);
    o.status = call.Run(context);
    is_unchanged = hosted.Unchanged();
  }
  Demand(is_unchanged && !call.tasks.is_changed,
         "the environment of the caller is as before " + NameOf(deed.kind) + ", " + host.environment.name);
  if (!host.asks_nothing) {
    o.issue = call.issue;
    if (IsWork(deed.kind)) o.report = call.report.Value();
    Demand(deed.kind == DeedKind::drop_targets || deed.kind == DeedKind::reset || o.issue.status == o.status,
           "the issue of " + NameOf(deed.kind) + " has the status returned");
  }
  o.digest = DigestOf(context);
  o.units = call.units;
  return o;
}

}  // namespace fuzz
