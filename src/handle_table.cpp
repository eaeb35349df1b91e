// handle_table: the rows of the database, evaluated by the compiler (paper section 4.2).
#include "handle_rows.h"

namespace tpa {

namespace {
template <u32 count>
using Indices = std::make_integer_sequence<u32, count>;
constexpr HandleRows<rows_for_two> two = make_rows<2>(Indices<rows_for_two>{});
constexpr HandleRows<rows_for_three> three = make_rows<3>(Indices<rows_for_three>{});
constexpr HandleRows<rows_for_four> four = make_rows<4>(Indices<rows_for_four>{});
// What the tests prove about these rows holds for these bits; every compiler must make the same.
template <u32 count>
constexpr u32 generators_in(const HandleRows<count>& rows) {
  u32 sum = 0;
  for (const HandleRow& r : rows.at) sum += r.count;
  return sum;
}
template <u32 count>
constexpr u64 fingerprint(const HandleRows<count>& rows) {
  u64 hash = 0xcbf29ce484222325;  // FNV-1a over counts and codes
  for (const HandleRow& r : rows.at) {
    hash = (hash ^ (r.count + (r.complete ? 256u : 0u))) * 0x100000001b3;
    for (u32 i = 0; i < r.count; ++i) hash = (hash ^ r.code[i]) * 0x100000001b3;
  }
  return hash;
}
static_assert(generators_in(two) == 332);
static_assert(generators_in(three) == 518);
static_assert(generators_in(four) == 48438);
static_assert(fingerprint(two) == 0x90336377db4efe34u);
static_assert(fingerprint(three) == 0xea1463da7a683dc7u);
static_assert(fingerprint(four) == 0xdf919926f9b4398u);

}  // namespace

const HandleRow& handle_row(u32 k, const u32 (&sides)[max_handle_polygons]) {
  const u32 index = row_index(k, sides);
  return k == 2 ? two.at[index] : k == 3 ? three.at[index] : four.at[index];
}

}  // namespace tpa
