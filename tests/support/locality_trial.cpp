// SPDX-License-Identifier: MIT
#include "support/locality_trial.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "support/mixed_seed.h"

namespace support {

namespace {

// ---------------------------------------------------------------- a call

struct Call {
  Mesh mesh;
  std::vector<uint32_t> moving;
  std::vector<double> targets;  // of `moving`
  bool adapts = false;
  uint32_t first_near = 0, near_count = 0;  // ids of the scene
  double limit = std::numeric_limits<double>::infinity();
};

void AddTargets(const Mesh& m, const std::vector<double>& to, uint32_t base, bool all, Call& call) {
  for (uint32_t v = 0; 3 * size_t{v} < to.size(); ++v) {
    if (!all && std::equal(&to[3 * size_t{v}], &to[3 * size_t{v}] + 3, &m.positions[3 * size_t{v}])) continue;
    call.moving.push_back(base + v);
    call.targets.insert(call.targets.end(), &to[3 * size_t{v}], &to[3 * size_t{v}] + 3);
  }
}

Call CallOf(const NearScene& near, const Beside& beside) {
  Call call;
  call.adapts = near.adapts;
  call.near_count = VertexCount(near.mesh);
  call.limit = beside.limit;
  call.mesh = beside.comes_first ? Together({beside.mesh, near.mesh}) : Together({near.mesh, beside.mesh});
  if (beside.comes_first) call.first_near = VertexCount(beside.mesh);
  if (near.adapts) return call;
  AddTargets(near.mesh, near.targets, call.first_near, beside.all_targets, call);
  AddTargets(beside.mesh, beside.targets, beside.comes_first ? 0 : call.near_count, true, call);
  return call;
}

// ---------------------------------------------------------------- what is seen of the scene

using Bits = std::vector<uint64_t>;

uint64_t BitsOf(double x) {
  uint64_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

void Add(const double* p, Bits& bits) {
  for (int i = 0; i < 3; ++i) bits.push_back(BitsOf(p[i]));
}

struct Seen {
  tpa_status status = TPA_OK;
  Mesh result;
  std::vector<Bits> faces, face_origins, vertex_origins, held_back;  // sorted
  std::vector<Bits> placed_events, other_events;                     // sorted; those with a place, and all others
  tpa_report report{};
};

// Bits of a face, from its least corner on.
Bits BitsOfFace(const Mesh& m, uint32_t f) {
  Bits best;
  for (uint32_t first = 0; first < 3; ++first) {
    Bits bits;
    for (uint32_t i = 0; i < 3; ++i) Add(&m.positions[3 * size_t{m.triangles[3 * f + (first + i) % 3]}], bits);
    if (best.empty() || bits < best) best = bits;
  }
  return best;
}

uint64_t NearId(uint32_t id, uint32_t first) { return id == TPA_NONE ? TPA_NONE : id - first; }

class Look {
 public:
  Look(tpa_context* context, const Call& call, Seen& seen)
      : context_(context), call_(call), first_face_(0), seen_(seen) {}
  void All(uint32_t first_face) {
    first_face_ = first_face;
    seen_.result = MeshOf(context_);
    Faces();
    Vertices();
    Events();
    for (auto* list : {&seen_.faces, &seen_.face_origins, &seen_.vertex_origins, &seen_.held_back, &seen_.placed_events,
                       &seen_.other_events})
      std::sort(list->begin(), list->end());
  }

 private:
  bool IsNear(uint32_t v) const { return seen_.result.positions[3 * size_t{v} + 2] < call_.limit; }

  void Faces() {
    const std::vector<uint32_t> origins = TriangleOriginsOf(context_);
    for (uint32_t f = 0; f < TriangleCount(seen_.result); ++f) {
      if (!IsNear(seen_.result.triangles[3 * f])) continue;
      seen_.faces.push_back(BitsOfFace(seen_.result, f));
      Bits origin = seen_.faces.back();
      origin.push_back(NearId(origins[f], first_face_));
      seen_.face_origins.push_back(origin);
    }
  }

  void Vertices() {
    const std::vector<tpa_vertex_origin> origins = VertexOriginsOf(context_);
    for (uint32_t v = 0; v < VertexCount(seen_.result); ++v) {
      if (!IsNear(v)) continue;
      Bits bits;
      Add(&seen_.result.positions[3 * size_t{v}], bits);
      for (const uint32_t p : origins[v].parents) bits.push_back(NearId(p, call_.first_near));
      bits.push_back(BitsOf(static_cast<double>(origins[v].weight)));
      seen_.vertex_origins.push_back(bits);
    }
    const uint32_t* kept = nullptr;
    uint32_t count = 0;
    EXPECT_EQ(tpa_rolled_back(context_, &kept, &count), TPA_OK);
    for (uint32_t i = 0; i < count; ++i) {
      if (!IsNear(kept[i])) continue;
      Bits bits;
      Add(&seen_.result.positions[3 * size_t{kept[i]}], bits);
      seen_.held_back.push_back(bits);
    }
  }

  // Components before the commit have ids of the scene or not; so have components after, by their places.
  bool IsOfNear(const tpa_event& e) const {
    if (e.before != TPA_NONE) return e.before - call_.first_near < call_.near_count;
    return e.after != TPA_NONE && IsNear(e.after);
  }

  void Events() {
    for (const tpa_event& e : EventsOf(context_)) {
      Bits bits{static_cast<uint64_t>(e.type), e.amount};
      const bool has_place = e.type == TPA_EVENT_HANDLE || e.type == TPA_EVENT_CAP || e.type == TPA_EVENT_ROLLBACK;
      if (has_place) {
        Add(e.position, bits);
        if (e.position[2] < call_.limit) seen_.placed_events.push_back(bits);
      } else if (e.type == TPA_EVENT_REMOVAL) {
        seen_.other_events.push_back(bits);
      } else if (IsOfNear(e)) {
        bits.push_back(NearId(e.before, call_.first_near));
        seen_.placed_events.push_back(bits);
      }
    }
  }

  tpa_context* context_;
  const Call& call_;
  uint32_t first_face_;
  Seen& seen_;
};

Seen Run(const Call& call, const tpa_config& config, uint32_t first_face) {
  const Arena arena(config, call.mesh);
  Seen seen;
  seen.report = Sized<tpa_report>();
  if (!call.adapts) {
    EXPECT_EQ(MoveSome(*arena, call.moving, call.targets), TPA_OK);
  }
  seen.status = call.adapts ? tpa_adapt(*arena, nullptr, &seen.report, nullptr)
                            : tpa_step(*arena, nullptr, &seen.report, nullptr);
  Look(*arena, call, seen).All(first_face);
  return seen;
}

// ---------------------------------------------------------------- comparison

struct Field {
  const char* name;
  uint32_t tpa_report::*count;
};

constexpr Field counts[] = {{"contacts", &tpa_report::contacts},
                            {"groups", &tpa_report::groups},
                            {"caps", &tpa_report::caps},
                            {"removed_patches", &tpa_report::removed_patches},
                            {"rolled_back_vertices", &tpa_report::rolled_back_vertices},
                            {"unresolved", &tpa_report::unresolved}};

std::string Numbers(const char* name, double alone, double beside) {
  char text[128];
  std::snprintf(text, sizeof text, "report: %s %.17g alone, %.17g beside", name, alone, beside);
  return text;
}

// Volumes of bodies of about the size 1 are rounded where they lie 1000 away.
bool IsNearlySum(double sum, double a, double b) { return std::fabs(sum - (a + b)) <= 1e-9 * (a + b) + 1e-10; }

// Volumes of all bodies: the scene's, and those beside.
std::string RegionsBeside(const tpa_report& a, double before, double after, const tpa_report& b) {
  if (!IsNearlySum(b.region_before, a.region_before, before))
    return Numbers("region_before", a.region_before + before, b.region_before);
  if (!IsNearlySum(b.region_after, a.region_after, after))
    return Numbers("region_after", a.region_after + after, b.region_after);
  return "";
}

// Beside bodies without contacts, of this volume.
std::string ReportBesideIdle(const tpa_report& a, double volume, const tpa_report& b) {
  for (const Field& f : counts)
    if (a.*f.count != b.*f.count) return Numbers(f.name, a.*f.count, b.*f.count);
  if (a.passes != b.passes) return Numbers("passes", a.passes, b.passes);
  for (size_t k = 0; k < 4; ++k)
    if (a.handles[k] != b.handles[k]) return Numbers("handles", a.handles[k], b.handles[k]);
  if (BitsOf(a.region_lost) != BitsOf(b.region_lost)) return Numbers("region_lost", a.region_lost, b.region_lost);
  if (BitsOf(a.region_gained) != BitsOf(b.region_gained))
    return Numbers("region_gained", a.region_gained, b.region_gained);
  if (BitsOf(a.region_reach) != BitsOf(b.region_reach)) return Numbers("region_reach", a.region_reach, b.region_reach);
  return RegionsBeside(a, volume, volume, b);
}

// Beside bodies with contacts of their own, whose report alone is `other`. Passes are those of all bodies together.
std::string ReportBesideActive(const tpa_report& a, const tpa_report& other, const tpa_report& b) {
  for (const Field& f : counts)
    if (a.*f.count + other.*f.count != b.*f.count) return Numbers(f.name, a.*f.count + other.*f.count, b.*f.count);
  for (size_t k = 0; k < 4; ++k)
    if (a.handles[k] + other.handles[k] != b.handles[k])
      return Numbers("handles", a.handles[k] + other.handles[k], b.handles[k]);
  if (!IsNearlySum(b.region_lost, a.region_lost, other.region_lost))
    return Numbers("region_lost", a.region_lost + other.region_lost, b.region_lost);
  if (!IsNearlySum(b.region_gained, a.region_gained, other.region_gained))
    return Numbers("region_gained", a.region_gained + other.region_gained, b.region_gained);
  const double reach = std::max(a.region_reach, other.region_reach);
  if (reach != b.region_reach) return Numbers("region_reach", reach, b.region_reach);
  return RegionsBeside(a, other.region_before, other.region_after, b);
}

std::string DifferenceOf(const Seen& a, const Seen& b, bool is_active) {
  if (a.status != b.status) return "status " + std::to_string(a.status) + " alone, " + std::to_string(b.status);
  if (a.faces != b.faces)
    return "mesh: " + std::to_string(a.faces.size()) + " faces alone, " + std::to_string(b.faces.size()) + " beside";
  if (a.vertex_origins != b.vertex_origins || a.face_origins != b.face_origins) return "origins";
  if (a.held_back != b.held_back) return "held back";
  if (a.placed_events != b.placed_events || (!is_active && a.other_events != b.other_events)) return "events";
  return "";
}

tpa_config ConfigOf(uint32_t vertices) {
  tpa_config config = DefaultConfig(4 * vertices + 1024);
  config.max_contacts = 16 * vertices + 4096;
  config.max_cut_edges = 4 * vertices + 1024;
  config.max_events = vertices + 256;
  return config;
}

std::string Compare(const NearScene& scene, const Seen& alone, const Beside& beside, Mesh& result) {
  const Call call = CallOf(scene, beside);
  const tpa_config config = ConfigOf(VertexCount(call.mesh));
  const Seen seen = Run(call, config, beside.comes_first ? TriangleCount(beside.mesh) : 0);
  result = seen.result;
  std::string what = DifferenceOf(alone, seen, beside.is_active);
  if (!what.empty() || alone.status != TPA_OK) return what;
  if (!beside.is_active) return ReportBesideIdle(alone.report, TopologyOf(beside.mesh).Volume(), seen.report);
  const NearScene other{beside.mesh, beside.targets, scene.adapts};
  const Seen others = Run(CallOf(other, {}), ConfigOf(VertexCount(other.mesh)), 0);
  return others.status == TPA_OK ? ReportBesideActive(alone.report, others.report, seen.report) : "";
}

Seen Alone(const NearScene& scene) { return Run(CallOf(scene, {}), ConfigOf(VertexCount(scene.mesh)), 0); }

}  // namespace

std::string DifferenceBeside(const NearScene& scene, const Beside& beside) {
  Mesh result;
  return Compare(scene, Alone(scene), beside, result);
}

LocalityTrial PlayLocality(const NearFamily& family, uint64_t seed, size_t most) {
  Random random(MixedSeed(family.name, seed));
  LocalityTrial trial;
  trial.scene = family.make(random);
  const Seen alone = Alone(trial.scene);
  trial.meets = alone.report.contacts > 0;
  std::vector<BesideKind> kinds = BesideKinds();
  for (size_t i = 0; i < most && i < kinds.size(); ++i) std::swap(kinds[i], kinds[i + random() % (kinds.size() - i)]);
  for (size_t i = 0; i < std::min(most, kinds.size()); ++i) {
    Random of_kind(MixedSeed(kinds[i].name, seed));
    const Beside beside = kinds[i].make(trial.scene, of_kind);
    Mesh result;
    const std::string what = Compare(trial.scene, alone, beside, result);
    if (!what.empty()) trial.differences.push_back({kinds[i].name, what, alone.result, result});
    trial.played.push_back(kinds[i].name);
  }
  return trial;
}

}  // namespace support
