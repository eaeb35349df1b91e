// SPDX-License-Identifier: MIT
// page: one self-contained web page of a run: its meshes, the slices of its volume, its events and numbers. It needs no
// network and a browser with WebGL 2.
#pragma once

#include <string>
#include <vector>

#include "tool/io/volume.h"
#include "tool/view/film.h"

namespace tool {

struct PageContent {
  std::string command, title;    // "segment", "scan.nii.gz"
  std::string report;            // of --json
  std::string time_name;         // "iteration"
  std::string unit;              // of lengths; empty: none
  Space space = Space::unnamed;  // of the film's places
  const Film* film = nullptr;
  const Volume* volume = nullptr;  // null: none
  double threshold = 0;            // of the object in the volume
  std::vector<std::string> notes;  // lines for the reader
};

// The whole text. O(voxels + triangles of the film).
std::string page_of(const PageContent& content);

// Texts of web/, which the build makes constants of.
extern const char page_html[], page_css[], page_js[];

}  // namespace tool
