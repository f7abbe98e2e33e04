// SPDX-License-Identifier: BSD-3-Clause
// The process that holds a PHANToM: what reaches it, what it leaves alone, and the ways in which the vendor's library may fail
// in it, and three deaths under force. The fate of the force when either process dies at any step, or a call of the
// driver's fails or never returns, is tried in a simulated world (tests/world/phantom_world_test.cpp).

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "device/phantom/hdapi_words.h"
#include "forceshade/device.h"
#include "tests/device/stand_in_hd/phantom_fixture.h"

namespace forceshade::device {
namespace {

using stand_in_hd::Crash;
using stand_in_hd::Moment;

// A driver that is gone is missed after a second.
constexpr Phantom::Options kHurried{
    .watchdog_timeout = 1s, .open = 10min, .start = 10min, .calibration = 10min, .rate_tolerance = 1};

// Commands again and again: where this process stood still, the frames took the force away.
void expect_obeys(Phantom& device) {
  wait_until([&] {
    device.command({0, 0, 1});
    return stand_in_hd::arm().force == Eigen::Vector3d(0, 1, 0);
  });
}

std::string words_of_fault(Phantom& device) {
  std::string words;
  wait_until([&] {
    const ReadResult read = device.read();
    if (const Fault* fault = std::get_if<Fault>(&read)) words = fault->words;
    return !words.empty();
  });
  return words;
}

// No process of this one's, running or ended, is left.
bool has_no_child() {
  errno = 0;
  return ::waitpid(-1, nullptr, WNOHANG) == -1 && errno == ECHILD;
}

// A handler of the driver's would end the process: the stand-in installs one for SIGTERM, as the vendor's library does.
TEST_F(phantom, is_held_whatever_signals_come_and_leaves_the_programs_own_handlers_alone) {
  const auto ours = [](int) {};
  struct sigaction before {};
  before.sa_handler = ours;
  ASSERT_EQ(::sigaction(SIGTERM, &before, nullptr), 0);
  {
    Phantom device("", kPatient);
    ASSERT_FALSE(device.start(1000));
    for (const int signal :
         {SIGTERM, SIGINT, SIGHUP, SIGQUIT, SIGPIPE, SIGALRM, SIGUSR1, SIGUSR2, SIGXFSZ, SIGTSTP, SIGTTOU, SIGTERM})
      ASSERT_EQ(::kill(device.process(), signal), 0);
    expect_obeys(device);
    std::this_thread::sleep_for(50ms);
    EXPECT_TRUE(std::holds_alternative<Reading>(device.read()));
    EXPECT_TRUE(seen().scheduler);
    EXPECT_EQ(::getpgid(device.process()), device.process()) << "no terminal's signals reach it";
    struct sigaction now {};
    ASSERT_EQ(::sigaction(SIGTERM, nullptr, &now), 0);
    EXPECT_EQ(now.sa_handler, before.sa_handler);
  }
  std::signal(SIGTERM, SIG_DFL);
  EXPECT_TRUE(has_no_child());
}

TEST_F(phantom, prints_nothing_of_the_librarys_to_standard_output) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  {
    Phantom device("", kPatient);
    EXPECT_FALSE(device.start(1000));
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  expect_words(testing::internal::GetCapturedStderr(), {"InitLogFile"});
}

// Not written twice either, when the library ends the process in order.
TEST_F(phantom, whose_library_exits_prints_nothing_that_the_program_was_about_to) {
  tell({.crash = {.how = Crash::How::exit, .when = Moment::before_start}});
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  std::fputs("once", stdout);
  EXPECT_THROW(Phantom(""), DeviceError);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "once");
  EXPECT_EQ(testing::internal::GetCapturedStderr().find("once"), std::string::npos);
}

TEST_F(phantom, whose_library_is_missing_says_where_it_was_looked_for) {
  setenv("FORCESHADE_HD_LIBRARY", "/nowhere/libHD.so", 1);
  expect_words(tests::thrown_by<DeviceError>([&] { Phantom device(""); }),
               {"/nowhere/libHD.so: cannot open shared object file", "FORCESHADE_HD_LIBRARY"});
}

TEST_F(phantom, keeps_no_file_of_the_program_open) {
  std::array<int, 2> ends{};
  ASSERT_EQ(::pipe(ends.data()), 0);
  const int high = ::fcntl(ends[1], F_DUPFD, 500);  // also above those that the process itself needs
  ASSERT_GE(high, 500);
  {
    const Phantom device("");
    ::close(ends[1]);
    ::close(high);
    char nothing = 0;
    EXPECT_EQ(::read(ends[0], &nothing, 1), 0) << "the other end is closed";
  }
  ::close(ends[0]);
}

TEST_F(phantom, whose_library_fails_while_it_is_opened_says_so_and_leaves_no_process) {
  struct Case {
    Crash::How how;
    std::vector<std::string> words;
  };
  for (const auto& [how, words] :
       {Case{Crash::How::segmentation_fault, {"was ended by a signal (Segmentation fault)"}},
        Case{Crash::How::abort, {"was ended by a signal (Aborted)"}}, Case{Crash::How::exit, {"ended with exit code 0"}},
        Case{Crash::How::exception, {"the vendor's library failed: thrown by the driver"}}}) {
    stand_in_hd::reset();
    tell({.crash = {.how = how, .when = Moment::before_start}});
    expect_words(tests::thrown_by<DeviceError>([&] { Phantom device(""); }), words);
    EXPECT_TRUE(has_no_child()) << words.front();
  }
}

// On the driver's thread, where nothing can be sent any more.
TEST_F(phantom, whose_library_fails_in_a_frame_says_so_and_leaves_no_process) {
  for (const Crash::How how : {Crash::How::segmentation_fault, Crash::How::abort, Crash::How::exit, Crash::How::exception}) {
    SCOPED_TRACE(static_cast<int>(how));
    stand_in_hd::reset();
    tell({.crash = {.how = how, .when = Moment::frame, .frame = 10}});
    {
      Phantom device("", kPatient);
      const auto fault = device.start(1000);
      ASSERT_TRUE(fault);
      expect_words(fault->words, {"the process of the PHANToM's driver", "the vendor's library failed in it"});
    }
    EXPECT_TRUE(has_no_child());
  }
}

TEST_F(phantom, whose_process_is_killed_says_so_and_leaves_none) {
  Phantom device("", kHurried);
  ASSERT_FALSE(device.start(1000));
  ::kill(device.process(), SIGKILL);
  siginfo_t ended{};
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(device.process()), &ended, WEXITED | WNOWAIT), 0);
  EXPECT_EQ(words_of_fault(device), hdapi::kDriverEnded);
  EXPECT_TRUE(has_no_child());
}

