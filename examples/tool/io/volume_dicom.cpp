// SPDX-License-Identifier: MIT
// volume_dicom: a DICOM series as one volume: slices of one series in the order of their positions along the normal,
// whatever their names and numbers. Millimetres in the patient's space, LPS.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

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
  DicomFrame at;
  size_t frame = 0, frames = 1;  // number within the file, of so many
  double depth = 0;              // along the normal
};
using Series = std::vector<Slice>;

double largest_difference(const Point& a, const Point& b) {
  double most = 0;
  for (size_t k = 0; k < 3; ++k) most = std::max(most, std::fabs(a[k] - b[k]));
  return most;
}

bool is_parallel(const DicomFrame& a, const DicomFrame& b) {
  return largest_difference(a.row, b.row) < equal_direction && largest_difference(a.column, b.column) < equal_direction;
}

bool belong_together(const Slice& a, const DicomFile& b) {
  const DicomHeader &one = a.header, &other = b.header;
  return std::string_view(one.series) == other.series && one.rows == other.rows && one.columns == other.columns &&
         is_parallel(a.at, b.frames[0]);
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

std::string name_of_file(const std::string& path) { return std::filesystem::path(path).filename().string(); }

std::string name_of(const Slice& slice) {
  const std::string file = name_of_file(slice.path);
  return slice.frames > 1 ? text_of(file, " frame ", slice.frame + 1) : file;
}

std::string path_of(const Slice& slice) {
  return slice.frames > 1 ? text_of(slice.path, ": frame ", slice.frame + 1) : slice.path;
}

size_t files_of(const Series& series) {
  return static_cast<size_t>(
      std::count_if(series.begin(), series.end(), [](const Slice& slice) { return slice.frame == 0; }));
}

// Which of several series is meant?
Status refuse_several(const std::string& path, const std::vector<Series>& series) {
  std::string list;
  for (size_t i = 0; i < std::min<size_t>(series.size(), 8); ++i) {
    const Slice& first = series[i][0];
    list += text_of(i > 0 ? "; " : "", name_of_file(first.path), " (", files_of(series[i]), " files, ",
                    first.header.modality, " ", first.header.columns, " x ", first.header.rows, ", \"",
                    first.header.description, "\")");
  }
  return failure(path, ": holds ", series.size(), " series; give a file of the one that is meant: ", list,
                 series.size() > 8 ? "; ..." : "");
}

Status fault_of(const std::string& path, const DicomFile& file) {
  return file.fault.empty() ? failure(path, ": is DICOM, but damaged")
                            : failure(path, ": damaged; GDCM ended by ", file.fault);
}

// The series of all sound files, in the order of their first files.
Status sort_into_series(const std::string& path, const std::vector<std::string>& paths,
                        const std::vector<DicomFile>& files, std::vector<Series>& all) {
  for (size_t i = 0; i < files.size(); ++i) {
    const DicomFile& file = files[i];
    if (!file.header.is_image || file.frames.empty()) {
      if (paths[i] == path)
        return file.header.is_damaged ? fault_of(path, file) : failure(path, ": holds no DICOM image");
      continue;
    }
    size_t k = 0;
    while (k < all.size() && !belong_together(all[k][0], file)) ++k;
    if (k == all.size()) all.emplace_back();
    for (size_t frame = 0; frame < file.frames.size(); ++frame)
      all[k].push_back({paths[i], file.header, file.frames[frame], frame, file.frames.size()});
  }
  return all.empty() ? failure(path, ": holds no DICOM image") : success();
}

// A dose or a segmentation in the folder of the images that it belongs to is not what is meant.
void leave_out_supplements(std::vector<Series>& all, std::string& note) {
  const auto is_supplement = [](const Series& series) { return series[0].header.is_supplement; };
  if (std::count_if(all.begin(), all.end(), is_supplement) + 1 != static_cast<std::ptrdiff_t>(all.size())) return;
  for (const Series& series : all)
    if (is_supplement(series))
      note += text_of(note.empty() ? "" : "; ", name_of_file(series[0].path), " (", series[0].header.modality,
                      ") is left out");
  all.erase(std::remove_if(all.begin(), all.end(), is_supplement), all.end());
}

// Damaged files count as slices of the series, unless they name another one.
Status check_damage(const std::vector<std::string>& paths, const std::vector<DicomFile>& files, const Series& chosen,
                    std::string& note) {
  for (size_t i = 0; i < files.size(); ++i) {
    const DicomHeader& header = files[i].header;
    if (!header.is_damaged) continue;
    const std::string_view series = header.series;
    if (series.empty() || series == chosen[0].header.series) return fault_of(paths[i], files[i]);
    note += text_of(note.empty() ? "" : "; ", name_of_file(paths[i]), " (of another series) is damaged");
  }
  return success();
}

Status choose_series(const std::string& path, const std::vector<std::string>& paths,
                     const std::vector<DicomFile>& files, Series& chosen, std::string& note) {
  std::vector<Series> all;
  if (Status status = sort_into_series(path, paths, files, all); !status) {
    // With nothing else in the folder, the damage is the reason.
    for (size_t i = 0; i < files.size(); ++i)
      if (files[i].header.is_damaged) return fault_of(paths[i], files[i]);
    return status;
  }
  for (Series& series : all)
    for (const Slice& slice : series)
      if (slice.path == path) {
        chosen = series;
        return check_damage(paths, files, chosen, note);
      }
  leave_out_supplements(all, note);
  chosen = all[0];
  if (all.size() == 1) return check_damage(paths, files, chosen, note);
  for (size_t i = 0; i < files.size(); ++i)
    if (files[i].header.is_damaged) return fault_of(paths[i], files[i]);
  return refuse_several(path, all);
}

Status check_slice(const Slice& slice, const Slice& first) {
  if (slice.header.samples != 1)
    return failure(slice.path, ": ", slice.header.samples, " numbers for each voxel (colours), one is needed");
  if (!slice.at.has_place)
    return failure(path_of(slice), ": gives no ImagePositionPatient and ImageOrientationPatient");
  if (!slice.at.has_spacing) return failure(path_of(slice), ": gives no PixelSpacing");
  if (!is_parallel(slice.at, first.at))
    return failure(path_of(slice), ": ImageOrientationPatient is not that of ", name_of(first));
  const DicomFrame &a = slice.at, &b = first.at;
  if (largest_difference({a.spacing[0], a.spacing[1], 0}, {b.spacing[0], b.spacing[1], 0}) > least_difference_mm)
    return failure(path_of(slice), ": PixelSpacing is not that of ", name_of(first));
  return success();
}

// One slice of each place, number `request.time` of several.
Status choose_time(const std::string& path, const VolumeRequest& request, Series& series) {
  std::sort(series.begin(), series.end(), [](const Slice& a, const Slice& b) {
    if (a.depth != b.depth) return a.depth < b.depth;
    return a.path != b.path ? a.path < b.path : a.frame < b.frame;
  });
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
    std::stable_sort(place.begin(), place.end(), [](const Slice& a, const Slice& b) {
      return std::pair(a.at.time, a.header.instance) < std::pair(b.at.time, b.header.instance);
    });
  }
  if (times > 1 && !request.time)
    return failure(path, ": ", times, " slices at each place (time points): --time K, from 0 to ", times - 1,
                   ", picks one by TemporalPositionIndex, InstanceNumber, or number of the frame");
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
  const DicomFrame& first = series[0].at;
  const double steps = static_cast<double>(series.size() - 1);
  map.axes[2] = 1 / steps * (series.back().at.position - first.position);
  const double allowed = most_sideways * std::min(first.spacing[0], first.spacing[1]);
  for (size_t i = 0; i < series.size(); ++i) {
    const Point expected = first.position + static_cast<double>(i) * map.axes[2];
    const Point off = series[i].at.position - expected;
    const double sideways = std::hypot(dot(off, first.row), dot(off, first.column));
    if (sideways > std::max(allowed, least_difference_mm))
      return failure(path_of(series[i]), ": lies ", rounded(sideways), " mm beside the line of the other slices");
  }
  const double tilt = std::acos(std::min(1.0, dot(unit(map.axes[2]), unit(cross(first.row, first.column)))));
  if (tilt > noted_tilt)
    note = text_of(path, ": slices are tilted by ", std::round(1800 / pi * tilt) / 10,
                   " degrees (gantry tilt); the mesh is in true places");
  return success();
}

