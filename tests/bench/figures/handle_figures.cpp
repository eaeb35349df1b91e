// SPDX-License-Identifier: MIT
// handle_figures: prints the figures of docs/handles.md in Markdown. All numbers but the times are the same on every
// run.
//
//   handle_figures [--contacts N] [--runs N] [--part stored|pairs|triples|quadruples|times] [--failures]
//   handle_figures --scene SEED
//
// N contacts with loops of up to 15 sides, a third each of pairs, triples and quadruples of meshes (default 10000), and
// the contacts with longer loops that turn up on the way; N runs for each time (default 300). A part prints its tables,
// or its columns and rows of the same tables. --failures names the seeds of scenes without a fitting handle on stderr;
// --scene writes a scene as a mesh.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <iterator>
#include <string>

#include "contact_trial.h"
#include "tool/scenes/elementary.h"

namespace {

using figures::Loops;
using figures::Source;
using figures::Trial;
using tpa::u32;

const char* const part_names[] = {"pairs", "triples", "quadruples", "stored", "times"};

struct Arguments {
  int contacts = 10000, runs = 300, scene = 0;
  bool failures = false;
  std::string part;  // empty: all
  bool Wants(int i) const { return part.empty() || part == part_names[i]; }
};

// The value at a share of the values in order, rounded up.
double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const double at = std::ceil(share * static_cast<double>(values.size())) - 1;
  return values[static_cast<size_t>(std::max(at, 0.0))];
}

// ---------------------------------------------------------------- what is stored

void ForEachKey(u32 k, u32 longest, tpa::HandleKey& key, void (*visit)(const tpa::HandleKey&, void*), void* data) {
  if (key.k == k) return visit(key, data);
  for (u32 side = 3; side <= longest; ++side) {
    key.sides[key.k++] = side;
    ForEachKey(k, side, key, visit, data);
    --key.k;
  }
}

struct Stored {
  std::vector<double> generators;
  tpa::u64 complete = 0, handles = 0;
};

Stored CountStored(u32 k) {
  Stored stored;
  tpa::HandleKey key;
  const auto visit = [](const tpa::HandleKey& at, void* data) {
    Stored& s = *static_cast<Stored*>(data);
    s.generators.push_back(tpa::generator_count(at));
    s.complete += tpa::key_is_complete(at) ? 1u : 0u;
    s.handles += tpa::handle_count(at);
  };
  ForEachKey(k, 15, key, visit, &stored);
  return stored;
}

void PrintStored() {
  std::printf("### Generators\n\n");
  std::printf(
      "| polygons | keys | generators | least | median | most | keys with all handles of the rule | handles "
      "|\n");
  std::printf("|---|---|---|---|---|---|---|---|\n");
  for (u32 k = 2; k <= 4; ++k) {
    const Stored s = CountStored(k);
    double sum = 0;
    for (double g : s.generators) sum += g;
    std::printf("| %u | %zu | %.0f | %.0f | %.0f | %.0f | %llu | %llu |\n", k, s.generators.size(), sum,
                Quantile(s.generators, 0), Quantile(s.generators, 0.5), Quantile(s.generators, 1),
                static_cast<unsigned long long>(s.complete), static_cast<unsigned long long>(s.handles));
  }
}

// ---------------------------------------------------------------- random contacts

struct Contacts {
  std::vector<Trial> of[3];  // of pairs, triples, quadruples
  int scenes[3] = {};
};

// A seed says how many parts its scene has.
constexpr int seeds_for_each = 1000000;
int PartsOf(int seed) { return seed / seeds_for_each; }
figures::Scene SceneOf(int seed) { return figures::RandomScene(PartsOf(seed), static_cast<uint64_t>(seed)); }

void NameFailure(int seed, const Trial& trial) {
  if (trial.tabled && trial.source == Source::nothing) std::fprintf(stderr, "scene %d: nothing\n", seed);
}

// Draws scenes until so many contacts have loops within the database; keeps the others too.
Contacts MakeContacts(const Arguments& arguments) {
  Contacts all;
  figures::Laboratory laboratory;
  for (int k = 2; k <= 4; ++k) {
    int left = arguments.Wants(k - 2) ? (arguments.contacts + 4 - k) / 3 : 0;
    for (int& scene = all.scenes[k - 2]; left > 0; ++scene)
      for (Trial& t : laboratory.Run(SceneOf(k * seeds_for_each + scene))) {
        if (arguments.failures) NameFailure(k * seeds_for_each + scene, t);
        if (t.tabled) --left;
        all.of[k - 2].push_back(std::move(t));
        if (left == 0) break;
      }
  }
  return all;
}

template <class Want>
int Count(const std::vector<Trial>& trials, Want want) {
  return static_cast<int>(std::count_if(trials.begin(), trials.end(), want));
}

