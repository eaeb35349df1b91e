#include "id_set.h"

namespace tpa {

namespace {

u32 bit_of(u32 id) { return 1u << id % IdSet::bits; }
u32 lowest(u32 word) { return static_cast<u32>(__builtin_ctz(word)); }
u32 from(u32 bit) { return ~0u << bit % IdSet::bits; }

// The next word from this one on that is not 0, or none.
u32 next_word(const IdSet& set, u32 word) {
  constexpr u32 bits = IdSet::bits;
  const u32 place = word / bits, behind = place + 1;
  if (const u32 beside = set.level[1][place] & from(word); beside != 0) return bits * place + lowest(beside);
  u32 wanted = from(behind);
  for (u32 top = behind / bits; top < set.top_words; ++top, wanted = ~0u)
    if (const u32 rest = set.level[2][top] & wanted; rest != 0) {
      const u32 next = bits * top + lowest(rest);
      return bits * next + lowest(set.level[1][next]);
    }
  return none;
}

}  // namespace

[[gnu::noinline]] bool IdSet::add(u32 id) {
  if (contains(id)) return false;
  for (u32 l = 0; l < levels; ++l, id /= bits) {
    u32& word = level[l][id / bits];
    const bool known = word != 0;
    word |= bit_of(id);
    if (known) break;
  }
  return true;
}

void IdSet::remove(u32 id) {
  for (u32 l = 0; l < levels; ++l, id /= bits)
    if ((level[l][id / bits] &= ~bit_of(id)) != 0) return;
}

[[gnu::noinline]] IdSet::Iterator IdSet::from_word(u32 word) const {
  word = next_word(*this, word);
  return {*this, word, word == none ? 0 : level[0][word]};
}

}  // namespace tpa
