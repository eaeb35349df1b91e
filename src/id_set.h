// id_set: which of the numbers 0 .. n - 1 are members. A bit for each, a bit for each word of these, and again for those:
// members are found in ascending order, and few among many soon.
#pragma once

#include <string.h>

#include "base.h"

namespace tpa {

struct IdSet {
  static constexpr u32 levels = 3, bits = 32;  // of a word
  u32* level[levels] = {};
  u32 words = 0, top_words = 0;  // of all levels, and of the last one

  bool contains(u32 id) const { return (level[0][id / bits] >> id % bits & 1) != 0; }
  // False where it has been in.
  bool add(u32 id);
  void remove(u32 id);
  void clear() { memset(level[0], 0, words * sizeof(u32)); }

  // Members that are added meanwhile may be left out.
  struct End {};
  struct Iterator {
    const IdSet& set;
    u32 word, rest;
    u32 operator*() const { return bits * word + static_cast<u32>(__builtin_ctz(rest)); }
    bool operator!=(End) const { return rest != 0; }
    void operator++() {
      rest &= rest - 1;
      if (rest == 0) *this = set.from_word(word + 1);
    }
    Iterator& operator=(const Iterator& other) {
      word = other.word, rest = other.rest;
      return *this;
    }
  };
  Iterator begin() const { return from_word(0); }
  End end() const { return {}; }

 private:
  Iterator from_word(u32 word) const;
};

// Words that a set of the numbers 0 .. n - 1 takes, all 0 where it is empty. One more on each level is read.
constexpr u64 words_on_level(u64 n, u32 level) { return (n >> 5 * (level + 1)) + 2; }
constexpr u64 id_set_words(u64 n) {
  u64 words = 0;
  for (u32 l = 0; l < IdSet::levels; ++l) words += words_on_level(n, l);
  return words;
}
inline IdSet open_id_set(u32* words, u32 n) {
  IdSet set;
  for (u32 l = 0; l < IdSet::levels; ++l) {
    set.level[l] = words;
    words += words_on_level(n, l);
  }
  set.words = static_cast<u32>(id_set_words(n));
  set.top_words = static_cast<u32>(words_on_level(n, IdSet::levels - 1));
  return set;
}

}  // namespace tpa
