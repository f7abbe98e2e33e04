// SPDX-License-Identifier: BSD-3-Clause
// The effect of each signal on a run: the command as another process, on the simulated device, judged by its exit code, its
// words and its recording.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "forceshade/recording.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::tests {
namespace {

using Words = std::vector<std::string>;

// The forceshade command as another process.
class Command {
 public:
  // In `directory`, with `environment` (NAME=VALUE) added to this process's.
  Command(const TemporaryDirectory& directory, const Words& arguments, const Words& environment = {});
  ~Command();
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  void send(int signal) const;

  bool is_running() const;

  // Waits for its end: "exit 0: " and all it printed, but for the warning of --certificate none. A process that is stopped
  // instead is left to the destructor.
  std::string end();

 private:
  const TemporaryDirectory& directory_;
  pid_t process_ = -1;
};

Command::Command(const TemporaryDirectory& directory, const Words& arguments, const Words& environment)
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
  do waitpid(process_, &status, WUNTRACED);
  while (WIFSTOPPED(status) && WSTOPSIG(status) == SIGSTOP);  // nothing here sends it: somebody outside does, who lets it go on
  if (WIFSTOPPED(status)) return "stopped by signal " + std::to_string(WSTOPSIG(status));
  process_ = -1;
  std::string output = directory_.read("output");
  if (output.starts_with("***")) output.erase(0, output.find('\n') + 1);
  return (WIFEXITED(status) ? "exit " + std::to_string(WEXITSTATUS(status)) : "signal " + std::to_string(WTERMSIG(status))) +
         ": " + output;
}

constexpr std::chrono::milliseconds kLook{10};

// A run that no signal ends is over after an hour of ticks.
Words drive(const char* seconds = "3600") {
  return {"drive", "--law", "wall", "--certificate", "none", "--device", "simulated", "--seconds", seconds, "--out", "run.fsr"};
}

// Waits until the run has written so many bytes more of its recording: its ticks go on.
void wait_for_ticks(const TemporaryDirectory& here, const Command& run) {
  const std::string log = here.file("run.fsr-wal");
  const auto size = [&] {
    std::error_code none;
    const auto bytes = std::filesystem::file_size(log, none);
    return none ? 0 : bytes;
  };
  const auto before = size();
  while (run.is_running() && size() < before + 20'000) std::this_thread::sleep_for(kLook);
}

// In recordings, without their logs.
std::uintmax_t bytes_below(const std::string& directory) {
  std::uintmax_t bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(directory)) {
    std::error_code gone;
    const auto size = entry.file_size(gone);
    if (entry.path().extension() == ".fsr" && !gone) bytes += size;
  }
  return bytes;
}

void expect_ended_in_order(const TemporaryDirectory& here, Command& run, const std::string& signal) {
  const std::string end = run.end();
  EXPECT_TRUE(end.starts_with("exit 0: ")) << signal << '\n' << end;
  EXPECT_NE(end.find("(stopped)"), std::string::npos) << signal << '\n' << end;
  EXPECT_NE(end.find("forceshade: " + signal + " ended the run\n"), std::string::npos) << signal << '\n' << end;
  recorder::Recording recording(here.file("run.fsr"));
  EXPECT_EQ(recorder::problems_of(recording), std::vector<std::string>{}) << signal;
  device::Sample last;
  recording.for_each_chunk([&](std::span<const device::Sample> samples) { last = samples.back(); });
  EXPECT_EQ(last.status, device::Sample::kEnd) << signal;
  EXPECT_EQ(last.force, (std::array<float, 3>{0, 0, 0})) << signal;
}

