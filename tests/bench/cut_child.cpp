// SPDX-License-Identifier: MIT
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "cutters.h"

namespace bench {

namespace {

struct CloseFile {
  void operator()(std::FILE* f) const { std::fclose(f); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

File TemporaryFile() {
  File file(std::tmpfile());
  if (!file) {
    std::perror("cut_bench: tmpfile");
    std::exit(2);
  }
  return file;
}

void WriteNumbers(std::FILE* file, const std::vector<double>& numbers) {
  std::fwrite(numbers.data(), sizeof(double), numbers.size(), file);
}

void WriteMesh(std::FILE* file, const Mesh& mesh) {
  WriteNumbers(file, {static_cast<double>(mesh.positions.size()), static_cast<double>(mesh.triangles.size())});
  WriteNumbers(file, mesh.positions);
  WriteNumbers(file, {mesh.triangles.begin(), mesh.triangles.end()});
}

bool ReadNumbers(std::FILE* file, std::vector<double>& numbers) {
  return std::fread(numbers.data(), sizeof(double), numbers.size(), file) == numbers.size();
}

bool ReadCut(std::FILE* file, Cut& cut) {
  std::rewind(file);
  std::vector<double> head(3);
  if (!ReadNumbers(file, head)) return false;
  cut.seconds = head[0];
  cut.mesh.positions.resize(static_cast<size_t>(head[1]));
  std::vector<double> corners(static_cast<size_t>(head[2]));
  if (!ReadNumbers(file, cut.mesh.positions) || !ReadNumbers(file, corners)) return false;
  for (const double corner : corners) cut.mesh.triangles.push_back(static_cast<uint32_t>(corner));
  return true;
}

// Of the child, whose cut is in the file.
Outcome OutcomeOf(pid_t child, std::FILE* file) {
  Outcome outcome;
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) != child) return outcome;
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (signal == SIGALRM)
    outcome.kind = Outcome::late;
  else if (signal != 0)
    outcome.kind = Outcome::crashed;
  else if (WEXITSTATUS(status) == 0 && ReadCut(file, outcome.cut))
    outcome.kind = Outcome::done;
  return outcome;
}

// Messages of peers would stand in the table.
void Silence() {
  if (std::freopen("/dev/null", "w", stderr) == nullptr) _exit(3);
}

// The mean of as many runs as fit into a tenth of a second.
std::optional<Cut> CutOften(Cutter cutter, const Mesh& mesh) {
  std::optional<Cut> cut;
  double sum = 0;
  int runs = 0;
  do {
    cut = cutter(mesh);
    if (!cut) return cut;
    sum += cut->seconds;
    ++runs;
  } while (sum < 0.1 && runs < 100);
  cut->seconds = sum / runs;
  return cut;
}

[[noreturn]] void CutAndExit(Cutter cutter, const Mesh& mesh, std::FILE* file) try {
  const std::optional<Cut> cut = CutOften(cutter, mesh);
  if (!cut) _exit(1);
  WriteNumbers(file, {cut->seconds});
  WriteMesh(file, cut->mesh);
  _exit(std::fflush(file) == 0 ? 0 : 3);
} catch (const std::exception&) {
  _exit(1);
}

}  // namespace

Outcome RunInChild(Cutter cutter, const Mesh& mesh, int seconds) {
  const File file = TemporaryFile();
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    alarm(static_cast<unsigned>(seconds));
    Silence();
    CutAndExit(cutter, mesh, file.get());
  }
  return OutcomeOf(child, file.get());
}

Outcome RunProgram(const std::vector<std::string>& command, const Mesh& mesh, int seconds) {
  const File input = TemporaryFile(), output = TemporaryFile();
  WriteMesh(input.get(), mesh);
  std::rewind(input.get());
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    alarm(static_cast<unsigned>(seconds));
    Silence();
    dup2(fileno(input.get()), STDIN_FILENO);
    dup2(fileno(output.get()), STDOUT_FILENO);
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    execvp(arguments[0], arguments.data());
    _exit(3);
  }
  return OutcomeOf(child, output.get());
}

}  // namespace bench
