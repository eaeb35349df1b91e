// SPDX-License-Identifier: MIT
#include "tool/io/decoder.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#if TOOL_HAVE_ZLIB
#include <zlib.h>
#endif
#if TOOL_HAVE_BZIP2
#include <bzlib.h>
#endif

namespace tool {

namespace {

#if TOOL_HAVE_ZLIB
// A gzip or a zlib stream.
class Deflated {
 public:
  static constexpr const char* library = "zlib";
  // A gzip file may be several members in a row (RFC 1952, 2.2). Anything else behind a member is no part of the data.
  static constexpr unsigned char first_byte_of_member = 0x1f;

  ~Deflated() { inflateEnd(&stream_); }
  bool start() {
    constexpr int largest_window_either_header = 15 + 32;
    return inflateInit2(&stream_, largest_window_either_header) == Z_OK;
  }
  void restart() { inflateReset(&stream_); }
  void feed(unsigned char* bytes, size_t count) {
    stream_.next_in = bytes;
    stream_.avail_in = static_cast<uInt>(count);
  }
  size_t unread() const { return stream_.avail_in; }
  unsigned char next() const { return stream_.next_in[0]; }
  // Fills `room` bytes as far as the input goes.
  bool unpack(void* bytes, size_t room, size_t& made, bool& ended) {
    stream_.next_out = static_cast<Bytef*>(bytes);
    stream_.avail_out = static_cast<uInt>(room);
    const int answer = inflate(&stream_, Z_NO_FLUSH);
    made = room - stream_.avail_out;
    ended = answer == Z_STREAM_END;
    return ended || answer == Z_OK || answer == Z_BUF_ERROR;
  }
  const char* fault() const { return stream_.msg ? stream_.msg : "no zlib stream"; }

 private:
  z_stream stream_{};
};
#endif

#if TOOL_HAVE_BZIP2
class Bzipped {
 public:
  static constexpr const char* library = "bzip2";
  static constexpr unsigned char first_byte_of_member = 'B';

  ~Bzipped() { BZ2_bzDecompressEnd(&stream_); }
  bool start() { return BZ2_bzDecompressInit(&stream_, 0, 0) == BZ_OK; }
  void restart() {
    const bz_stream old = stream_;
    BZ2_bzDecompressEnd(&stream_);
    stream_ = bz_stream{};
    start();
    stream_.next_in = old.next_in;
    stream_.avail_in = old.avail_in;
  }
  void feed(unsigned char* bytes, size_t count) {
    stream_.next_in = reinterpret_cast<char*>(bytes);
    stream_.avail_in = static_cast<unsigned>(count);
  }
  size_t unread() const { return stream_.avail_in; }
  unsigned char next() const { return static_cast<unsigned char>(stream_.next_in[0]); }
  bool unpack(void* bytes, size_t room, size_t& made, bool& ended) {
    stream_.next_out = static_cast<char*>(bytes);
    stream_.avail_out = static_cast<unsigned>(room);
    const int answer = BZ2_bzDecompress(&stream_);
    made = room - stream_.avail_out;
    ended = answer == BZ_STREAM_END;
    return ended || answer == BZ_OK;
  }
  const char* fault() const { return "no bzip2 stream"; }

 private:
  bz_stream stream_{};
};
#endif

#if TOOL_HAVE_ZLIB || TOOL_HAVE_BZIP2
template <class Stream>
class Unpacker final : public Decoder {
 public:
  explicit Unpacker(const std::string& path) : path_(path) {}
  bool start() { return stream_.start(); }

  Status read(const Upstream& upstream, void* bytes, size_t wanted, size_t& got) override {
    got = 0;
    while (got < wanted && !finished_) {
      if (stream_.unread() == 0) {
        if (Status status = refill(upstream); !status) return status;
        if (finished_) break;
      }
      size_t made = 0;
      bool ended = false;
      const size_t piece = std::min(wanted - got, size_t{1} << 20);
      const bool good = stream_.unpack(static_cast<char*>(bytes) + got, piece, made, ended);
      got += made;
      produced_ += made;
      at_member_start_ = false;
      if (!good) {
        return failure(path_, ": compressed data damaged after ", produced_, " bytes (", stream_.fault(), ")");
      }
      if (ended) {
        if (Status status = next_member(upstream); !status) return status;
      }
    }
    return success();
  }

