// SPDX-License-Identifier: MIT
// The handle database, as pure functions.
#include "api/api.h"
#include "handles/handles.h"

namespace tpa {

namespace {

bool read_key(u32 polygons, const u32* sides, HandleKey& key) {
  if (polygons < 2 || polygons > TPA_HANDLE_MAX_POLYGONS || sides == nullptr) return false;
  key.k = polygons;
  for (u32 i = 0; i < polygons; ++i) {
    if (sides[i] < TPA_HANDLE_MIN_SIDES || sides[i] > TPA_HANDLE_MAX_SIDES) return false;
    key.sides[i] = sides[i];
  }
  return true;
}

static_assert(sizeof(FaceCorners) == 3 * sizeof(u32));
static_assert(4 * TPA_HANDLE_MAX_SIDES + 2 * 4 - 4 == TPA_HANDLE_MAX_FACES);

Span<FaceCorners> as_faces(u32* numbers, u32 capacity) {
  return {reinterpret_cast<FaceCorners*>(numbers), capacity / 3};
}

}  // namespace

}  // namespace tpa

using namespace tpa;

extern "C" {

tpa_status tpa_handle_describe(uint32_t polygons, const uint32_t* sides, tpa_handle_info* info) {
  HandleKey key;
  if (check_struct(info) || !read_key(polygons, sides, key)) return TPA_E_ARGUMENT;
  write_struct({0, generator_count(key), handle_count(key), handle_face_count(key), key_is_complete(key) ? 1u : 0u},
               info);
  return TPA_OK;
}

tpa_status tpa_handle_get(uint32_t polygons, const uint32_t* sides, uint64_t index, uint32_t* faces,
                          uint32_t capacity) {
  HandleKey key;
  if (faces == nullptr || !read_key(polygons, sides, key)) return TPA_E_ARGUMENT;
  return handle_get(key, index, as_faces(faces, capacity)) ? TPA_OK : TPA_E_ARGUMENT;
}

tpa_status tpa_handle_generator(uint32_t polygons, const uint32_t* sides, uint32_t generator, uint32_t* faces,
                                uint32_t capacity, uint64_t* orbit) {
  HandleKey key;
  if (faces == nullptr || !read_key(polygons, sides, key)) return TPA_E_ARGUMENT;
  if (!generator_get(key, generator, as_faces(faces, capacity))) return TPA_E_ARGUMENT;
  if (orbit != nullptr) *orbit = generator_size(key, generator);
  return TPA_OK;
}

}  // extern "C"
