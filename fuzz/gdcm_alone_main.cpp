// SPDX-License-Identifier: MIT
// gdcm_alone FILE: the calls of GDCM that read a DICOM slice, and nothing else. Exit 0 whatever is in the file; else
// GDCM has died of it, by a signal.
#include <gdcmImageHelper.h>
#include <gdcmImageReader.h>
#include <gdcmReader.h>
#include <gdcmTrace.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <exception>
#include <fstream>
#include <vector>

#include "sanitizer_end.h"

namespace {

// As much memory as examples/tool/io/apart.h allows. A sanitizer maps more addresses than any machine has bytes.
void BoundMemory() {
  unsigned long long pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  const unsigned long long now = pages * static_cast<unsigned long long>(sysconf(_SC_PAGESIZE));
  rlimit limit{};
  if (now >= 1ull << 42 || getrlimit(RLIMIT_AS, &limit) != 0) return;
  limit.rlim_cur = now + (1ull << 30);
  setrlimit(RLIMIT_AS, &limit);
}

void ReadHeader(const char* path) {
  std::ifstream stream(path, std::ios::binary);
  gdcm::Reader reader;
  reader.SetStream(stream);
  if (!stream || !reader.CanRead()) return;
  if (!reader.ReadUpToTag(gdcm::Tag(0x7fe0, 0x10), {gdcm::Tag(0x7fe0, 0x10)})) return;
  const gdcm::File& file = reader.GetFile();
  gdcm::MediaStorage storage;
  storage.SetFromFile(file);
  if (!gdcm::MediaStorage::IsImage(storage)) return;
  gdcm::ImageHelper::GetDimensionsValue(file);
  gdcm::ImageHelper::GetPixelFormatValue(file);
  gdcm::ImageHelper::GetOriginValue(file);
  gdcm::ImageHelper::GetDirectionCosinesValue(file);
  gdcm::ImageHelper::GetSpacingValue(file);
  gdcm::ImageHelper::GetRescaleInterceptSlopeValue(file);
}

void ReadImage(const char* path) {
  std::ifstream stream(path, std::ios::binary);
  gdcm::ImageReader reader;
  reader.SetStream(stream);
  if (!stream || !reader.Read()) return;
  const gdcm::Image& image = reader.GetImage();
  std::vector<char> voxels(image.GetBufferLength());
  image.GetBuffer(voxels.data());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  // A report of a sanitizer ends the program by a signal, too.
  fuzz::AtSanitizerEnd([] { raise(SIGABRT); });
  gdcm::Trace::DebugOff();
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
  BoundMemory();
  for (void (*const read)(const char*) : {ReadHeader, ReadImage}) try {
      read(argv[1]);
    } catch (const std::exception&) {
      continue;
    }
  return 0;
}
