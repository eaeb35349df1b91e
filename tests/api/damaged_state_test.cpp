// SPDX-License-Identifier: MIT
// tpa_restore on damaged streams: refused, with all as before, or taken as a sound state, byte for byte. Damage whose
// hash has been made right again included.
#include "support/evolution.h"

namespace damaged_state_test {
namespace {

using namespace support;

constexpr size_t header_bytes = 108;

bool Ascends(const std::vector<uint32_t>& list, uint32_t most) {
  for (size_t i = 0; i < list.size(); ++i)
    if (list[i] >= most || (i > 0 && list[i] <= list[i - 1])) return false;
  return true;
}

// Each vertex has an edge of its own; maps lead into the mesh and back; lists of vertices ascend.
void ExpectConsistent(const tpa_context* context, const Bytes& bytes, const std::string& what) {
  const Mesh m = MeshOf(context);
  const uint32_t count = VertexCount(m);
  const std::vector<uint32_t> old_to_new = OldToNewOf(context);
  const std::vector<tpa_vertex_origin> origins = VertexOriginsOf(context);
  const size_t old = old_to_new.size();
  for (uint32_t v = 0; v < count; ++v) {
    const uint64_t edge = NumberAt(bytes, header_bytes + 24 * size_t{count} + 4 * size_t{v}, 4);
    ASSERT_LT(edge, m.triangles.size()) << what;
    EXPECT_EQ(m.triangles[edge], v) << what;
    const tpa_vertex_origin& o = origins[v];
    ASSERT_LT(o.parents[0], old) << what;
    EXPECT_TRUE(o.weight >= 0 && o.weight <= 1) << what;
    if (o.parents[1] == TPA_NONE)
      EXPECT_EQ(old_to_new[o.parents[0]], v) << what;
    else
      EXPECT_LT(o.parents[1], old) << what;
  }
  for (uint32_t u = 0; u < old; ++u) {
    if (old_to_new[u] == TPA_NONE) continue;
    ASSERT_LT(old_to_new[u], count) << what;
    EXPECT_EQ(origins[old_to_new[u]].parents[0], u) << what;
    EXPECT_EQ(origins[old_to_new[u]].parents[1], TPA_NONE) << what;
  }
  auto map = Sized<tpa_triangle_map_view>();
  ASSERT_EQ(tpa_triangle_map(context, &map), TPA_OK);
  for (uint32_t f : TriangleOriginsOf(context)) EXPECT_TRUE(f == TPA_NONE || f < map.old_count) << what;
  EXPECT_TRUE(Ascends(TargetsOf(context).vertices, count)) << what;
  const uint32_t* left = nullptr;
  uint32_t left_count = 0;
  ASSERT_EQ(tpa_rolled_back(context, &left, &left_count), TPA_OK);
  EXPECT_TRUE(Ascends({left, left + left_count}, count)) << what;
  for (const tpa_event& e : EventsOf(context)) EXPECT_TRUE(e.type >= TPA_EVENT_HANDLE && e.type <= TPA_EVENT_DEATH);
}

// Whatever has been restored is a closed manifold, saves itself, and serves validation, a step and an adaptation.
void ExpectSound(tpa_context* context, const Bytes& bytes, const std::string& what) {
  EXPECT_EQ(SavedFrom(context), bytes) << what;
  auto view = Sized<tpa_mesh_view>();
  if (tpa_view(context, &view) == TPA_E_STATE) return;
  EXPECT_EQ(TopologyOf(MeshOf(context)).defect, "") << what;
  ExpectConsistent(context, bytes, what);
  auto validation = Sized<tpa_validation>();
  tpa_issue issue;
  const auto serves = [&](tpa_status status) { return status == TPA_OK || status == TPA_E_LIMIT; };
  EXPECT_TRUE(serves(tpa_validate(context, nullptr, &validation, &issue))) << what << ": " << Text(issue);
  const tpa_status stepped = tpa_step(context, nullptr, nullptr, &issue);
  EXPECT_TRUE(serves(stepped) || stepped == TPA_E_TANGLED) << what << ": " << Text(issue);
  EXPECT_TRUE(serves(tpa_adapt(context, nullptr, nullptr, &issue))) << what << ": " << Text(issue);
  EXPECT_EQ(TopologyOf(MeshOf(context)).defect, "") << what;
}

struct Counts {
  uint32_t taken = 0, refused = 0;
};

class Victim {
 public:
  Victim(const tpa_config& config, const Mesh& mesh) : arena_(config, mesh), before_(SavedFrom(*arena_)) {}

