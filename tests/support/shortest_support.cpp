#include "support/shortest_support.h"

#include "triangulate/four_in_order.h"
#include "triangulate/three_in_order.h"

namespace shortest_support {

namespace {

using tpa::u32;

template <class LoopsOfLibrary>
LoopsOfLibrary InputOf(const Loops& loops, bool filtered) {
  LoopsOfLibrary input;
  input.points = loops.points.data();
  if (filtered) input.filter.ask = AskIsFree<tpa::HandleFace>;
  for (size_t l = 0; l < loops.sides.size(); ++l) input.first[l + 1] = input.first[l] + u32(loops.sides[l]);
  return input;
}

Found FindThree(const Loops& loops, u32 wanted, double limit, tpa::u64 work, bool filtered) {
  const auto input = InputOf<tpa::ThreeLoops>(loops, filtered);
  const int longest = *std::max_element(loops.sides.begin(), loops.sides.end());
  std::vector<double> scratch(tpa::three_scratch_bytes(u32(longest), u32(loops.mu)) / sizeof(double) + 1);
  const auto bytes = reinterpret_cast<tpa::u8*>(scratch.data());
  Found found;
  std::vector<tpa::ThreeHandle> best(wanted);
  best.resize(tpa::shortest_of_three(input, limit, work, bytes, {best.data(), wanted}, found.complete));
  std::vector<tpa::HandleFace> faces(size_t(loops.Faces()));
  for (const tpa::ThreeHandle& handle : best) {
    tpa::write_three(input, handle, bytes, faces.data());
    Handle list;
    for (const tpa::HandleFace& f : faces) list.push_back({int(f.v[0]), int(f.v[1]), int(f.v[2])});
    found.handles.push_back(handle_support::Normal(list)), found.lengths.push_back(handle.length);
  }
  return found;
}

Found FindFour(const Loops& loops, u32 wanted, double limit, tpa::u64 work, bool filtered) {
  const auto input = InputOf<tpa::ShortLoops>(loops, filtered);
  const tpa::u64 bytes = tpa::four_scratch_bytes(input, wanted);
  std::vector<double> room(bytes / sizeof(double));
  tpa::ShortestScratch scratch;
  Found found;
  EXPECT_TRUE(tpa::lay_out_four(input, wanted, reinterpret_cast<tpa::u8*>(room.data()), bytes, scratch));
  EXPECT_EQ(scratch.found.best.size, wanted);
  const u32 count = tpa::shortest_of_four(input, limit, work, scratch, found.complete);
  std::vector<tpa::HandleFace> faces(size_t(loops.Faces()));
  for (u32 n = 0; n < count; ++n) {
    tpa::write_four(input, scratch.found, n, faces.data());
    Handle list;
    for (const tpa::HandleFace& f : faces) list.push_back({int(f.v[0]), int(f.v[1]), int(f.v[2])});
    found.handles.push_back(handle_support::Normal(list)), found.lengths.push_back(scratch.found.best[n].length);
  }
  return found;
}

}  // namespace

Found Find(const Loops& loops, u32 wanted, double limit, tpa::u64 work, bool filtered) {
  return loops.sides.size() == 3 ? FindThree(loops, wanted, limit, work, filtered)
                                 : FindFour(loops, wanted, limit, work, filtered);
}

}  // namespace shortest_support
