// SPDX-License-Identifier: MIT
// evolve_figures: plays families of scenes and prints how many end as they should, in Markdown: right, clean where what
// else they should be is not known, too near to a change of topology to be compared, or wrong. Every failure is told
// with the command that shows its end.
//
//     evolve_figures [--stride K] [--from SEED] [--renumbered | --turned] [SCENE COUNT]...
//
// Without scenes: all families as often as the table says.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "oracle/ball_union.h"
#include "support/evolve_family.h"
#include "tool/scenes/scene.h"

namespace {

struct Family {
  const char* kind;
  uint32_t seeds;
};

constexpr Family families[] = {
    {"merging-pair", 1000}, {"ramming-pair", 1000}, {"meeting-3", 100}, {"meeting-4", 100},
    {"meeting-5", 100},     {"meeting-8", 100},     {"dumbbell", 20},   {"tube", 50},
    {"shell", 20},          {"ring", 20},           {"vanish", 20},     {"grow", 1},
    {"grow-and-shrink", 1}, {"enright", 1},         {"curl-noise", 5},  {"balls-2", 100},
    {"balls-3", 100},       {"balls-4", 100},       {"balls-5", 100},   {"balls-6", 100},
    {"balls-7", 100},       {"balls-8", 100},       {"balls-100", 100}, {"balls-1000", 50},
};

bool Print(const support::Play& play, uint32_t seeds, support::Pose pose) {
  const support::FamilyResult r = support::JudgeFamily(play, seeds, pose);
  constexpr const char* poses[] = {"", ", renumbered", ", turned"};
  std::printf("| %s%s | %u | %u | %u | %u | %zu | %.1f |\n", play.kind.c_str(), poses[static_cast<int>(pose)], r.played,
              r.right, r.clean, r.near_critical, r.failures.size(), r.seconds);
  for (const auto& f : r.failures) std::fprintf(stderr, "%s: %s\n", f.command.c_str(), f.fault.c_str());
  std::fflush(stdout);
  return r.failures.empty();
}

bool PrintAll(support::Play play) {
  bool good = true;
  for (const Family& f : families) {
    play.kind = f.kind;
    good = Print(play, f.seeds, support::Pose::as_is) && good;
    if (play.kind != "merging-pair") continue;
    good = Print(play, f.seeds, support::Pose::renumbered) && good;
    good = Print(play, f.seeds, support::Pose::turned) && good;
  }
  return good;
}

int Usage(const char* what) {
  std::fprintf(stderr,
               "%s\nusage: evolve_figures [--stride K] [--from SEED] [--renumbered | --turned] [SCENE COUNT]...\n",
               what);
  return 2;
}

bool IsScene(const char* word) {
  for (const tool::SceneKind& kind : tool::scene_kinds())
    if (std::strcmp(word, kind.name) == 0) return true;
  return false;
}

}  // namespace

int main(int count, char** words) {
  support::Play play;
  support::Pose pose = support::Pose::as_is;
  for (bool option = true; option;) {
    const auto is = [&](const char* name, int wanted) { return count > wanted && std::strcmp(words[1], name) == 0; };
    int taken = 0;
    if (is("--stride", 2)) play.stride = std::atof(words[2]), taken = 2;
    if (is("--from", 2)) play.seed = std::strtoull(words[2], nullptr, 10), taken = 2;
    if (is("--renumbered", 1)) pose = support::Pose::renumbered, taken = 1;
    if (is("--turned", 1)) pose = support::Pose::turned, taken = 1;
    count -= taken, words += taken;
    option = taken > 0;
  }
  if (play.stride < 0) return Usage("--stride wants a length");
  if (count % 2 == 0) return Usage("each SCENE wants a COUNT");
  for (int i = 1; i < count; i += 2) {
    if (!IsScene(words[i])) return Usage((std::string("no scene is called ") + words[i]).c_str());
    if (std::atoi(words[i + 1]) <= 0) return Usage("COUNT must be positive");
  }
  if (!support::KnowsUnions()) std::printf("Built without CGAL: ends of growing balls are not compared.\n");
  std::printf("| scene | seeds | right | clean | near critical | wrong | seconds |\n|---|---|---|---|---|---|---|\n");
  if (count < 2) return PrintAll(play) ? 0 : 1;
  bool good = true;
  for (int i = 1; i < count; i += 2) {
    play.kind = words[i];
    good = Print(play, static_cast<uint32_t>(std::atoi(words[i + 1])), pose) && good;
  }
  return good ? 0 : 1;
}
