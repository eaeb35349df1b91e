// SPDX-License-Identifier: MIT
// A failing test writes its meshes, and says where. The failures happen in child processes.
#include "support/mesh_on_failure.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "oracle/mesh_oracle.h"
#include "support/library_mesh.h"
#include "support/support.h"
#include "tool/io/mesh_io.h"

namespace mesh_on_failure_test {
namespace {

using namespace support;

// The path in "... written to PATH; ..." or at the end of the text.
std::string PathIn(const std::string& text) {
  const std::string before = "written to ";
  const size_t at = text.find(before);
  return at == std::string::npos ? ""
                                 : text.substr(at + before.size(), text.find_first_of(";\n", at) - at - before.size());
}

void ExpectFile(const std::string& path, const Mesh& mesh) {
  Mesh read;
  ASSERT_TRUE(tool::read_mesh(path, read).ok) << path;
  EXPECT_EQ(read.positions, mesh.positions);
  EXPECT_EQ(read.triangles, mesh.triangles);
  std::filesystem::remove(path);
}

// Fails, as far as the child process knows.
template <class Judge>
[[noreturn]] void FailWith(const Judge& judge) {
  judge();
  std::exit(testing::Test::HasFailure() ? 1 : 0);
}

TEST(MeshOnFailure, AnUnsoundMeshIsWritten) {
  Mesh open = Sphere({0, 0, 0}, 1, 2);
  open.triangles.resize(open.triangles.size() - 3);
  const Mesh tangled = Together({Sphere({0, 0, 0}, 1, 3), Sphere({1, 0, 0}, 1, 3)});
  for (const Mesh& mesh : {open, tangled}) {
    const testing::AssertionResult result = IsSound(mesh, "some name, 1/2");
    EXPECT_FALSE(result);
    ExpectFile(PathIn(result.message()), mesh);
  }
}

TEST(MeshOnFailure, AfterAFewMeshesNoMoreAreWritten) {
  const Mesh mesh = Sphere({0, 0, 0}, 1, 1);
  int written = 0;
  for (int i = 0; i < 100; ++i) {
    const std::string path = PathIn(Written(mesh, "many"));
    if (path.empty()) continue;
    ++written;
    std::filesystem::remove(path);
  }
  EXPECT_EQ(written, 8);
}

TEST(MeshOnFailureDeathTest, GuardsAScope) {
  const Mesh mesh = Sphere({0, 0, 0}, 1, 3);
  EXPECT_EXIT(FailWith([&] {
                const MeshOnFailure judged("guarded", mesh);
                ADD_FAILURE() << "as wanted";
              }),
              testing::ExitedWithCode(1), "mesh guarded written to .*GuardsAScope-guarded-1.ply");
  ExpectFile(testing::TempDir() + "topoadapt-MeshOnFailureDeathTest.GuardsAScope-guarded-1.ply", mesh);
  // Failures before the scope do not count.
  EXPECT_EXIT(FailWith([&] {
                ADD_FAILURE() << "as wanted";
                const MeshOnFailure judged("guarded", mesh);
              }),
              testing::ExitedWithCode(1), "^$");
  EXPECT_EXIT(FailWith([&] { const MeshOnFailure judged("guarded", mesh); }), testing::ExitedWithCode(0), "^$");
}

TEST(MeshOnFailureDeathTest, ArenasAndMeshesOfTheLibraryAreGuarded) {
  const Mesh mesh = Sphere({0, 0, 0}, 1, 3);
  EXPECT_EXIT(FailWith([&] {
                const Arena arena(ConfigFor(mesh), mesh);
                ADD_FAILURE() << "as wanted";
              }),
              testing::ExitedWithCode(1), "mesh now written to .*\n*.*mesh loaded written to ");
  EXPECT_EXIT(FailWith([&] {
                const LibraryMesh library(mesh);
                ADD_FAILURE() << "as wanted";
              }),
              testing::ExitedWithCode(1), "mesh given written to ");
  for (const char* name : {"now-1", "loaded-2", "given-1"})
    ExpectFile(
        testing::TempDir() + "topoadapt-MeshOnFailureDeathTest.ArenasAndMeshesOfTheLibraryAreGuarded-" + name + ".ply",
        mesh);
}

}  // namespace
}  // namespace mesh_on_failure_test