 private:
  Status refill(const Upstream& upstream) {
    size_t filled = 0;
    if (Status status = upstream(input_, sizeof input_, filled); !status) return status;
    stream_.feed(input_, filled);
    if (filled != 0) return success();
    if (!at_member_start_ || produced_ == 0) {
      return failure(path_, ": compressed data cut off after ", produced_, " bytes");
    }
    finished_ = true;
    return success();
  }

  Status next_member(const Upstream& upstream) {
    at_member_start_ = true;
    if (stream_.unread() == 0) {
      if (Status status = refill(upstream); !status) return status;
    }
    if (finished_ || stream_.next() != Stream::first_byte_of_member) {
      finished_ = true;
    } else {
      stream_.restart();
    }
    return success();
  }

  std::string path_;
  Stream stream_;
  unsigned char input_[1 << 16];
  uint64_t produced_ = 0;
  bool at_member_start_ = true, finished_ = false;
};

template <class Stream>
Status make_unpacker(const std::string& path, std::unique_ptr<Decoder>& decoder) {
  auto unpacker = std::make_unique<Unpacker<Stream>>(path);
  if (!unpacker->start()) return failure(path, ": ", Stream::library, " does not start (out of memory?)");
  decoder = std::move(unpacker);
  return success();
}
#endif

// Two digits a byte; blanks between digits are passed over.
class HexDecoder final : public Decoder {
 public:
  explicit HexDecoder(const std::string& path) : path_(path) {}

  Status read(const Upstream& upstream, void* bytes, size_t wanted, size_t& got) override {
    for (got = 0; got < wanted;) {
      int digits[2] = {-1, -1};
      for (int& digit : digits) {
        if (Status status = next_digit(upstream, digit); !status) return status;
        if (digit < 0) return success();
      }
      static_cast<unsigned char*>(bytes)[got++] = static_cast<unsigned char>(16 * digits[0] + digits[1]);
    }
    return success();
  }

 private:
  // -1 at the end.
  Status next_digit(const Upstream& upstream, int& digit) {
    for (digit = -1; digit < 0;) {
      if (at_ == filled_) {
        if (Status status = upstream(input_, sizeof input_, filled_); !status) return status;
        at_ = 0;
        if (filled_ == 0) return success();
      }
      const char c = input_[at_++];
      ++position_;
      if (c >= '0' && c <= '9') digit = c - '0';
      if (c >= 'a' && c <= 'f') digit = c - 'a' + 10;
      if (c >= 'A' && c <= 'F') digit = c - 'A' + 10;
      const bool blank = std::memchr(" \t\r\n\v\f", c, 6) != nullptr;
      if (digit < 0 && !blank) return failure(path_, ": character ", position_, " of the voxels is no hex digit");
    }
    return success();
  }

  std::string path_;
  char input_[1 << 14];
  size_t at_ = 0, filled_ = 0;
  uint64_t position_ = 0;
};

}  // namespace

const char* name_of(Packing packing) {
  switch (packing) {
    case Packing::none: return "raw";
    case Packing::deflate: return "gzip";
    case Packing::bzip2: return "bzip2";
    case Packing::hex: return "hex";
  }
  return "";
}

Packing packing_of(std::string_view first_bytes) {
  if (first_bytes.substr(0, 2) == "\x1f\x8b") return Packing::deflate;
  if (first_bytes.substr(0, 3) == "BZh") return Packing::bzip2;
  return Packing::none;
}

Status make_decoder(const std::string& path, Packing packing, std::unique_ptr<Decoder>& decoder) {
  switch (packing) {
    case Packing::hex: decoder = std::make_unique<HexDecoder>(path); return success();
#if TOOL_HAVE_ZLIB
    case Packing::deflate: return make_unpacker<Deflated>(path, decoder);
#endif
#if TOOL_HAVE_BZIP2
    case Packing::bzip2: return make_unpacker<Bzipped>(path, decoder);
#endif
    default: break;
  }
  const char* library = packing == Packing::deflate ? "zlib" : "libbz2";
  return failure(path, ": is compressed (", name_of(packing), "), and this build is without ", library);
}

}  // namespace tool
