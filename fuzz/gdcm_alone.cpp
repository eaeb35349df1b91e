// SPDX-License-Identifier: MIT
#include "gdcm_alone.h"

#include <pthread.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstdlib>

#include "sanitizer_end.h"

extern char** environ;

namespace fuzz {

namespace {

// A report of a sanitizer counts as a signal, whatever status the sanitizer would exit with.
void EndByASignal() {
  signal(SIGABRT, SIG_DFL);
  raise(SIGABRT);
}

void InTheOtherProcess() {
  for (const int of : {SIGSEGV, SIGBUS, SIGABRT, SIGILL, SIGFPE, SIGTERM, SIGXFSZ, SIGALRM, SIGUSR1, SIGUSR2})
    signal(of, SIG_DFL);
  AtSanitizerEnd(EndByASignal);
}

}  // namespace

void DieByTheSystem() {
  static const int error = pthread_atfork(nullptr, nullptr, InTheOtherProcess);
  (void)error;
}

bool GdcmAloneDies(const std::string& path) {
  const char* other = std::getenv("TOPOADAPT_GDCM_ALONE");
  std::string program = other != nullptr ? other : TOPOADAPT_GDCM_ALONE, file = path;
  if (program.empty()) return false;
  char* const arguments[] = {program.data(), file.data(), nullptr};
  pid_t process = 0;
  if (posix_spawn(&process, program.c_str(), nullptr, nullptr, arguments, environ) != 0) return false;
  int state = 0;
  while (waitpid(process, &state, 0) < 0 && errno == EINTR) continue;
  return WIFSIGNALED(state);
}

}  // namespace fuzz