// One row: pairs, triples, quadruples, all; each as a share of `of`.
template <class Want, class Of>
void PrintRow(const Contacts& contacts, const char* name, Want want, Of of) {
  int sum = 0, sum_of = 0;
  std::printf("| %s |", name);
  const auto print = [](int count, int out_of) {
    std::printf(" %d (%.1f %%) |", count, out_of == 0 ? 0.0 : 100.0 * count / out_of);
  };
  for (const auto& trials : contacts.of) {
    const int count = Count(trials, want), out_of = Count(trials, of);
    print(count, out_of), sum += count, sum_of += out_of;
  }
  print(sum, sum_of);
  std::printf("\n");
}

void PrintSources(const Contacts& contacts) {
  const auto any = [](const Trial&) { return true; };
  const auto shorter = [](const Trial& t) { return t.tabled; };
  const auto longer = [](const Trial& t) { return !t.tabled; };
  const auto from = [](bool tabled, Source low, Source high) {
    return [=](const Trial& t) { return t.tabled == tabled && low <= t.source && t.source <= high; };
  };
  std::printf("\n### Does the database suffice?\n\n");
  std::printf("| contacts of | pairs | triples | quadruples | all |\n|---|---|---|---|---|\n");
  PrintRow(contacts, "all", any, any);
  PrintRow(contacts, "all loops of 15 sides or fewer", shorter, any);
  PrintRow(contacts, "- the shortest stored handle is free", from(true, Source::first_stored, Source::first_stored),
           shorter);
  PrintRow(contacts, "- one of the 48 shortest stored is free", from(true, Source::first_stored, Source::later_stored),
           shorter);
  PrintRow(contacts, "- only a handle that is not stored", from(true, Source::other_handle, Source::other_handle),
           shorter);
  PrintRow(contacts, "- nothing: cut exactly", from(true, Source::nothing, Source::nothing), shorter);
  PrintRow(contacts, "a loop of more than 15 sides", longer, any);
  PrintRow(contacts, "- a handle made on the spot is free", from(false, Source::first_stored, Source::other_handle),
           longer);
  PrintRow(contacts, "- nothing: cut exactly", from(false, Source::nothing, Source::nothing), longer);
}

void PrintSides(const Contacts& contacts) {
  std::printf("\n### Sides of the loops\n\n| contacts of | scenes drawn | least | 10 %% | median | 90 %% | most |\n");
  std::printf("|---|---|---|---|---|---|---|\n");
  for (int i = 0; i < 3; ++i) {
    std::vector<double> sides;
    for (const Trial& t : contacts.of[i])
      for (const auto& loop : t.loops) sides.push_back(static_cast<double>(loop.size()));
    std::printf("| %s | %d |", part_names[i], contacts.scenes[i]);
    for (double share : {0.0, 0.1, 0.5, 0.9, 1.0}) std::printf(" %.0f |", Quantile(sides, share));
    std::printf("\n");
  }
}

double Ratio(const Loops& loops) {
  figures::StoredChoice stored(loops);
  stored.Rank();
  const double made = figures::MadeChoice(loops).First();
  return made > 0 ? stored.LengthOf(0) / made : 0;
}

// Stored against made. A ratio below one for two polygons would mean that the search for the shortest fails.
bool PrintRatios(const Contacts& contacts) {
  std::printf("\n### Length: the shortest stored handle divided by one made on the spot\n\n");
  std::printf("| polygons | contacts | none made | least | median | 90 %% | 99 %% | most |\n");
  std::printf("|---|---|---|---|---|---|---|---|\n");
  bool sound = true;
  for (int i = 0; i < 3; ++i) {
    std::vector<double> ratios;
    size_t none = 0;
    for (const Trial& t : contacts.of[i]) {
      if (!t.tabled) continue;
      const double ratio = Ratio(t.loops);
      ratio > 0 ? ratios.push_back(ratio) : void(++none);
    }
    sound &= i > 0 || ratios.empty() || Quantile(ratios, 0) > 1 - 1e-9;
    std::printf("| %d | %zu | %zu |", i + 2, ratios.size() + none, none);
    for (double share : {0.0, 0.5, 0.9, 0.99, 1.0}) std::printf(" %.3f |", Quantile(ratios, share));
    std::printf("\n");
  }
  if (!sound) std::printf("\nWRONG: a stored handle is shorter than the shortest\n\n");
  return sound;
}

bool AllAgree(const Contacts& contacts) {
  for (const auto& trials : contacts.of)
    for (const Trial& t : trials)
      if (!t.agrees) {
        std::printf("\nWRONG: a stored handle is free, and the library did not join the loops\n");
        return false;
      }
  return true;
}

