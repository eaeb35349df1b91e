// SPDX-License-Identifier: MIT
// parallel: the caller's threads, or none. Work is cut into chunks with bounds that do not depend on the number of
// threads, so the bits of a result cannot depend on the number either. Nor on the floating-point environment of a
// thread, where the library can set it.
#pragma once

#include "base/float_environment.h"
#include "base/meter.h"

namespace tpa {

// A copy of the caller's tpa_exec; without parallel_for, work is serial. The meter counts the work of the call.
struct Exec {
  void* user = nullptr;
  void (*parallel_for)(void* user, u32 count, void (*task)(void* data, u32 index), void* data) = nullptr;
  Meter* meter = nullptr;
};

// Calls body(first, last) for consecutive ranges of `chunk` numbers (the last may be shorter) that cover 0 .. count
// - 1.
template <class Body>
void for_chunks(const Exec& exec, u32 count, u32 chunk, Body body) {
  struct Job {
    Body* body;
    u32 count, chunk;
  } job{&body, count, chunk};
  const u32 chunks = count / chunk + (count % chunk != 0 ? 1 : 0);
  static constexpr auto task = [](void* data, u32 index) {
    const Job& j = *static_cast<Job*>(data);
    const u32 first = index * j.chunk;
    (*j.body)(first, j.count - first < j.chunk ? j.count : first + j.chunk);
  };
  if (exec.parallel_for != nullptr && chunks > 1) {
    const auto on_any_thread = [](void* data, u32 index) {
      const FloatEnvironment environment;
      task(data, index);
    };
    exec.parallel_for(exec.user, chunks, on_any_thread, &job);
    return;
  }
  for (u32 i = 0; i < chunks; ++i) task(&job, i);
}

// The same in at most `most_runs` tasks, each with consecutive ranges of its own: body(run, first, last). For tasks
// with memory of their own, by the number of the run; without threads all is run 0.
template <class Body>
void for_runs(const Exec& exec, u32 count, u32 chunk, u32 most_runs, Body body) {
  const u32 chunks = count / chunk + (count % chunk != 0 ? 1 : 0);
  const u32 runs = exec.parallel_for != nullptr ? min_of(chunks, most_runs) : min_of(chunks, 1u);
  for_chunks(exec, runs, 1, [&](u32 run, u32) {
    const auto begin = [&](u32 of) { return static_cast<u32>(u64{chunks} * of / runs); };
    for (u32 i = begin(run); i < begin(run + 1); ++i) {
      const u32 first = i * chunk;
      body(run, first, count - first < chunk ? count : first + chunk);
    }
  });
}

inline constexpr u32 most_metered_runs = 32;

// The same with a meter for each run, as exec.meter: body(run, first, last, meter). Ranges are left out once it has
// stopped.
template <class Body>
void for_metered_runs(const Exec& exec, u32 count, u32 chunk, u32 most_runs, Body body) {
  u64 spent[most_metered_runs] = {};
  Stop stop[most_metered_runs] = {};
  const Meter whole = begin_part(exec.meter);
  for_runs(exec, count, chunk, min_of(most_runs, most_metered_runs), [&](u32 run, u32 first, u32 last) {
    if (exec.parallel_for == nullptr) {
      if (!has_stopped(exec.meter)) body(run, first, last, exec.meter);
      return;
    }
    Meter mine = whole;
    mine.spent = spent[run];
    mine.stop = max_of(whole.stop, stop[run]);
    if (has_stopped(&mine)) return;
    body(run, first, last, exec.meter != nullptr ? &mine : nullptr);
    spent[run] = mine.spent;
    stop[run] = mine.stop;
  });
  for (u32 run = 0; run < most_metered_runs; ++run) end_part(exec.meter, spent[run], stop[run]);
}

// The sum of part(first, last) over ranges that cover 0 .. count - 1, added in order. Ranges depend on `count` only, so
// the bits of the sum do not depend on threads. Up to 4096 numbers are one range.
template <class Part>
f64 sum_of_chunks(const Exec& exec, u32 count, Part part) {
  constexpr u32 least = 4096, most = 32;
  f64 parts[most] = {};
  const u32 chunk = least * (count / (least * most) + 1);
  for_chunks(exec, count, chunk, [&](u32 first, u32 last) { parts[first / chunk] = part(first, last); });
  f64 sum = 0;
  for (f64 one : parts) sum += one;
  return sum;
}

}  // namespace tpa
