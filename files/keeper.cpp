// SPDX-License-Identifier: BSD-3-Clause
#include "files/keeper.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace forceshade::files {
namespace {

namespace fs = std::filesystem;
constexpr int kBetweenCounts = 200;         // ms
constexpr int kMostPasses = 5'000;          // each of a millisecond or more, until what was killed has gone
constexpr std::size_t kBeforeThreads = 15;  // fields of /proc/PID/stat between the parent and the number of threads

struct Process {
  pid_t id = 0, parent = 0;
  unsigned long threads = 0;
};

// Those that run, of all users.
std::vector<Process> processes() {
  std::vector<Process> all;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/proc", ignored)) {
    Process process{std::atoi(entry.path().filename().c_str()), 0, 0};
    if (process.id <= 0) continue;
    std::ifstream in(entry.path() / "stat");
    std::string text;
    std::getline(in, text, '\0');                   // no iterator, which throws where the process has ended since
    const std::size_t name_ends = text.rfind(')');  // a name may have brackets and spaces
    if (name_ends == std::string::npos) continue;   // it has ended
    std::istringstream fields(text.substr(name_ends + 1));
    std::string state, other;
    fields >> state >> process.parent;
    for (std::size_t i = 0; i < kBeforeThreads; ++i) fields >> other;
    if (fields >> process.threads && state != "Z" && state != "X") all.push_back(process);
  }
  return all;
}

std::vector<Process> descendants() {
  std::vector<Process> rest = processes(), found;
  std::set<pid_t> family{::getpid()};
  for (bool is_more = true; is_more;) {
    const auto others =
        std::partition(rest.begin(), rest.end(), [&](const Process& one) { return !family.contains(one.parent); });
    is_more = others != rest.end();
    for (auto one = others; one != rest.end(); ++one) family.insert(one->id);
    found.insert(found.end(), others, rest.end());
    rest.erase(others, rest.end());
  }
  return found;
}

unsigned long threads_of(const std::vector<Process>& these) {
  unsigned long sum = 0;
  for (const Process& one : these) sum += one.threads;
  return sum;
}

// All are stopped first, since what is stopped starts nothing in the meantime.
void end_descendants() {
  std::set<pid_t> stopped;
  for (bool is_more = true; is_more;) {
    is_more = false;
    for (const Process& one : descendants())
      if (stopped.insert(one.id).second) {
        ::kill(one.id, SIGSTOP);
        is_more = true;
      }
  }
  for (int pass = 0; pass < kMostPasses; ++pass) {
    while (::waitpid(-1, nullptr, WNOHANG) > 0) {
    }
    const auto left = descendants();
    if (left.empty()) return;
    for (const Process& one : left) ::kill(one.id, SIGKILL);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

}  // namespace

unsigned long threads_of_this_user() {
  auto all = processes();
  std::erase_if(all, [](const Process& process) {
    struct stat its {};
    return ::stat(("/proc/" + std::to_string(process.id)).c_str(), &its) != 0 || its.st_uid != ::getuid();
  });
  return threads_of(all);
}

void keep(const std::function<void()>& become_program, int control, int reports, const ProcessLimits& limits) {
  ::setsid();
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  sigset_t all, children;
  sigfillset(&all);
  ::sigprocmask(SIG_SETMASK, &all, nullptr);
  ::signal(SIGCHLD, SIG_DFL);
  sigemptyset(&children);
  sigaddset(&children, SIGCHLD);
  const pid_t program = ::fork();
  if (program == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // where it ends its keeper
    become_program();
    ::_exit(127);
  }
  // No end of any other pipe stays open here.
  const std::array<int, 3> kept{::fcntl(control, F_DUPFD, 3), ::fcntl(reports, F_DUPFD, 3),
                                ::signalfd(-1, &children, SFD_NONBLOCK)};
  for (int i = 0; i < 3; ++i) ::dup2(kept[static_cast<std::size_t>(i)], i);
  ::close_range(3, ~0U, 0);
  pollfd end{0, POLLIN, 0};
  bool has_ended = program < 0, is_alone = has_ended, is_too_much = false;
  // Waits until something ends, at most so many ms.
  const auto look = [&](int most) {
    std::array<pollfd, 2> both{pollfd{2, POLLIN, 0}, end.revents == 0 ? end : pollfd{-1, 0, 0}};
    ::poll(both.data(), both.size(), is_alone ? -1 : most);
    end.revents = static_cast<short>(end.revents | both[1].revents);
    signalfd_siginfo information;
    while (::read(2, &information, sizeof information) > 0) {
    }
    int status = 0;
    pid_t ended = 0;
    while ((ended = ::waitpid(-1, &status, WNOHANG)) > 0) {
      if (ended != program) continue;
      has_ended = true;
      if (::write(1, &status, sizeof status) < 0) break;  // the reader has gone
    }
    is_alone = ended < 0 && errno == ECHILD;
  };
  while (end.revents == 0 && !is_too_much) {
    look(kBetweenCounts);
    is_too_much = !is_alone && threads_of(descendants()) > limits.threads;
  }
  if (is_too_much && ::write(1, &kTooMany, sizeof kTooMany) < 0) ::_exit(0);
  for (auto until = std::chrono::steady_clock::now() + limits.grace; !has_ended && !is_too_much;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - std::chrono::steady_clock::now()).count();
    if (left <= 0) break;
    look(static_cast<int>(left));
  }
  if (!is_alone) end_descendants();
  ::_exit(0);
}

}  // namespace forceshade::files
