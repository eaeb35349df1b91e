// SPDX-License-Identifier: MIT
#include "support/evolve_family.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "oracle/ball_union.h"
#include "support/support.h"
#include "tool/topology.h"

namespace support {

namespace {

// The library's own judgement of its present mesh.
std::string FaultByValidation(const tool::Surface& surface) {
  auto v = Sized<tpa_validation>();
  tpa_issue issue;
  const tpa_status status = tpa_validate(surface.context(), nullptr, &v, &issue);
  if (status != TPA_OK) return tool::describe(issue);
  if (v.self_intersections > 0) return tool::text_of(v.self_intersections, " self-intersections");
  return {};
}

std::string Listed(const std::vector<long>& genera) {
  std::string text = "{";
  for (const long g : genera) text += tool::text_of(text.size() > 1 ? " " : "", g);
  return text + "}";
}

std::string EndFault(const tool::Scene& scene, const std::vector<tool::Part>& parts) {
  if (scene.end) {
    std::vector<long> genera;
    for (const tool::Part& p : parts) genera.push_back(p.genus);
    std::sort(genera.begin(), genera.end());
    if (genera != scene.end->genera) return "genera " + Listed(genera) + " instead of " + Listed(scene.end->genera);
  }
  double volume = 0;
  for (const tool::Part& p : parts) volume += p.volume;
  if (scene.volume > 0 && std::fabs(volume / scene.volume - 1) > scene.volume_tolerance)
    return tool::text_of("volume ", volume, " instead of ", scene.volume);
  return {};
}

std::string UnionFault(const tool::BallUnion& balls, const std::vector<tool::Part>& parts, bool& undecided) {
  const auto wanted = BettiOfUnion(balls.centers, balls.radius, balls.margin);
  undecided = !wanted;
  if (!wanted) return {};
  Betti found{0, 0, 0};
  for (const tool::Part& p : parts) {
    ++(p.volume > 0 ? found.components : found.voids);
    found.tunnels += p.genus;
  }
  if (found == *wanted) return {};
  return tool::text_of("components, tunnels, voids ", found.components, " ", found.tunnels, " ", found.voids,
                       " instead of ", wanted->components, " ", wanted->tunnels, " ", wanted->voids);
}

double WindingAround(const Point& p, const tool::TriangleMesh& m, const std::vector<uint32_t>& name, uint32_t but) {
  double sum = 0;
  for (size_t f = 0; f < TriangleCount(m); ++f)
    if (name[m.triangles[3 * f]] != but) sum += SolidAngle(m, f, p);
  return sum;
}

}  // namespace

std::string RegionFault(const tool::TriangleMesh& m) {
  const Topology topology = TopologyOf(m);
  if (!topology.defect.empty()) return topology.defect;
  if (topology.components.size() == 1)
    return topology.components[0].volume > 0 ? "" : "the only component is turned inside out";
  // Components by their smallest vertices: names spread along edges until nothing changes.
  std::vector<uint32_t> name(VertexCount(m));
  for (uint32_t v = 0; v < name.size(); ++v) name[v] = v;
  for (bool changed = true; changed;) {
    changed = false;
    for (size_t f = 0; f < m.triangles.size(); f += 3) {
      const uint32_t* c = &m.triangles[f];
      const uint32_t least = std::min({name[c[0]], name[c[1]], name[c[2]]});
      for (size_t i = 0; i < 3; ++i) {
        changed = changed || name[c[i]] != least;
        name[c[i]] = least;
      }
    }
  }
  for (const Component& c : topology.components) {
    const double outside = WindingAround(PositionOf(m, c.smallest_vertex), m, name, c.smallest_vertex);
    if (std::lround(outside) != (c.volume > 0 ? 0 : 1))
      return tool::text_of("the component of vertex ", c.smallest_vertex, ", of ", c.vertices, " vertices and volume ",
                           c.volume, ", lies where the others wind round it ", std::lround(outside), " times");
  }
  return {};
}

namespace {

// Faults independent of the scene.
std::string FaultOfPlay(const Verdict& verdict) {
  if (std::string fault = FaultOf(verdict.mesh); !fault.empty()) return fault;
  if (verdict.evolution.longest_stall <= 1) return {};
  return tool::text_of(verdict.evolution.longest_stall, " steps in a row with vertices that stayed behind");
}

Verdict Faulty(Verdict verdict, std::string fault) {
  verdict.ending = Ending::wrong, verdict.fault = std::move(fault);
  return verdict;
}

Verdict PlayAndJudge(const tool::Scene& scene, const tool::EvolutionOptions& options) {
  Verdict verdict;
  tool::Surface surface;
  std::string fault;
  const tool::Status played = tool::evolve(
      scene, options,
      [&](const tool::Surface& now, const tool::Evolution& e) {
        fault = FaultByValidation(now);
        if (!fault.empty()) fault = tool::text_of("step ", e.steps, ": ", fault);
        return fault.empty();
      },
      surface, verdict.evolution);
  verdict.mesh = surface.copy();
  if (!played) fault = tool::text_of("step ", verdict.evolution.steps + 1, ": ", played.message);
  if (fault.empty()) fault = FaultOfPlay(verdict);
  if (!fault.empty()) return Faulty(verdict, fault);
  if (!tool::end_is_known(scene, options, verdict.evolution)) {
    verdict.ending = Ending::clean;
    return verdict;
  }
  if (fault = RegionFault(verdict.mesh); !fault.empty()) return Faulty(verdict, fault);
  const std::vector<tool::Part> parts = tool::parts_of(verdict.mesh);
  bool undecided = false;
  verdict.fault = EndFault(scene, parts);
  if (verdict.fault.empty() && scene.balls) verdict.fault = UnionFault(*scene.balls, parts, undecided);
  verdict.ending = !verdict.fault.empty() ? Ending::wrong : undecided ? Ending::near_critical : Ending::right;
  return verdict;
}

}  // namespace

Verdict Judge(const tool::Scene& scene, const tool::EvolutionOptions& options) {
  Verdict verdict = PlayAndJudge(scene, options);
  if (verdict.ending == Ending::wrong) verdict.fault += "; " + Written(verdict.mesh, scene.name);
  return verdict;
}

std::string Play::Command() const {
  std::string text = tool::text_of("topoadapt evolve ", kind, " --seed ", seed);
  if (renumber > 0) text += tool::text_of(" --renumber ", renumber);
  if (turn > 0) text += tool::text_of(" --turn ", turn);
  if (stride > 0) text += tool::text_of(" --stride ", stride);
  return substeps ? text : text + " --no-substeps";
}

Verdict Judge(const Play& play) {
  tool::Scene scene;
  if (const tool::Status made = tool::make_scene(play.kind, play.seed, scene); !made) return Faulty({}, made.message);
  if (play.renumber > 0) scene = tool::renumbered(scene, play.renumber);
  if (play.turn > 0) scene = tool::turned(scene, play.turn);
  tool::EvolutionOptions options;
  options.stride = play.stride;
  options.substeps = play.substeps;
  return Judge(scene, options);
}

FamilyResult JudgeFamily(Play play, uint32_t seeds, Pose pose) {
  FamilyResult result;
  for (const uint64_t end = play.seed + seeds; play.seed < end; ++play.seed) {
    if (pose == Pose::renumbered) play.renumber = play.seed;
    if (pose == Pose::turned) play.turn = 1 + static_cast<int>(5 * play.seed % 23);
    const Verdict v = Judge(play);
    ++result.played;
    result.seconds += v.evolution.seconds.total;
    switch (v.ending) {
      case Ending::right: ++result.right; break;
      case Ending::clean: ++result.clean; break;
      case Ending::near_critical: ++result.near_critical; break;
      default: result.failures.push_back({play.Command(), v.fault});
    }
  }
  return result;
}

}  // namespace support
