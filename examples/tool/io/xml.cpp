// SPDX-License-Identifier: MIT
#include "tool/io/xml.h"

#include <algorithm>
#include <cstring>

#include "tool/io/files.h"

#if TOOL_HAVE_EXPAT
#include <expat.h>
#endif

namespace tool {

namespace {

const std::string no_text;

template <class T>
void append_as(std::string_view bytes, bool big_endian, std::vector<double>& numbers) {
  for (size_t at = 0; at < bytes.size(); at += sizeof(T))
    numbers.push_back(static_cast<double>(load<T>(bytes.data() + at, big_endian)));
}

}  // namespace

const std::string& XmlElement::operator[](const std::string& attribute) const {
  const auto found = attributes.find(attribute);
  return found == attributes.end() ? no_text : found->second;
}

const XmlElement* child_of(const XmlDocument& document, const XmlElement& element, std::string_view name) {
  for (const size_t child : element.children)
    if (document[child].name == name) return &document[child];
  return nullptr;
}

Status unpack(const std::string& path, std::string_view packed, size_t most, std::string& bytes) {
  std::unique_ptr<Decoder> decoder;
  if (Status status = make_decoder(path, Packing::deflate, decoder); !status) return status;
  const auto upstream = [&](void* to, size_t wanted, size_t& got) {
    got = std::min(wanted, packed.size());
    std::memcpy(to, packed.data(), got);
    packed.remove_prefix(got);
    return success();
  };
  // Believed as it unfolds.
  for (size_t done = 0;;) {
    const size_t piece = std::min(most + 1 - done, size_t{1} << 20);
    bytes.resize(done + piece);
    size_t got = 0;
    if (Status status = decoder->read(upstream, bytes.data() + done, piece, got); !status) return status;
    done += got;
    bytes.resize(done);
    if (got < piece) return success();
    if (done > most) return failure(path, ": an array unpacks to more bytes than it has numbers");
  }
}

bool append_numbers(std::string_view bytes, VoxelType type, bool big_endian, std::vector<double>& numbers) {
  if (bytes.size() % bytes_of(type) != 0) return false;
  switch (type) {
    case VoxelType::i8: append_as<int8_t>(bytes, big_endian, numbers); break;
    case VoxelType::u8: append_as<uint8_t>(bytes, big_endian, numbers); break;
    case VoxelType::i16: append_as<int16_t>(bytes, big_endian, numbers); break;
    case VoxelType::u16: append_as<uint16_t>(bytes, big_endian, numbers); break;
    case VoxelType::i32: append_as<int32_t>(bytes, big_endian, numbers); break;
    case VoxelType::u32: append_as<uint32_t>(bytes, big_endian, numbers); break;
    case VoxelType::i64: append_as<int64_t>(bytes, big_endian, numbers); break;
    case VoxelType::u64: append_as<uint64_t>(bytes, big_endian, numbers); break;
    case VoxelType::f32: append_as<float>(bytes, big_endian, numbers); break;
    case VoxelType::f64: append_as<double>(bytes, big_endian, numbers); break;
  }
  return true;
}

bool append_numbers(std::string_view text, std::vector<double>& numbers) {
  for (std::string_view word; next_word(text, word);) {
    double number = 0;
    if (!parse_real(word, number)) return false;
    numbers.push_back(number);
  }
  return true;
}

#if TOOL_HAVE_EXPAT

namespace {

// Files of meshes nest some ten deep.
constexpr size_t deepest = 100;

struct Reading {
  XML_Parser parser;
  XmlDocument& document;
  std::vector<size_t> open;
  const char* fault = nullptr;
};

void stop(Reading& reading, const char* fault) {
  reading.fault = fault;
  XML_StopParser(reading.parser, XML_FALSE);
}

void XMLCALL begin_element(void* data, const XML_Char* name, const XML_Char** attributes) {
  Reading& reading = *static_cast<Reading*>(data);
  if (reading.open.size() >= deepest) return stop(reading, "elements nest too deep");
  XmlElement element;
  element.name = name;
  for (; *attributes != nullptr; attributes += 2) element.attributes[attributes[0]] = attributes[1];
  const size_t number = reading.document.size();
  if (!reading.open.empty()) {
    element.parent = reading.open.back();
    reading.document[element.parent].children.push_back(number);
  }
  reading.document.push_back(std::move(element));
  reading.open.push_back(number);
}

void XMLCALL end_element(void* data, const XML_Char*) { static_cast<Reading*>(data)->open.pop_back(); }

void XMLCALL add_text(void* data, const XML_Char* text, int length) {
  Reading& reading = *static_cast<Reading*>(data);
  reading.document[reading.open.back()].text.append(text, static_cast<size_t>(length));
}

void XMLCALL refuse_entity(void* data, const XML_Char*, int, const XML_Char*, int, const XML_Char*, const XML_Char*,
                           const XML_Char*, const XML_Char*) {
  stop(*static_cast<Reading*>(data), "defines entities");
}

}  // namespace

Status parse_xml(const std::string& path, std::string_view bytes, XmlDocument& document) {
  document.clear();
  const std::unique_ptr<std::remove_pointer_t<XML_Parser>, void (*)(XML_Parser)> parser(XML_ParserCreate(nullptr),
                                                                                        XML_ParserFree);
  if (!parser) return failure(path, ": expat does not start (out of memory?)");
  Reading reading{parser.get(), document, {}};
  XML_SetUserData(parser.get(), &reading);
  XML_SetElementHandler(parser.get(), begin_element, end_element);
  XML_SetCharacterDataHandler(parser.get(), add_text);
  XML_SetEntityDeclHandler(parser.get(), refuse_entity);
  constexpr size_t largest_piece = size_t{1} << 26;
  for (bool last = false; !last;) {
    const std::string_view piece = bytes.substr(0, largest_piece);
    bytes.remove_prefix(piece.size());
    last = bytes.empty();
    if (XML_Parse(parser.get(), piece.data(), static_cast<int>(piece.size()), last ? 1 : 0) == XML_STATUS_OK) continue;
    const char* fault = reading.fault ? reading.fault : XML_ErrorString(XML_GetErrorCode(parser.get()));
    return failure(path, ": line ", XML_GetCurrentLineNumber(parser.get()), ": XML: ", fault);
  }
  return success();
}

#else

Status parse_xml(const std::string& path, std::string_view, XmlDocument&) {
  return failure(path, ": is XML, and this build is without expat");
}

#endif

}  // namespace tool
