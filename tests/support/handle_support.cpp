// SPDX-License-Identifier: MIT
#include "support/handle_support.h"

#include <gtest/gtest.h>

#include <utility>

#include "support/share.h"

namespace handle_support {

Sides SidesOf(const tpa::HandleKey& key) { return {key.sides, key.sides + key.k}; }
tpa::HandleKey Key(const Sides& sides) {
  tpa::HandleKey key;
  key.k = static_cast<tpa::u32>(sides.size());
  for (size_t i = 0; i < sides.size(); ++i) key.sides[i] = static_cast<tpa::u32>(sides[i]);
  return key;
}

std::vector<Sides> PortionOfKeys(int k, size_t part, size_t parts) {
  const std::vector<Sides> keys = Keys(k, 60, 15);
  EXPECT_EQ(keys.size(), k == 2 ? 91u : k == 3 ? 455u : 1820u);
  std::vector<Sides> portion;
  for (size_t i = part; i < keys.size(); i += parts * support::Stride(20)) portion.push_back(keys[i]);
  return portion;
}

namespace {
Handle FromLibrary(const std::vector<tpa::FaceCorners>& faces) {
  Handle h;
  for (const tpa::FaceCorners& f : faces)
    h.push_back({static_cast<int>(f.v[0]), static_cast<int>(f.v[1]), static_cast<int>(f.v[2])});
  return Normal(std::move(h));
}
}  // namespace

Handle Get(const tpa::HandleKey& key, tpa::u64 index) {
  std::vector<tpa::FaceCorners> faces(tpa::handle_face_count(key));
  EXPECT_TRUE(tpa::handle_get(key, index, {faces.data(), static_cast<tpa::u32>(faces.size())}));
  return FromLibrary(faces);
}

Handle GetGenerator(const tpa::HandleKey& key, tpa::u32 g) {
  std::vector<tpa::FaceCorners> faces(tpa::handle_face_count(key));
  EXPECT_TRUE(tpa::generator_get(key, g, {faces.data(), static_cast<tpa::u32>(faces.size())}));
  return FromLibrary(faces);
}

std::set<Handle> Expand(const tpa::HandleKey& key) {
  std::set<Handle> all;
  const tpa::u64 count = tpa::handle_count(key);
  for (tpa::u64 i = 0; i < count; ++i) all.insert(Get(key, i));
  EXPECT_EQ(all.size(), count) << Name(SidesOf(key));
  return all;
}

}  // namespace handle_support
