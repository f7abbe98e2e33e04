// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <stdexcept>
#include <variant>

#include "files/csv.h"
#include "forceshade/device.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace forceshade::device {
namespace {

using tests::TemporaryDirectory;

constexpr const char* kHeader = "t_s,x_mm,y_mm,z_mm\n";

// All readings at this rate, which are as many as the replay announced.
std::vector<Reading> played(Replay replay, double rate) {
  EXPECT_EQ(replay.readings_left(), std::nullopt) << "not known before it is started";
  EXPECT_FALSE(replay.start(rate));
  const std::size_t expected = replay.readings_left().value();
  std::vector<Reading> readings;
  ReadResult result = replay.read();
  for (; std::holds_alternative<Reading>(result); result = replay.read()) {
    readings.push_back(std::get<Reading>(result));
    EXPECT_EQ(replay.readings_left(), expected - readings.size());
  }
  EXPECT_TRUE(std::holds_alternative<EndOfData>(result));
  EXPECT_TRUE(std::holds_alternative<EndOfData>(replay.read()));
  EXPECT_EQ(readings.size(), expected);
  return readings;
}

bool same_bits(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::memcmp(a.data(), b.data(), 3 * sizeof(float)) == 0;
}

// A hand that goes 1 mm in each 10 ms.
std::vector<Reading> at_100_hz(double begin) {
  std::vector<Reading> recording;
  for (int k = 0; k <= 50; ++k) recording.push_back({{static_cast<float>(k), 1, -1}, begin + 0.01 * k});
  return recording;
}

TEST(replay, at_the_recordings_own_rate_gives_every_row_to_the_bit) {
  const TemporaryDirectory directory;
  const auto readings =
      played(Replay::load(directory.write("hand.csv", std::string(kHeader) + "0,1,2,3\n0.25,4,5,6\n0.5,7,8,nan\n")), 4);
  ASSERT_EQ(readings.size(), 3U);
  EXPECT_EQ(readings[0].time, 0);
  EXPECT_EQ(readings[0].position, Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(readings[1].time, 0.25);
  EXPECT_EQ(readings[1].position, Eigen::Vector3f(4, 5, 6));
  EXPECT_TRUE(std::isnan(readings[2].position.z()));

  // Time stamps are decimal, periods are not: rounding moves them apart, and the recorded bits are given nevertheless.
  std::mt19937 random(5);
  std::uniform_real_distribution<float> uniform(-1, 1);
  for (const double rate : {100.0, 333.0, 1000.0, 1024.0, 10000.0})
    for (const double begin : {0.0, -3.7, 1234.56789}) {
      std::vector<Reading> recording;
      for (int k = 0; k < 3000; ++k)
        recording.push_back({{uniform(random), uniform(random), uniform(random)}, begin + k / rate});
      const auto same = played(Replay(recording), rate);
      ASSERT_EQ(same.size(), recording.size()) << rate << ' ' << begin;
      for (std::size_t k = 0; k < same.size(); ++k) {
        ASSERT_TRUE(same_bits(same[k].position, recording[k].position)) << rate << ' ' << begin << ' ' << k;
        ASSERT_EQ(same[k].time, recording[k].time);
      }
    }
}

TEST(replay, of_100_hz_takes_as_long_at_any_rate) {
  for (const double rate : {100.0, 500.0, 1000.0, 3000.0, 30.0})
    for (const double begin : {0.0, 17.5, -2.0}) {
      const auto readings = played(Replay(at_100_hz(begin)), rate);
      ASSERT_EQ(readings.size(), static_cast<std::size_t>(std::floor(0.5 * rate + 1e-6)) + 1) << rate;
      for (std::size_t k = 0; k < readings.size(); ++k) {
        const double time = static_cast<double>(k) / rate;
        EXPECT_NEAR(readings[k].time, begin + time, 1e-9);
        EXPECT_NEAR(static_cast<double>(readings[k].position.x()), 100 * time, 1e-5);
        EXPECT_EQ(readings[k].position.y(), 1);
      }
    }
}

// A clock that wakes when it can: the pace is that of the time stamps, not of the rows.
TEST(replay, of_uneven_time_stamps_goes_straight_between_them) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> gap(1e-4, 0.02);
  std::vector<Reading> recording;
  for (double time = 0; recording.size() < 500; time += gap(random)) {
    const auto t = static_cast<float>(time);
    recording.push_back(
        {.position = {3 * t, -2 * t, 1}, .time = time, .buttons = static_cast<std::uint16_t>(recording.size())});
  }
  std::size_t last = 0;
  for (const Reading& reading : played(Replay(recording), 1000)) {
    EXPECT_NEAR(static_cast<double>(reading.position.x()), 3 * reading.time, 1e-5);
    EXPECT_NEAR(static_cast<double>(reading.position.y()), -2 * reading.time, 1e-5);
    while (last + 1 < recording.size() && recording[last + 1].time <= reading.time) ++last;
    EXPECT_EQ(reading.buttons, last) << "what cannot be between is the earlier one's";
  }
  EXPECT_GE(last, 490U);
}

TEST(replay, is_invalid_only_between_the_neighbours_of_an_invalid_position) {
  std::vector<Reading> recording = at_100_hz(0);
  recording[20].position.z() = std::nanf("");
  const auto readings = played(Replay(recording), 1000);
  ASSERT_EQ(readings.size(), 501U);
  for (std::size_t k = 0; k < readings.size(); ++k) EXPECT_EQ(std::isnan(readings[k].position.z()), k > 190 && k < 210) << k;
}

TEST(replay, gives_nothing_before_it_is_started_and_one_reading_of_one_row) {
  EXPECT_TRUE(std::holds_alternative<Fault>(Replay(at_100_hz(0)).read()));
  EXPECT_EQ(played(Replay({Reading{}}), 1000).size(), 1U);
}

// Times whose difference is beyond binary64, and some that are as near as two numbers can be.
TEST(replay, of_extreme_times_stays_finite) {
  Replay endless({{{1, 0, 0}, -1e308}, {{2, 0, 0}, 1e308}});
  EXPECT_FALSE(endless.start(1000));
  for (int k = 0; k < 3; ++k) {
    const auto reading = std::get<Reading>(endless.read());
    EXPECT_EQ(reading.position.x(), 1);
    EXPECT_TRUE(std::isfinite(reading.time));
  }
  const auto close = played(Replay({{{1, 0, 0}, 0}, {{2, 0, 0}, 5e-324}, {{3, 0, 0}, 1e-300}, {{4, 0, 0}, 0.002}}), 1000);
  ASSERT_EQ(close.size(), 3U);
  EXPECT_EQ(close[0].position.x(), 3);
  EXPECT_NEAR(static_cast<double>(close[1].position.x()), 3.5, 1e-6);
  EXPECT_EQ(close[2].position.x(), 4);
}

TEST(replay, keeps_the_last_command) {
  Replay replay({Reading{}});
  EXPECT_EQ(replay.last_command(), Eigen::Vector3f(0, 0, 0));
  replay.command({1, 2, 3});
  replay.command({4, 5, 6});
  EXPECT_EQ(replay.last_command(), Eigen::Vector3f(4, 5, 6));
}

TEST(replay, refuses_a_time_that_does_not_increase_or_is_not_finite_and_no_positions) {
  const std::string time = ": column 1 (t_s): expected a ";
  for (const auto& [rows, words] : {std::pair{"0,0,0,0\n0.5,0,0,0\n0.25,0,0,0\n", ":4" + time + "time after 0.5, got \"0.25\""},
                                    {"0,0,0,0\n\n0.5,0,0,0\n0.5,0,0,0\n", ":5" + time + "time after 0.5, got \"0.5\""},
                                    {"nan,0,0,0\n", ":2" + time + "finite time, got \"nan\""},
                                    {"1e999,0,0,0\n", ":2" + time + "finite time, got \"1e999\""},
                                    {"0,0,here,0\n", ":2: column 3 (y_mm): expected a number, got \"here\""},
                                    {"", ": expected at least one recorded position, got none"}}) {
    const TemporaryDirectory directory;
    const std::string path = directory.write("hand.csv", std::string(kHeader) + rows);
    EXPECT_EQ(tests::thrown_by<Error>([&] { Replay::load(path); }), path + words);
  }
  EXPECT_THROW(Replay({{{0, 0, 0}, 1}, {{0, 0, 0}, 1}}), std::invalid_argument);
  EXPECT_THROW(Replay({{{0, 0, 0}, std::nan("")}}), std::invalid_argument);
  EXPECT_THROW(Replay({}), std::invalid_argument);
}

TEST(open_device, opens_a_replay_and_a_device_that_is_none) {
  const TemporaryDirectory directory;
  const auto replay = open_device("replay:" + directory.write("hand.csv", std::string(kHeader) + "0,1,2,3\n"));
  replay->start(1000);
  EXPECT_EQ(replay->readings_left(), 1U);
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

TEST(open_device, lists_the_kinds_it_knows_and_names_the_nearest) {
  for (const std::string name : {"", "replay", "replay:", "phantom:", "simulated:", "phantomx", "null:1", ":"}) {
    const std::string nearest = name.ends_with('x') ? name.substr(0, name.size() - 1) : "";
    EXPECT_EQ(tests::thrown_by<Error>([&] { open_device(name); }),
              "unknown device \"" + name +
                  "\": expected null, replay:FILE.csv, simulated[:MODEL[:FILE.csv]], mouse[:MODEL], phantom[:NAME], "
                  "command:PROGRAM, haply[:ID] or dhd[:SERIAL]" +
                  (nearest.empty() ? "" : "; the nearest is " + nearest));
  }
}

}  // namespace
}  // namespace forceshade::device
