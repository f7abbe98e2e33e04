// SPDX-License-Identifier: BSD-3-Clause
// The report of a certified run, as a whole, with every number another one; and its recording.

#include "forceshade/run.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>

#include "certificate/build.h"
#include "forceshade/checks.h"
#include "forceshade/recording.h"
#include "run/record.h"
#include "run/rule_names.h"
#include "run/summary.h"
#include "run/words.h"
#include "tests/device/servo_loop_fixture.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace forceshade::run {
namespace {

namespace fs = std::filesystem;
using device::EndReason;
using device::Rule;
using device::ServoResult;
using nlohmann::ordered_json;

ServoResult made_result() {
  ServoResult run;
  run.end_reason = EndReason::tripped;
  run.trip = device::Trip{Rule::velocity, 17};
  run.ticks = 18;
  run.missed_deadlines = 2;
  run.overruns = 1;
  run.invalid_positions = 4;
  run.unfinished_ticks = 5;
  run.achieved_rate_hz = 999.5;
  run.worst_delay = {.tick = 6, .late_ms = 1.5, .before_ms = 2.5, .computed_ms = 3.5};
  run.acts_on_lateness = true;
  run.wakeup_us = {1, 2, 3, 4, 5, {{1.5, 7}, {2.5, 8}}};
  run.compute_us = {11, 12, 13, 14, 15, {{16.5, 17}}};
  run.tick_us = {21, 22, 23, 24, 25, {{26.5, 27}}};
  run.peak_force_N = 3.25;
  run.supervised = true;
  for (std::size_t rule = 0; rule < device::kRules; ++rule) run.limited_ticks[rule] = 100 + rule;
  run.passivity = device::Passivity::damping;
  run.passivity_settings.epsilon = 0.125;
  run.passivity_settings.friction = 0.375;
  run.passivity_settings.latency = true;
  run.account.balance = -0.5;
  run.account.lowest_balance = -0.75;
  run.account.dissipated = 0.25;
  run.account.forgiven = 0.0625;
  run.account.withheld = 8.5;
  run.account.altered = 9;
  run.account.largest_change = 10.5;
  run.account.longest_step = 11.5;
  run.account.given = 4;
  run.followed_device = true;
  run.privileges = {.scheduling = true, .memory_locked = false, .cpu = 3};
  return run;
}

// taken = given - (dissipated + forgiven - balance) = 4 - (0.25 + 0.0625 + 0.5).
TEST(run_summary, has_each_number_of_the_loop_under_its_name) {
  const ordered_json expected = ordered_json::parse(R"({
    "end_reason": "tripped", "ticks": 18, "missed_deadlines": 2, "overruns": 1,
    "worst_delay": {"tick": 6, "late_ms": 1.5, "tick_before_ms": 2.5, "computed_before_ms": 3.5},
    "invalid_positions": 4, "unfinished_ticks": 5, "rate_hz": 999.5, "paced_by": "device",
    "compute_us": {"p50": 11.0, "p99": 12.0, "p999": 13.0, "p9999": 14.0, "max": 15.0, "histogram": [[16.5, 17]]},
    "tick_us": {"p50": 21.0, "p99": 22.0, "p999": 23.0, "p9999": 24.0, "max": 25.0, "histogram": [[26.5, 27]]},
    "wakeup_us": {"p50": 1.0, "p99": 2.0, "p999": 3.0, "p9999": 4.0, "max": 5.0, "histogram": [[1.5, 7], [2.5, 8]]},
    "peak_force_N": 3.25, "energy_given_mJ": 4.0, "energy_taken_mJ": 3.1875,
    "supervisor": {"supervised": true, "acts_on_lateness": true, "trip": {"rule": "velocity", "tick": 17}, "limited_ticks": {
      "peak force": 100, "continuous force": 101, "warm motors": 102, "slew": 103, "workspace": 104, "gentle start": 105,
      "dead-man switch": 106, "missed deadlines": 107, "invalid position": 108, "uncalibrated": 109, "invalid force": 110,
      "jump": 111, "velocity": 112, "frozen encoder": 113, "watchdog": 114, "oscillation": 115, "energy": 116,
      "unfinished": 117}, "forces_off_ticks": 0, "forces_off": null, "fades": 0, "faded_s": 0.0},
    "passivity": {"controller": "damping", "epsilon_mJ": 0.125, "friction_N": 0.375, "latency": true, "balance_mJ": -0.5,
      "lowest_balance_mJ": -0.75, "dissipated_by_friction_mJ": 0.25, "forgiven_mJ": 0.0625, "withheld_mJ": 8.5,
      "altered_ticks": 9, "largest_change_N": 10.5, "longest_step_mm": 11.5},
    "realtime_scheduling": true, "memory_locked": false, "cpu": 3})");
  EXPECT_EQ(to_json(made_result()).dump(1), expected.dump(1));
  // Fields that may be absent or another word.
  ServoResult other = made_result();
  other.trip.reset();
  other.end_reason = EndReason::time_up;
  other.followed_device = false;
  other.supervised = false;
  other.acts_on_lateness = false;
  other.passivity_settings.latency = false;
  other.privileges = {.scheduling = false, .memory_locked = true, .cpu = std::nullopt};
  ordered_json changed = expected;
  changed["end_reason"] = "time up";
  changed["paced_by"] = "clock";
  changed["supervisor"]["trip"] = nullptr;
  changed["supervisor"]["supervised"] = changed["supervisor"]["acts_on_lateness"] = false;
  changed["passivity"]["latency"] = false;
  changed["realtime_scheduling"] = false;
  changed["memory_locked"] = true;
  changed["cpu"] = nullptr;
  EXPECT_EQ(to_json(other).dump(1), changed.dump(1));
  other.wakeup_us.histogram.clear();
  EXPECT_EQ(to_json(other)["paced_by"], nullptr) << "ticks followed one another";
}

