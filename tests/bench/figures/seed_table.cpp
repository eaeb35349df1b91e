// SPDX-License-Identifier: MIT
#include "bench/figures/seed_table.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace figures {

using support::Outcome;

bool Arguments::Asks(const std::string& name) const {
  const size_t star = family.find('*');
  if (star == std::string::npos) return name == family;
  const size_t rest = family.size() - star - 1;
  return name.size() >= star + rest && name.compare(0, star, family, 0, star) == 0 &&
         name.compare(name.size() - rest, rest, family, star + 1, rest) == 0;
}

Arguments ReadArguments(int argc, char** argv) {
  Arguments a;
  std::vector<std::string> words;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--list") == 0)
      a.list = true;
    else if (std::strcmp(argv[i], "--reasons") == 0)
      a.reasons = true;
    else if (std::strcmp(argv[i], "--write") == 0 && i + 1 < argc)
      a.folder = argv[++i];
    else if (argv[i][0] != 0)
      words.push_back(argv[i]);
  }
  if (!words.empty()) a.family = words[0];
  if (words.size() > 1) a.from = a.to = std::strtoull(words[1].c_str(), nullptr, 10);
  if (words.size() > 2) a.to = std::strtoull(words[2].c_str(), nullptr, 10);
  return a;
}

SeedTable::SeedTable(Arguments arguments, const char* extra) : arguments_(std::move(arguments)) {
  std::printf(
      "| family | meshes | right | refused | wrong | %s | median s | most s | most vertices | seeds |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n",
      extra);
}

void WriteMeshes(const Arguments& arguments, const std::string& family, uint64_t seed, const NamedMeshes& meshes) {
  if (arguments.folder.empty()) return;
  std::filesystem::create_directories(arguments.folder);
  for (const auto& [name, mesh] : meshes) {
    if (mesh.triangles.empty()) continue;
    const std::string path = arguments.folder + "/" + family + "-" + std::to_string(seed) + name + ".off";
    const tool::Status s = tool::write_mesh(path, mesh);
    if (!s) std::fprintf(stderr, "%s\n", s.message.c_str());
  }
}

void SeedTable::Add(const std::string& family, uint64_t seed, const Result& result, Row& row) const {
  ++row.meshes;
  row.extra += result.extra;
  row.most_vertices = std::max(row.most_vertices, result.vertices);
  row.seconds.push_back(result.seconds);
  if (result.outcome == Outcome::right) {
    ++row.right;
    return;
  }
  const bool is_wrong = result.outcome == Outcome::wrong;
  ++(is_wrong ? row.wrong : row.refused);
  (is_wrong ? row.wrong_seeds : row.refused_seeds) += " " + std::to_string(seed);
  if (arguments_.reasons)
    std::fprintf(stderr, "%s %llu: %s: %s; %u vertices, %.3f s\n", family.c_str(),
                 static_cast<unsigned long long>(seed), is_wrong ? "wrong" : "refused", result.reason.c_str(),
                 result.vertices, result.seconds);
  WriteMeshes(arguments_, family, seed, result.meshes);
}

namespace {

// The first few seeds.
std::string Some(const char* name, const std::string& seeds) {
  if (seeds.empty()) return "";
  return std::string(" ") + name + (seeds.size() < 60 ? seeds : seeds.substr(0, seeds.rfind(' ', 60)) + " ...");
}

}  // namespace

void SeedTable::Print(const std::string& family, Row& row) {
  if (row.meshes == 0) return;
  std::sort(row.seconds.begin(), row.seconds.end());
  std::printf("| %s | %u | %u | %u | %u | %.2f | %.4f | %.3f | %u |%s%s |\n", family.c_str(), row.meshes, row.right,
              row.refused, row.wrong, row.extra / row.meshes, row.seconds[row.seconds.size() / 2], row.seconds.back(),
              row.most_vertices, Some("wrong", row.wrong_seeds).c_str(), Some("refused", row.refused_seeds).c_str());
  std::fflush(stdout);
  sum_.meshes += row.meshes, sum_.right += row.right, sum_.refused += row.refused, sum_.wrong += row.wrong;
}

bool SeedTable::End() const {
  std::printf("| all | %u | %u | %u | %u | | | | | |\n", sum_.meshes, sum_.right, sum_.refused, sum_.wrong);
  return sum_.wrong == 0;
}

}  // namespace figures
