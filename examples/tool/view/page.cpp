// SPDX-License-Identifier: MIT
#include "tool/view/page.h"

#include "tool/io/base64.h"
#include "tool/json.h"
#include "tool/view/deflate.h"
#include "tool/view/packing.h"

namespace tool {

namespace {

// Base64 of zlib streams, each in an element of its own.
struct Blobs {
  std::string html;
  size_t count = 0;

  size_t add(std::string_view bytes) {
    html += text_of("<script type=\"text/plain\" id=\"blob", count, "\">", base64(zlib_stream(bytes)), "</script>\n");
    return count++;
  }
};

template <class Values>
void describe_numbers(JsonWriter& json, std::string_view key, const Values& values) {
  json.key(key).begin_array();
  for (const auto& v : values) json.value(v);
  json.end_array();
}

std::string describe_volume(JsonWriter& json, const PageContent& c, Blobs& blobs) {
  json.key("volume");
  if (!c.volume) {
    json.null();
    return {};
  }
  const PackedVolume p = pack_volume(*c.volume);
  json.begin_object().member("blob", blobs.add(p.bytes)).member("threshold", c.threshold);
  describe_numbers(json, "size", p.size);
  describe_numbers(json, "steps", p.steps);
  const Point origin = c.film->map(p.to_world.origin);
  describe_numbers(json, "origin", origin);
  json.key("axes").begin_array();
  for (const Point& axis : p.to_world.axes) {
    const Point shown = c.film->map(p.to_world.origin + axis) - origin;
    json.begin_array().value(shown[0]).value(shown[1]).value(shown[2]).end_array();
  }
  json.end_array();
  json.member("low", p.low).member("high", p.high).end_object();
  if (p.steps[0] * p.steps[1] * p.steps[2] == 1) return {};
  return text_of("detail of the slices, which show means of ", p.steps[0], " x ", p.steps[1], " x ", p.steps[2],
                 " voxels");
}

std::string describe_frames(JsonWriter& json, const Film& film, Blobs& blobs) {
  json.key("frames").begin_array();
  size_t coarse = 0;
  for (const FilmFrame& frame : film.frames) {
    const PackedMesh p = pack_mesh(frame.mesh, frame.marks);
    json.begin_object().member("time", frame.time).member("name", frame.name).member("blob", blobs.add(p.bytes));
    json.member("vertices", p.vertices).member("triangles", p.triangles).member("marked", !frame.marks.empty());
    describe_numbers(json, "box", p.box);
    json.end_object();
    coarse += frame.triangles > 0 ? 1u : 0u;
  }
  json.end_array();
  if (coarse == 0) return {};
  return text_of("triangles of ", coarse, coarse == 1 ? " mesh" : " meshes", ", drawn coarser than in the run");
}

void describe_moments(JsonWriter& json, const Film& film) {
  json.key("moments").begin_array();
  for (const FilmMoment& m : film.moments) {
    json.begin_array().value(m.time).value(m.genus).value(m.components).value(m.vertices);
    json.value(m.volume).end_array();
  }
  json.end_array();
  json.key("events").begin_array();
  for (const FilmEvent& e : film.events) {
    json.begin_object().member("time", e.time).member("merge", e.merge).member("split", e.split);
    json.member("genus_up", e.genus_up).member("genus_down", e.genus_down).member("death", e.death);
    json.member("rollback", e.rollback);
    json.key("places").begin_array();
    for (const Point& p : e.places) json.begin_array().value(p[0]).value(p[1]).value(p[2]).end_array();
    json.end_array().end_object();
  }
  json.end_array();
}

// Nothing in the text may end the element.
std::string inside_script(std::string text) {
  for (size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
  return text;
}

void replace_mark(std::string& text, std::string_view mark, std::string_view by) {
  text.replace(text.find(mark), mark.size(), by);
}

}  // namespace

std::string page_of(const PageContent& c) {
  const Film& film = *c.film;
  Blobs blobs;
  JsonWriter json;
  json.begin_object().member("command", c.command).member("title", c.title).member("time_name", c.time_name);
  json.member("unit", c.unit).member("space", name_of(c.space));
  std::vector<std::string> notes = c.notes;
  notes.push_back(describe_volume(json, c, blobs));
  notes.push_back(describe_frames(json, film, blobs));
  describe_moments(json, film);
  const auto note_stride = [&](size_t stride, const char* of) {
    if (stride > 1) notes.push_back(text_of(of, " but for one in ", stride));
  };
  note_stride(film.frame_stride, "meshes of the run");
  note_stride(film.moment_stride, "points of the chart");
  if (film.events_left_out > 0) notes.push_back(text_of("the last ", film.events_left_out, " moments with events"));
  std::erase(notes, "");
  describe_numbers(json, "notes", notes);
  std::string data = json.text();
  data += ",\"report\":" + c.report + "}";
  std::string page = page_html;
  replace_mark(page, "/*STYLE*/", page_css);
  replace_mark(page, "<!--DATA-->",
               "<script type=\"application/json\" id=\"data\">" + inside_script(data) + "</script>\n" + blobs.html);
  replace_mark(page, "/*SCRIPT*/", page_js);
  return page;
}

}  // namespace tool
