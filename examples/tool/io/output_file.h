// SPDX-License-Identifier: MIT
// output_file: every file that the tool writes. The bytes go to a new file in the same folder, are flushed to the disk
// and checked, and take the name at the end. Until then the file of before stays whole, whatever happens.
#pragma once

#include <string>
#include <string_view>

#include "tool/result.h"

namespace tool {

// Follows symbolic links: the file at their end is replaced, and they stay. Other hard links to a replaced file keep
// the old bytes. Rights of a replaced file stay. A failure removes the new file; only a killed process leaves one
// (".topoadapt-...tmp"). A device or a pipe is written to directly.
Status write_file(const std::string& path, std::string_view bytes);

// Fails if write_file would surely fail: no such folder, a folder instead of a file, no right to write, or a folder
// that admits no new file. A file made for the trial is gone at the end.
Status check_output(const std::string& path);

// Do two names lead to one file, there or yet to be written? False for two empty names.
bool is_same_place(const std::string& one, const std::string& other);

}  // namespace tool
