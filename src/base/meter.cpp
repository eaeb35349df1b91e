// SPDX-License-Identifier: MIT
#include "base/meter.h"

namespace tpa {

namespace {

// Some tenth of a millisecond.
constexpr u64 between_looks = 4096;

// Another thread may read the progress at any time; on small processors possibly halves of two values.
void write_progress(u64* to, u64 spent) {
#if TPA_SMALL
  *static_cast<volatile u64*>(to) = spent;
#else
  __atomic_store_n(to, spent, __ATOMIC_RELAXED);
#endif
}

}  // namespace

void look(Meter& m) {
  const u64 usable = m.budget - min_of(m.aside, m.budget);
  if (m.stop == Stop::no) {
    if (m.spent > usable)
      m.stop = Stop::budget;
    else if (m.cancel != nullptr && __atomic_load_n(m.cancel, __ATOMIC_RELAXED) != 0)
      m.stop = Stop::cancelled;
  }
  report_progress(m);
  const u64 last = m.budget == UINT64_MAX ? UINT64_MAX : usable + 1;
  m.next_look = m.stop != Stop::no ? UINT64_MAX : min_of(m.spent + between_looks, last);
}

void set_aside(Meter* m, u64 units) {
  if (!keeps_done(m) || m->budget == UINT64_MAX) return;
  if (m->stop == Stop::budget) {
    // Tasks stop at counts that depend on their order, all beyond what was usable, so this counts.
    m->spent = min_of(m->spent, m->budget - min_of(m->aside, m->budget));
    m->stop = Stop::no;
  }
  m->aside = units;
  look(*m);
}

bool end_within_budget(Meter* m, u64 last) {
  if (m == nullptr) return true;
  if (m->stop != Stop::no) return false;
  m->spent += last;
  look(*m);
  if (m->stop == Stop::budget) m->needed = m->spent;
  return m->stop == Stop::no;
}

void report_progress(const Meter& m) {
  if (m.progress != nullptr) write_progress(m.progress, min_of(m.spent, m.budget));
}

Meter begin_part(const Meter* whole) {
  Meter part;
  if (whole == nullptr) return part;
  if (whole->budget != UINT64_MAX) part.budget = whole->budget - min_of(whole->spent + whole->aside, whole->budget);
  part.cancel = whole->cancel;
  part.stop = whole->stop;
  return part;
}

void end_part(Meter* whole, u64 spent, Stop stop) {
  if (whole == nullptr) return;
  spend(whole, spent);
  if (stop == Stop::cancelled && whole->stop == Stop::no) whole->stop = Stop::cancelled;
}

}  // namespace tpa
