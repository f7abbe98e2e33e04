// SPDX-License-Identifier: BSD-3-Clause
// The Inverse3 over the stand-in for its service: no allocation in a tick, and the words for what its socket shows.

#include "device/haply/haply.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "tests/device/framed_device.h"
#include "tests/device/haply/stand_in.h"
#include "tests/support/words.h"

namespace forceshade::device {
namespace {

using namespace std::chrono_literals;

// The hand moves with the messages, and the device keeps its force between any two.
const std::string kPatientDevice = "--clock messages --longest-gap 3600000 --assume idle-after=never ";

std::string words_of(const char* stand_in) {
  HaplyStandIn service(stand_in);
  Attendant nobody;
  return tests::thrown_by<DeviceError>([&] { open_haply("", kPatient, nobody); });
}

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
    if (words == kLate) options.answer = 200ms;
    const std::string said = driven(*open_haply("", options, nobody), 1000);
    EXPECT_NE(said.find(words), std::string::npos) << said;
    if (words == kLate) continue;
    EXPECT_EQ(stand_in.verdict()["faults"], nlohmann::json::object());
  }
}

TEST_F(haply_device, that_cannot_be_driven_is_refused_in_words) {
  for (const auto& [stand_in, words] :
       {std::pair{"--assume in-use=any", "another program uses the Inverse3 049D"},
        std::pair{"--assume http=none", "no Inverse Service answers at 127.0.0.1:"},
        std::pair{"--version 2.2.0", "expected 3.1 or later, below 4, got 2.2.0"},
        std::pair{"--assume mount=turned", "the Inverse3's mount: expected the identity"},
        std::pair{"--assume transform=doubled", "the Inverse3's transform: expected the identity"},
        std::pair{"--version 4.0.1", "expected 3.1 or later, below 4, got 4.0.1"}})
    EXPECT_NE(words_of(stand_in).find(words), std::string::npos) << words_of(stand_in);
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
