// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/recording.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "files/csv.h"
#include "files/output_file.h"
#include "forceshade/device.h"
#include "forceshade/fast.h"
#include "forceshade/servo_loop.h"
#include "run/recorder/layout.h"
#include "run/recorder/sqlite.h"
#include "tests/support/kept_samples.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace forceshade::recorder {
namespace {

using tests::TemporaryDirectory;

// In and out of a wall of 0.5 N/mm, with one position that is not a number; a device with buttons, a gimbal and encoders.
struct Kept : device::ServoResult {
  std::vector<Sample> samples;
};

Kept drive(Recorder& recorder) {
  std::vector<device::Reading> path;
  for (int k = 0; k < 200; ++k)
    path.push_back({.position = {1, 2, std::sin(0.1F * static_cast<float>(k))},
                    .time = 0.0001 * k,
                    .buttons = static_cast<std::uint16_t>(k % 2),
                    .gimbal = Eigen::Vector3f(0.1F, 0.2F, 0.3F),
                    .encoder = {{7, -8, 9}}});
  path[100].position.z() = std::nanf("");
  device::Replay replay(std::move(path));
  const auto law = std::get<fast::Law>(fast::Law::build(LawId::wall, {.stiffness = 0.5F}));
  const std::atomic<bool> never_stop = false;
  tests::KeptSamples kept;
  Kept run{run_servo_loop(replay, law, {.rate_hz = 10'000, .sinks = {&recorder, &kept}}, never_stop), {}};
  run.samples = std::move(kept.samples);
  return run;
}

// A recording of these samples, in a directory of its own.
struct Recorded {
  explicit Recorded(const std::vector<Sample>& samples) {
    Recorder recorder(path, {});
    for (const Sample& sample : samples) recorder.push(sample);
    recorder.close("time up");
  }
  TemporaryDirectory directory;
  std::string path = directory.file("run.fsr");
};

Kept record(const std::string& path) {
  Recorder recorder(path, {{"law", "wall"}});
  Kept run = drive(recorder);
  recorder.close(std::string(name_of(run.end_reason)));
  return run;
}

std::string words_of(const std::string& path) {
  return tests::thrown_by<Error>([&] { Recording recording(path); });
}

void execute(const std::string& path, const std::string& sql) {
  Database(path, Database::Access::write).execute(sql);
}

TEST(recording, of_a_run_has_every_number_of_every_tick_also_as_csv) {
  const TemporaryDirectory directory;
  const Kept run = record(directory.file("run.fsr"));
  Recording recording(directory.file("run.fsr"));
  EXPECT_EQ(problems_of(recording), std::vector<std::string>{});
  EXPECT_EQ(recording.metadata().at("end_reason"), "end of data");
  export_csv(recording, directory.file("run.csv"));
  EXPECT_TRUE(directory.read("run.csv").starts_with("tick,t_s,device_t_s,x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,status,compute_us,"));

  auto file = files::open_input(directory.file("run.csv"));
  files::Reader rows(file, "run.csv",
                     {"t_s", "device_t_s", "z_mm", "law_fz_N", "fz_N", "compute_us", "encoder_2", "gimbal_3_rad", "energy_mJ",
                      "wakeup_us", "status", "buttons", "late", "limited", "altered", "tripped"});
  const std::vector<std::string> statuses = {"free", "contact", "invalid", "end"};
  std::size_t count = 0, late = 0;
  for (; rows.next(); ++count) {
    const Sample& sample = run.samples.at(count);
    late += sample.late;
    EXPECT_EQ(sample.status == static_cast<int>(Status::invalid), count == 100);
    EXPECT_EQ(sample.buttons, std::min<std::uint64_t>(count, 199) % 2);
    EXPECT_GE(sample.wakeup_ns, 0);
    EXPECT_EQ(std::llround(rows.binary64(0) * 1e9), sample.wall_ns);
    EXPECT_EQ(rows.binary64(1), sample.device_time);
    if (count == 100)
      EXPECT_TRUE(std::isnan(rows.binary32(2)));
    else
      EXPECT_EQ(rows.binary32(2), sample.position[2]);
    EXPECT_EQ(rows.binary32(3), sample.law_force[2]);
    EXPECT_EQ(rows.binary32(4), sample.force[2]);
    EXPECT_EQ(std::llround(rows.binary64(5) * 1e3), sample.compute_ns);
    EXPECT_EQ(rows.text(6), "-8");
    EXPECT_EQ(rows.text(7), "0.3");
    EXPECT_EQ(rows.binary64(8), sample.energy);
    EXPECT_EQ(std::llround(rows.binary64(9) * 1e3), sample.wakeup_ns);
    EXPECT_EQ(rows.text(10), statuses.at(sample.status));
    EXPECT_EQ(rows.text(11), std::to_string(sample.buttons));
    EXPECT_EQ(rows.text(12), std::to_string(sample.late));
    for (const std::size_t flag : {13U, 14U, 15U}) EXPECT_EQ(rows.text(flag), "0");
  }
  EXPECT_EQ(count, 201U);
  EXPECT_EQ(late, run.missed_deadlines);
  EXPECT_GT(run.energy_given_mJ(), 0.1);
  EXPECT_NEAR(run.samples.back().energy, run.energy_given_mJ() - run.energy_taken_mJ(), 1e-12);
}

// The other number has no column of its own: the encoders are left out that a device has not.
TEST(recording, as_csv_names_unfinished_ticks_and_leaves_out_encoders) {
  const Recorded run({{.tick = 0, .status = 1, .device_state = Sample::kForcesOn | Sample::kUnfinished},
                      {.tick = 1, .limited = 5, .altered = 1, .tripped = 3}});
  Recording recording(run.path);
  export_table(recording, run.directory.file("run.csv"));
  const std::string csv = run.directory.read("run.csv");
  EXPECT_NE(csv.find(",unfinished,"), std::string::npos) << csv;
  EXPECT_TRUE(csv.ends_with("free,0,0,0,0,,,,nan,nan,nan,0,0,0,0,5,1,3\n")) << csv;
}

// As numpy.load reads it: a header of whole 64 bytes that ends in a newline, then the samples' own bytes. It has as many rows
// as there are samples, whatever ticks they are of.
TEST(recording, as_npy_is_a_header_and_the_samples) {
  const Recorded run({{.tick = 3}, {.tick = 4}, {.tick = 9}});
  Recording recording(run.path);
  export_table(recording, run.directory.file("run.npy"));
  const std::string npy = run.directory.read("run.npy");
  ASSERT_EQ(npy.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t length = 10 + static_cast<unsigned char>(npy[8]) + 256U * static_cast<unsigned char>(npy[9]);
  EXPECT_EQ(length % 64, 0U);
  EXPECT_EQ(npy[length - 1], '\n');
  const std::string header = npy.substr(10, length - 10);
  EXPECT_TRUE(
      header.starts_with("{'descr': [('tick', '<u8'), ('wall_ns', '<i8'), ('device_t_s', '<f8'), ('encoder_1', '<i8'), "));
  EXPECT_NE(header.find("'fortran_order': False, 'shape': (3,), }"), std::string::npos);
  std::string bytes;
  recording.for_each_chunk([&](std::span<const Sample> chunk) {
    bytes.append(reinterpret_cast<const char*>(chunk.data()), chunk.size() * sizeof(Sample));
  });
  EXPECT_TRUE(npy.substr(length) == bytes);
}

// As NumPy writes the type of a member, or of the elements of one.
template <class Member>
std::string type_of(const Member&) {
  if constexpr (requires { typename Member::value_type; }) {
    return type_of(typename Member::value_type{});
  } else {
    const char kind = std::is_floating_point_v<Member> ? 'f' : std::is_signed_v<Member> ? 'i' : 'u';
    return std::string(sizeof(Member) == 1 ? "|" : "<") + kind + std::to_string(sizeof(Member));
  }
}

// The sizes of the columns before it give the place of each column's bytes. Of an array the first column is looked at.
TEST(recording, names_its_columns_where_they_are_and_by_their_types) {
  Sample sample;
  struct Expected {
    std::string name;
    std::size_t place;
    std::string type;
  };
  const auto* base = reinterpret_cast<const char*>(&sample);
  const auto is = [&](const char* name, const auto& member) {
    return Expected{name, static_cast<std::size_t>(reinterpret_cast<const char*>(&member) - base), type_of(member)};
  };
  const std::vector<Expected> expected{is("tick", sample.tick),
                                       is("wall_ns", sample.wall_ns),
                                       is("device_t_s", sample.device_time),
                                       is("encoder_1", sample.encoder),
                                       is("energy_mJ", sample.energy),
                                       is("compute_ns", sample.compute_ns),
                                       is("wakeup_ns", sample.wakeup_ns),
                                       is("x_mm", sample.position),
                                       is("law_fx_N", sample.law_force),
                                       is("fx_N", sample.force),
                                       is("gimbal_1_rad", sample.gimbal),
                                       is("buttons", sample.buttons),
                                       is("limited", sample.limited),
                                       is("status", sample.status),
                                       is("late", sample.late),
                                       is("altered", sample.altered),
                                       is("tripped", sample.tripped),
                                       is("shown", sample.shown),
                                       is("sent_work_mJ", sample.sent_work),
                                       is("sent_acted_fx_N", sample.sent_acted),
                                       is("sent_acting_fx_N", sample.sent_acting),
                                       is("temperature", sample.temperature),
                                       is("device_state", sample.device_state)};
  std::size_t at = 0, found = 0;
  for (const Column& column : kColumns) {
    for (const auto& [name, place, type] : expected) {
      if (name != column.name) continue;
      EXPECT_EQ(at, place) << name;
      EXPECT_EQ(column.type, type) << name;
      ++found;
    }
    at += static_cast<std::size_t>(column.type[2] - '0');
  }
  EXPECT_EQ(found, expected.size());
  EXPECT_EQ(at, sizeof(Sample));
}

TEST(recording, that_is_still_being_made_can_be_read) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("run.fsr");
  Recorder recorder(path, {});
  Recording before(path);
  const Kept run = drive(recorder);
  EXPECT_EQ(recorder.close("end of data").error, "");
  EXPECT_EQ(before.extent().samples, 0U) << "a reader sees the file as it was opened";
  Recording after(path);
  EXPECT_EQ(problems_of(after), std::vector<std::string>{});
  EXPECT_EQ(after.extent().samples, run.samples.size());
}

// As someone would who carries away one of the three files.
TEST(recording, that_lost_its_log_still_says_what_it_was) {
  const TemporaryDirectory directory;
  Recorder recorder(directory.file("run.fsr"), {{"law", "wall"}});
  drive(recorder);
  std::filesystem::copy_file(directory.file("run.fsr"), directory.file("copy.fsr"));
  Recording recording(directory.file("copy.fsr"));
  EXPECT_EQ(recording.metadata().at("law"), "wall");
  EXPECT_EQ(problems_of(recording),
            std::vector<std::string>{recording.path() + ": no end: cut off, or still being made, after 0 samples"});
}

TEST(recording, that_was_changed_is_found_out) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("run.fsr");
  const auto problem = [&](const std::string& sql) {
    std::filesystem::remove(path);
    record(path);
    execute(path, sql);
    Recording recording(path);
    const auto problems = problems_of(recording);
    return problems.empty() ? "" : problems.front();
  };
  EXPECT_EQ(problem(""), "");
  for (const char* change : {"data = zeroblob(length(data))", "data = x'', samples = 0",
                             // The digest is that of no bytes at all.
                             "data = x'', samples = 0, sha256 = "
                             "x'e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855'",
                             "first_tick = 1", "last_tick = last_tick + 1", "sha256 = x'00'"}) {
    const std::string words = problem(std::string("UPDATE chunk SET ") + change + " WHERE id = 1");
    EXPECT_NE(words.find(" is not what was written"), std::string::npos) << change << ": " << words;
    Recording recording(path);
    EXPECT_THROW(export_csv(recording, directory.file("never.csv")), Error);
    EXPECT_THROW(export_npy(recording, directory.file("never.npy")), Error);
    for (const char* name : {"never.csv", "never.npy"}) EXPECT_FALSE(std::filesystem::exists(directory.file(name))) << change;
  }
  EXPECT_EQ(problem("DELETE FROM chunk"), path + ": expected 201, got 0 samples");
  EXPECT_EQ(problem("INSERT INTO chunk SELECT 1000, first_tick, last_tick, samples, sha256, data FROM chunk WHERE id = 1"),
            path + ": twice or too late: tick 0");
  EXPECT_EQ(problem("DELETE FROM metadata WHERE key = 'ended'"),
            path + ": no end: cut off, or still being made, after 201 samples");
}

TEST(recording, with_ticks_left_out_repeated_or_out_of_order_says_which) {
  for (const auto& [ticks, words] :
       std::vector<std::pair<std::vector<std::uint64_t>, std::string>>{{{0, 1, 2}, ""},
                                                                       {{1, 2}, "missing: tick 0"},
                                                                       {{5, 6}, "missing: ticks 0 to 4"},
                                                                       {{0, 1, 3}, "missing: tick 2"},
                                                                       {{0, 1, 1, 2}, "twice or too late: tick 1"},
                                                                       {{0, 1, 2, 1}, "twice or too late: tick 1"}}) {
    std::vector<Sample> samples;
    for (const std::uint64_t tick : ticks) samples.push_back({.tick = tick});
    const Recorded run(samples);
    Recording recording(run.path);
    std::string all;
    for (const std::string& problem : problems_of(recording)) all += problem.substr(run.path.size() + 2);
    EXPECT_EQ(all, words);
  }
}

TEST(recording, that_was_truncated_on_disk_is_found_out) {
  const TemporaryDirectory directory;
  record(directory.file("run.fsr"));
  const std::string whole = directory.read("run.fsr");
  const auto found_out = [&](const std::string& bytes) {
    const std::string path = directory.write("damaged.fsr", bytes);
    try {
      Recording recording(path);
      const auto problems = problems_of(recording);
      return !problems.empty();
    } catch (const Error& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(path + ": ")) << error.what();
      return true;
    }
  };
  EXPECT_FALSE(found_out(whole));
  for (std::size_t size = 0; size < whole.size(); size += 1021) EXPECT_TRUE(found_out(whole.substr(0, size))) << size;
  // The last bytes of the last page may be zeros, as which SQLite reads what is missing.
  for (std::size_t cut = 1; cut < 200; ++cut) EXPECT_TRUE(found_out(whole.substr(0, whole.size() - cut))) << cut;
}

TEST(recording, is_told_from_other_files) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("run.fsr");
  EXPECT_EQ(words_of(directory.file("absent.fsr")), directory.file("absent.fsr") + ": cannot open: No such file or directory");
  EXPECT_EQ(words_of(directory.path()), directory.path() + ": expected a recording (.fsr), got a folder");
  const std::string text = directory.write("text.fsr", std::string(5000, 'a'));
  EXPECT_EQ(words_of(text), text + ": expected a recording (.fsr), got a text");
  const std::string empty = directory.write("empty.fsr", "");
  EXPECT_EQ(words_of(empty), empty + ": expected a recording (.fsr), got an empty file");
  execute(empty, "CREATE TABLE metadata(key TEXT, value TEXT)");
  EXPECT_EQ(words_of(empty), empty + ": a database, but not a forceshade recording");
  record(path);
  execute(path, "PRAGMA user_version = 1");
  EXPECT_EQ(words_of(path), path + ": expected a recording of format 2 to 5, got format 1");
  execute(path, "PRAGMA user_version = 4; UPDATE metadata SET value = '[(''x'', ''<f4'')]' WHERE key = 'layout'");
  EXPECT_TRUE(words_of(path).ends_with("got [('x', '<f4')]")) << words_of(path);
}

}  // namespace
}  // namespace forceshade::recorder
