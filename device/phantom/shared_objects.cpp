// SPDX-License-Identifier: BSD-3-Clause
#include "device/phantom/shared_objects.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <sstream>

extern char** environ;

namespace forceshade::device {
namespace {

namespace fs = std::filesystem;

// The standard output of a program, in English; none where it cannot be started or fails.
std::optional<std::string> output_of(std::vector<std::string> words) {
  words.insert(words.begin(), {"env", "LC_ALL=C"});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return std::nullopt;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int reason = ::posix_spawnp(&child, "env", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  std::string text;
  std::array<char, 4096> some;
  for (ssize_t got; (got = ::read(ends[0], some.data(), some.size())) != 0;) {
    if (got > 0) text.append(some.data(), static_cast<std::size_t>(got));
    if (got < 0 && errno != EINTR) break;
  }
  ::close(ends[0]);
  if (reason != 0) return std::nullopt;
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) return std::nullopt;
  return text;
}

// The bytes of an ELF file that say for what processor it is: class, order of bytes, machine. Empty for anything else.
std::string processor_of(const fs::path& file) {
  std::array<char, 20> header{};
  std::ifstream in(file, std::ios::binary);
  if (!in.read(header.data(), header.size()) || std::string_view(header.data(), 4) !=
                                                    "\x7f"
                                                    "ELF")
    return "";
  return {header[4], header[5], header[18], header[19]};
}

bool is_for_this_processor(const fs::path& file) {
  static const std::string own = processor_of("/proc/self/exe");
  return processor_of(file) == own;
}

// The loader's cache, as `ldconfig -p` lists it: "	libm.so.6 (libc6,x86-64) => /lib/x86_64-linux-gnu/libm.so.6".
std::vector<fs::path> cached(const std::string& name) {
  std::vector<fs::path> files;
  std::istringstream lines(output_of({"/sbin/ldconfig", "-p"}).value_or(""));
  for (std::string line; std::getline(lines, line);) {
    const std::size_t arrow = line.find(" => ");
    if (line.starts_with('\t' + name + " (") && arrow != std::string::npos) files.emplace_back(line.substr(arrow + 4));
  }
  return files;
}

struct Package {
  const char* library;
  const char* package;
};

// Debian 12's names where Debian has it (apt-file); the vendor's where it is theirs.
constexpr Package kPackages[] = {
    {"libncurses.so.5", "libncurses5"},
    {"libtinfo.so.5", "libtinfo5"},
    {"libraw1394.so.11", "libraw1394-11"},
    {"libraw1394.so.8", "no package of Debian 12, which has libraw1394.so.11: use a newer driver of the vendor's"},
    {"libstdc++.so.5", "libstdc++5"},
    {"libstdc++.so.6", "libstdc++6"},
    {"libusb-1.0.so.0", "libusb-1.0-0"},
    {"libGL.so.1", "libgl1"},
    {"libGLU.so.1", "libglu1-mesa"},
    {"libz.so.1", "zlib1g"},
    {"libPhantomIOLib42.so", "the vendor's device driver (Touch driver)"},
    {"libPHANToMIO.so.4", "the vendor's device driver (PHANToM Device Drivers)"},
};

}  // namespace

std::optional<fs::path> file_of_library(const std::string& name) {
  std::vector<fs::path> candidates;
  if (name.find('/') != std::string::npos) {
    candidates.emplace_back(name);
  } else {
    const char* path = std::getenv("LD_LIBRARY_PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
      candidates.push_back(fs::path(folder.empty() ? "." : folder) / name);
    for (fs::path& file : cached(name)) candidates.push_back(std::move(file));
    for (const char* folder : {"/lib64", "/usr/lib64", "/lib", "/usr/lib"}) candidates.push_back(fs::path(folder) / name);
  }
  const auto found = std::find_if(candidates.begin(), candidates.end(), is_for_this_processor);
  if (found == candidates.end()) return std::nullopt;
  return *found;
}

std::optional<std::vector<std::string>> missing_dependencies(const fs::path& file) {
  const auto text = output_of({"ldd", file.string()});
  if (!text) return std::nullopt;
  std::vector<std::string> missing;
  const auto add = [&](const std::string& what) {
    if (std::find(missing.begin(), missing.end(), what) == missing.end()) missing.push_back(what);
  };
  std::istringstream lines(*text);
  for (std::string line; std::getline(lines, line);) {
    // "	libtinfo.so.5 => not found"; "FILE: LIBRARY: version `GLIBC_2.38' not found (required by FILE)".
    const std::size_t arrow = line.find(" => not found"), version = line.find(": version `"), quote = line.find("' not found");
    const std::size_t first = line.find_first_not_of(" \t");
    if (arrow != std::string::npos && arrow > first) add(line.substr(first, arrow - first));
    if (version != std::string::npos && quote != std::string::npos) {
      const std::size_t number = version + 11;
      add(line.substr(number, quote - number));
    }
  }
  return missing;
}

std::string package_of(const std::string& library) {
  for (const auto& [name, package] : kPackages)
    if (library == name) return package;
  return library.starts_with("libHD") ? "the vendor's OpenHaptics" : "";
}

}  // namespace forceshade::device
