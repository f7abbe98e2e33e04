// SPDX-License-Identifier: BSD-3-Clause
// The Inverse3 over the stand-in for its service: no allocation in a tick, and the words for what its socket shows.

#include "device/haply/haply.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/device/framed_device.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace forceshade::device {
namespace {

using namespace std::chrono_literals;

// The stand-in as a process of a test's, at a port of the system's choice.
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

  // Once the session is over.
  nlohmann::json verdict() {
    ::waitpid(process_, nullptr, 0);
    process_ = -1;
    return nlohmann::json::parse(here_.read("report"));
  }

 private:
  tests::TemporaryDirectory here_;
  pid_t process_ = -1;
};

bool has_websockets() {
  return std::system("/usr/bin/python3 -c 'import websockets' 2> /dev/null") == 0;
}

// The hand moves with the messages, and the device keeps its force between any two.
const std::string kPatientDevice = "--clock messages --longest-gap 3600000 --assume idle-after=never ";

class haply_device : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_websockets()) GTEST_SKIP() << "the Python package websockets is not there (Debian package python3-websockets)";
  }
  Attendant nobody;
};

// Neither while it runs nor when it fails. Only the thread that calls the device is counted.
TEST_F(haply_device, allocates_nothing_once_started) {
  HaplyStandIn stand_in(kPatientDevice + "--event garbage@1400");
  const auto device = open_haply("", kPatient, nobody);
  ASSERT_FALSE(device->start(1000));
  expect_ticks_without_allocation(*device);
  const std::size_t before = tests::allocations();
  const Fault fault = fault_of(*device);
  EXPECT_EQ(tests::allocations(), before);
  EXPECT_NE(std::string(fault.words).find("expected JSON"), std::string::npos) << fault.words;
}

// Faults in contact that the socket itself shows; the rest is tried in a simulated world (tests/world/arms_world_test.cpp).
TEST_F(haply_device, ends_a_run_in_the_words_of_what_went_wrong) {
  constexpr const char *kClosed = "the Inverse Service has closed the connection", *kLate = "has not answered for 200 ms";
  for (const auto& [event, words] : {std::pair{"close", kClosed}, {"reset", kClosed}, {"freeze", kLate}}) {
    SCOPED_TRACE(event);
    HaplyStandIn stand_in(kPatientDevice + "--event " + event + "@contact");
    FramedOptions options = kPatient;
    if (words == kLate) options.answer = 200ms, options.end = 0ms;
    const std::string said = driven(*open_haply("", options, nobody), 1000);
    EXPECT_NE(said.find(words), std::string::npos) << said;
    if (words == kLate) continue;
    EXPECT_EQ(stand_in.verdict()["faults"], nlohmann::json::object());
  }
}

// Any other refusal is tried without a service (haply_messages_test.cpp).
TEST_F(haply_device, that_cannot_be_driven_is_refused_in_words) {
  for (const auto& [stand_in, words] : {std::pair{"--assume http=none", "no Inverse Service answers at 127.0.0.1:"},
                                        {"--version 4.0.1", "expected 3.1 or later, below 4, got 4.0.1"}}) {
    HaplyStandIn service(stand_in);
    tests::expect_words(tests::thrown_by<DeviceError>([&] { open_haply("", kPatient, nobody); }), {words});
  }
}

TEST_F(haply_device, is_driven_whatever_the_documents_leave_open_and_makes_no_fault) {
  std::string others;
  for (const char* other : {"values-key=both", "http=before", "envelope=asked", "force-reported=no", "basis-reported=no",
                            "control-mode=force", "grip=wireless", "ping=0.05", "clamp=0.1", "ration=0.3", "in-flight=drop",
                            "unknown-command=close", "malformed=close", "not-finite=close", "after-close=hold"})
    others += std::string("--assume ") + other + ' ';
  for (const std::string& options : {others, std::string("--version 3.4.2 --assume grip=none --type minverse")}) {
    SCOPED_TRACE(options);
    HaplyStandIn stand_in(kPatientDevice + options);
    expect_ticks(*open_haply("", kPatient, nobody));
    EXPECT_EQ(stand_in.verdict()["faults"], nlohmann::json::object());
  }
}

// The service gets the forces that the frames were given to hold, and no force acts after the last command.
TEST_F(haply_device, shortens_what_is_beyond_its_highest_force_and_refuses_what_is_not_finite) {
  HaplyStandIn stand_in(kPatientDevice);
  {
    const auto device = open_haply("", kPatient, nobody);
    EXPECT_EQ(device->capabilities().model, "inverse3");
    EXPECT_EQ(device->capabilities().driver, "Inverse Service 3.5.1");
    EXPECT_NE(device->capabilities().forces.find("force gate gain 0.3"), std::string_view::npos);
    command_too_much(*device);
  }
  expect_highest_force(stand_in.verdict(), 5);
}

}  // namespace
}  // namespace forceshade::device
