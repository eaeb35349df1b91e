// SPDX-License-Identifier: MIT
// meter: the work of a call, counted in units while it goes on. A unit takes some 10 to 60 ns on a desktop processor,
// wherever it is spent. Counts depend on the state and the arguments only, never on time, threads or addresses. So a
// budget in units ends a call at the same place everywhere.
#pragma once

#include "base/base.h"

namespace tpa {

enum class Stop : u8 { no, budget, cancelled };

// Many functions take a pointer to a meter; nullptr: nobody counts.
struct Meter {
  u64 spent = 0;
  u64 budget = UINT64_MAX;
  const i32* cancel = nullptr;  // of the caller; not zero ends the call
  u64* progress = nullptr;      // of the caller; receives `spent` now and then
  u64 next_look = 0;            // look() when so much is spent
  u64 needed = 0;               // enough for the same call, where known: only the end of all work showed the excess
  u64 aside = 0;                // of the budget, for the end of the call: other work stops before
  bool keeps = false;           // at the end of the budget, the call commits what is done (TPA_EXEC_KEEP)
  Stop stop = Stop::no;         // once set, work must end soon, and the call fails
};

// Compares with the budget, reads the caller's flag, writes the progress.
void look(Meter& m);

inline void spend(Meter* m, u64 units) {
  if (m == nullptr) return;
  m->spent += units;
  if (m->spent >= m->next_look) look(*m);
}

inline bool has_stopped(const Meter* m) { return m != nullptr && m->stop != Stop::no; }

// ---------------------------------------------------------------- calls that keep what is done

inline u64 spent_by(const Meter* m) { return m != nullptr ? m->spent : 0; }
inline bool keeps_done(const Meter* m) { return m != nullptr && m->keeps; }

// Sets so much of the budget aside in place of the units set aside before, in such a call. Work that stopped at more
// units set aside may go on.
void set_aside(Meter* m, u64 units);
// Does the rest of the budget hold so many units, in such a call? Work that cannot stop in its middle asks first.
inline bool can_afford(const Meter* m, u64 units) {
  return !keeps_done(m) || m->budget == UINT64_MAX || m->spent + m->aside + units <= m->budget;
}

// Counts the last work of a call, all other work being done. False if it is too much.
[[nodiscard]] bool end_within_budget(Meter* m, u64 last = 0);

// Writes the progress at the end of a call: at most the budget.
void report_progress(const Meter& m);

// ---------------------------------------------------------------- parts of the work, by tasks at the same time

// A part starts with all of the budget that is left, so its own end cannot depend on other parts. Nor can the outcome:
// a part that stops has spent more than all parts may together.
Meter begin_part(const Meter* whole);

// Adds what a part has spent.
void end_part(Meter* whole, u64 spent, Stop stop);

}  // namespace tpa
