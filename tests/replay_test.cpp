// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/device/replay.h"

#include <gtest/gtest.h>

#include <cmath>
#include <variant>

#include "forceshade/csv/csv.h"
#include "forceshade/device/open_device.h"
#include "forceshade/tests/temporary_directory.h"

namespace forceshade::device {
namespace {

using tests::TemporaryDirectory;

constexpr const char* kHeader = "t_s,x_mm,y_mm,z_mm\n";

std::string error_of(const std::string& rows) {
  const TemporaryDirectory directory;
  const std::string path = directory.write("hand.csv", rows);
  try {
    Replay::load(path);
  } catch (const csv::Error& error) {
    return std::string(error.what()).substr(directory.path().size() + 1);
  }
  return "no error";
}

TEST(replay, gives_every_row_once) {
  const TemporaryDirectory directory;
  Replay replay = Replay::load(directory.write("hand.csv", std::string(kHeader) + "0,1,2,3\n0.25,4,5,6\n0.25,7,8,nan\n"));
  EXPECT_EQ(replay.readings_left(), 3U);

  const auto first = std::get<Reading>(replay.read());
  EXPECT_EQ(first.time, 0);
  EXPECT_EQ(first.position, Eigen::Vector3f(1, 2, 3));
  const auto second = std::get<Reading>(replay.read());
  EXPECT_EQ(second.time, 0.25);
  EXPECT_EQ(second.position, Eigen::Vector3f(4, 5, 6));
  EXPECT_TRUE(std::isnan(std::get<Reading>(replay.read()).position.z()));

  EXPECT_EQ(replay.readings_left(), 0U);
  EXPECT_TRUE(std::holds_alternative<EndOfData>(replay.read()));
  EXPECT_TRUE(std::holds_alternative<EndOfData>(replay.read()));
}

TEST(replay, keeps_the_last_command) {
  Replay replay({Reading{}});
  EXPECT_EQ(replay.last_command(), Eigen::Vector3f(0, 0, 0));
  replay.command({1, 2, 3});
  replay.command({4, 5, 6});
  EXPECT_EQ(replay.last_command(), Eigen::Vector3f(4, 5, 6));
}

TEST(replay, refuses_a_time_that_decreases_or_is_not_finite) {
  EXPECT_EQ(error_of(std::string(kHeader) + "0,0,0,0\n0.5,0,0,0\n0.25,0,0,0\n"),
            "hand.csv:4: column 1 (t_s): expected a time not before 0.5, got \"0.25\"");
  EXPECT_EQ(error_of(std::string(kHeader) + "nan,0,0,0\n"), "hand.csv:2: column 1 (t_s): expected a finite time, got \"nan\"");
  EXPECT_EQ(error_of(std::string(kHeader) + "1e999,0,0,0\n"),
            "hand.csv:2: column 1 (t_s): expected a finite time, got \"1e999\"");
}

TEST(replay, refuses_an_empty_recording) {
  EXPECT_EQ(error_of(kHeader), "hand.csv: expected at least one recorded position, got none");
}

TEST(replay, names_the_field_that_is_no_number) {
  EXPECT_EQ(error_of(std::string(kHeader) + "0,0,here,0\n"), "hand.csv:2: column 3 (y_mm): expected a number, got \"here\"");
}

TEST(open_device, opens_a_replay) {
  const TemporaryDirectory directory;
  const std::string path = directory.write("hand.csv", std::string(kHeader) + "0,1,2,3\n");
  EXPECT_EQ(open_device("replay:" + path)->readings_left(), 1U);
}

TEST(open_device, opens_a_device_that_is_none) {
  const auto device = open_device("null");
  EXPECT_EQ(device->capabilities().model, "null");
  device->start(500);
  EXPECT_EQ(std::get<Reading>(device->read()).time, 0);
  EXPECT_FALSE(device->command({1, 2, 3}));
  const auto second = std::get<Reading>(device->read());
  EXPECT_EQ(second.time, 0.002);
  EXPECT_EQ(second.position, Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(device->readings_left(), std::nullopt);
}

TEST(open_device, lists_the_kinds_it_knows) {
  for (const std::string name : {"", "replay", "replay:", "phantom:", "phantomx", "simulatedx", "null:1"}) {
    try {
      open_device(name);
      FAIL() << name;
    } catch (const UnknownDevice& error) {
      EXPECT_EQ(error.what(), "unknown device \"" + name +
                                  "\": expected null, replay:FILE.csv, simulated[:MODEL[:RECORDING.csv]] or phantom[:NAME]");
    }
  }
}

}  // namespace
}  // namespace forceshade::device
