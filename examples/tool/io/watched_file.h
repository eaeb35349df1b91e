// SPDX-License-Identifier: MIT
// watched_file: a file for GDCM, and silence of its messages.
#pragma once

#include <gdcmTrace.h>

#include <fstream>

namespace tool {

// A file that knows whether more bytes were asked for than there are. GDCM fills up voxels that are cut off.
class WatchedFile : public std::filebuf {
 public:
  bool cut_off() const { return cut_off_; }

 protected:
  std::streamsize xsgetn(char* bytes, std::streamsize wanted) override {
    const std::streamsize got = std::filebuf::xsgetn(bytes, wanted);
    // Behind the last element, the next one's number is looked for.
    constexpr std::streamsize tag = 4;
    cut_off_ = cut_off_ || (got < wanted && (got > 0 || wanted > tag));
    return got;
  }

 private:
  bool cut_off_ = false;
};

inline void silence_gdcm() {
  gdcm::Trace::DebugOff();
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
}

}  // namespace tool
