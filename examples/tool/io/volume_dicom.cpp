// SPDX-License-Identifier: MIT
// volume_dicom: a DICOM series as one volume: slices of one series in the order of their positions along the normal,
// whatever their names and numbers. Millimetres in the patient's space, LPS.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "tool/io/dicom_file.h"
#include "tool/io/files.h"
#include "tool/io/volume_io.h"

namespace tool {

namespace {

// Cosines of directions differ by less within a series.
constexpr double equal_direction = 1e-3;
// Distances between slices may differ by such a part, and positions lie off the line through the first and the last by
// such a part of a voxel. Headers round positions to some digits.
constexpr double equal_distance = 0.02, least_difference_mm = 0.02, most_sideways = 0.05;
// Positions that count as one, in mm.
constexpr double same_place = 1e-3;
// Of slices that are tilted: radians between the normal and the way from slice to slice.
constexpr double noted_tilt = 0.01;

struct Slice {
  std::string path;
  DicomHeader header;
  double depth = 0;  // along the normal
};
using Series = std::vector<Slice>;

double largest_difference(const Point& a, const Point& b) {
  double most = 0;
  for (size_t k = 0; k < 3; ++k) most = std::max(most, std::fabs(a[k] - b[k]));
  return most;
}

bool belong_together(const DicomHeader& a, const DicomHeader& b) {
  return std::string_view(a.series) == b.series && a.rows == b.rows && a.columns == b.columns &&
         largest_difference(a.row, b.row) < equal_direction && largest_difference(a.column, b.column) < equal_direction;
}

Status list_files(const std::string& path, std::vector<std::string>& files) {
  std::error_code error;
  const std::filesystem::path given(path);
  const bool is_folder = std::filesystem::is_directory(given, error);
  const std::filesystem::path parent = given.has_parent_path() ? given.parent_path() : std::filesystem::path(".");
  const std::filesystem::path folder = is_folder ? given : parent;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    std::error_code ignored;
    const bool given_file = !is_folder && it->path().filename() == given.filename();
    if (given_file || it->is_regular_file(ignored)) files.push_back(given_file ? path : it->path().string());
  }
  if (error) return failure(path, ": ", error.message());
  if (!is_folder && std::find(files.begin(), files.end(), path) == files.end()) return failure(path, ": no such file");
  std::sort(files.begin(), files.end());
  return files.empty() ? failure(path, ": the folder is empty") : success();
}

// For messages: micrometres, without the noise of a header's decimals.
double rounded(double mm) { return std::round(1000 * mm) / 1000; }

std::string name_of(const Slice& slice) { return std::filesystem::path(slice.path).filename().string(); }

// Which of several series is meant?
Status refuse_several(const std::string& path, const std::vector<Series>& series) {
  std::string list;
  for (size_t i = 0; i < std::min<size_t>(series.size(), 8); ++i) {
    const Slice& first = series[i][0];
    list += text_of(i > 0 ? "; " : "", name_of(first), " (", series[i].size(), " files, ", first.header.modality, " ",
                    first.header.columns, " x ", first.header.rows, ", \"", first.header.description, "\")");
  }
  return failure(path, ": holds ", series.size(), " series; give a file of the one that is meant: ", list,
                 series.size() > 8 ? "; ..." : "");
}

Status choose_series(const std::string& path, const std::vector<std::string>& files,
                     const std::vector<DicomHeader>& headers, Series& chosen) {
  std::vector<Series> all;
  for (size_t i = 0; i < files.size(); ++i) {
    if (headers[i].is_damaged) return failure(files[i], ": is DICOM, but damaged");
    if (!headers[i].is_image) {
      if (files[i] == path) return failure(path, ": holds no DICOM image");
      continue;
    }
    size_t k = 0;
    while (k < all.size() && !belong_together(all[k][0].header, headers[i])) ++k;
    if (k == all.size()) all.emplace_back();
    all[k].push_back({files[i], headers[i]});
  }
  if (all.empty()) return failure(path, ": holds no DICOM image");
  for (const Series& series : all)
    for (const Slice& slice : series)
      if (slice.path == path) {
        chosen = series;
        return success();
      }
  if (all.size() > 1) return refuse_several(path, all);
  chosen = all[0];
  return success();
}

Status check_slice(const Slice& slice) {
  const DicomHeader& h = slice.header;
  if (h.samples != 1) return failure(slice.path, ": ", h.samples, " numbers for each voxel (colours), one is needed");
  if (!h.has_place) return failure(slice.path, ": gives no ImagePositionPatient and ImageOrientationPatient");
  if (!h.has_spacing) return failure(slice.path, ": gives no PixelSpacing");
  return success();
}

// One slice of each place, number `request.time` of several.
Status choose_time(const std::string& path, const VolumeRequest& request, Series& series) {
  std::sort(series.begin(), series.end(),
            [](const Slice& a, const Slice& b) { return a.depth != b.depth ? a.depth < b.depth : a.path < b.path; });
  std::vector<Series> places;
  for (const Slice& slice : series) {
    if (places.empty() || slice.depth - places.back()[0].depth > same_place) places.emplace_back();
    places.back().push_back(slice);
  }
  const size_t times = places[0].size();
  for (Series& place : places) {
    if (place.size() != times)
      return failure(path, ": ", place.size(), " slices at ", rounded(place[0].depth), " mm (", name_of(place[0]),
                     ", ...), ", times, " at ", rounded(places[0][0].depth), " mm");
    std::stable_sort(place.begin(), place.end(),
                     [](const Slice& a, const Slice& b) { return a.header.instance < b.header.instance; });
  }
  if (times > 1 && !request.time)
    return failure(path, ": ", times, " slices at each place (time points): --time K, from 0 to ", times - 1,
                   ", picks one by InstanceNumber");
  const uint64_t time = request.time.value_or(0);
  if (time >= times) return failure(path, ": ", times, " slices at each place, so that there is no --time ", time);
  series.clear();
  for (const Series& place : places) series.push_back(place[static_cast<size_t>(time)]);
  return success();
}

// Equal distances, or where they are not.
Status check_distances(const std::string& path, const Series& series) {
  std::vector<double> distances;
  for (size_t i = 1; i < series.size(); ++i) distances.push_back(series[i].depth - series[i - 1].depth);
  std::vector<double> sorted = distances;
  std::sort(sorted.begin(), sorted.end());
  const double usual = sorted[(sorted.size() - 1) / 2];
  const double allowed = std::max(equal_distance * usual, least_difference_mm);
  uint64_t missing = 0, gaps = 0;
  size_t widest = 0;
  for (size_t i = 0; i < distances.size(); ++i) {
    const double more = std::round(distances[i] / usual) - 1;
    if (more >= 1 && std::fabs(distances[i] - (more + 1) * usual) <= (more + 1) * allowed) {
      missing += static_cast<uint64_t>(std::min(more, 1e9));
      ++gaps;
    }
    if (distances[i] > distances[widest]) widest = i;
  }
  const std::string between = text_of(name_of(series[widest]), " and ", name_of(series[widest + 1]));
  if (gaps > 0)
    return failure(path, ": missing slices: ", missing, " in ", gaps, " gaps; the widest, of ",
                   rounded(distances[widest]), " mm, lies between ", between, "; others are ", rounded(usual),
                   " mm apart");
  if (sorted.back() - sorted[0] <= allowed) return success();
  return failure(path, ": slices are ", rounded(sorted[0]), " to ", rounded(sorted.back()),
                 " mm apart (widest between ", between, "); only even distances are read");
}

// The third axis goes from the first slice to the last, tilted or not.
Status stack(const std::string& path, const Series& series, Affine& map, std::string& note) {
  if (Status status = check_distances(path, series); !status) return status;
  const DicomHeader& first = series[0].header;
  const double steps = static_cast<double>(series.size() - 1);
  map.axes[2] = 1 / steps * (series.back().header.position - first.position);
  const double allowed = most_sideways * std::min(first.spacing[0], first.spacing[1]);
  for (size_t i = 0; i < series.size(); ++i) {
    const Point expected = first.position + static_cast<double>(i) * map.axes[2];
    const Point off = series[i].header.position - expected;
    const double sideways = std::hypot(dot(off, first.row), dot(off, first.column));
    if (sideways > std::max(allowed, least_difference_mm))
      return failure(series[i].path, ": lies ", rounded(sideways), " mm beside the line of the other slices");
  }
  const double tilt = std::acos(std::min(1.0, dot(unit(map.axes[2]), unit(cross(first.row, first.column)))));
  if (tilt > noted_tilt)
    note = text_of(path, ": slices are tilted by ", std::round(1800 / pi * tilt) / 10,
                   " degrees (gantry tilt); the mesh is in true places");
  return success();
}

Status set_map(const std::string& path, const Series& series, Volume& volume) {
  const DicomHeader& first = series[0].header;
  Affine& map = volume.to_world;
  map.axes[0] = first.spacing[0] * first.row;
  map.axes[1] = first.spacing[1] * first.column;
  map.origin = first.position;
  volume.space = Space::lps;
  if (first.frames > 1) {
    map.axes[2] = first.spacing[2] * unit(cross(first.row, first.column));
    volume.note = text_of(path, ": ", first.frames, " frames of one file, ", rounded(first.spacing[2]), " mm apart");
  } else if (Status status = stack(path, series, map, volume.note); !status) {
    return status;
  }
  return is_regular(map) ? success() : failure(path, ": positions and spacings give voxels no place or no volume");
}

// Slices of one series, in order.
Status find_slices(const std::string& path, const VolumeRequest& request, Series& series) {
  std::vector<std::string> files;
  if (Status status = list_files(path, files); !status) return status;
  std::vector<DicomHeader> headers;
  if (Status status = read_dicom_headers(files, headers); !status) return status;
  if (headers.size() != files.size()) return failure(path, ": GDCM's answer is damaged");
  if (Status status = choose_series(path, files, headers, series); !status) return status;
  const Point normal = cross(series[0].header.row, series[0].header.column);
  for (Slice& slice : series) {
    if (Status status = check_slice(slice); !status) return status;
    slice.depth = dot(slice.header.position, normal);
    if (!std::isfinite(slice.depth) || !(length(normal) > 0.5))
      return failure(slice.path, ": position and orientation are no numbers, or no directions");
    if (largest_difference({slice.header.spacing[0], slice.header.spacing[1], 0},
                           {series[0].header.spacing[0], series[0].header.spacing[1], 0}) > least_difference_mm)
      return failure(slice.path, ": PixelSpacing is not that of ", name_of(series[0]));
  }
  const bool frames = series[0].header.frames > 1;
  if (frames && series.size() > 1)
    return failure(path, ": ", series.size(), " files of several frames each; give one of them in a folder of its own");
  if (frames) return success();
  if (series.size() == 1) return failure(path, ": holds one slice, a volume has several");
  return choose_time(path, request, series);
}

}  // namespace

Status read_dicom(const std::string& path, const VolumeRequest& request, Volume& volume) {
  Series series;
  if (Status status = find_slices(path, request, series); !status) return status;
  const DicomHeader& first = series[0].header;
  const bool frames = first.frames > 1;
  if (frames && request.time.value_or(0) != 0)
    return failure(path, ": one time point, so that there is no --time ", *request.time);
  const int64_t sizes[3] = {first.columns, first.rows, frames ? first.frames : static_cast<int64_t>(series.size())};
  if (Status status = set_sizes(path, sizes, volume); !status) return status;
  if (Status status = set_map(path, series, volume); !status) return status;
  std::vector<std::string> paths;
  for (const Slice& slice : series) paths.push_back(slice.path);
  const uint64_t voxels = static_cast<uint64_t>(sizes[0] * sizes[1] * (frames ? sizes[2] : 1));
  volume.values.clear();
  return read_dicom_voxels(paths, {path, {}, voxels, request.allow_nan}, volume);
}

}  // namespace tool
