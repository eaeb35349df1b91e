// SPDX-License-Identifier: MIT
#include "support/mesh_on_failure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iostream>

#include "tool/io/mesh_io.h"

namespace support {

namespace {

constexpr int most_meshes = 8;  // of a test

// Null outside of tests.
const testing::TestInfo* RunningTest() { return testing::UnitTest::GetInstance()->current_test_info(); }

int ResultCount() { return RunningTest() == nullptr ? 0 : RunningTest()->result()->total_part_count(); }

bool HasFailedSince(int first) {
  for (int i = first; i < ResultCount(); ++i)
    if (RunningTest()->result()->GetTestPartResult(i).failed()) return true;
  return false;
}

// The number of a mesh among those of the running test.
int NextNumber() {
  static const testing::TestInfo* last = nullptr;
  static int count = 0;
  if (last != RunningTest()) count = 0;
  last = RunningTest();
  return ++count;
}

std::string PathOf(const std::string& name, int number) {
  std::string file = "topoadapt-";
  if (RunningTest() != nullptr)
    file += std::string(RunningTest()->test_suite_name()) + "." + RunningTest()->name() + "-";
  file += name + "-" + std::to_string(number);
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '.' || c == '-' || c == '_'; };
  std::replace_if(
      file.begin(), file.end(), [&](char c) { return !is_plain(static_cast<unsigned char>(c)); }, '-');
  return (std::filesystem::path(testing::TempDir()) / (file + ".ply")).string();
}

}  // namespace

std::string Written(const Mesh& m, const std::string& name) {
  const int number = NextNumber();
  if (number > most_meshes) return "mesh " + name + " not written, after " + std::to_string(most_meshes) + " others";
  const std::string path = PathOf(name, number);
  const tool::Status s = tool::write_mesh(path, m);
  return s ? "mesh " + name + " written to " + path : s.message;
}

MeshOnFailure::MeshOnFailure(std::string name, Mesh mesh)
    : MeshOnFailure(std::move(name), [m = std::move(mesh)] { return m; }) {}

MeshOnFailure::MeshOnFailure(std::string name, std::function<Mesh()> mesh)
    : name_(std::move(name)), mesh_(std::move(mesh)), results_before_(ResultCount()) {}

MeshOnFailure::~MeshOnFailure() {
  if (!HasFailedSince(results_before_)) return;
  const Mesh m = mesh_();
  if (!m.triangles.empty()) std::cerr << Written(m, name_) << "\n";
}

}  // namespace support
