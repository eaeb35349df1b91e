// SPDX-License-Identifier: MIT
// Outputs of the tool on full disks, in folders that admit no new file, through links, and of killed processes: the
// file of before stays whole until the new one is.
#include <fcntl.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <functional>
#include <thread>

#include "support/tool_support.h"
#include "tool/io/output_file.h"

namespace output_files_test {
namespace {

using namespace support;
namespace fs = std::filesystem;

constexpr const char* old_bytes = "what stood here before\n";

// A disk in memory that only this process and its children see. Null, or why not.
const char* MountDisk(const std::string& place) {
  if (geteuid() != 0) return "mounting a disk needs the superuser";
  const bool mounted = unshare(CLONE_NEWNS) == 0 && mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                       mount("topoadapt-test", place.c_str(), "tmpfs", 0, "size=600k") == 0;
  return mounted ? nullptr : std::strerror(errno);
}

class OutputFiles : public Tool {
 protected:
  // Runs the tool, after `prepare` in the new process. The state as of waitpid.
  static pid_t Begin(const std::vector<std::string>& words, const std::function<void()>& prepare) {
    std::vector<char*> arguments = {const_cast<char*>(TOPOADAPT_TOOL_PATH)};
    for (const std::string& w : words) arguments.push_back(const_cast<char*>(w.c_str()));
    arguments.push_back(nullptr);
    const pid_t process = fork();
    if (process != 0) return process;
    const int nowhere = open("/dev/null", O_RDWR);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    prepare();
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  static int End(pid_t process) {
    int state = 0;
    while (waitpid(process, &state, 0) < 0 && errno == EINTR) continue;
    return state;
  }
  // No file may grow beyond `bytes`: the signal kills, or, ignored, writing fails as on a full disk.
  static int RunWithin(const std::vector<std::string>& words, uint64_t bytes, bool killed) {
    return End(Begin(words, [&] {
      const rlimit limit = {bytes, bytes}, no_core = {0, 0};
      setrlimit(RLIMIT_CORE, &no_core);
      setrlimit(RLIMIT_FSIZE, &limit);
      std::signal(SIGXFSZ, killed ? SIG_DFL : SIG_IGN);
    }));
  }
  std::vector<std::string> NamesIn(const fs::path& place) const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(place)) names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }
  // Every option with a file, for files that all exist.
  std::vector<std::vector<std::string>> EveryOutput() const {
    const std::string box = Write("box.off", Sphere({0, 0, 0}, 1, 8)), out = At("out/");
    fs::create_directories(out);
    const std::vector<std::string> segment = {"segment", "--phantom", "genus-3", "--iterations", "1", "--partial"};
    std::vector<std::vector<std::string>> calls = {{"resolve", box, "--out", out + "m.ply"},
                                                   {"resolve", box, "--out", out + "m.stl"},
                                                   {"resolve", box, "--out", out + "m.obj"},
                                                   {"resolve", box, "--out", out + "m.gii"},
                                                   {"detect", box, "--json", out + "r.json"},
                                                   {"resolve", box, "--out", At("m.off"), "--png", out + "p.png"},
                                                   {"resolve", box, "--out", At("m.off"), "--html", out + "p.html"}};
    for (const auto& [option, name] : {std::pair{"--out", "m.vtp"}, {"--mask", "k.nrrd"}, {"--save", "state"}}) {
      calls.push_back(segment);
      calls.back().insert(calls.back().end(), {option, out + name});
    }
    for (const auto& call : calls) std::ofstream(call.back(), std::ios::binary) << old_bytes;
    return calls;
  }
};

TEST_F(OutputFiles, AFullDiskLeavesTheFileOfBefore) {
  for (const auto& call : EveryOutput()) {
    const int state = RunWithin(call, 200, false);
    EXPECT_TRUE(WIFEXITED(state) && WEXITSTATUS(state) == 2) << call.back();
    EXPECT_EQ(Contents(call.back()), old_bytes);
  }
  EXPECT_EQ(NamesIn(At("out")).size(), EveryOutput().size()) << "files are left over";
}

TEST_F(OutputFiles, ADiskOf600KB) {
  const std::string disk = At("disk");
  fs::create_directories(disk);
  if (const char* reason = MountDisk(disk)) GTEST_SKIP() << "no disk can be mounted: " << reason;
  const std::string large = Write("large.ply", Sphere({0, 0, 0}, 1, 60));
  std::ofstream(disk + "/m.obj", std::ios::binary) << old_bytes;
  const Ended full = Call("resolve " + large + " --out " + disk + "/m.obj");
  EXPECT_EQ(full.exit_code, 2);
  EXPECT_NE(full.err.find("m.obj"), std::string::npos) << full.err;
  EXPECT_NE(full.err.find(std::strerror(ENOSPC)), std::string::npos) << full.err;
  EXPECT_EQ(Contents(disk + "/m.obj"), old_bytes);
  EXPECT_EQ(NamesIn(disk), std::vector<std::string>{"m.obj"});
  const std::string small = Write("small.ply", Sphere({0, 0, 0}, 1, 4));
  EXPECT_EQ(Call("resolve " + small + " --out " + disk + "/m.obj").exit_code, 0);
  EXPECT_NE(Contents(disk + "/m.obj"), old_bytes);
  EXPECT_EQ(umount(disk.c_str()), 0);
}

// What a killed process leaves: the old or the new file, and perhaps one file under way.
TEST_F(OutputFiles, KilledAtAHundredBytes) {
  const std::string mesh = Write("in.ply", Sphere({0, 0, 0}, 1, 8));
  const std::string out = At("out/m.obj");
  fs::create_directories(At("out"));
  ASSERT_EQ(Call("resolve " + mesh + " --out " + out).exit_code, 0);
  const std::string whole = Contents(out);
  for (uint64_t moment = 0; moment < 100; ++moment) {
    std::ofstream(out, std::ios::binary) << old_bytes;
    const int state = RunWithin({"resolve", mesh, "--out", out}, moment * whole.size() / 100, true);
    EXPECT_TRUE(WIFSIGNALED(state) && WTERMSIG(state) == SIGXFSZ) << moment;
    EXPECT_EQ(Contents(out), old_bytes) << moment;
    for (const std::string& name : NamesIn(At("out"))) {
      if (name == "m.obj") continue;
      EXPECT_EQ(name.rfind(".topoadapt-", 0), 0u) << name;
      fs::remove(At("out/" + name));
    }
  }
}

TEST_F(OutputFiles, KilledAtAHundredTimes) {
  const std::string mesh = Write("in.ply", Sphere({0, 0, 0}, 1, 16));
  const std::string out = At("out/m.obj");
  fs::create_directories(At("out"));
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_EQ(Call("resolve " + mesh + " --out " + out).exit_code, 0);
  const auto time = std::chrono::steady_clock::now() - begin;
  const std::string whole = Contents(out);
  int killed = 0;
  for (int moment = 0; moment < 100; ++moment) {
    std::ofstream(out, std::ios::binary) << old_bytes;
    const pid_t process = Begin({"resolve", mesh, "--out", out}, [] {});
    std::this_thread::sleep_for(time * moment / 100);
    kill(process, SIGKILL);
    killed += WIFSIGNALED(End(process)) ? 1 : 0;
    const std::string left = Contents(out);
    EXPECT_TRUE(left == old_bytes || left == whole) << moment << ": " << left.size() << " bytes";
  }
  EXPECT_GT(killed, 0);
}

TEST_F(OutputFiles, InputAndOutputMayBeOneFile) {
  const std::string mesh = Write("m.ply", Together({Sphere({0, 0, 0}, 1, 6), Sphere({0.9, 0.1, 0.2}, 1, 6)}));
  const std::string before = Contents(mesh);
  const int state = RunWithin({"resolve", mesh, "--out", mesh}, 500, false);
  EXPECT_TRUE(WIFEXITED(state) && WEXITSTATUS(state) == 2);
  EXPECT_EQ(Contents(mesh), before);
  EXPECT_EQ(Call("resolve " + mesh + " --out " + mesh).exit_code, 0);
  EXPECT_EQ(Call("detect " + mesh).exit_code, 0);
}

TEST_F(OutputFiles, LinksStay) {
  const std::string mesh = Write("in.ply", Sphere({0, 0, 0}, 1, 4));
  fs::create_directories(At("there"));
  fs::create_directories(At("here"));
  std::ofstream(At("there/m.ply"), std::ios::binary) << old_bytes;
  fs::permissions(At("there/m.ply"), fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("../there/m.ply", At("here/second.ply"));
  fs::create_symlink("second.ply", At("here/first.ply"));
  const std::string call = "resolve " + mesh + " --out " + At("here/first.ply");
  EXPECT_EQ(Call(call).exit_code, 0);
  EXPECT_EQ(fs::read_symlink(At("here/first.ply")), "second.ply");
  EXPECT_EQ(fs::read_symlink(At("here/second.ply")), "../there/m.ply");
  EXPECT_EQ(Contents(At("there/m.ply")).rfind("ply", 0), 0u);
  EXPECT_EQ(fs::status(At("there/m.ply")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  // A link to a file to come.
  fs::create_symlink("../there/new.ply", At("here/new.ply"));
  EXPECT_EQ(Call("resolve " + mesh + " --out " + At("here/new.ply")).exit_code, 0);
  EXPECT_TRUE(fs::is_symlink(At("here/new.ply")));
  EXPECT_EQ(Contents(At("there/new.ply")), Contents(At("there/m.ply")));
  fs::create_symlink("round.ply", At("here/round.ply"));
  Refuse("resolve " + mesh + " --out " + At("here/round.ply"), {"round.ply", "links"});
  // One file by two names.
  Refuse("resolve " + mesh + " --out " + At("here/first.ply") + " --json " + At("there/m.ply"), {"--out", "--json"});
  Refuse("resolve " + mesh + " --out " + At("here/../here/x.ply") + " --png " + At("here/x.ply"), {"--out", "--png"});
  EXPECT_EQ(NamesIn(At("here")).size(), 4u);
  EXPECT_EQ(NamesIn(At("there")).size(), 2u);
}

// A folder on a disk mounted for reading stops the superuser, too.
TEST_F(OutputFiles, AReadOnlyFolderIsRefusedFirst) {
  const std::string place = At("closed");
  fs::create_directories(place);
  std::ofstream(place + "/m.ply", std::ios::binary) << old_bytes;
  const bool root = geteuid() == 0;
  if (root) {
    if (const char* reason = MountDisk(place))
      GTEST_SKIP() << "the superuser may write everywhere, and no disk can be mounted: " << reason;
    std::ofstream(place + "/m.ply", std::ios::binary) << old_bytes;
    ASSERT_EQ(mount("topoadapt-test", place.c_str(), "tmpfs", MS_REMOUNT | MS_RDONLY, "size=600k"), 0);
  } else {
    fs::permissions(place, fs::perms::owner_read | fs::perms::owner_exec);
  }
  fs::create_symlink(place + "/m.ply", At("link.ply"));
  // The input is absent, and yet the message is about the output.
  for (const std::string& name : {place + "/m.ply", place + "/new.ply", At("link.ply")})
    Refuse("resolve " + At("absent.off") + " --out " + name, {fs::path(name).filename().string()});
  Refuse("detect " + At("absent.off") + " --json " + place + "/r.json", {"r.json"});
  EXPECT_EQ(Contents(place + "/m.ply"), old_bytes);
  if (root) {
    EXPECT_EQ(umount(place.c_str()), 0);
  } else {
    fs::permissions(place, fs::perms::owner_all);
  }
}

TEST_F(OutputFiles, DevicesAndPipesAreWrittenTo) {
  const std::string mesh = Write("in.off", Sphere({0, 0, 0}, 1, 4));
  const Ended direct = Call("detect " + mesh + " --json /dev/stdout");
  EXPECT_EQ(direct.exit_code, 0) << direct.err;
  EXPECT_NE(direct.out.find("\"vertices\":"), std::string::npos) << direct.out;
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  EXPECT_EQ(Call("detect " + mesh + " --json /dev/full").exit_code, 2);
  const std::string command = std::string(TOPOADAPT_TOOL_PATH) + " detect " + mesh + " > /dev/full 2> " + At("e");
  const int state = std::system(command.c_str());
  EXPECT_TRUE(WIFEXITED(state) && WEXITSTATUS(state) == 2);
  EXPECT_NE(Contents(At("e")).find("standard output"), std::string::npos);
}

}  // namespace
}  // namespace output_files_test