// Under force, by the order of events alone: whatever time they take, the arm is let go, and no process is left.
TEST_F(phantom, that_is_pushed_when_its_program_is_killed_is_let_go) {
  const pid_t program = ::fork();
  if (program == 0) {
    Phantom device("", kPatient);
    if (device.start(1000)) ::_exit(1);
    for (;;) device.command({0, 0, 1});
  }
  wait_until([] { return stand_in_hd::arm().force == Eigen::Vector3d(0, 1, 0); });
  ::kill(program, SIGKILL);
  wait_until([] { return ::kill(stand_in_hd::arm().pid, 0) != 0; });
  EXPECT_TRUE(stand_in_hd::arm().force.isZero(0));
  ::waitpid(program, nullptr, 0);
}

TEST_F(phantom, that_is_pushed_when_its_library_fails_or_hangs_in_a_frame_is_let_go) {
  for (const Crash::How how : {Crash::How::segmentation_fault, Crash::How::exit, Crash::How::hang}) {
    SCOPED_TRACE(static_cast<int>(how));
    stand_in_hd::reset();
    auto device = std::make_unique<Phantom>("", kPatient);
    ASSERT_FALSE(device->start(1000));
    expect_obeys(*device);
    tell({.crash = {.how = how, .when = Moment::frame}});
    wait_until([] { return stand_in_hd::struck().has_value(); });
    device.reset();
    EXPECT_TRUE(stand_in_hd::arm().force.isZero(0));
    EXPECT_TRUE(has_no_child());
  }
  stand_in_hd::reset();
}

// The system kills this process first where memory runs out, and the driver's, which then sends zero, last.
TEST_F(phantom, has_a_process_that_memory_is_taken_from_last) {
  const auto readiness = [](const std::string& process) {
    int score = 0;
    std::ifstream("/proc/" + process + "/oom_score_adj") >> score;
    return score;
  };
  const int before = readiness("self");
  if (!(std::ofstream("/proc/self/oom_score_adj") << before << std::flush))
    GTEST_SKIP() << "/proc/self/oom_score_adj is not to be written";
  {
    Phantom device("", kPatient);
    EXPECT_EQ(readiness("self"), 1000);
    EXPECT_LE(readiness(std::to_string(device.process())), before);
  }
  EXPECT_EQ(readiness("self"), before);
}

// SIGSTOP, as by Ctrl-Z: the loop sees that no frames come, and lets them go on, so that they send zero.
TEST_F(phantom, whose_stopped_process_is_resumed_and_sends_zero) {
  auto device = std::make_unique<Phantom>("", kHurried);
  ASSERT_FALSE(device->start(1000));
  expect_obeys(*device);
  ASSERT_EQ(::kill(device->process(), SIGSTOP), 0);
  EXPECT_EQ(words_of_fault(*device), hdapi::kSilent);
  wait_until([] { return stand_in_hd::arm().force == Eigen::Vector3d(0, 0, 0) && !seen().output; });
  device.reset();
  EXPECT_TRUE(has_no_child());
}

// Each with a driver of its own: the second's stand-in shares no memory with anyone.
TEST_F(phantom, is_driven_beside_another_by_one_program) {
  tell({.position = Eigen::Vector3d(1, 2, 3)});
  Phantom first("", kPatient);
  const std::string memory = std::getenv("STAND_IN_HD_MEMORY");
  unsetenv("STAND_IN_HD_MEMORY");
  auto second = std::make_unique<Phantom>("Left arm", kPatient);
  setenv("STAND_IN_HD_MEMORY", memory.c_str(), 1);
  ASSERT_FALSE(first.start(1000));
  ASSERT_FALSE(second->start(500));
  EXPECT_NE(first.process(), second->process());
  EXPECT_EQ(std::get<Reading>(first.read()).position, Eigen::Vector3f(1, -3, 2));
  EXPECT_NE(std::get<Reading>(second->read()).position, Eigen::Vector3f(1, -3, 2));
  expect_obeys(first);
  second->command({0.5F, 0, 0});
  wait_until([&] { return std::get<Reading>(second->read()).sent->acting == Eigen::Vector3f(0.5F, 0, 0); });
  EXPECT_EQ(std::get<Reading>(first.read()).sent->acting, Eigen::Vector3f(0, 0, 1));
  // The end of one is not the end of the other.
  second.reset();
  EXPECT_TRUE(std::holds_alternative<Reading>(first.read()));
  EXPECT_TRUE(seen().output);
}

TEST_F(phantom, that_is_held_already_is_refused) {
  const Phantom first("");
  expect_words(tests::thrown_by<DeviceError>([&] { Phantom second(""); }),
               {"the device is in use", "close the program that has it open"});
  EXPECT_TRUE(seen().initialised) << "the first is left alone";
}

}  // namespace
}  // namespace forceshade::device
