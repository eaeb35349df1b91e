// SPDX-License-Identifier: MIT
// xml: an XML file as its elements, read by expat. TOOL_HAVE_EXPAT is 1 if the build found it.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "tool/io/volume_source.h"
#include "tool/result.h"

namespace tool {

struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;  // of the element itself
  size_t parent = 0;
  std::vector<size_t> children;  // numbers of elements

  // Empty where there is no such attribute.
  const std::string& operator[](const std::string& attribute) const;
};

// Elements in the order of their start tags; the root is number 0, its own parent.
using XmlDocument = std::vector<XmlElement>;

// Fails, naming expat, in a build without it. Documents that define entities are refused.
Status parse_xml(const std::string& path, std::string_view bytes, XmlDocument& document);

// The first child of that name; null without.
const XmlElement* child_of(const XmlDocument& document, const XmlElement& element, std::string_view name);

// Bytes unpacked from zlib or gzip, at most `most`. `path` starts the messages.
Status unpack(const std::string& path, std::string_view packed, size_t most, std::string& bytes);

// Appends numbers of a type, lying one after the other, as doubles. Fails unless `bytes` are whole numbers.
bool append_numbers(std::string_view bytes, VoxelType type, bool big_endian, std::vector<double>& numbers);

// The same of a text.
bool append_numbers(std::string_view text, std::vector<double>& numbers);

}  // namespace tool
