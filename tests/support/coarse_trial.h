// SPDX-License-Identifier: MIT
// coarse_trial: one, three or all vertices of a coarse body move by .3 to 3 of its mean edges in one tpa_step. Columns
// of rays judge the result, not the report: the region may change by a small share of the components that meet, or by a
// thin layer over the faces in contact (P3), or the step holds vertices back.
#pragma once

#include <string>
#include <vector>

#include "support/step_noise.h"

namespace support {

constexpr double coarse_share = 0.01;    // of the volume of the components that meet
constexpr double coarse_closing = 0.03;  // c: the layer's thickness in mean edges of the faces in contact

struct CoarseFamily {
  std::string name;
  Mesh (*body)(Random& random);
  uint32_t moving;  // vertices that move; 0: all
};
inline void PrintTo(const CoarseFamily& family, std::ostream* out) { *out << family.name; }
const std::vector<CoarseFamily>& CoarseFamilies();

struct CoarseTrial {
  Step step;
  bool meets = false;    // the moved mesh has contacts
  double volume = 0;     // of the components that meet, or of all if none does, before the step
  double allowed = 0;    // volume that the region may change; 0 without contacts
  double changed = 0;    // volume of the symmetric difference, by columns
  double error = 0;      // of `changed`: three standard deviations, and rounding
  double told = 0;       // by the report: lost and gained
  double held_back = 0;  // share of the vertices
  std::string fault;     // P1 broken, a refusal that changes the mesh, or a part inside out
  bool Refuses() const { return step.status != TPA_OK; }
  bool HoldsBack() const { return held_back > 0; }
  bool IsJudged() const { return !Refuses() && fault.empty(); }
  bool IsBeyond() const { return IsJudged() && changed - error > allowed; }
  bool IsOver() const { return IsBeyond() && !HoldsBack(); }
  bool TellsLess() const { return IsJudged() && !HoldsBack() && told < changed - error; }
  double Share() const { return volume > 0 ? changed / volume : 0; }
};

CoarseTrial PlayCoarse(const CoarseFamily& family, uint64_t seed);

}  // namespace support