  void Try(const Bytes& bytes, const std::string& what, Counts& counts) {
    tpa_issue issue;
    const tpa_status status = tpa_restore(*arena_, bytes.data(), bytes.size(), &issue);
    if (status != TPA_OK) {
      ++counts.refused;
      EXPECT_TRUE(status == TPA_E_DATA || status == TPA_E_CONFIG || status == TPA_E_LIMIT) << what << ": " << status;
      EXPECT_EQ(issue.status, status) << what;
      EXPECT_LE(issue.element, bytes.size()) << what;
      EXPECT_EQ(SavedFrom(*arena_), before_) << what << ": a refusal changed the state";
      return;
    }
    ++counts.taken;
    ExpectSound(*arena_, bytes, what);
    ASSERT_EQ(tpa_restore(*arena_, before_.data(), before_.size(), nullptr), TPA_OK) << what;
  }

 private:
  Arena arena_;
  Bytes before_;
};

Bytes BusyState(const std::string& name, tpa_config& config, Mesh& mesh) {
  for (const Evolution& e : Evolutions(2)) {
    if (e.name != name) continue;
    config = e.config;
    mesh = e.mesh;
    const Arena arena(e.config, e.mesh);
    Prepare(*arena, e, 0, 2);
    EXPECT_EQ(Call(*arena, 0).status, TPA_OK);
    EXPECT_EQ(MoveSome(*arena, {5, 2}, {1, 2, 3, 4, 5, 6}), TPA_OK);
    return SavedFrom(*arena);
  }
  ADD_FAILURE() << "no evolution is called " << name;
  return {};
}

// ---------------------------------------------------------------- damage without a right hash

TEST(DamagedState, EachFlippedBitIsFound) {
  const Mesh m = Sphere({}, 1, 2);
  Victim victim(ConfigFor(m), m);
  const Arena saved(ConfigFor(m), m);
  ASSERT_EQ(MoveSome(*saved, {5}, {1, 2, 3}), TPA_OK);
  const Bytes whole = SavedFrom(*saved);
  Counts counts;
  for (size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    Bytes bytes = whole;
    bytes[bit / 8] = static_cast<uint8_t>(bytes[bit / 8] ^ 1 << bit % 8);
    victim.Try(bytes, "bit " + std::to_string(bit), counts);
  }
  EXPECT_EQ(counts.taken, 0u);
}

TEST(DamagedState, OfAnyOtherLengthIsRefused) {
  const Mesh m = Sphere({}, 1, 2);
  Victim victim(ConfigFor(m), m);
  const Bytes whole = SavedFrom(*Arena(ConfigFor(m), m));
  Counts counts;
  for (size_t size = 0; size < whole.size() + 9; ++size) {
    if (size == whole.size()) continue;
    Bytes bytes = whole;
    bytes.resize(size);
    bytes.shrink_to_fit();
    if (size == 0) bytes.reserve(1);
    victim.Try(bytes, std::to_string(size) + " bytes", counts);
    if (size < header_bytes + 8) continue;
    SetNumber(bytes, 44, 8, size);
    Seal(bytes);
    victim.Try(bytes, std::to_string(size) + " bytes, as the header says", counts);
  }
  EXPECT_EQ(counts.taken, 0u);
}

TEST(DamagedState, SaysWhatIsWrong) {
  const Mesh m = Sphere({}, 1, 2);
  const Arena arena(ConfigFor(m), m);
  const Bytes whole = SavedFrom(*arena);
  const auto fault = [&](const Bytes& bytes, size_t size) {
    tpa_issue issue;
    EXPECT_EQ(tpa_restore(*arena, bytes.data(), size, &issue), TPA_E_DATA);
    return issue;
  };
  Bytes newer = whole;
  newer[8] = 2;
  Seal(newer);
  EXPECT_EQ(fault(newer, newer.size()).element, 8u);
  EXPECT_EQ(fault(newer, newer.size()).needed, 2u);
  EXPECT_EQ(fault(newer, newer.size()).available, 1u);
  EXPECT_EQ(fault(whole, whole.size() - 40).element, whole.size() - 40);
  EXPECT_EQ(fault(whole, whole.size() - 40).needed, whole.size());
  Bytes foreign = whole;
  foreign[0] = 'X';
  EXPECT_EQ(fault(foreign, foreign.size()).element, 0u);
  Bytes damaged = whole;
  damaged[header_bytes] ^= 1;
  EXPECT_EQ(fault(damaged, damaged.size()).element, whole.size() - 8) << "the hash";
  Bytes infinite = whole;
  SetNumber(infinite, header_bytes + 24 * 3 + 8, 8, 0x7FF0000000000000u);
  Seal(infinite);
  const tpa_issue issue = fault(infinite, infinite.size());
  EXPECT_EQ(issue.element, header_bytes + 24 * 3) << "vertex 3";
  EXPECT_EQ(Text(issue), "not a saved state of this version, or damaged: byte " + std::to_string(issue.element));
}

// ---------------------------------------------------------------- damage with a right hash

TEST(DamagedState, EachWordOfASmallStateWithARightHash) {
  const Mesh m = Sphere({}, 1, 1);
  Victim victim(ConfigFor(m), m);
  const Arena saved(ConfigFor(m), m);
  ASSERT_EQ(MoveSome(*saved, {1, 4}, {1, 2, 3, 4, 5, 6}), TPA_OK);
  const Bytes whole = SavedFrom(*saved);
  Counts counts;
  for (size_t at = 0; at + 8 < whole.size(); at += 4) {
    const uint64_t word = NumberAt(whole, at, 4);
    for (uint64_t value : {uint64_t{0}, uint64_t{1}, word + 1, word - 1, word ^ 0x80000000u, uint64_t{0x7FF80000},
                           uint64_t{0xFFFFFFFF}, uint64_t{VertexCount(m)}, uint64_t{3 * TriangleCount(m)}}) {
      Bytes bytes = whole;
      SetNumber(bytes, at, 4, value & 0xFFFFFFFF);
      Seal(bytes);
      victim.Try(bytes, "word at " + std::to_string(at) + " is " + std::to_string(value), counts);
    }
  }
  EXPECT_GT(counts.taken, 40u);
  EXPECT_GT(counts.refused, 500u);
}

// Words written over by others of the stream, or changed a little.
TEST(DamagedState, BusyStatesWithARightHash) {
  Counts counts;
  for (const char* name : {"coinciding", "three-spindles", "ball-noise"}) {
    tpa_config config{};
    Mesh mesh;
    const Bytes whole = BusyState(name, config, mesh);
    config.max_pieces = 1 << 12;
    Victim victim(config, Sphere({}, 1, 2));
    Random random(7);
    for (int round = 0; round < 150; ++round) {
      Bytes bytes = whole;
      const uint64_t words = whole.size() / 4 - 2;
      for (uint64_t changes = 1 + random() % 3; changes > 0; --changes) {
        const size_t to = 4 * (random() % words), from = 4 * (random() % words);
        const uint64_t word =
            random() % 2 == 0 ? NumberAt(whole, from, 4) : NumberAt(whole, to, 4) ^ 1u << random() % 32;
        SetNumber(bytes, to, 4, word);
      }
      Seal(bytes);
      victim.Try(bytes, std::string(name) + ", round " + std::to_string(round), counts);
    }
  }
  EXPECT_GT(counts.taken, 40u);
  EXPECT_GT(counts.refused, 100u);
}

}  // namespace
}  // namespace damaged_state_test
