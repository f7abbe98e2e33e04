// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Runs the forceshade command as its users do.

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/support/temporary_directory.h"

namespace forceshade::tests {

struct CommandRun {
  int code;  // 128 and the signal's number if one ended it
  std::string out, err;
};

// At spaces; '' is an empty argument.
inline std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word == "''" ? "" : word);
  return words;
}

// In a child process that calls run() and exits with what it returns: in the directory, with standard input from /dev/null;
// standard output goes to `output` if one is given.
inline CommandRun run_in_child(const TemporaryDirectory& here, const std::string& output, const std::function<int()>& run) {
  const std::string out = output.empty() ? here.file(".out") : output, err = here.file(".err");
  const pid_t child = ::fork();
  if (child == 0) {
    const auto redirect = [](const std::string& path, int flags, int stream) {
      if (::dup2(::open(path.c_str(), flags | O_CLOEXEC, 0600), stream) < 0) ::_exit(126);
    };
    redirect("/dev/null", O_RDONLY, STDIN_FILENO);
    redirect(out, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
    redirect(err, O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
    if (::chdir(here.file("").c_str()) != 0) ::_exit(126);
    ::_exit(run());
  }
  int status = 0;
  if (child < 0 || ::waitpid(child, &status, 0) != child) throw std::runtime_error("cannot run the command");
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), output.empty() ? here.read(".out") : "",
          here.read(".err")};
}

// The program FORCESHADE_COMMAND, as run_in_child().
inline CommandRun run_command(const TemporaryDirectory& here, const std::vector<std::string>& arguments,
                              const std::string& output = "") {
  std::string program = FORCESHADE_COMMAND;
  std::vector<std::string> copies = arguments;
  std::vector<char*> argv{program.data()};
  for (std::string& argument : copies) argv.push_back(argument.data());
  argv.push_back(nullptr);
  return run_in_child(here, output, [&] {
    ::execv(program.c_str(), argv.data());
    return 127;
  });
}

}  // namespace forceshade::tests
