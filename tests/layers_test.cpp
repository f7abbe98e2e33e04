// SPDX-License-Identifier: BSD-3-Clause
// The layers of the code: each module stands on those before it, and what devices, recordings and sessions want of time,
// waiting, threads, processes and luck they ask of system/ alone, so that a simulated world can stand in its place
// (tests/world).

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/structure.h"

namespace forceshade::tests {
namespace {

// The folders at the top are layers: the table has the modules of each together, and a module includes only its own folder and
// those before it.
TEST(layers, each_folder_and_module_is_built_before_those_that_use_it) {
  const std::string page = text_of(kRoot / "CONTRIBUTING.md"), manifest = text_of(kRoot / "MANIFEST.in");
  const auto folder_of = [](const std::string& module) { return module.substr(0, module.find('/')); };
  std::ifstream file(kRoot / "cmake/modules.txt");
  std::set<std::string> before;
  std::vector<std::string> folders;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#')) continue;
    const std::size_t colon = line.find(':');
    const std::string module = line.substr(0, colon), folder = folder_of(module);
    if (folders.empty() || folders.back() != folder) {
      EXPECT_EQ(std::ranges::count(folders, folder), 0) << folder << " is in two places of the table";
      EXPECT_NE(page.find("\n| `" + folder + "/` | "), std::string::npos) << "CONTRIBUTING.md has no row of " << folder;
      EXPECT_NE(manifest.find("\ngraft " + folder + "\n"), std::string::npos) << "MANIFEST.in lacks " << folder;
      folders.push_back(folder);
    }
    std::istringstream seen(line.substr(colon + 1));
    for (std::string used; seen >> used;) EXPECT_TRUE(used == "*" || before.contains(used)) << module << " includes " << used;
    before.insert(module);
  }
  EXPECT_GT(folders.size(), 12U);
}

// Files that ask the system itself, each with the reason.
const std::map<std::string, std::string> kExceptions{
    {"apps/certify.cpp", "the number of processors, for certification, which no clock judges"},
    {"apps/certify_plan.cpp", "the same"},
    {"apps/progress_line.h", "how long each part of a check takes"},
    {"apps/standard_input.cpp", "waits for a pipe"},
    {"apps/terminal_attendant.cpp", "waits for a key of the terminal"},
    {"device/haply/haply_socket.cpp", "waits for a network"},
    {"device/lasting_words.cpp", "a lock that is held for a moment, and across no step"},
    {"files/child_process.cpp", "the process of a third-party program"},
    {"files/keeper.cpp", "the process between this one and a third-party program"},
    {"files/keeper.h", "the same"},
    {"files/output_file.cpp", "waits for a pipe"},
    {"clients/study/command/experiment.cpp", "the number of processors"},
    {"clients/study/command/experiment_fronts.cpp", "waits for a key of the terminal"},
    {"clients/study/command/experiment_virtual.cpp", "virtual participants, on all processors"},
    {"window/glfw_canvas.cpp", "waits for the display"},
};

TEST(layers, only_system_asks_for_time_waiting_threads_processes_and_luck) {
  const std::regex asks(
      R"(clock_gettime|_clock::now|sleep_for|sleep_until|nanosleep|usleep|std::j?thread|std::mutex|condition_variable|)"
      R"(std::async|\bpoll\(|\bfork\(|waitpid|random_device)");
  const std::regex of_ours(R"(\bsystem::(sleep_for|sleep_until))");
  std::map<std::string, std::string> unused = kExceptions;
  int read = 0;
  for (const char* folder : {"device", "files", "run", "window", "apps", "clients"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(kRoot / folder)) {
      const std::string extension = entry.path().extension(), file = std::filesystem::relative(entry.path(), kRoot);
      if ((extension != ".h" && extension != ".cpp") || file.find("/tests/") != std::string::npos) continue;
      ++read;
      const std::string text = std::regex_replace(text_of(entry.path()), of_ours, "");
      if (!std::regex_search(text, asks)) continue;
      EXPECT_TRUE(kExceptions.contains(file)) << file << " asks the operating system itself";
      unused.erase(file);
    }
  EXPECT_GT(read, 300);
  for (const auto& [file, reason] : unused) ADD_FAILURE() << file << " is an exception that is not needed: " << reason;
}

}  // namespace
}  // namespace forceshade::tests