Status set_map(const std::string& path, const Series& series, Volume& volume) {
  const DicomFrame& first = series[0].at;
  Affine& map = volume.to_world;
  map.axes[0] = first.spacing[0] * first.row;
  map.axes[1] = first.spacing[1] * first.column;
  map.origin = first.position;
  volume.space = Space::lps;
  if (Status status = stack(path, series, map, volume.note); !status) return status;
  if (series[0].header.is_guess)
    volume.note = text_of(path, ": ", series.size(), " frames without places of their own, ", rounded(map.spacing(2)),
                          " mm apart as GDCM finds");
  return is_regular(map) ? success() : failure(path, ": positions and spacings give voxels no place or no volume");
}

// Slices of one series, in order.
Status find_slices(const std::string& path, const VolumeRequest& request, Series& series, std::string& note) {
  std::vector<std::string> paths;
  if (Status status = list_files(path, paths); !status) return status;
  std::vector<DicomFile> files;
  if (Status status = read_dicom_headers(paths, files); !status) return status;
  if (Status status = choose_series(path, paths, files, series, note); !status) return status;
  if (!note.empty()) note = text_of(path, ": ", note);
  const Point normal = cross(series[0].at.row, series[0].at.column);
  for (Slice& slice : series) {
    if (Status status = check_slice(slice, series[0]); !status) return status;
    slice.depth = dot(slice.at.position, normal);
    if (!std::isfinite(slice.depth) || !(length(normal) > 0.5))
      return failure(path_of(slice), ": position and orientation are no numbers, or no directions");
  }
  if (series.size() == 1) return failure(path, ": holds one slice, a volume has several");
  if (Status status = choose_time(path, request, series); !status) return status;
  return series.size() > 1 ? success() : failure(path, ": holds one slice at each time, a volume has several");
}