TEST(signals, each_that_would_end_or_stop_the_process_ends_the_run_in_order) {
  std::vector<std::pair<int, std::string>> all{
      {SIGINT, "SIGINT"},   {SIGTERM, "SIGTERM"}, {SIGHUP, "SIGHUP"},       {SIGQUIT, "SIGQUIT"}, {SIGTSTP, "SIGTSTP"},
      {SIGUSR1, "SIGUSR1"}, {SIGUSR2, "SIGUSR2"}, {SIGALRM, "SIGALRM"},     {SIGPROF, "SIGPROF"}, {SIGVTALRM, "SIGVTALRM"},
      {SIGPWR, "SIGPWR"},   {SIGXCPU, "SIGXCPU"}, {SIGSTKFLT, "SIGSTKFLT"}, {SIGIO, "SIGPOLL"}};
  for (const int k : {0, 1, SIGRTMAX - SIGRTMIN}) all.emplace_back(SIGRTMIN + k, "SIGRTMIN+" + std::to_string(k));
  for (const auto& [number, name] : all) {
    const TemporaryDirectory here;
    const auto before = std::signal(number, SIG_DFL);  // nohup, with which the test may have been started, has SIGHUP ignored
    Command run(here, drive());
    std::signal(number, before);
    wait_for_ticks(here, run);
    run.send(number);
    expect_ended_in_order(here, run, name);
  }
}

TEST(signals, those_that_report_something_else_end_no_run) {
  const TemporaryDirectory here;
  Command run(here, drive());
  wait_for_ticks(here, run);
  for (const int number : {SIGPIPE, SIGXFSZ, SIGTTIN, SIGTTOU, SIGCHLD, SIGURG, SIGWINCH, SIGCONT}) {
    run.send(number);
    wait_for_ticks(here, run);
  }
  run.send(SIGTERM);
  expect_ended_in_order(here, run, "SIGTERM");
}

TEST(signals, two_at_once_end_a_run_in_order_too) {
  for (const int second : {SIGINT, SIGTERM}) {
    const TemporaryDirectory here;
    Command run(here, drive());
    wait_for_ticks(here, run);
    for (const int number : {SIGINT, second, SIGINT, second}) run.send(number);
    const std::string end = run.end();
    EXPECT_TRUE(end.starts_with("exit 0: ")) << end;
    recorder::Recording recording(here.file("run.fsr"));
    EXPECT_EQ(recorder::problems_of(recording), std::vector<std::string>{});
  }
}

// Its recording goes into a pipe that nobody reads.
TEST(signals, a_person_who_insists_ends_at_once_an_end_that_hangs) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "the thread sanitizer keeps signals back until the call returns that hangs here, open()";
#endif
  const TemporaryDirectory here;
  ASSERT_EQ(::mkfifo(here.file("nobody").c_str(), 0600), 0);
  std::filesystem::create_directory(here.file("kept"));
  Command run(here,
              {"drive", "--law", "wall", "--certificate", "none", "--device", "simulated", "--pace", "none", "--seconds", "1",
               "--out", "nobody"},
              {"TMPDIR=" + here.file("kept")});
  // Closed, the recording holds a second of ticks, and its log is gone.
  while (run.is_running() && bytes_below(here.file("kept")) < 100'000) std::this_thread::sleep_for(kLook);
  // Until one comes two seconds after the first was taken.
  for (; run.is_running(); std::this_thread::sleep_for(kLook)) run.send(SIGINT);
  const std::string end = run.end();
  EXPECT_TRUE(end.starts_with("signal ")) << end;
}

TEST(signals, of_a_terminal_that_hangs_up_is_ignored_under_nohup) {
  const TemporaryDirectory here;
  const auto before = std::signal(SIGHUP, SIG_IGN);
  Command run(here, drive());
  std::signal(SIGHUP, before);
  wait_for_ticks(here, run);
  run.send(SIGHUP);
  wait_for_ticks(here, run);
  run.send(SIGINT);
  expect_ended_in_order(here, run, "SIGINT");
}

TEST(signals, that_whoever_started_the_command_had_blocked_or_ignored_end_a_run) {
  const TemporaryDirectory here;
  sigset_t blocked;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &blocked, nullptr);
  const auto before = std::signal(SIGTERM, SIG_IGN);
  Command run(here, drive());
  std::signal(SIGTERM, before);
  pthread_sigmask(SIG_UNBLOCK, &blocked, nullptr);
  wait_for_ticks(here, run);
  run.send(SIGTERM);
  expect_ended_in_order(here, run, "SIGTERM");
}

