// SPDX-License-Identifier: MIT
// Files of meshes in every format, and damaged files of all kinds. Real ones are looked for in TOPOADAPT_SHARED_DATA.
#include <random>
#include <tuple>

#include "oracle/mesh_oracle.h"
#include "support/file_support.h"

namespace tool {
namespace mesh_files_test {
namespace {

TEST(MeshFiles, RoundTripInEveryFormat) {
  std::vector<std::string> names = {"a.obj", "a.off", "a.ply", "a.STL"};
#if TOOL_HAVE_EXPAT
  names.insert(names.end(), {"a.vtp", "a.gii"});
#endif
  for (const std::string& name : names) {
    TriangleMesh mesh = tetrahedron(), back;
    const bool exact = name != "a.STL" && name != "a.gii";  // else floats
    if (exact) {
      mesh.positions[3] = 0.1;
      mesh.positions[7] = -1.0 / 3;
      mesh.positions[11] = 1e-300;
    }
    const Status written_status = write_mesh(scratch_path(name), mesh);
    ASSERT_TRUE(written_status.ok) << written_status.message;
    const Status status = read_mesh(scratch_path(name), back);
    ASSERT_TRUE(status.ok) << status.message;
    EXPECT_EQ(back.positions, mesh.positions) << name;
    EXPECT_EQ(back.triangles, mesh.triangles) << name;
  }
}

TEST(MeshFiles, MissingUnknownUnwritable) {
  TriangleMesh mesh;
  EXPECT_EQ(read_mesh("/no/such.off", mesh).message, "/no/such.off: no such file");
  const std::string unknown = "a.tri: unknown mesh format (known: .obj .off .ply .stl .vtp .gii, to write also .vtk)";
  EXPECT_EQ(read_mesh("a.tri", mesh).message, unknown);
  EXPECT_EQ(write_mesh("a.tri", mesh).message, unknown);
  EXPECT_EQ(read_mesh("a.vtk", mesh).message,
            "a.vtk: .vtk is written, but not read (.obj .off .ply .stl .vtp .gii are)");
  EXPECT_EQ(write_mesh("/no/such/a.off", mesh).message,
            "/no/such/a.off: the folder admits no new file: No such file or directory");
  mesh = tetrahedron();
  mesh.positions[4] = 1e300;
  const std::string path = scratch_path("a.stl");
  EXPECT_EQ(write_mesh(path, mesh).message, path + ": vertex 1 does not fit STL's floats");
}

const std::vector<uint32_t> fan = {0, 1, 2, 0, 2, 3};

TEST(Obj, CornersPolygonsAndNegativeIndices) {
  const std::string vertices = "# c\no thing\nv 0 0 0\nv 1 0 0 1.0\r\nvt 0 0\nv 1 1 \\\n 0\nvn 0 0 1\nv 0 1 0\n";
  EXPECT_EQ(mesh_of("a.obj", vertices + "f 1 2 3 4 # all\n").triangles, fan);
  EXPECT_EQ(mesh_of("a.obj", vertices + "f 1/1 2/1/1 3//1 4\n").triangles, fan);
  EXPECT_EQ(mesh_of("a.obj", vertices + "f -4 -3 -2 -1").triangles, fan);
  EXPECT_EQ(mesh_of("a.obj", vertices).positions, (std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}));
  EXPECT_TRUE(std::isnan(mesh_of("a.obj", "v 0 nan 0\n").positions[1]));
}

// An L, a face of more than three corners that is not convex, in the three formats that have polygons.
TEST(MeshFiles, PolygonsThatAreNotConvex) {
  const std::string rows[] = {"0 0 0", "2 0 0", "2 1 0", "1 1 0", "1 2 0", "0 2 0"};
  std::string lines, obj;
  for (const std::string& row : rows) lines += row + "\n", obj += "v " + row + "\n";
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  for (const TriangleMesh& mesh :
       {mesh_of("L.obj", obj + "f 2 3 4 5 6 1\n"), mesh_of("L.off", "OFF\n6 1 0\n" + lines + "6 1 2 3 4 5 0\n"),
        mesh_of("L.ply", head + lines + "6 1 2 3 4 5 0\n")}) {
    ASSERT_EQ(mesh.triangles.size(), 12u);
    double sum = 0;
    for (size_t f = 0; f < 12; f += 3) {
      const double *a = &mesh.positions[3 * size_t{mesh.triangles[f]}],
                   *b = &mesh.positions[3 * size_t{mesh.triangles[f + 1]}],
                   *c = &mesh.positions[3 * size_t{mesh.triangles[f + 2]}];
      const double area = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
      EXPECT_GT(area, 0);
      sum += area;
    }
    EXPECT_EQ(sum, 3);
  }
}

TEST(MeshFiles, RepeatedCorners) {
  const std::string four = "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  EXPECT_EQ(mesh_of("a.off", four + "4 0 1 2 2\n").triangles, (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_EQ(mesh_of("a.off", four + "6 0 0 1 2 3 0\n").triangles, fan);
  EXPECT_EQ(mesh_of("a.off", four + "3 0 0 1\n").triangles, (std::vector<uint32_t>{0, 0, 1}));
  EXPECT_EQ(mesh_of("a.off", four + "4 0 1 1 1\n").triangles, (std::vector<uint32_t>{0, 1, 1}));
}

TEST(Obj, Errors) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  EXPECT_EQ(mesh_error("a.obj", vertices + "f 1 2 3\nf 1 2 9\n"),
            ": line 5: face 1: index 9 is out of range for 3 vertices");
  EXPECT_EQ(mesh_error("a.obj", vertices + "f 1 0 2\n"), ": line 4: face 0: index 0 is out of range for 3 vertices");
  EXPECT_EQ(mesh_error("a.obj", vertices + "f 1 -4 2\n"), ": line 4: face 0: index -4 is out of range for 3 vertices");
  EXPECT_EQ(mesh_error("a.obj", vertices + "f 1 2\n"), ": line 4: face 0 has 2 corners");
  EXPECT_EQ(mesh_error("a.obj", vertices + "f 1 b 2\n"), ": line 4: face 0: \"b\" is not an index");
  EXPECT_EQ(mesh_error("a.obj", "v 1 2\n"), ": line 1: a vertex of 2 coordinates");
  EXPECT_EQ(mesh_error("a.obj", "v 1 2 c\n"), ": line 1: \"c\" is not a coordinate");
  EXPECT_EQ(mesh_error("a.obj", ""), ": no vertex in the file");
}

TEST(Off, HeadersAndPolygons) {
  const std::string body = "0 0 0\n1 0 0 # c\n\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n";
  EXPECT_EQ(mesh_of("a.off", "OFF\n4 1 0\n" + body).triangles, fan);
  EXPECT_EQ(mesh_of("a.off", "OFF 4 1 0\n" + body).triangles, fan);
  EXPECT_EQ(mesh_of("a.off", "OFF4 1 0\n" + body).triangles, fan);  // as in ModelNet
  EXPECT_EQ(mesh_of("a.off", "# c\nCOFF\n# d\n4 1\n" + body).triangles, fan);
}

TEST(Off, Errors) {
  EXPECT_EQ(mesh_error("a.off", ""), ": is empty");
  EXPECT_EQ(mesh_error("a.off", "PLY\n"), ": line 1: no \"OFF\" at the start");
  EXPECT_EQ(mesh_error("a.off", "OFF BINARY\n"), ": line 1: binary OFF is not read");
  EXPECT_EQ(mesh_error("a.off", "4OFF\n"), ": line 1: 4OFF is not three-dimensional");
  EXPECT_EQ(mesh_error("a.off", "OFF\n3 x\n"), ": line 2: \"3 x\" are not the numbers of vertices and faces");
  EXPECT_EQ(mesh_error("a.off", "OFF\n9000000000000000000 1 0\n0 0 0\n"),
            ": ends after 1 of 9000000000000000000 vertices");
  EXPECT_EQ(mesh_error("a.off", "OFF\n1 2 0\n0 0 0\n3 0 0 0\n"), ": ends after 1 of 2 faces");
  EXPECT_EQ(mesh_error("a.off", "OFF\n1 1 0\n0 0 0\n3 0 1 0\n"),
            ": line 4: face 0: index 1 is out of range for 1 vertices");
  EXPECT_EQ(mesh_error("a.off", "OFF\n1 1 0\n0 0 0\n9000000000000000000 0 0 0\n"),
            ": line 4: face 0 has 3 of its 9000000000000000000 corners");
  EXPECT_EQ(mesh_error("a.off", "OFF\n1 1 0\n0 0\n"), ": line 3: a vertex of 2 coordinates");
}

std::string ply(const std::string& format, const std::string& index_type, int vertices = 4) {
  return "ply\nformat " + format + " 1.0\ncomment c\nelement vertex " + std::to_string(vertices) +
         "\nproperty float x\nproperty uchar red\nproperty float y\nproperty float z\n" +
         "element face 1\nproperty list uchar " + index_type + " vertex_index\nproperty uchar flag\nend_header\n";
}

std::string ply_body(bool big) {
  std::string body;
  for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
    body += bytes_of_numbers<float>({static_cast<double>(x)}, big) + "r" +
            bytes_of_numbers<float>({static_cast<double>(y), 0}, big);
  }
  return body + "\4" + bytes_of_numbers<int16_t>({0, 1, 2, 3}, big) + "!";
}

