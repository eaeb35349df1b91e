// SPDX-License-Identifier: MIT
// gdcm_alone: who is at fault where the process that reads a DICOM file dies? A program with calls of GDCM and nothing
// of the tool (gdcm_alone_main.cpp) reads the file again, under the same sanitizers. Where it ends in peace, the fault
// is the tool's.
#pragma once

#include <string>

namespace fuzz {

// From now on processes made by fork() leave signals and reports of sanitizers to the system. Else a fuzzer takes the
// death of such a process for its own, and writes a file for each.
void DieByTheSystem();
// Does GDCM alone die of a signal on the file? False without GDCM. TOPOADAPT_GDCM_ALONE in the environment names
// another program.
bool GdcmAloneDies(const std::string& path);

}  // namespace fuzz
