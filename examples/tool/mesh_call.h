// SPDX-License-Identifier: MIT
// mesh_call: what detect, resolve and validate have in common: options, and a mesh that is read, cleaned and loaded.
#pragma once

#include <initializer_list>
#include <string>

#include "tool/commands.h"
#include "tool/mend/clean.h"
#include "tool/mend/inside_out.h"
#include "tool/view/view.h"

namespace tool {

struct MeshCall {
  Arguments arguments;
  Outputs outputs;
  ViewOutputs view;
  SurfaceBounds bounds;
  CleanOptions clean;
  bool as_is = false, turns_all = false, turns_parts = false;
  bool takes_open = false;  // the command works without the library, too
  CleanMesh read;
  bool refuses_inside_out = false;  // says so itself, where all is
  InsideOut inside_out;             // as loaded
  size_t parts_turned = 0;
  Surface surface;
  tpa_config config;
  std::string path;
  double begin = clock_seconds();

  const TriangleMesh& mesh() const { return read.mesh; }
  bool is_open() const { return !read.rims.empty(); }
};

// Options that all three know, and those of one.
Status read_call(MeshCall& call, int count, const char* const* words, const std::vector<Option>& own);

// Reads, cleans and loads the mesh, and says what is odd. An open mesh fails, or stays unloaded where the command takes
// open ones.
Status load(MeshCall& call);

// Members of the report: what was cleaned, holes, and parts inside out.
void describe_reading(JsonWriter& json, const MeshCall& call);
// Members of "options".
void describe_options(JsonWriter& json, const MeshCall& call);

// One line for a mesh of which nothing would be left.
std::string line_of_all_turned(const MeshCall& call);

}  // namespace tool
