// SPDX-License-Identifier: MIT
// view: the options --html and --png of the commands that have something to look at.
#pragma once

#include "tool/commands.h"
#include "tool/view/page.h"

namespace tool {

struct ViewOutputs {
  std::string html, png;  // paths, empty if not wanted

  bool wanted() const { return !html.empty() || !png.empty(); }
};

// Fails if a file cannot be written, or is one of the command's others.
Status read_view(const Arguments& arguments, const Outputs& outputs, ViewOutputs& view);

// Members of "options".
void describe(JsonWriter& json, const ViewOutputs& view);

Status write_view(const ViewOutputs& view, const PageContent& content);

}  // namespace tool