TEST(run_summary, has_each_field_of_the_last_ticks) {
  device::Sample sample;
  sample.tick = 3;
  sample.wall_ns = 2'500'000;
  sample.position = {1, 2, 3};
  sample.law_force = {4, 5, 6};
  sample.force = {7, 8, 9};
  sample.limited =
      static_cast<std::uint16_t>((1U << device::Rules::bit_of(Rule::slew)) | (1U << device::Rules::bit_of(Rule::oscillation)));
  device::Sample last;
  last.tick = 4;
  last.tripped = static_cast<std::uint8_t>(Rule::jump) + 1;
  const ordered_json expected = ordered_json::parse(R"([
    {"tick": 3, "t_s": 0.0025, "position_mm": [1.0, 2.0, 3.0], "law_force_N": [4.0, 5.0, 6.0], "force_N": [7.0, 8.0, 9.0],
     "limited": ["slew", "oscillation"], "tripped": null},
    {"tick": 4, "t_s": 0.0, "position_mm": [null, null, null], "law_force_N": [0.0, 0.0, 0.0], "force_N": [0.0, 0.0, 0.0],
     "limited": [], "tripped": "jump"}])");
  EXPECT_EQ(last_ticks_json({sample, last}).dump(1), expected.dump(1));
  EXPECT_EQ(joined_rule_names(sample.limited), "slew, oscillation");
  EXPECT_EQ(joined_rule_names(0), "");
}

device::Capabilities known_device() {
  device::Capabilities known;
  known.model = "a model";
  known.serial = "a serial";
  known.driver = "a driver";
  known.firmware = "a firmware";
  return known;
}

const Rendering& wall() {
  static const Rendering rendering = std::get<Rendering>(rendering_of(LawId::wall, {.stiffness = 0.5F}));
  return rendering;
}

TEST(run_summary, says_what_was_rendered_where_and_what_ended_it) {
  Plan plan;
  plan.device = "stand-in";
  plan.digest = "c0ffee";
  plan.servo.placement = device::Placement({1, -2, 3.5F}).turned(2, 1);
  Outcome outcome{made_result(), {device::Sample{}}, {}};
  const ordered_json json = summary(outcome, wall(), plan, known_device(), "SIGINT");
  EXPECT_EQ(json["law"], "wall");
  EXPECT_FALSE(json.contains("digest"));
  EXPECT_EQ(json["parameters"], ordered_json::parse(R"({"stiffness_N_per_mm": 0.5})"));
  EXPECT_EQ(json["certificate_digest"], "c0ffee");
  EXPECT_EQ(json["library_digest"], properties::current_build().library_digest);
  EXPECT_EQ(json["placement"], ordered_json::parse(R"({"origin_mm": [1.0, -2.0, 3.5], "axes": "+y,-x,+z"})"));
  EXPECT_EQ(json["device"], ordered_json::parse(R"({"name": "stand-in", "model": "a model", "serial": "a serial",
                                                    "driver": "a driver", "firmware": "a firmware"})"));
  EXPECT_EQ(json["ticks"], 18);
  EXPECT_EQ(json["signal"], "SIGINT");
  EXPECT_EQ(json["warning"], nullptr);
  EXPECT_EQ(json["last_ticks"].size(), 1U);
  plan.digest.reset();
  const ordered_json bare = summary(outcome, wall(), plan, {});
  EXPECT_EQ(bare["certificate_digest"], nullptr);
  EXPECT_EQ(bare["signal"], nullptr);
  EXPECT_EQ(bare["device"], ordered_json::parse(R"({"name": "stand-in", "model": "unknown"})"));
  const Identity map{kHeightMapKind, "hill.toml", {{"rendering", std::string("height-map")}}, std::string(64, 'd')};
  EXPECT_EQ(summary_of(map).dump(),
            R"({"height_map":"hill.toml","digest":")" + std::string(64, 'd') + R"(","parameters":{"rendering":"height-map"}})");
}