TEST(signals, of_a_fault_in_the_program_keep_the_systems_reaction) {
  const TemporaryDirectory here;
  rlimit core{};
  ASSERT_EQ(::getrlimit(RLIMIT_CORE, &core), 0);
  const rlimit none{0, core.rlim_max};
  ::setrlimit(RLIMIT_CORE, &none);
  Command run(here, drive());
  ::setrlimit(RLIMIT_CORE, &core);
  wait_for_ticks(here, run);
  run.send(SIGABRT);
  EXPECT_TRUE(run.end().starts_with("signal " + std::to_string(SIGABRT)));
}

// Before the run there is nothing to end in order: here while the device is opened, which waits for a file.
TEST(signals, before_the_run_leave_nothing_behind) {
  const TemporaryDirectory here;
  int ends[2]{};
  ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
  ::fcntl(ends[0], F_SETFD, 0);  // the command inherits this end
  const int room = ::fcntl(ends[1], F_GETPIPE_SZ);
  ASSERT_GT(room, 0);
  Command run(here, {"drive", "--law", "wall", "--certificate", "none", "--device", "replay:/dev/fd/" + std::to_string(ends[0]),
                     "--out", "run.fsr"});
  ::close(ends[0]);
  const std::string hand = "t_s,x_mm,y_mm,z_mm\n0,3,0,-1\n" + std::string(static_cast<std::size_t>(room), ' ') + "\n9,3,0,-1\n";
  // More than there is room for, so it is written once the command reads it.
  EXPECT_EQ(::write(ends[1], hand.data(), hand.size()), static_cast<ssize_t>(hand.size()));
  run.send(SIGINT);
  ::close(ends[1]);
  EXPECT_EQ(run.end(), "exit 130: forceshade: interrupted: the run had not begun\n");
  EXPECT_FALSE(std::filesystem::exists(here.file("run.fsr")));
}

TEST(signals, end_a_check_of_a_device_without_a_verdict) {
  const TemporaryDirectory here;
  Command check(here, {"device", "check", "null", "--seconds", "60", "--json", "check.json"});
  while (check.is_running() && here.read("output").find("without any force") == std::string::npos)
    std::this_thread::sleep_for(kLook);
  check.send(SIGTERM);
  const std::string end = check.end();
  EXPECT_TRUE(end.starts_with("exit 130: ")) << end;
  EXPECT_NE(end.find("interrupted: the check was not finished"), std::string::npos) << end;
  EXPECT_FALSE(std::filesystem::exists(here.file("check.json")));
}

// A file-size limit: the write that meets it fails with words, and all else is as in any run.
TEST(signals, a_file_size_limit_costs_the_ticks_that_it_refuses_and_nothing_else) {
  const TemporaryDirectory here;
  rlimit size{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &size), 0);
  const rlimit small{300'000, size.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  Words limited = drive("3.5");
  for (const char* word : {"--json", "run.json"}) limited.emplace_back(word);
  Command run(here, limited);
  ::setrlimit(RLIMIT_FSIZE, &size);
  const std::string end = run.end();
  EXPECT_TRUE(end.starts_with("exit 2: ")) << end;
  EXPECT_NE(end.find("ticks             3500 (time up)"), std::string::npos) << end;
  EXPECT_NE(end.find("run.fsr: disk I/O error; recorded "), std::string::npos) << end;
  EXPECT_NE(here.read("run.json").find("\"ticks\": 3500"), std::string::npos);
  EXPECT_GT(recorder::Recording(here.file("run.fsr")).extent().samples, 0U);
}

TEST(signals, a_summary_that_cannot_be_written_costs_nothing_else) {
  const TemporaryDirectory here;
  Command run(here, {"drive", "--law", "wall", "--certificate", "none", "--device", "simulated", "--pace", "none", "--seconds",
                     "0.5", "--out", "run.fsr", "--json", "nowhere/run.json"});
  const std::string end = run.end();
  EXPECT_TRUE(end.starts_with("exit 2: ")) << end;
  EXPECT_NE(end.find("nowhere/run.json"), std::string::npos) << end;
  EXPECT_NE(end.find("ticks             500 (time up)"), std::string::npos) << end;
  recorder::Recording recording(here.file("run.fsr"));
  EXPECT_EQ(recorder::problems_of(recording), std::vector<std::string>{});
}

}  // namespace
}  // namespace forceshade::tests
