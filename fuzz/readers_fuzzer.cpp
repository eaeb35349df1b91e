// SPDX-License-Identifier: MIT
// The tool's readers of meshes and volumes: files of any bytes are read or refused with a line of text, without a
// crash, and with memory for no more than the file holds. A mesh that is read comes back from each format that it is
// written to. DICOM is read in a process of its own. Where the process dies, GDCM must be at fault: GDCM alone, without
// code of the tool, dies of the file as well (gdcm_alone.h).
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "bytes.h"
#include "gdcm_alone.h"
#include "target.h"
#include "tool/io/files.h"
#include "tool/io/mesh_io.h"
#include "tool/io/polygon_mesh.h"
#include "tool/io/volume_io.h"

namespace fuzz {

namespace {

using namespace tool;

uint64_t files = 0, meshes = 0, volumes = 0, lines = 0, deaths = 0;

constexpr size_t most_elements_for_a_byte = 4;
constexpr size_t deflate_ratio = 1100;

// The path may be that of another file, where a header names one.
void JudgeRefusal(const Status& status, const std::string& folder) {
  ++lines;
  Demand(status.message.rfind(folder, 0) == 0 && status.message.find('\n') == std::string::npos,
         "a file is refused with a line that begins with a path: ", status.message);
}

struct MeshFormat {
  Status (*parse)(const std::string& path, std::string_view bytes, PolygonMesh& mesh);
  Status (*format)(const TriangleMesh& mesh, std::string& bytes);
  bool keeps_all;
};
constexpr MeshFormat mesh_formats[] = {{parse_obj, format_obj, true},
                                       {parse_off, format_off, true},
                                       {parse_ply, format_ply, true},
                                       {parse_stl, format_stl, false}};

bool IsFinite(const TriangleMesh& mesh) {
  for (double x : mesh.positions)
    if (!(x - x == 0)) return false;
  return true;
}

void ReadMesh(const MeshFormat& f, std::string_view bytes) {
  PolygonMesh polygons;
  const Status status = f.parse("file", bytes, polygons);
  if (!status) return JudgeRefusal(status, "file");
  const TriangleMesh mesh = triangles_of(std::move(polygons));
  ++meshes;
  Demand(mesh.positions.size() % 3 == 0 && mesh.triangles.size() % 3 == 0, "whole vertices and triangles");
  Demand(mesh.positions.size() / 3 <= most_elements_for_a_byte * bytes.size() &&
             mesh.triangles.size() / 3 <= most_elements_for_a_byte * bytes.size(),
         "no more elements than the file has room for");
  for (uint32_t v : mesh.triangles) Demand(v < mesh.positions.size() / 3, "corners are vertices");
  if (!f.keeps_all || !IsFinite(mesh) || mesh.triangles.empty()) return;
  std::string written;
  Demand(f.format(mesh, written).ok, "a mesh that was read is written");
  PolygonMesh polygons_again;
  Demand(f.parse("file", written, polygons_again).ok, "and read again");
  const TriangleMesh again = triangles_of(std::move(polygons_again));
  Demand(again.positions == mesh.positions && again.triangles == mesh.triangles, "with the same bits");
}

using ReadVolume = Status (*)(const std::string& path, const VolumeRequest& request, Volume& volume);
constexpr ReadVolume volume_formats[] = {read_nifti, read_nrrd, read_meta_image, read_nifti, read_dicom};
constexpr const char* endings[] = {".nii", ".nrrd", ".mha", ".hdr", ".dcm"};

// In a folder of this process, which goes at its end.
const std::filesystem::path& Folder() {
  static const struct Own {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("topoadapt_fuzz_" + std::to_string(getpid()));
    Own() { std::filesystem::create_directories(path); }
    ~Own() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  } own;
  return own.path;
}

// Not flushed to the disk: the file need not last.
bool WriteFile(const std::string& path, std::string_view bytes) {
  return bool(std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size())));
}

void ReadVolumeFile(uint32_t format, std::string_view bytes) {
  const std::string path = (Folder() / (std::string("file") + endings[format])).string();
  Demand(WriteFile(path, bytes), "a file for the fuzzer");
  // The voxels of a header of a pair.
  static const bool has_partner = WriteFile((Folder() / "file.img").string(), std::string(4096, '\1'));
  Demand(has_partner, "a file of voxels for the fuzzer");
  Volume volume;
  DieByTheSystem();
  const Status status = volume_formats[format](path, {uint64_t{0}, false}, volume);
  if (!status && status.message.find("GDCM ended by signal") != std::string::npos) {
    ++deaths;
    Trace(status.message);
    Demand(GdcmAloneDies(path), "a reader dies where GDCM alone does: ", status.message);
  }
  if (!status) return JudgeRefusal(status, "");
  ++volumes;
  Demand(volume.nx > 0 && volume.ny > 0 && volume.nz > 0, "a volume has voxels");
  const auto voxels = static_cast<size_t>(volume.nx) * static_cast<size_t>(volume.ny) * static_cast<size_t>(volume.nz);
  Demand(is_regular(volume.to_world), "a voxel has a place and a volume");
  const Affine back = inverse(volume.to_world);
  for (const Point& p : {back.axes[0], back.axes[1], back.axes[2], back.origin})
    for (const double x : p) Demand(x - x == 0, "the way back into the volume is finite");
  Demand(volume.values.size() == voxels, "as many values as voxels");
  constexpr size_t room = 4096;
  Demand(voxels <= deflate_ratio * bytes.size() + room, "no more voxels than the files have room for");
}

}  // namespace

std::string Tally() {
  return text_of(files, " files, ", meshes, " meshes, ", volumes, " volumes, ", lines, " refused, ", deaths,
                 " deaths of GDCM");
}

bool ReachedEnough(uint64_t inputs) { return lines > inputs / 2; }

}  // namespace fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace fuzz;
  if (size == 0) return 0;
  ++files;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const uint32_t format = data[0] % 9;
  if (format < 4)
    ReadMesh(mesh_formats[format], bytes);
  else
    ReadVolumeFile(format - 4, bytes);
  return 0;
}
