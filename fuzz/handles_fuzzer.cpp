// SPDX-License-Identifier: MIT
// Handles: the database by the public functions against the criterion of section 4.1 and an oracle on the least sum of
// squares; and triangulations of loops with any coordinates, which must be consistent, different, and never longer at
// first than a handle of the database.
#include <map>
#include <set>

#include "blocks.h"
#include "bytes.h"
#include "oracle/handle_oracle.h"
#include "support/candidates_support.h"
#include "support/handle_support.h"
#include "target.h"

namespace fuzz {

namespace {

using namespace handle_support;

uint64_t keys = 0, listed = 0, counted = 0, refused = 0, searches = 0, candidates = 0;

constexpr uint32_t most_numbers = 3 * TPA_HANDLE_MAX_FACES;

std::vector<uint32_t> Unsigned(const Sides& sides) { return {sides.begin(), sides.end()}; }

Handle HandleOf(const uint32_t* faces, uint32_t count) {
  Handle h;
  for (uint32_t f = 0; f < count; ++f)
    h.push_back(
        {static_cast<int>(faces[3 * f]), static_cast<int>(faces[3 * f + 1]), static_cast<int>(faces[3 * f + 2])});
  return Normal(h);
}

// ---------------------------------------------------------------- the database

// Least sums of squares, and how many handles have it; found once for each key, of modest length only.
const handle_oracle::Minimum* MinimumFor(Sides sides) {
  static std::map<Sides, handle_oracle::Minimum> known;
  static const std::vector<handle_oracle::Plan> plans[5] = {
      {}, {}, {}, handle_oracle::PlansOf(3), handle_oracle::PlansOf(4)};
  std::sort(sides.rbegin(), sides.rend());
  const size_t k = sides.size();
  if (Mu(sides) > (k == 2 ? 30 : k == 3 ? 24 : 16)) return nullptr;
  const auto [found, is_new] = known.try_emplace(sides);
  if (is_new) found->second = handle_oracle::MinimumOf(plans[k], sides);
  return &found->second;
}

Handle Fetch(const std::vector<uint32_t>& sides, uint64_t index, uint32_t count) {
  uint32_t faces[most_numbers];
  const auto k = static_cast<uint32_t>(sides.size());
  Demand(tpa_handle_get(k, sides.data(), index, faces, 3 * count) == TPA_OK, "handle ", index, " is given");
  ++listed;
  return HandleOf(faces, count);
}

void JudgeHandle(const Handle& h, const Sides& sides, const tpa_handle_info& info,
                 const handle_oracle::Minimum* least) {
  const std::string fault = WhyNotSphere(h, sides);
  Demand(fault.empty(), "a consistent handle, but: ", fault);
  Demand(h.size() == info.faces && !HasChord(h, sides), "no edge inside a polygon");
  if (least == nullptr || info.complete == 0) return;
  Demand(SumOfSquares(h, Mu(sides)) == handle_oracle::SumOfSquares(sides, least->excess), "the least sum of squares");
}

void JudgeKey(Bytes& in) {
  Sides sides(2 + in.Below(3));
  const uint32_t longest = in.Once(2) ? 5 : TPA_HANDLE_MAX_SIDES;
  for (int& s : sides) s = static_cast<int>(TPA_HANDLE_MIN_SIDES + in.Below(longest - TPA_HANDLE_MIN_SIDES + 1));
  const std::vector<uint32_t> wanted = Unsigned(sides);
  const auto k = static_cast<uint32_t>(sides.size());
  auto info = Sized<tpa_handle_info>();
  Demand(tpa_handle_describe(k, wanted.data(), &info) == TPA_OK, "a key of the database is described");
  Demand(info.faces == static_cast<uint32_t>(Mu(sides)) + 2 * k - 4 && info.handles > 0, "faces of a handle");
  ++keys;
  const handle_oracle::Minimum* least = MinimumFor(sides);
  if (least != nullptr && info.complete != 0) {
    ++counted;
    Demand(info.handles == least->handles, info.handles, " handles of ", least->handles);
  }
  std::map<Handle, uint64_t> met;
  for (uint32_t i = 0; i < 4; ++i) {
    const uint64_t index = in.Wide() % info.handles;
    const Handle h = Fetch(wanted, index, info.faces);
    JudgeHandle(h, sides, info, least);
    Demand(met.try_emplace(h, index).first->second == index, "no handle has two numbers");
  }
  uint32_t faces[most_numbers];
  uint64_t orbit = 0;
  const uint32_t generator = in.Below(info.generators);
  Demand(tpa_handle_generator(k, wanted.data(), generator, faces, most_numbers, &orbit) == TPA_OK && orbit > 0 &&
             orbit <= GroupOrder(sides) && GroupOrder(sides) % orbit == 0,
         "a generator makes ", orbit, " handles");
  JudgeHandle(HandleOf(faces, info.faces), sides, info, least);
}

void JudgeWrongKey(Bytes& in) {
  uint32_t sides[6], faces[most_numbers];
  for (uint32_t& s : sides) s = in.Once(4) ? in.Below(0x7FFFFFFF) : in.Below(20);
  for (uint32_t& f : faces) f = 0xA5A5A5A5;
  const uint32_t k = in.Below(7);
  const uint64_t index = in.Wide();
  const uint32_t capacity = in.Below(most_numbers + 1);
  auto info = Sized<tpa_handle_info>();
  bool is_key = k >= 2 && k <= TPA_HANDLE_MAX_POLYGONS;
  for (uint32_t i = 0; is_key && i < k; ++i)
    is_key = sides[i] >= TPA_HANDLE_MIN_SIDES && sides[i] <= TPA_HANDLE_MAX_SIDES;
  Demand(tpa_handle_describe(k, sides, &info) == (is_key ? TPA_OK : TPA_E_ARGUMENT), "keys are known, others refused");
  const bool is_there = is_key && index < info.handles && capacity >= 3 * info.faces;
  Demand(tpa_handle_get(k, sides, index, faces, capacity) == (is_there ? TPA_OK : TPA_E_ARGUMENT), "so are handles");
  if (is_there) return;
  ++refused;
  for (uint32_t f : faces) Demand(f == 0xA5A5A5A5, "faces stay as they were");
}

// ---------------------------------------------------------------- loops in space

candidates_support::Loops LoopsFrom(Bytes& in) {
  candidates_support::Loops loops(1 + in.Below(6));
  const uint32_t longest = in.Once(8) ? 60 : 12;
  const bool is_on_grid = in.Once(2);
  for (auto& loop : loops) {
    loop.resize(3 + in.Below(longest));
    for (tpa::Vec3& p : loop)
      for (double* x : {&p.x, &p.y, &p.z}) *x = is_on_grid ? in.Below(4) : in.Around(4);
  }
  return loops;
}

// The shortest of all handles of the database; infinite beyond it.
double ShortestStored(const candidates_support::Loops& loops) {
  std::vector<uint32_t> sides;
  for (const auto& loop : loops) sides.push_back(static_cast<uint32_t>(loop.size()));
  auto info = Sized<tpa_handle_info>();
  double shortest = HUGE_VAL;
  if (tpa_handle_describe(static_cast<uint32_t>(sides.size()), sides.data(), &info) != TPA_OK) return shortest;
  for (uint64_t i = 0; i < info.handles && info.handles <= 2000; ++i) {
    uint32_t numbers[most_numbers];
    Demand(tpa_handle_get(static_cast<uint32_t>(sides.size()), sides.data(), i, numbers, most_numbers) == TPA_OK,
           "each handle is given");
    candidates_support::Faces faces(info.faces);
    for (uint32_t f = 0; f < info.faces; ++f)
      for (uint32_t c = 0; c < 3; ++c) faces[f].v[c] = numbers[3 * f + c];
    shortest = std::min(shortest, candidates_support::Length(loops, faces));
  }
  return shortest;
}

void JudgeLoops(Bytes& in) {
  candidates_support::Hindrance hindrance{in.Once(2) ? 10 + in.Below(60) : 0};
  tpa::CandidateOptions options;
  options.max_candidates = 1 + in.Below(64);
  if (hindrance.percent > 0) options.filter = {candidates_support::AskHindrance, &hindrance};
  candidates_support::Search search(LoopsFrom(in), options);
  const double stored = hindrance.percent == 0 ? ShortestStored(search.points) : HUGE_VAL;
  ++searches;
  std::set<Handle> met;
  for (candidates_support::Faces faces; search.Next(faces);) {
    const std::string fault = candidates_support::WhyNotConsistent(search.points, faces);
    Demand(fault.empty(), "a consistent triangulation of loops, but: ", fault);
    Handle h;
    for (const tpa::FaceCorners& f : faces)
      h.push_back({static_cast<int>(f.v[0]), static_cast<int>(f.v[1]), static_cast<int>(f.v[2])});
    const double length = candidates_support::Length(search.points, faces);
    if (met.empty()) Demand(length <= stored * (1 + 1e-12), "the shortest first: ", length, ", not ", stored);
    Demand(met.insert(Normal(h)).second, "no triangulation comes twice");
    ++candidates;
  }
  Demand(met.size() <= options.max_candidates * tpa::most_sources, "no more triangulations than wanted");
}

}  // namespace

std::string Tally() {
  return tool::text_of(keys, " keys, ", listed, " handles, ", counted, " keys counted, ", refused, " calls refused, ",
                       searches, " sets of loops, ", candidates, " triangulations");
}

bool ReachedEnough(uint64_t inputs) { return listed > inputs && counted > inputs / 8 && candidates > inputs; }

}  // namespace fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace fuzz;
  Bytes in{data, size};
  do {
    switch (in.Below(4)) {
      case 0:
      case 1: JudgeLoops(in); break;
      case 2: JudgeWrongKey(in); break;
      default: JudgeKey(in);
    }
  } while (in.size > 0);
  return 0;
}