TEST(Ply, TextAndBothBinaryOrders) {
  const std::string text = "0 9 0 0\n1 9 0 0\n1 9 1 0\n0 9 1 0\n4 0 1 2 3 7\n";
  const TriangleMesh mesh = mesh_of("a.ply", ply("ascii", "int") + text);
  EXPECT_EQ(mesh.triangles, fan);
  EXPECT_EQ(mesh.positions, (std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}));
  for (const bool big : {false, true}) {
    const std::string head = ply(big ? "binary_big_endian" : "binary_little_endian", "short");
    const TriangleMesh binary = mesh_of("b.ply", head + ply_body(big));
    EXPECT_EQ(binary.triangles, fan);
    EXPECT_EQ(binary.positions, mesh.positions);
  }
}

TEST(Ply, Errors) {
  EXPECT_EQ(mesh_error("a.ply", "solid"), ": line 1: no \"ply\" at the start");
  EXPECT_EQ(mesh_error("a.ply", "ply\nformat ascii 1.0\n"), ": the header has no end_header");
  EXPECT_EQ(mesh_error("a.ply", "ply\nformat octal 1.0\n"), ": line 2: format \"octal\" is unknown");
  EXPECT_EQ(mesh_error("a.ply", "ply\nformat ascii 1.0\nelement vertex -1\n"),
            ": line 3: \"-1\" is not a number of elements");
  EXPECT_EQ(mesh_error("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nend_header\n"),
            ": element vertex has no properties");
  const std::string little = "binary_little_endian";
  EXPECT_EQ(mesh_error("a.ply", ply(little, "short") + ply_body(false).substr(0, 30)),
            ": vertex 2 of 4: data ends or is no number");
  EXPECT_EQ(mesh_error("a.ply", ply(little, "short", 2000000000) + ply_body(false)),
            ": vertex 4 of 2000000000: data ends or is no number");
  std::string bad_index = ply(little, "short") + ply_body(false);
  bad_index[bad_index.size() - 3] = 50;
  EXPECT_EQ(mesh_error("a.ply", bad_index), ": face 0: index 50 is out of range for 4 vertices");
  EXPECT_EQ(mesh_error("a.ply", ply("ascii", "int", 1) + "0 0 0 0\n3 0 0 -1 0\n"),
            ": face 0: index -1 is out of range for 1 vertices");
  EXPECT_EQ(mesh_error("a.ply", ply("ascii", "float", 1) + "0 0 0 0\n3 0 0.5 0 0\n"),
            ": face 0 of 1: 0.5 is not an index");
}

