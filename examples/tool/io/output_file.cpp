// SPDX-License-Identifier: MIT
#include "tool/io/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace tool {

namespace {

namespace fs = std::filesystem;

// Links of /proc lead to what a process has open, by no name of a file.
bool is_of_process(const fs::path& path) { return path.native().rfind("/proc/", 0) == 0; }

// The end of a chain of links, which need not exist. Empty for a chain without an end.
fs::path end_of_links(const std::string& path) {
  constexpr int longest_chain = 40;  // as on Linux
  std::error_code error;
  fs::path at = fs::absolute(path, error);
  for (int i = 0; i < longest_chain; ++i) {
    if (is_of_process(at) || !fs::is_symlink(at, error)) return at;
    at = (at.parent_path() / fs::read_symlink(at, error)).lexically_normal();
  }
  return {};
}

Status failure_of(const std::string& path, const char* what) {
  return failure(path, ": ", what, ": ", std::strerror(errno));
}

// A file that goes with its name, unless kept.
class NewFile {
 public:
  explicit NewFile(const fs::path& folder) {
    static std::atomic<unsigned> count = 0;
    constexpr unsigned most_trials = 1000;  // names that killed processes have left
    for (unsigned trial = 0; trial < most_trials && file_ < 0; ++trial) {
      name_ = folder / text_of(".topoadapt-", getpid(), '-', count.fetch_add(1), ".tmp");
      file_ = open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (file_ < 0 && errno != EEXIST) return;
    }
    there_ = file_ >= 0;
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile() {
    if (file_ >= 0) close(file_);
    if (there_) unlink(name_.c_str());
  }

  bool is_open() const { return there_; }
  int file() const { return file_; }
  // An error may come as late as here.
  bool end() {
    const bool flushed = fsync(file_) == 0;
    const int error = errno;
    const bool closed = close(file_) == 0;
    file_ = -1;
    if (!flushed) errno = error;
    return flushed && closed;
  }
  bool rename_to(const fs::path& path) {
    there_ = std::rename(name_.c_str(), path.c_str()) != 0;
    return !there_;
  }

 private:
  fs::path name_;
  int file_ = -1;
  bool there_ = false;
};

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = write(file, bytes.data(), std::min(bytes.size(), size_t{1} << 24));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<size_t>(written));
  }
  return true;
}

Status write_directly(const std::string& path, std::string_view bytes) {
  const int file = open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) return failure_of(path, "cannot be opened for writing");
  const bool written = write_all(file, bytes);
  Status status = written ? success() : failure_of(path, "writing failed");
  close(file);
  return status;
}

// Makes the new name last. Some file systems refuse, and need no such call.
void flush_folder(const fs::path& folder) {
  const int handle = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (handle < 0) return;
  fsync(handle);
  close(handle);
}

}  // namespace

Status write_file(const std::string& path, std::string_view bytes) {
  const fs::path place = end_of_links(path);
  if (place.empty()) return failure(path, ": the links lead nowhere");
  struct stat before {};
  const bool exists = stat(place.c_str(), &before) == 0;
  if (is_of_process(place) || (exists && !S_ISREG(before.st_mode))) return write_directly(path, bytes);
  NewFile file(place.parent_path());
  if (!file.is_open()) return failure_of(path, "the folder admits no new file");
  // The owner of a replaced file stays where the process may see to this; without the right, the file is the writer's.
  if (exists && (before.st_uid != geteuid() || before.st_gid != getegid()))
    if (fchown(file.file(), before.st_uid, before.st_gid) != 0) errno = 0;
  if (exists && fchmod(file.file(), before.st_mode & 07777) != 0) return failure_of(path, "rights cannot be kept");
  if (!write_all(file.file(), bytes) || !file.end())
    return failure_of(path, text_of("writing ", bytes.size(), " bytes failed").c_str());
  if (!file.rename_to(place)) return failure_of(path, "the file cannot take its name");
  flush_folder(place.parent_path());
  return success();
}

Status check_output(const std::string& path) {
  std::error_code error;
  const fs::path place = end_of_links(path), folder = place.parent_path();
  if (place.empty()) return failure(path, ": the links lead nowhere");
  if (fs::is_directory(place, error)) return failure(path, ": is a folder");
  if (!fs::is_directory(folder, error)) return failure(path, ": there is no folder ", folder.string());
  const bool exists = fs::exists(place, error);
  if (exists && access(place.c_str(), W_OK) != 0) return failure_of(path, "cannot be opened for writing");
  if (is_of_process(place) || (exists && !fs::is_regular_file(place, error))) return success();
  const NewFile trial(folder);
  if (trial.is_open()) return success();
  return failure_of(path, text_of("the folder ", folder.string(), " admits no new file").c_str());
}

bool is_same_place(const std::string& one, const std::string& other) {
  if (one.empty() || other.empty()) return false;
  if (one == other) return true;
  std::error_code error;
  const fs::path a = end_of_links(one), b = end_of_links(other);
  if (fs::equivalent(a, b, error)) return fs::is_regular_file(a, error);
  return a.filename() == b.filename() && fs::equivalent(a.parent_path(), b.parent_path(), error);
}

}  // namespace tool
