// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The stand-in for Haply's Inverse Service as a process of a test's, at a port of the system's choice.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/temporary_directory.h"

namespace forceshade::device {

inline bool has_websockets() {
  return std::system("/usr/bin/python3 -c 'import websockets' 2> /dev/null") == 0;
}

class HaplyStandIn {
 public:
  // Ends after its first session. Its address is what a device opened from now on uses.
  explicit HaplyStandIn(const std::string& options) {
    int ends[2];
    if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
    std::vector<std::string> words{HAPLY_STAND_IN, "haply", "--port", "0", "--sessions", "1", "--report", here_.file("report")};
    std::istringstream in(options);
    for (std::string word; in >> word;) words.push_back(word);
    process_ = ::fork();
    if (process_ == 0) {
      std::vector<char*> arguments;
      for (std::string& word : words) arguments.push_back(word.data());
      arguments.push_back(nullptr);
      ::dup2(ends[1], STDOUT_FILENO);
      ::execv(arguments.front(), arguments.data());
      ::_exit(127);
    }
    ::close(ends[1]);
    std::string line;
    for (char c = 0; ::read(ends[0], &c, 1) == 1 && c != '\n';) line += c;
    ::close(ends[0]);
    if (!line.starts_with("listening on ")) throw std::runtime_error("the stand-in did not start: " + line);
    ::setenv("FORCESHADE_HAPLY_SERVICE", line.substr(13).c_str(), 1);
  }
  ~HaplyStandIn() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  HaplyStandIn(const HaplyStandIn&) = delete;
  HaplyStandIn& operator=(const HaplyStandIn&) = delete;

  pid_t process() const noexcept { return process_; }

  // Once the session is over. Its exit code is in it, too.
  nlohmann::json verdict() {
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = -1;
    auto report = nlohmann::json::parse(here_.read("report"));
    report["exit"] = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return report;
  }

 private:
  tests::TemporaryDirectory here_;
  pid_t process_ = -1;
};

}  // namespace forceshade::device