TEST(Stl, TextBinaryAndWelding) {
  const std::string second =
      "facet normal 0 0 1\nouter loop\nvertex 1 0 -0.0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\n";
  const TriangleMesh text = mesh_of("a.stl", std::string(text_facet) + second + "endsolid s\n");
  EXPECT_EQ(text.positions.size(), 12u);
  EXPECT_EQ(text.triangles, (std::vector<uint32_t>{0, 1, 2, 1, 3, 2}));
  // A binary file that begins like text.
  std::string bytes;
  ASSERT_TRUE(format_stl(text, bytes).ok);
  bytes.replace(0, 6, "solid ");
  const TriangleMesh binary = mesh_of("b.stl", bytes);
  EXPECT_EQ(binary.triangles, text.triangles);
}

TEST(Stl, Errors) {
  EXPECT_EQ(mesh_error("a.stl", "abc"),
            ": 3 bytes, neither text STL (\"solid\") nor the 84 bytes that binary STL begins with");
  EXPECT_EQ(mesh_error("a.stl", ""),
            ": 0 bytes, neither text STL (\"solid\") nor the 84 bytes that binary STL begins with");
  std::string bytes;
  ASSERT_TRUE(format_stl(tetrahedron(), bytes).ok);
  EXPECT_EQ(mesh_error("a.stl", bytes.substr(0, 150)), ": 150 bytes, 4 binary facets need 284");
  bytes[83] = '\x7f';
  EXPECT_EQ(mesh_error("a.stl", bytes), ": 284 bytes, 2130706436 binary facets need 106535321884");
  EXPECT_EQ(mesh_error("a.stl", text_facet), ": line 8: text STL ends without \"endsolid\"");
  EXPECT_EQ(mesh_error("a.stl", "solid s\nouter loop\nvertex 0 0\n"), ": line 3: \"\" is not a coordinate");
  EXPECT_EQ(mesh_error("a.stl", "solid s\nouter loop\nvertex 0 0 0\nendloop\n"), ": line 4: facet 0 has 1 corners");
  EXPECT_EQ(mesh_error("a.stl", "solid s\nhello\n"), ": line 2: \"hello\" is not part of text STL");
}