TEST(run_words, of_a_recording_name_the_build_the_device_and_what_was_rendered) {
  const properties::Build build = properties::current_build();
  device::ServoOptions servo;
  servo.paced = false;
  recorder::Metadata metadata = metadata_of_run("stand-in", known_device(), servo);
  for (const auto& [key, words] : recorder::Metadata{{"library_digest", build.library_digest},
                                                     {"version", build.version},
                                                     {"revision", build.revision},
                                                     {"compiler", build.compiler},
                                                     {"flags", build.flags},
                                                     {"instruction_set", build.instruction_set},
                                                     {"device", "stand-in"},
                                                     {"paced", "no"},
                                                     {"device_model", "a model"},
                                                     {"device_serial", "a serial"},
                                                     {"device_driver", "a driver"},
                                                     {"device_firmware", "a firmware"}})
    EXPECT_EQ(metadata[key], words) << key;
  EXPECT_TRUE(metadata.contains("passivity_epsilon_mJ"));
  servo.paced = true;
  metadata = metadata_of_run("stand-in", {}, servo);
  EXPECT_EQ(metadata["paced"], "yes");
  EXPECT_EQ(metadata["device_model"], "unknown");
  EXPECT_FALSE(metadata.contains("device_serial"));
  const Identity map{kHeightMapKind, "hill.toml", {{"stiffness_N_per_mm", 0.5F}}, std::string(64, 'd')};
  EXPECT_EQ(metadata_of(map),
            (recorder::Metadata{{"height_map", "hill.toml"}, {"digest", std::string(64, 'd')}, {"stiffness_N_per_mm", "0.5"}}));
  EXPECT_EQ(metadata_of(wall().identity), (recorder::Metadata{{"law", "wall"}, {"stiffness_N_per_mm", "0.5"}}));
}

// A tick of a device that stands still in the wall until its readings end, or until it fails.
struct InTheWall : device::Still {
  explicit InTheWall(bool its_fails) : fails(its_fails) {}
  device::ReadResult at(std::size_t reading) noexcept override {
    if (reading < 400) return device::Reading{{0, 0, -0.1F}, 0.001 * static_cast<double>(reading)};
    if (fails) return device::Fault{"broken"};
    return device::EndOfData{};
  }
  bool fails;
};

TEST(run, records_its_ticks_and_keeps_the_last_of_one_that_failed) {
  const tests::TemporaryDirectory directory;
  const std::atomic<bool> go_on = false;
  for (const bool fails : {false, true}) {
    InTheWall device(fails);
    Plan plan;
    plan.device = "stand-in";
    plan.digest = "c0ffee";
    plan.record = directory.file(fails ? "failed.fsr" : "whole.fsr");
    plan.servo.paced = false;
    plan.servo.placement = device::Placement({0.5F, 0, 0}).turned(2, 2);
    const Outcome outcome = run(device, wall(), plan, go_on);
    EXPECT_EQ(outcome.result.end_reason, fails ? EndReason::device_fault : EndReason::end_of_data);
    EXPECT_EQ(has_failed(outcome.result), fails);
    EXPECT_TRUE(outcome.record_faults.empty());
    if (fails) {
      // 0.2 s of a loop of 1000 Hz.
      EXPECT_NEAR(static_cast<double>(outcome.last_ticks.size()), 200, 2);
      EXPECT_GE(outcome.last_ticks.back().tick, 399U);
    } else {
      EXPECT_TRUE(outcome.last_ticks.empty());
    }
    recorder::Recording recording(plan.record);
    EXPECT_GE(recording.extent().samples, 400U);
    const recorder::Metadata& metadata = recording.metadata();
    EXPECT_EQ(metadata.at("certificate_digest"), "c0ffee");
    EXPECT_EQ(metadata.at("origin_mm"), "0.5,0,0");
    EXPECT_EQ(metadata.at("axes"), "-x,-y,+z");
    EXPECT_EQ(metadata.at("law"), "wall");
    EXPECT_EQ(metadata.at("device"), "stand-in");
    EXPECT_EQ(metadata.at("end_reason"), fails ? "device fault" : "end of data");
  }
}

