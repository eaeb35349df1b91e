// evolve_figures: plays families of scenes and prints how many end as they should, in Markdown; every failure with
// the command that shows it.
//
//     evolve_figures [--stride K] [--renumbered | --turned] [SCENE COUNT]...
//
// Without scenes: all families as often as the table says.
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "ball_union.h"
#include "evolve_family.h"

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
  std::printf("| %s%s | %u | %u | %u | %zu | %.1f |\n", play.kind.c_str(), poses[static_cast<int>(pose)], r.played,
              r.good, r.undecided, r.faults.size(), r.seconds);
  for (const std::string& fault : r.faults) std::fprintf(stderr, "%s\n", fault.c_str());
  std::fflush(stdout);
  return r.faults.empty();
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

}  // namespace

int main(int count, char** words) {
  support::Play play;
  support::Pose pose = support::Pose::as_is;
  for (bool option = true; option;) {
    const auto is = [&](const char* name, int wanted) { return count > wanted && std::strcmp(words[1], name) == 0; };
    int taken = 0;
    if (is("--stride", 2)) play.stride = std::atof(words[2]), taken = 2;
    if (is("--renumbered", 1)) pose = support::Pose::renumbered, taken = 1;
    if (is("--turned", 1)) pose = support::Pose::turned, taken = 1;
    count -= taken, words += taken;
    option = taken > 0;
  }
  if (!support::KnowsUnions()) std::printf("Built without CGAL: ends of growing balls are not compared.\n");
  std::printf("| scene | seeds | right | near critical | wrong | seconds |\n|---|---|---|---|---|---|\n");
  if (count < 2) return PrintAll(play) ? 0 : 1;
  bool good = true;
  for (int i = 1; i + 1 < count; i += 2) {
    play.kind = words[i];
    good = Print(play, static_cast<uint32_t>(std::atoi(words[i + 1])), pose) && good;
  }
  return good ? 0 : 1;
}
