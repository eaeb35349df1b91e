// SPDX-License-Identifier: MIT
// apart: work in a process of its own, so that a library which crashes on a damaged file, or asks for endless memory,
// takes nothing else along. The work sends records of bytes back.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "tool/result.h"

namespace tool {

class Sender {
 public:
  explicit Sender(int pipe) : pipe_(pipe) {}
  // False where nobody listens any more.
  bool send(std::string_view record) const;

 private:
  int pipe_;
};

struct ApartLimits {
  uint64_t bytes = uint64_t{1} << 30;  // of memory, beyond what this process has
  uint64_t seconds = 600;              // of processor time
};

// Calls work(sender) in the other process, and take(record) in this one for each record in turn. A record of `work`'s
// own failure ends both; so does a failure of `take`. Where the other process dies, died(reason) makes the failure.
Status run_apart(const ApartLimits& limits, const std::function<Status(const Sender&)>& work,
                 const std::function<Status(std::string_view record)>& take,
                 const std::function<Status(const std::string& reason)>& died);

}  // namespace tool
