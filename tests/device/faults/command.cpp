// SPDX-License-Identifier: BSD-3-Clause
#include "tests/device/faults/command.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

namespace forceshade::faults {

Command::Command(const tests::TemporaryDirectory& directory, const Words& arguments, const Words& environment)
    : directory_(directory) {
  const std::string path = directory.path(), output = directory.file("output");
  std::vector<char*> words{const_cast<char*>("forceshade")};
  for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  process_ = fork();
  if (process_ != 0) return;
  for (const std::string& variable : environment) putenv(const_cast<char*>(variable.c_str()));
  const int to = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  dup2(to, STDOUT_FILENO);
  dup2(to, STDERR_FILENO);
  if (chdir(path.c_str()) == 0) execv(FORCESHADE_COMMAND, words.data());
  _exit(127);
}

Command::~Command() {
  if (process_ < 0) return;
  send(SIGKILL);
  waitpid(process_, nullptr, 0);
}

void Command::send(int signal) const {
  if (process_ > 0) kill(process_, signal);  // else it would go to every process there is
}

bool Command::is_running() const {
  siginfo_t ended{};
  return waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid == 0;
}

std::string Command::end() {
  int status = 0;
  waitpid(process_, &status, WUNTRACED);
  if (WIFSTOPPED(status)) return "stopped by signal " + std::to_string(WSTOPSIG(status));
  process_ = -1;
  std::string output = directory_.read("output");
  if (output.starts_with("***")) output.erase(0, output.find('\n') + 1);
  return (WIFEXITED(status) ? "exit " + std::to_string(WEXITSTATUS(status)) : "signal " + std::to_string(WTERMSIG(status))) +
         ": " + output;
}

}  // namespace forceshade::faults
