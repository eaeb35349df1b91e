// SPDX-License-Identifier: MIT
#include "tool/io/apart.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>

namespace tool {

namespace {

// A failure of the work, or its end.
constexpr char record_mark = 'r', failure_mark = 'f', end_mark = 'e';
// Larger records are signs of damage.
constexpr uint64_t largest_record = uint64_t{1} << 34;

bool write_all(int pipe, const char* bytes, size_t count) {
  while (count > 0) {
    const ssize_t written = write(pipe, bytes, std::min(count, size_t{1} << 20));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes += written;
    count -= static_cast<size_t>(written);
  }
  return true;
}

bool read_all(int pipe, char* bytes, size_t count) {
  while (count > 0) {
    const ssize_t got = read(pipe, bytes, std::min(count, size_t{1} << 20));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    bytes += got;
    count -= static_cast<size_t>(got);
  }
  return true;
}

bool send_marked(int pipe, char mark, std::string_view record) {
  char head[9] = {mark};
  const uint64_t size = record.size();
  std::memcpy(head + 1, &size, sizeof size);
  return write_all(pipe, head, sizeof head) && write_all(pipe, record.data(), record.size());
}

// Records arrive as fast as they are read, so that their memory is there when a size is.
bool receive(int pipe, char& mark, std::string& record) {
  char head[9];
  uint64_t size = 0;
  if (!read_all(pipe, head, sizeof head)) return false;
  mark = head[0];
  std::memcpy(&size, head + 1, sizeof size);
  if (size > largest_record) return false;
  record.clear();
  for (size_t done = 0; done < size;) {
    const size_t piece = std::min<size_t>(size - done, size_t{1} << 24);
    record.resize(done + piece);
    if (!read_all(pipe, record.data() + done, piece)) return false;
    done += piece;
  }
  return true;
}

void bound(int resource, uint64_t most) {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0) return;
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_cur, most);
  setrlimit(resource, &limit);
}

// A sanitizer maps more addresses than any machine has bytes; its processes stay unbounded.
void bound_memory(uint64_t bytes) {
  uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const uint64_t now = pages * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
  constexpr uint64_t more_than_any_program = uint64_t{1} << 42;
  if (pages > 0 && now < more_than_any_program) bound(RLIMIT_AS, now + bytes);
}

// The other process. Libraries' messages are not those of this program.
[[noreturn]] void work_and_exit(int pipe, const ApartLimits& limits, const std::function<Status(const Sender&)>& work) {
  const int nowhere = open("/dev/null", O_WRONLY);
  if (nowhere >= 0) dup2(nowhere, STDERR_FILENO);
  if (nowhere >= 0) dup2(nowhere, STDOUT_FILENO);
  signal(SIGPIPE, SIG_DFL);
  signal(SIGINT, SIG_DFL);
  bound(RLIMIT_CORE, 0);
  bound(RLIMIT_CPU, limits.seconds);
  bound_memory(limits.bytes);
  Status status = success();
  try {
    status = work(Sender(pipe));
  } catch (const std::exception&) {
    _exit(2);
  }
  const bool sent = status ? send_marked(pipe, end_mark, "") : send_marked(pipe, failure_mark, status.message);
  _exit(sent ? 0 : 1);
}

std::string reason_of(int state) {
  if (WIFSIGNALED(state)) return text_of("signal ", WTERMSIG(state), " (", strsignal(WTERMSIG(state)), ")");
  return "out of memory, or not understood";
}

}  // namespace

bool Sender::send(std::string_view record) const { return send_marked(pipe_, record_mark, record); }

Status run_apart(const ApartLimits& limits, const std::function<Status(const Sender&)>& work,
                 const std::function<Status(std::string_view record)>& take,
                 const std::function<Status(const std::string& reason)>& died) {
  int ends[2];
  if (pipe(ends) != 0) return failure("no pipe to another process: ", std::strerror(errno));
  std::fflush(nullptr);
  const pid_t other = fork();
  if (other < 0) {
    close(ends[0]);
    close(ends[1]);
    return failure("no other process: ", std::strerror(errno));
  }
  if (other == 0) {
    close(ends[0]);
    work_and_exit(ends[1], limits, work);
  }
  close(ends[1]);
  Status status = success();
  bool ended = false;
  std::string record;
  for (char mark = 0; !ended && status && receive(ends[0], mark, record);) {
    ended = mark != record_mark;
    if (mark == failure_mark) status = failure(record);
    if (mark == record_mark) status = take(record);
  }
  close(ends[0]);
  int state = 0;
  while (waitpid(other, &state, 0) < 0 && errno == EINTR) continue;
  return status && !ended ? died(reason_of(state)) : status;
}

}  // namespace tool
