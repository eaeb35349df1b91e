// SPDX-License-Identifier: MIT
// Calls of the whole header in random order, each in a random floating-point environment and on random threads. A copy
// of the context does the same call at ease, and must come to the same bits.
#include <algorithm>
#include <cstring>
#include <map>

#include "blocks.h"
#include "commit_judge.h"
#include "deed_source.h"
#include "growing.h"
#include "oracle/mesh_oracle.h"
#include "target.h"
#include "tool/result.h"
#include "wrong_calls.h"

namespace fuzz {

namespace {

struct Counts {
  uint64_t inputs = 0, deeds = 0, done = 0, limits = 0, cut_short = 0, kept = 0, roomy = 0, grown = 0, saved = 0,
           rewound = 0, again = 0;
} counts;
Judged judged;

void DemandSame(const Outcome& a, const Outcome& b, const Host& host, const std::string& what) {
  const std::string both = what + ": " + Text(a) + "; " + Text(b);
  Demand(a.status == b.status, "the same status of ", both);
  Demand(a.digest == b.digest, "the same state after ", both);
  // tpa_issue tells more of a tangle where there is room for its pairs.
  if (host.asks_nothing || a.status == TPA_E_TANGLED) return;
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

// Of triangles that meet, a chain of pairs from each to each: no fewer than islands.
size_t GroupsInContact(const Mesh& m) {
  std::map<uint32_t, uint32_t> next;  // towards the lowest of a group
  const auto lowest = [&](uint32_t f) {
    while (next.at(f) != f) f = next.at(f);
    return f;
  };
  for (const auto& [f, g] : support::AllMeetingPairs(m)) {
    next.emplace(f, f), next.emplace(g, g);
    const uint32_t a = lowest(f), b = lowest(g);
    next[std::max(a, b)] = std::min(a, b);
  }
  return static_cast<size_t>(
      std::count_if(next.begin(), next.end(), [](const auto& n) { return n.first == n.second; }));
}

class Player {
 public:
  explicit Player(Bytes in) : in_(in), size_(in.size), now_(Made(ConfigFrom(in_))) {}

  void Play() {
    while (in_.size > 0) switch (in_.Below(16)) {
        case 0: now_ = Copied(now_); break;
        case 1: Grow(); break;
        case 2: Save(); break;
        case 3: Rewind(); break;
        case 4:
          if (DamageState(in_, now_, saved_.bytes)) Forget();
          break;
        case 5: CallWrongly(in_, now_); break;
        default: Perform();
      }
  }

 private:
  void Perform() {
    const Host host = HostFrom(in_);
    const Before before(now_.context);
    const Deed deed = DeedFrom(in_, before.mesh);
    if (!IsJudged(performed_++, size_)) return PerformAlone(deed, host);
    const State state(deed, now_);
    const Owner twin = Copied(now_), spare = Copied(now_);
    const Outcome at_ease = Do(deed, twin.context), o = Do(deed, now_.context, host);
    Trace(NameOf(deed.kind) + ": " + Text(at_ease));
    DemandSame(at_ease, o, host, NameOf(deed.kind) + " in another environment");
    if (IsWork(deed.kind)) CutShort(deed, host, at_ease, state, spare, before);
    ++counts.deeds;
    if (o.status == TPA_OK) {
      ++counts.done;
      JudgeMesh(now_.context, judged);
      is_proper_ = IsProper(deed.kind, at_ease);
      if (IsCommit(deed.kind)) JudgeCommit(deed, before, at_ease, is_proper_, now_.context, judged);
    } else {
      DemandUnchanged(deed, o, state);
    }
    if (o.status == TPA_E_LIMIT) {
      ++counts.limits;
      if (IsCommit(deed.kind)) FollowLimits(deed, spare, before.moved);
    } else if (IsWork(deed.kind) && in_.Once(4)) {
      ++counts.roomy;
      const Owner roomy = Grown(spare, Ample(ConfigOf(spare.context)));
      if (roomy.context != nullptr) DemandSame(at_ease, Do(deed, roomy.context), {}, "a call with more room");
    }
    if (!saved_.bytes.empty()) log_.push_back({deed, at_ease});
    if (in_.Once(4)) JudgeDetection(now_.context, host, judged);
  }

  // Without a twin and without judges. Bytes mean the same as with them.
  void PerformAlone(const Deed& deed, const Host& host) {
    const Outcome o = Do(deed, now_.context, host);
    Trace(NameOf(deed.kind) + " alone: " + Text(o));
    ++counts.deeds;
    counts.done += o.status == TPA_OK ? 1 : 0;
    if (IsWork(deed.kind) && host.tasks != Host::no_exec) {
      if (in_.Once(4)) in_.Below(4);
      if (in_.Once(2) && !in_.Once(2)) in_.Wide();
    }
    // Without a report nobody knows what is left.
    if (o.status == TPA_OK) is_proper_ = !host.asks_nothing && IsProper(deed.kind, o);
    if (o.status != TPA_E_LIMIT && IsWork(deed.kind)) in_.Once(4);
    if (!saved_.bytes.empty()) log_.push_back({deed, o});
    in_.Once(4);
  }

  // Raises the limits named until the call has enough: the result is that of ample limits. An island meets a limit at
  // most twice.
  void FollowLimits(const Deed& deed, const Owner& before, const Mesh& moved) {
    tpa_config config = ConfigOf(before.context);
    uint32_t times[TPA_LIMIT_SUBSTEPS + 1] = {};
    for (;;) {
      const Owner raised = Grown(before, config);
      const Outcome o = Do(deed, raised.context);
      if (o.status != TPA_E_LIMIT) {
        const Owner roomy = Grown(before, Ample(config));
        const Outcome with_room = Do(deed, roomy.context);
        if (with_room.status != TPA_E_LIMIT) DemandSame(o, with_room, {}, NameOf(deed.kind) + " with limits as named");
        return;
      }
      Demand(o.issue.limit > 0 && o.issue.limit <= TPA_LIMIT_SUBSTEPS && o.issue.needed > o.issue.available,
             "a limit is named: ", Text(o));
      // By the hash the passes first know a part of the contacts; each sub-step has wants of its own.
      const bool goes_on = deed.kind == DeedKind::advance;
      const uint32_t most = (config.detect_mode == TPA_DETECT_COMPLETE ? 2 : 12) * (goes_on ? most_substeps : 1);
      Demand(++times[o.issue.limit] <= most || times[o.issue.limit] <= most * GroupsInContact(moved),
             "the amount named is enough: ", NameOf(deed.kind), ", ", Text(o));
      if (o.issue.needed > (o.issue.limit == TPA_LIMIT_SUBSTEPS ? most_substeps : most_elements)) return;
      LimitOf(config, o.issue.limit) = static_cast<uint32_t>(o.issue.needed);
    }
  }

  void Grow() {
    tpa_config config = ConfigOf(now_.context);
    if (in_.Once(4)) {
      const tpa_config other = ConfigFrom(in_);
      Forget();
      config = other;
    } else {
      ChangeLimits(in_, config);
    }
    const uint64_t digest = DigestOf(now_.context), fields = FieldsOf(config);
    const bool keeps_fields = fields == FieldsOf(ConfigOf(now_.context));
    Owner grown = Grown(now_, config);
    if (grown.context == nullptr) return;  // the state does not fit
    Demand(!keeps_fields || DigestOf(grown.context) == digest, "tpa_grow carries the whole state");
    ++counts.grown;
    Trace("grown");
    now_ = std::move(grown);
  }

  void Save() {
    Trace("saved");
    saved_ = {StateOf(now_.context), DigestOf(now_.context), is_proper_};
    log_.clear();
    ++counts.saved;
  }

  void Forget() {
    is_proper_ = false;
    saved_ = {};
    log_.clear();
  }

  // Goes back to the saved state, and does again what has been done since.
  void Rewind() {
    if (saved_.bytes.empty()) return;
    const uint64_t digest = DigestOf(now_.context);
    tpa_issue issue;
    const tpa_status status = tpa_restore(now_.context, saved_.bytes.data(), saved_.bytes.size(), &issue);
    if (status == TPA_E_LIMIT) {
      Demand(DigestOf(now_.context) == digest, "a tpa_restore out of room changes nothing");
      return;
    }
    Outcome told;
    told.status = status;
    told.issue = issue;
    told.digest = DigestOf(now_.context);
    Demand(status == TPA_OK && told.digest == saved_.digest, "a saved state is restored: ", Text(told));
    is_proper_ = saved_.is_proper;
    ++counts.rewound;
    Trace("rewound");
    for (const Done& done : log_) {
      const Outcome o = Do(done.deed, now_.context);
      Trace("again " + NameOf(done.deed.kind) + ": " + Text(o));
      if (o.status == TPA_OK) is_proper_ = IsProper(done.deed.kind, o);
      // Limits may have changed in between.
      if (o.status == TPA_E_LIMIT || done.outcome.status == TPA_E_LIMIT) break;
      Demand(o.status == done.outcome.status && o.digest == done.outcome.digest,
             "the same run again: ", NameOf(done.deed.kind), ", ", Text(done.outcome), "; ", Text(o));
      ++counts.again;
    }
    saved_ = {};
    log_.clear();
  }

  // A budget that suffices does not matter, a smaller one fails the call; so does a call that is cancelled.
  void CutShort(const Deed& deed, Host host, const Outcome& at_ease, const State& before, const Owner& start,
                const Before& given) {
    if (host.tasks == Host::no_exec || at_ease.units == 0) return;
    host.has_old_exec = false;
    if (in_.Once(4)) host.cancels_at = in_.Below(4);
    if (in_.Once(2)) {
      const uint64_t wide = in_.Once(2) ? at_ease.units - 1 : in_.Wide();
      host.budget = 1 + wide % at_ease.units;
      if (wide / at_ease.units % 2 == 1) KeepDone(deed, host, before, start, given);
    }
    const Owner copy = Copied(start);
    const Outcome o = Do(deed, copy.context, host);
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
      // Nothing of the failed call is left, not even knowledge that bounds what the next call may do.
      host.budget = 0;
      host.cancels_at = TPA_NONE;
      DemandSame(at_ease, Do(deed, copy.context, host), host, NameOf(deed.kind) + " after a failed call: ");
    } else {
      DemandSame(at_ease, o, host, call);
      Demand(o.units == at_ease.units, "the same units of work, ", o.units, " for ", at_ease.units, ": ", call);
    }
  }

  // With TPA_EXEC_KEEP the call ends within its budget: with a sound mesh that the report tells the truth of, or
  // without any trace. Anybody's environment and threads come to the same bits.
  void KeepDone(const Deed& deed, Host host, const State& before, const Owner& start, const Before& given) {
    host.flags = TPA_EXEC_KEEP;
    host.cancels_at = TPA_NONE;
    host.asks_nothing = false;
    Host plain;
    plain.flags = host.flags;
    plain.budget = host.budget;
    const Owner copy = Copied(start), twin = Copied(start);
    const Outcome o = Do(deed, copy.context, host);
    const std::string call = NameOf(deed.kind) + " that keeps, budget " + std::to_string(host.budget);
    Trace(call + ": " + Text(o));
    DemandSame(Do(deed, twin.context, plain), o, host, call);
    Demand(o.units <= host.budget, "a budget is kept: ", call, ": ", Text(o));
    if (o.status != TPA_OK) return DemandUnchanged(deed, o, before);
    ++counts.kept;
    JudgeMesh(copy.context, judged);
    JudgeCommit(deed, given, o, IsProper(deed.kind, o), copy.context, judged);
  }

  // A body inside out stays, from tpa_load to tpa_adapt.
  bool IsProper(DeedKind kind, const Outcome& o) const {
    if (kind == DeedKind::load || kind == DeedKind::reset) return false;
    return kind == DeedKind::adapt ? o.report.unresolved == 0 : is_proper_;
  }

  struct Saved {
    std::vector<uint8_t> bytes{};
    uint64_t digest = 0;
    bool is_proper = false;
  };
  struct Done {
    Deed deed;
    Outcome outcome;
  };

  Bytes in_;
  uint64_t size_ = 0, performed_ = 0;
  Owner now_;
  Saved saved_;
  std::vector<Done> log_;   // since saved_
  bool is_proper_ = false;  // free of self-intersections, with winding numbers 0 and 1 only
};

}  // namespace

std::string Tally() {
  return tool::text_of(counts.inputs, " inputs, ", counts.deeds, " deeds, ", counts.done, " done, ", counts.limits,
                       " out of room, ", counts.cut_short, " cut short, ", counts.kept, " kept, ", counts.roomy,
                       " with more room, ", counts.grown, " grown, ", counts.saved, " saved, ", counts.rewound,
                       " rewound, ", counts.again, " again; judged: ", judged.meshes, " meshes, ", judged.pairs,
                       " pairs, ", judged.events, " events, ", judged.made_vertices, " new vertices, ", judged.regions,
                       " regions");
}

bool ReachedEnough(uint64_t inputs) { return judged.regions > inputs && judged.events > inputs; }

}  // namespace fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  ++fuzz::counts.inputs;
  fuzz::Player(fuzz::Bytes{data, size}).Play();
  return 0;
}