TEST(run, of_no_certificate_says_so_and_one_that_was_stopped_before_leaves_nothing) {
  const tests::TemporaryDirectory directory;
  InTheWall device(false);
  Plan plan;
  plan.record = directory.file("run.fsr");
  plan.servo.paced = false;
  const std::atomic<bool> stopped = true, go_on = false;
  EXPECT_THROW(run(device, wall(), plan, stopped), Interrupted);
  EXPECT_FALSE(fs::exists(plan.record));
  run(device, wall(), plan, go_on);
  EXPECT_EQ(recorder::Recording(plan.record).metadata().at("certificate_digest"), "none");
  EXPECT_THROW(run(device, wall(), plan, go_on), Error) << "it is there already";
  plan.overwrite = true;
  InTheWall again(true);
  run(again, wall(), plan, go_on);
  EXPECT_EQ(recorder::Recording(plan.record).metadata().at("end_reason"), "device fault");
}

TEST(run, has_failed_where_the_supervisor_or_the_device_ended_it) {
  for (const auto& [reason, failed] : {std::pair{EndReason::stopped, false},
                                       {EndReason::time_up, false},
                                       {EndReason::end_of_data, false},
                                       {EndReason::device_fault, true},
                                       {EndReason::tripped, true}}) {
    ServoResult result;
    result.end_reason = reason;
    if (reason == EndReason::tripped) result.trip = device::Trip{Rule::jump, 1};
    EXPECT_EQ(has_failed(result), failed) << name_of(reason);
  }
}

TEST(record, of_a_table_leaves_the_table_alone) {
  const tests::TemporaryDirectory directory;
  for (const char* name : {"run.csv", "run.npy"}) {
    {
      Record record(directory.file(name), {{"law", "wall"}}, false, false);
      record.sink().push({.tick = 0});
      record.sink().push({.tick = 1});
      EXPECT_TRUE(record.close("time_up").empty());
    }
    EXPECT_TRUE(fs::is_regular_file(directory.file(name)));
  }
  EXPECT_EQ(directory.entries(), 2);
  const std::string table = directory.read("run.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 3) << table;
  { Record never_closed(directory.file("other.csv"), {}, false, false); }
  { Record never_closed(directory.file("other.fsr"), {}, false, false); }
  EXPECT_EQ(directory.entries(), 2);
}

// The ticks are kept where the table cannot be made, and their place is reported.
TEST(record, keeps_the_ticks_where_the_table_cannot_be_made) {
  const tests::TemporaryDirectory directory;
  const std::string path = directory.file("run.csv");
  std::string said;
  {
    Record record(path, {{"law", "wall"}}, false, false);
    record.sink().push({.tick = 0});
    fs::create_directory(path);
    const std::vector<std::string> faults = record.close("time_up");
    ASSERT_EQ(faults.size(), 1U);
    said = faults[0];
  }
  const std::size_t at = said.find("; the ticks are in "), end = said.find(": forceshade recording export");
  ASSERT_TRUE(at != std::string::npos && end != std::string::npos) << said;
  const std::string kept = said.substr(at + 19, end - at - 19);
  EXPECT_TRUE(kept.starts_with(path + ".partial-")) << kept;
  EXPECT_EQ(recorder::Recording(kept).extent().samples, 1U);
}

// Another process that has locked a file, as SQLite locks one that it reads or writes.
class Locker {
 public:
  explicit Locker(const std::string& path) {
    std::array<int, 2> locked{};
    EXPECT_EQ(::pipe(locked.data()), 0);
    process = ::fork();
    if (process == 0) {
      struct flock lock {};
      lock.l_type = F_RDLCK;
      const bool is_held = ::fcntl(::open(path.c_str(), O_RDWR), F_SETLK, &lock) == 0;
      if (::write(locked[1], "", 1) == 1 && is_held) ::pause();
      ::_exit(0);
    }
    char one = 0;
    EXPECT_EQ(::read(locked[0], &one, 1), 1);
    for (const int end : locked) ::close(end);
  }
  ~Locker() {
    ::kill(process, SIGKILL);
    ::waitpid(process, nullptr, 0);
  }
  Locker(const Locker&) = delete;
  Locker& operator=(const Locker&) = delete;

  pid_t process = 0;
};

// Whoever has a recording open that has its end only reads it.
TEST(record, takes_the_place_of_one_that_nobody_writes) {
  for (const bool has_end : {false, true}) {
    const tests::TemporaryDirectory directory;
    const std::string path = directory.file("run.fsr");
    {
      recorder::Recorder before(path, {{"law", "wall"}}, recorder::Recorder::Options{});
      before.push({.tick = 0});
      if (has_end) before.close("stopped");
    }
    const Locker other(path);
    const std::string words = tests::thrown_by<Error>([&] {
      Record record(path, {{"law", "cylinder"}}, false, true);
      record.close("stopped");
    });
    EXPECT_EQ(
        words,
        has_end ? "" : path + ": cannot replace the recording: the process " + std::to_string(other.process) + " writes it");
    EXPECT_EQ(recorder::Recording(path).metadata().at("law"), has_end ? "cylinder" : "wall");
  }
}

}  // namespace
}  // namespace forceshade::run
