// SPDX-License-Identifier: MIT
// Prints the large handle tables as plain arrays in C++. The compiler takes minutes to evaluate them, and finds the
// same numbers for each platform.
#include <cstdio>

#include "handles/handle_table.h"

namespace {

using tpa::u32;

void PrintRows(const char* name, const tpa::QuarterOfFour& rows) {
  std::printf("extern constexpr QuarterOfFour %s = {{\n", name);
  for (const tpa::HandleRow& row : rows.at) {
    std::printf("{{");
    for (u32 code : row.code) std::printf("%u,", code);
    std::printf("},%u,%s},\n", row.count, row.complete ? "true" : "false");
  }
  std::printf("}};\n");
}

void PrintWords(const char* name, const tpa::WordRow* (*row)(u32), u32 end) {
  std::printf("static constexpr u16 %s_index[] = {", name);
  for (u32 i = 0; i < end; ++i)
    if (row(i) != nullptr) std::printf("%u,", i);
  std::printf("};\nstatic constexpr WordRow %s_row[] = {\n", name);
  for (u32 i = 0; i < end; ++i) {
    const tpa::WordRow* r = row(i);
    if (r == nullptr) continue;
    std::printf("{{");
    for (const tpa::PackedWords& w : r->word) {
      std::printf("{%lluu,{", static_cast<unsigned long long>(w.steps));
      for (u32 steps : w.steps_of_strip) std::printf("%u,", steps);
      std::printf("},%u},", w.plan);
    }
    std::printf("},%u,%s},\n", r->count, r->complete ? "true" : "false");
  }
  std::printf("};\nconst WordRow* %s(u32 index) { return find(%s_index, %s_row, index); }\n", name, name, name);
}

}  // namespace

int main() {
  std::puts(
      "#include \"handles/handle_table.h\"\n"
      "namespace tpa {\n"
      "template <u32 n>\n"
      "static const WordRow* find(const u16 (&index)[n], const WordRow (&row)[n], u32 wanted) {\n"
      "  for (u32 i = 0; i < n; ++i)\n"
      "    if (index[i] == wanted) return &row[i];\n"
      "  return nullptr;\n"
      "}");
  PrintWords("unequal_row_of_three", tpa::unequal_row_of_three, tpa::rows_for_three);
  std::puts("#if !defined(TPA_WITHOUT_QUADRUPLES)");
  PrintRows("quarter_of_four_0", tpa::quarter_of_four_0);
  PrintRows("quarter_of_four_1", tpa::quarter_of_four_1);
  PrintRows("quarter_of_four_2", tpa::quarter_of_four_2);
  PrintRows("quarter_of_four_3", tpa::quarter_of_four_3);
  PrintWords("unequal_row_of_four_0", tpa::unequal_row_of_four_0, tpa::rows_for_four);
  PrintWords("unequal_row_of_four_1", tpa::unequal_row_of_four_1, tpa::rows_for_four);
  PrintWords("unequal_row_of_four_2", tpa::unequal_row_of_four_2, tpa::rows_for_four);
  PrintWords("unequal_row_of_four_3", tpa::unequal_row_of_four_3, tpa::rows_for_four);
  std::puts("#endif\n}");
}
