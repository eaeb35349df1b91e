// SPDX-License-Identifier: MIT
#include "support/region_trial.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "oracle/region_columns.h"
#include "oracle/region_topology.h"
#include "support/resolve_trial.h"

namespace support {

namespace {

std::string Percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f %%", 100 * share);
  return text;
}

struct Tolerance {
  double volume, difference;
};

constexpr Tolerance plain{0.001, 0.002}, touching{0.005, 0.01};

bool IsWithin(const RegionDifference& d, const Tolerance& t) {
  return std::fabs(d.VolumeError()) <= t.volume && d.Lost() + d.Gained() <= t.difference;
}
bool IsClear(const RegionDifference& d, const Tolerance& t) {
  const double most = std::max(std::fabs(d.VolumeError()) / t.volume, (d.Lost() + d.Gained()) / t.difference);
  return most < 0.3 || most > 10;
}

RegionVerdict Wrong(RegionVerdict v, std::string reason) {
  v.outcome = Outcome::wrong;
  v.reason = std::move(reason);
  return v;
}

RegionVerdict Refused(std::string reason) { return {Outcome::refused, std::move(reason)}; }

struct Call {
  tpa_status status;
  tpa_issue issue;
};

Call Adapt(const tpa_config& config, const Mesh& given, RegionTrial& trial) {
  trial.report = Sized<tpa_report>();
  Call call{};
  const Arena arena(config, given);
  const auto start = std::chrono::steady_clock::now();
  call.status = tpa_adapt(*arena, nullptr, &trial.report, &call.issue);
  trial.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  trial.result = MeshOf(*arena);
  return call;
}

tpa_config Doubled(tpa_config config) {
  for (uint32_t* limit : {&config.max_vertices, &config.max_contacts, &config.max_cut_edges, &config.max_events})
    *limit *= 2;
  return config;
}

bool AreSame(const Mesh& a, const Mesh& b) { return a.positions == b.positions && a.triangles == b.triangles; }

}  // namespace

RegionVerdict JudgeRegion(const FieldFamily& family, const Mesh& given, const Mesh& result, uint64_t seed) {
  RegionVerdict v;
  const Topology topology = TopologyOf(result);
  if (!topology.defect.empty()) return Wrong(v, topology.defect);
  const size_t meeting = AllMeetingPairs(result).size();
  if (meeting > 0) return Wrong(v, std::to_string(meeting) + " pairs meet, and none is counted");
  const TopologyVerdict t = JudgeTopology(given, result, topology, family.cells);
  v.topology_judged = t.judged;
  const Tolerance tolerance = family.touches && t.touches ? touching : plain;
  RegionDifference d = CompareRegions(given, result, 1500, seed);
  if (!IsClear(d, tolerance)) d = CompareRegions(given, result, 30000, seed);
  v.volume_error = d.VolumeError(), v.lost = d.Lost(), v.gained = d.Gained();
  if (!IsWithin(d, tolerance))
    return Wrong(v, "volume " + Percent(d.VolumeError()) + " off, " + Percent(d.Lost()) + " lost, " +
                        Percent(d.Gained()) + " gained");
  if (!d.is_plain) return Wrong(v, "winding numbers beyond 0 and 1");
  if (!t.right) return Wrong(v, t.reason);
  return v;
}

RegionTrial TryToAdapt(const Mesh& given) {
  RegionTrial trial;
  tpa_config config = GenerousConfig(given);
  Call call = Adapt(config, given, trial);
  for (int more = 0; call.status == TPA_E_LIMIT && more < 3; ++more) {
    config = Doubled(config);
    call = Adapt(config, given, trial);
  }
  if (call.status != TPA_OK && !AreSame(given, trial.result))
    trial.verdict = Wrong({}, Text(call.issue) + ", but the mesh has changed");
  else if (call.status != TPA_OK)
    trial.verdict = Refused(Text(call.issue));
  else if (trial.report.unresolved > 0)
    trial.verdict = AllMeetingPairs(trial.result).size() == trial.report.unresolved
                        ? Refused(std::to_string(trial.report.unresolved) + " unresolved")
                        : Wrong({}, "other contacts are left than counted");
  return trial;
}

RegionTrial TryRegion(const FieldFamily& family, const Mesh& given, uint64_t seed) {
  RegionTrial trial = TryToAdapt(given);
  if (trial.verdict.outcome == Outcome::right) trial.verdict = JudgeRegion(family, given, trial.result, seed);
  return trial;
}

}  // namespace support
