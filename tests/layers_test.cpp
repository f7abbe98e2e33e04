// SPDX-License-Identifier: BSD-3-Clause
// The layers of the code: each module stands on those before it, and what devices, recordings and sessions want of time,
// waiting, threads, processes and luck they ask of system/ alone, so that a simulated world can stand in its place
// (tests/world).

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "tests/structure.h"

namespace forceshade::tests {
namespace {

// The table is in layers: a module may include only those that stand before it.
TEST(layers, each_module_is_built_before_those_that_use_it) {
  std::ifstream file(kRoot / "cmake/modules.txt");
  std::set<std::string> before;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with('#')) continue;
    const std::size_t colon = line.find(':');
    std::istringstream seen(line.substr(colon + 1));
    for (std::string module; seen >> module;)
      EXPECT_TRUE(module == "*" || before.contains(module)) << line.substr(0, colon) << " includes " << module;
    before.insert(line.substr(0, colon));
  }
  EXPECT_GT(before.size(), 20U);
}

// Files that ask the system itself, each with the reason.
const std::map<std::string, std::string> kExceptions{
    {"apps/certify.cpp", "the number of processors, for certification, which no clock judges"},
    {"apps/certify_plan.cpp", "the same"},
    {"apps/part_times.h", "how long each part of a check takes"},
    {"apps/keyboard_buttons.cpp", "waits for a key of the terminal"},
    {"apps/terminal_attendant.cpp", "waits for a key of the terminal"},
    {"device/haply/haply_socket.cpp", "waits for a network"},
    {"device/lasting_words.cpp", "a lock that is held for a moment, and across no step"},
    {"device/phantom/shared_objects.cpp", "runs the loader's own programs, before any run"},
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
      R"(clock_gettime|_clock::now|sleep_for|sleep_until|nanosleep|usleep|std::j?thread|std::mutex|condition_variable|std::async|\bpoll\(|\bfork\(|waitpid|random_device)");
  const std::regex of_ours(R"(\bsystem::(sleep_for|sleep_until))");
  std::map<std::string, std::string> unused = kExceptions;
  int read = 0;
  for (const char* folder : {"device", "files", "recorder", "window", "apps", "clients"})
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