// Every prefix of a good file, and every file with one byte changed, must be read or refused, never crash.
TEST(DamagedFiles, AreReadOrRefused) {
  std::vector<std::pair<std::string, std::string>> files;
  struct Writer {
    const char* ending;
    Status (*format)(const TriangleMesh& mesh, std::string& bytes);
  };
  for (const Writer& writer : {Writer{".obj", format_obj}, Writer{".off", format_off}, Writer{".ply", format_ply},
                               Writer{".stl", format_stl}, Writer{".vtp", format_vtp}, Writer{".gii", format_gifti}}) {
    std::string bytes;
    ASSERT_TRUE(writer.format(tetrahedron(), bytes).ok);
    files.emplace_back(writer.ending, bytes);
  }
  files.emplace_back(".stl", std::string(text_facet) + "endsolid\n");
  files.emplace_back(".nrrd", nrrd("short", "encoding: raw\nendian: big\n") + bytes_of_numbers<int16_t>(eight));
  files.emplace_back(".mha", meta("MET_UCHAR", "ElementDataFile = LOCAL\n") + bytes_of_numbers<uint8_t>(eight));
  files.emplace_back(".nii", nifti_header(false, {3, 2, 2, 2}, 2) + bytes_of_numbers<uint8_t>(eight));
#if TOOL_HAVE_ZLIB
  files.emplace_back(".nii.gz", deflated(files.back().second, 31));
#endif
  std::mt19937 random(1);
  for (const auto& [ending, good] : files) {
    for (size_t trial = 0; trial < 2 * good.size(); ++trial) {
      std::string bytes = good.substr(0, trial);
      if (trial >= good.size()) bytes[trial - good.size()] = static_cast<char>(random() >> 24);
      const std::string path = written("damaged" + ending, bytes);
      Volume volume;
      TriangleMesh mesh;
      const bool is_mesh = ending == ".obj" || ending == ".off" || ending == ".ply" || ending == ".stl" ||
                           ending == ".vtp" || ending == ".gii";
      const Status status = is_mesh ? read_mesh(path, mesh) : read_volume(path, volume);
      EXPECT_EQ(status.ok, status.message.empty()) << status.message;
    }
  }
}

// Prisms over an L and over a star: caps of 6 and 14 corners, which are no fans.
TEST(RealData, ConcaveCaps) {
  if (real_file("field/concave_L.off").empty()) GTEST_SKIP() << "no field data in " << TOPOADAPT_SHARED_DATA;
  for (const auto& [name, triangles, volume] :
       {std::tuple("field/concave_L.off", 20u, 5.0), {"field/concave_star.off", 52u, 4.25206}}) {
    TriangleMesh mesh;
    ASSERT_TRUE(read_mesh(real_file(name), mesh).ok);
    EXPECT_EQ(mesh.triangles.size(), 3 * triangles);
    EXPECT_NEAR(support::TopologyOf(mesh).Volume(), volume, 1e-5);
    EXPECT_TRUE(support::IsSound(mesh, name));
  }
}

#ifdef TOPOADAPT_HAS_OWN_DATA
constexpr size_t vertices_of_spheres = 724, vertices_of_cow = 520, vertices_of_tangled = 410;
#else
constexpr size_t vertices_of_spheres = 804, vertices_of_cow = 2762, vertices_of_tangled = 8582;
#endif

TEST(RealData, Meshes) {
  if (real_file("meshes/two_spheres.stl").empty()) GTEST_SKIP() << "no real data in " << TOPOADAPT_SHARED_DATA;
  TriangleMesh spheres, cow, tangled;
  EXPECT_TRUE(read_mesh(real_file("meshes/two_spheres.stl"), spheres).ok);
  EXPECT_EQ(spheres.positions.size() / 3, vertices_of_spheres);
  EXPECT_EQ(spheres.triangles.size() / 3, 2 * vertices_of_spheres - 8);
  EXPECT_TRUE(read_mesh(real_file("meshes/cow.off"), cow).ok);
  EXPECT_EQ(cow.positions.size() / 3, vertices_of_cow);
  EXPECT_EQ(cow.triangles.size() / 3, 2 * vertices_of_cow - 4);
  EXPECT_TRUE(read_mesh(real_file("meshes/self_intersectA.obj"), tangled).ok);
  EXPECT_EQ(tangled.positions.size() / 3, vertices_of_tangled);
  EXPECT_EQ(tangled.triangles.size() / 3, 2 * vertices_of_tangled - 4);
}

}  // namespace
}  // namespace mesh_files_test
}  // namespace tool
