// SPDX-License-Identifier: MIT
// Calls of the whole header in random order, each in a random floating-point environment and on random threads. A copy
// of the context does the same call at ease, and must come to the same bits.
#include <cstring>

#include "blocks.h"
#include "commit_judge.h"
#include "deed_source.h"
#include "target.h"
#include "tool/result.h"

namespace fuzz {

namespace {

struct Counts {
  uint64_t inputs = 0, deeds = 0, done = 0, limits = 0, cut_short = 0;
} counts;
Judged judged;

void DemandSame(const Outcome& a, const Outcome& b, const Host& host, const std::string& what) {
  const std::string both = what + ": " + Text(a) + "; " + Text(b);
  Demand(a.status == b.status, "the same status of ", both);
  Demand(a.digest == b.digest, "the same state after ", both);
  if (host.asks_nothing) return;
  Demand(std::memcmp(&a.issue, &b.issue, sizeof a.issue) == 0, "the same issue of ", both);
  Demand(std::memcmp(&a.report, &b.report, sizeof a.report) == 0, "the same report of ", both);
}

// Digests of the state before a call; tpa_remesh and tpa_smooth may discard targets even where they fail.
struct State {
  uint64_t digest, without_targets;
  State(const Deed& deed, const Owner& o) : digest(DigestOf(o.context)), without_targets(digest) {
    if (deed.kind != DeedKind::remesh && deed.kind != DeedKind::smooth) return;
    const Owner copy = Copied(o);
    Demand(tpa_drop_targets(copy.context) == TPA_OK, "targets are dropped");
    without_targets = DigestOf(copy.context);
  }
};

void DemandUnchanged(const Deed& deed, const Outcome& o, const State& before) {
  Demand(o.digest == before.digest || o.digest == before.without_targets,
         "a failure changes nothing: ", NameOf(deed.kind), ", ", Text(o));
}

class Player {
 public:
  explicit Player(Bytes in) : in_(in), now_(Made(ConfigFrom(in_))) {}

  void Play() {
    while (in_.size > 0) Perform();
  }

 private:
  void Perform() {
    Host host = HostFrom(in_);
    const Before before(now_.context);
    const Deed deed = DeedFrom(in_, before.mesh);
    const State state(deed, now_);
    const Owner twin = Copied(now_), spare = Copied(now_);
    const Outcome at_ease = Do(deed, twin.context), o = Do(deed, now_.context, host);
    Trace(NameOf(deed.kind) + ": " + Text(at_ease));
    DemandSame(at_ease, o, host, NameOf(deed.kind) + " in another environment");
    if (IsWork(deed.kind)) CutShort(deed, host, at_ease, state, spare.context);
    ++counts.deeds;
    if (o.status == TPA_OK) {
      ++counts.done;
      JudgeMesh(now_.context, judged);
      is_proper_ = IsProper(deed.kind, at_ease);
      if (IsCommit(deed.kind)) JudgeCommit(deed, before, at_ease, is_proper_, now_.context, judged);
    } else {
      DemandUnchanged(deed, o, state);
    }
    counts.limits += o.status == TPA_E_LIMIT ? 1u : 0u;
    if (in_.Once(4)) JudgeDetection(now_.context, host, judged);
  }

  // A budget that suffices does not matter, a smaller one fails the call; so does a call that is cancelled.
  void CutShort(const Deed& deed, Host host, const Outcome& at_ease, const State& before, tpa_context* context) {
    if (host.tasks == Host::no_exec || at_ease.units == 0) return;
    if (in_.Once(4)) host.cancels_at = in_.Below(4);
    if (in_.Once(2)) host.budget = in_.Once(2) ? at_ease.units : 1 + in_.Wide() % at_ease.units;
    const Outcome o = Do(deed, context, host);
    const std::string call = NameOf(deed.kind) + " with a budget or a flag: ";
    const bool is_too_little = host.budget != 0 && host.budget < at_ease.units;
    if (o.status == TPA_E_CANCELLED && host.cancels_at != TPA_NONE) {
      ++counts.cut_short;
      DemandUnchanged(deed, o, before);
    } else if (is_too_little) {
      ++counts.cut_short;
      Demand(
          o.status == TPA_E_BUDGET && o.units == host.budget && (host.asks_nothing || o.issue.available == host.budget),
          "a budget of ", host.budget, " of ", at_ease.units, " fails the call: ", call, Text(o));
      DemandUnchanged(deed, o, before);
    } else {
      DemandSame(at_ease, o, host, call);
      Demand(o.units == at_ease.units, "the same units of work, ", o.units, " for ", at_ease.units, ": ", call);
    }
  }

  // A body inside out stays, from tpa_load to tpa_adapt.
  bool IsProper(DeedKind kind, const Outcome& o) const {
    if (kind == DeedKind::load || kind == DeedKind::reset) return false;
    return kind == DeedKind::adapt ? o.report.unresolved == 0 : is_proper_;
  }

  Bytes in_;
  Owner now_;
  bool is_proper_ = false;  // free of self-intersections, with winding numbers 0 and 1 only
};

}  // namespace

std::string Tally() {
  return tool::text_of(counts.inputs, " inputs, ", counts.deeds, " deeds, ", counts.done, " done, ", counts.limits,
                       " out of room, ", counts.cut_short, " cut short; judged: ", judged.meshes, " meshes, ",
                       judged.pairs, " pairs, ", judged.events, " events, ", judged.made_vertices, " new vertices, ",
                       judged.regions, " regions");
}

bool ReachedEnough(uint64_t inputs) { return judged.regions > inputs && judged.events > inputs; }

}  // namespace fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  ++fuzz::counts.inputs;
  fuzz::Player(fuzz::Bytes{data, size}).Play();
  return 0;
}
