// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Runs hostile.py as a device's program.

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "device/command/command.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::device {

inline constexpr double kRate = 200;  // Hz

struct Listener final : Attendant {
  void report(const std::string& said) noexcept override { words += said + '\n'; }
  std::string words;
};

// hostile.py in this mode, and its log.
struct Program {
  explicit Program(const std::string& name) : mode(name), log(here.file("log")) {}

  std::string command() const { return "exec python3 '" HOSTILE_PROGRAM "' " + mode + " '" + log + "'"; }

  // The number of processes that have its log in their command line.
  int left() const {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      std::ifstream in(entry.path() / "cmdline");
      const std::string line{std::istreambuf_iterator<char>(in), {}};
      count += line.find(log) != std::string::npos;
    }
    return count;
  }

  // The lines that it was sent, without their times.
  std::vector<std::string> lines() const {
    std::vector<std::string> all;
    std::ifstream in(log);
    for (std::string line; std::getline(in, line);) all.push_back(line.substr(line.find(' ') + 1));
    return all;
  }

  tests::TemporaryDirectory here;
  std::string mode, log;
};

}  // namespace forceshade::device