// The slices file by file, and for each slice its number among the voxels that are read.
std::vector<DicomPick> picks_of(const Series& series, std::vector<size_t>& order) {
  std::map<std::string, size_t> known;
  std::vector<DicomPick> picks;
  for (const Slice& slice : series) {
    const auto [at, is_new] = known.emplace(slice.path, picks.size());
    if (is_new) picks.push_back({slice.path, slice.frames, {}, {}});
    picks[at->second].frames.push_back(slice.frame);
    picks[at->second].scales.push_back(slice.at);
  }
  std::vector<size_t> next(picks.size());
  for (size_t p = 1; p < picks.size(); ++p) next[p] = next[p - 1] + picks[p - 1].frames.size();
  for (const Slice& slice : series) order.push_back(next[known[slice.path]]++);
  return picks;
}

}  // namespace

Status read_dicom(const std::string& path, const VolumeRequest& request, Volume& volume) {
  Series series;
  std::string note;
  if (Status status = find_slices(path, request, series, note); !status) return status;
  const DicomHeader& first = series[0].header;
  const int64_t sizes[3] = {first.columns, first.rows, static_cast<int64_t>(series.size())};
  if (Status status = set_sizes(path, sizes, volume); !status) return status;
  if (Status status = set_map(path, series, volume); !status) return status;
  if (volume.note.empty()) volume.note = note;
  std::vector<size_t> order;
  const std::vector<DicomPick> picks = picks_of(series, order);
  const size_t slice = static_cast<size_t>(sizes[0] * sizes[1]);
  volume.values.clear();
  if (Status status = read_dicom_voxels(picks, {path, {}, slice, request.allow_nan}, volume); !status) return status;
  if (std::is_sorted(order.begin(), order.end())) return success();
  // Files of several frames each that alternate.
  std::vector<float> sorted;
  sorted.reserve(volume.values.size());
  for (const size_t at : order) {
    const auto begin = volume.values.begin() + static_cast<std::ptrdiff_t>(at * slice);
    sorted.insert(sorted.end(), begin, begin + static_cast<std::ptrdiff_t>(slice));
  }
  volume.values.swap(sorted);
  return success();
}

}  // namespace tool
