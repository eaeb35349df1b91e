// SPDX-License-Identifier: MIT
#include "tool/view/view.h"

#include <array>

#include "tool/io/output_file.h"
#include "tool/view/picture.h"

namespace tool {

Status read_view(const Arguments& arguments, const Outputs& outputs, ViewOutputs& view) {
  for (Status s : {read_text(arguments, "--html", view.html), read_text(arguments, "--png", view.png)})
    if (!s) return s;
  const std::array<std::pair<const char*, const std::string*>, 4> files = {
      {{"--out", &outputs.mesh}, {"--json", &outputs.json}, {"--html", &view.html}, {"--png", &view.png}}};
  for (size_t i = 2; i < files.size(); ++i) {
    const auto& [name, path] = files[i];
    if (path->empty()) continue;
    if (Status s = check_output(*path); !s) return s;
    for (size_t k = 0; k < i; ++k)
      if (is_same_place(*path, *files[k].second)) return failure(files[k].first, " and ", name, " both write ", *path);
  }
  return success();
}

void describe(JsonWriter& json, const ViewOutputs& view) {
  view.html.empty() ? json.key("html").null() : json.member("html", view.html);
  view.png.empty() ? json.key("png").null() : json.member("png", view.png);
}

Status write_view(const ViewOutputs& view, const PageContent& content) {
  if (!view.html.empty())
    if (Status s = write_file(view.html, page_of(content)); !s) return s;
  return view.png.empty() ? success() : write_file(view.png, picture_of(content));
}

}  // namespace tool