bool PrintContacts(const Arguments& arguments) {
  const Contacts contacts = MakeContacts(arguments);
  PrintSides(contacts);
  PrintSources(contacts);
  const bool agree = AllAgree(contacts);
  return PrintRatios(contacts) && agree;
}

// ---------------------------------------------------------------- times

// Wobbly loops about the corners of a regular polygon, in the directions of a handle through them.
Loops WobblyLoops(const std::vector<u32>& sides, support::Random& random) {
  constexpr double turn = 6.283185307179586;
  Loops loops;
  for (u32 l = 0; l < sides.size(); ++l) {
    const double at = turn * l / static_cast<double>(sides.size());
    loops.emplace_back();
    for (u32 v = 0; v < sides[l]; ++v) {
      const double t = turn * v / sides[l];
      const support::Point p = support::RandomPoint(random, 0, 1);
      loops.back().push_back(
          {3 * tool::cosine(at) + tool::cosine(t) + p[0], 3 * tool::sine(at) - tool::sine(t) + p[1], p[2]});
    }
  }
  return loops;
}

// Processor time, so that other work does not count.
double MicrosecondsSoFar() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}
template <class Work>
double Microseconds(Work work) {
  const double start = MicrosecondsSoFar();
  work();
  return MicrosecondsSoFar() - start;
}

void PrintTimes(int runs) {
  struct Case {
    std::vector<u32> sides;
    const char *name, *limit;
  };
  const Case cases[] = {{{10, 10}, "10 10", "20"},
                        {{15, 15}, "15 15", "50"},
                        {{8, 8, 8}, "8 8 8", ""},
                        {{15, 15, 15}, "15 15 15", "1000"},
                        {{5, 5, 5, 5}, "5 5 5 5", ""},
                        {{8, 8, 8, 8}, "8 8 8 8", ""},
                        {{15, 15, 15, 15}, "15 15 15 15", "10000"},
                        {{30, 30}, "30 30", ""},
                        {{60, 60}, "60 60", ""},
                        {{30, 30, 30}, "30 30 30", ""},
                        {{50, 50, 50}, "50 50 50", ""},
                        {{30, 30, 30, 30}, "30 30 30 30", ""}};
  std::printf("\n### Microseconds to choose\n\n");
  std::printf("| sides | 48 shortest stored: median | 99 %% | limit | made: median | 99 %% |\n");
  std::printf("|---|---|---|---|---|---|\n");
  for (const Case& c : cases) {
    support::Random random(7);
    std::vector<double> stored, made;
    for (int run = 0; run < runs; ++run) {
      const Loops loops = WobblyLoops(c.sides, random);
      figures::StoredChoice choice(loops);
      if (choice.tabled()) stored.push_back(Microseconds([&] { choice.Rank(); }));
      figures::MadeChoice choice_made(loops);
      made.push_back(Microseconds([&] { choice_made.First(); }));
    }
    if (stored.empty())
      std::printf("| %s | - | - | |", c.name);
    else
      std::printf("| %s | %.1f | %.1f | %s |", c.name, Quantile(stored, 0.5), Quantile(stored, 0.99), c.limit);
    std::printf(" %.1f | %.1f |\n", Quantile(made, 0.5), Quantile(made, 0.99));
  }
}

int WriteScene(int seed) {
  if (PartsOf(seed) < 2 || PartsOf(seed) > 4) return 2;
  figures::Laboratory laboratory;
  std::printf("%s\n", support::Written(laboratory.PushTogether(SceneOf(seed)), "scene").c_str());
  return 0;
}

bool ReadArguments(int count, char** words, Arguments& out) {
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    if (word == "--failures") {
      out.failures = true;
      continue;
    }
    if (word == "--part" && i + 1 < count) {
      out.part = words[++i];
      if (std::find(std::begin(part_names), std::end(part_names), out.part) == std::end(part_names)) return false;
      continue;
    }
    int* const value = word == "--contacts" ? &out.contacts
                       : word == "--runs"   ? &out.runs
                       : word == "--scene"  ? &out.scene
                                            : nullptr;
    if (value == nullptr || ++i == count) return false;
    *value = std::atoi(words[i]);
    if (*value < 1) return false;
  }
  return true;
}

}  // namespace

int main(int count, char** words) {
  Arguments arguments;
  if (!ReadArguments(count, words, arguments)) {
    std::fprintf(stderr, "usage: handle_figures [--contacts N] [--runs N] [--part PART] [--failures] [--scene SEED]\n");
    return 2;
  }
  if (arguments.scene > 0) return WriteScene(arguments.scene);
  if (arguments.Wants(3)) PrintStored();
  const bool sound = (!arguments.Wants(0) && !arguments.Wants(1) && !arguments.Wants(2)) || PrintContacts(arguments);
  if (arguments.Wants(4)) PrintTimes(arguments.runs);
  return sound ? 0 : 1;
}
