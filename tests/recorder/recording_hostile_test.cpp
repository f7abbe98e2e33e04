// SPDX-License-Identifier: BSD-3-Clause
// Recordings that were changed, by a fault or on purpose: found out, refused in words, at no great cost.

#include <gtest/gtest.h>

#include <optional>
#include <random>

#include "forceshade/recording.h"
#include "run/recorder/checksum.h"
#include "run/recorder/layout.h"
#include "run/recorder/sqlite.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace forceshade::recorder {
namespace {

using tests::TemporaryDirectory;

constexpr std::uint64_t kSamples = 8;

// A small whole recording in its own directory, to be changed by SQL.
class Hostile {
 public:
  explicit Hostile(std::uint8_t status = 1) {
    Recorder recorder(path(), {{"law", "wall"}, {"stiffness_N_per_mm", "0.5"}});
    for (std::uint64_t tick = 0; tick < kSamples; ++tick) recorder.push({.tick = tick, .status = status});
    recorder.close("time up");
  }

  std::string path() const { return directory_.file("run.fsr"); }
  std::string bytes() const { return directory_.read("run.fsr"); }
  void set_bytes(const std::string& bytes) const { directory_.write("run.fsr", bytes); }
  void execute(const std::string& sql) const { Database(path(), Database::Access::write).execute(sql); }

  // As a program of that time would have written it: with fewer columns, and without a digest before format 3.
  void write_as_format(int version) const {
    std::vector<std::pair<std::int64_t, std::string>> chunks;
    auto recording = std::make_optional<Recording>(path());
    Metadata metadata = recording->metadata();
    recording->for_each_chunk([&](std::span<const Sample> chunk) {
      std::string& bytes = chunks.emplace_back(static_cast<std::int64_t>(chunks.size()) + 1, "").second;
      for (const Sample& sample : chunk) bytes.append(reinterpret_cast<const char*>(&sample), kFewerBytes);
    });
    recording.reset();
    Database database(path(), Database::Access::write);
    for (const auto& [id, bytes] : chunks) {
      const auto data = std::as_bytes(std::span(bytes));
      database.prepare("UPDATE chunk SET data = ?, sha256 = ? WHERE id = ?")
          .bind(0, data)
          .bind(1, sha256(data))
          .bind(2, id)
          .run();
    }
    metadata["layout"] = layout(kFewerColumns);
    database.prepare("UPDATE metadata SET value = ? WHERE key = 'layout'").bind(0, metadata["layout"]).run();
    database.prepare("UPDATE metadata SET value = ? WHERE key = 'metadata_sha256'")
        .bind(0, digest_of(metadata, kDigestKey))
        .run();
    database.execute("PRAGMA user_version = " + std::to_string(version));
  }

  // Without the file's name: why it is refused when opened, or the first problem that verify finds.
  std::string refusal() const {
    return words([&] { Recording{path()}; });
  }
  std::string problem() const {
    Recording recording(path());
    const auto problems = problems_of(recording);
    return problems.empty() ? "" : problems.front().substr(path().size() + 2);
  }
  template <class Read>
  std::string words(const Read& read) const {
    return tests::without(path() + ": ", tests::thrown_by<Error>(read));
  }

 private:
  TemporaryDirectory directory_;
};

constexpr const char* kEndless = "WITH RECURSIVE r(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM r) SELECT x, x FROM r";

// All that a reader gives of a recording.
struct Read {
  Metadata metadata;
  std::uint64_t samples = 0, first = 0, last = 0, missing = 0, repeated = 0;
  std::string bytes;
  bool operator==(const Read&) const = default;
};

std::optional<Read> read_whole(const std::string& path) {
  try {
    Recording recording(path);
    if (!problems_of(recording).empty()) return std::nullopt;
    const auto extent = recording.extent();
    Read read{recording.metadata(), extent.samples, extent.first_tick, extent.last_tick, extent.missing, extent.repeated, ""};
    recording.for_each_chunk([&](std::span<const Sample> chunk) {
      read.bytes.append(reinterpret_cast<const char*>(chunk.data()), chunk.size() * sizeof(Sample));
    });
    return read;
  } catch (const Error&) {
    return std::nullopt;
  }
}

// One bit at random is changed of every byte that is not 0, and of some of the others: what is read is as it was, or the
// recording is not whole.
TEST(recording, with_any_bit_changed_reads_the_same_or_is_found_out) {
  const Hostile recording;
  const std::string whole = recording.bytes();
  const auto before = read_whole(recording.path());
  ASSERT_TRUE(before);
  ASSERT_EQ(before->samples, kSamples);
  std::mt19937 random(13);
  int found = 0, same = 0;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    if (whole[at] == 0 && random() % 16 != 0) continue;
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ (1 << random() % 8));
    recording.set_bytes(changed);
    const auto after = read_whole(recording.path());
    ASSERT_TRUE(!after || *after == *before) << "byte " << at << " of " << whole.size();
    ++(after ? same : found);
  }
  std::printf("  %d changes found, %d in bytes that nothing reads\n", found, same);
  EXPECT_GT(found, 1000);
}

TEST(recording, with_other_metadata_is_found_out) {
  const std::string words = "the metadata (law, parameters, certificate, device and so on) are not what was written";
  for (const char* change :
       {"UPDATE metadata SET value = '0.4' WHERE key = 'stiffness_N_per_mm'", "DELETE FROM metadata WHERE key = 'law'",
        "INSERT INTO metadata VALUES('dead_man', 'held')", "UPDATE metadata SET key = 'Law' WHERE key = 'law'",
        "UPDATE metadata SET value = 'trip' WHERE key = 'end_reason'",
        "UPDATE metadata SET value = upper(value) WHERE key = 'metadata_sha256'",
        "UPDATE metadata SET key = 'la', value = 'w4:wall' WHERE key = 'law'",
        "UPDATE metadata SET value = value || ',stiffness_N_per_mm,0.5' WHERE key = 'started';"
        "DELETE FROM metadata WHERE key = 'stiffness_N_per_mm'"}) {
    const Hostile recording;
    EXPECT_EQ(recording.problem(), "") << change;
    recording.execute(change);
    EXPECT_EQ(recording.problem(), words) << change;
    Recording damaged(recording.path());
    EXPECT_EQ(recording.words([&] { export_csv(damaged, recording.path() + ".csv"); }), words) << change;
    EXPECT_EQ(recording.words([&] { export_npy(damaged, recording.path() + ".npy"); }), words) << change;
  }
}

// Before its end, too: a run that is cut off has a digest of what was there from the start.
TEST(recording, that_is_cut_off_covers_its_metadata) {
  const TemporaryDirectory directory;
  const std::string path = directory.file("run.fsr");
  { Recorder recorder(path, {{"law", "wall"}}); }
  EXPECT_EQ(Recording(path).metadata_problem(), "");
  EXPECT_TRUE(Recording(path).has_digest());
  Database(path, Database::Access::write).execute("UPDATE metadata SET value = 'bump-1p' WHERE key = 'law'");
  EXPECT_NE(Recording(path).metadata_problem(), "");
}

TEST(recording, of_the_format_without_a_digest_is_read_and_says_so) {
  const Hostile recording;
  recording.write_as_format(2);
  EXPECT_EQ(recording.problem(), "of format 2 with a digest of its metadata: one of the two is not what was written");
  recording.execute("DELETE FROM metadata WHERE key = 'metadata_sha256'");
  EXPECT_EQ(recording.problem(), "");
  EXPECT_FALSE(Recording(recording.path()).has_digest());
  EXPECT_EQ(Recording(recording.path()).metadata().at("law"), "wall");
  recording.execute("PRAGMA user_version = 3");
  EXPECT_EQ(recording.problem(), "of format 3 without a digest of its metadata: one of the two is not what was written");
}

TEST(recording, of_the_format_with_fewer_columns_is_read_with_zeros_for_the_others) {
  const Hostile recording;
  EXPECT_TRUE(Recording(recording.path()).has_all_columns());
  recording.execute("PRAGMA user_version = 3");
  EXPECT_NE(recording.refusal().find("expected samples of [('tick', '<u8'), "), std::string::npos) << recording.refusal();
  recording.execute("PRAGMA user_version = 4");
  recording.write_as_format(3);
  EXPECT_EQ(recording.problem(), "");
  Recording read(recording.path());
  EXPECT_FALSE(read.has_all_columns());
  std::uint64_t samples = 0;
  read.for_each_chunk([&](std::span<const Sample> chunk) {
    for (const Sample& sample : chunk) {
      EXPECT_EQ(sample.tick, samples++);
      EXPECT_EQ(sample.status, 1);
      EXPECT_EQ(sample.device_state, 0U);
    }
  });
  EXPECT_EQ(samples, kSamples);
}

// The extent of chunks, as their table says it, against a count tick by tick.
TEST(recording, counts_missing_and_repeated_ticks_of_any_chunks) {
  std::mt19937 random(17);
  const Hostile recording;
  int gaps = 0, repeats = 0;
  for (int i = 0; i < 20; ++i) {
    std::string sql = "BEGIN; DELETE FROM chunk;";
    Recording::Extent expected;
    std::uint64_t next = expected.first_tick = random() % 10;
    for (unsigned chunk = 0; chunk <= i % 8U; ++chunk) {
      const std::uint64_t way = random() % 7, size = 1 + random() % 5;
      const std::uint64_t first = chunk == 0 ? next : next + way - std::min<std::uint64_t>(next + way, 4);
      for (std::uint64_t tick = first; tick < first + size; ++tick) {
        expected.repeated += tick < next;
        expected.missing += tick < next ? 0 : tick - next;
        next = std::max(next, tick + 1);
      }
      expected.samples += size;
      expected.first_tick = std::min(expected.first_tick, first);
      expected.last_tick = next - 1;
      sql += "INSERT INTO chunk(first_tick, last_tick, samples, sha256, data) VALUES(" + std::to_string(first) + ", " +
             std::to_string(first + size - 1) + ", " + std::to_string(size) + ", x'', x'');";
    }
    recording.execute(sql + "COMMIT");
    const auto extent = Recording(recording.path()).extent();
    EXPECT_EQ(extent.samples, expected.samples);
    EXPECT_EQ(extent.repeated, expected.repeated);
    EXPECT_EQ(extent.first_tick, expected.first_tick);
    EXPECT_EQ(extent.last_tick, expected.last_tick);
    EXPECT_EQ(extent.missing, expected.missing);
    gaps += extent.missing > 0;
    repeats += extent.repeated > 0;
  }
  EXPECT_GT(gaps, 3);
  EXPECT_GT(repeats, 3);
}

TEST(recording, with_a_chunk_that_cannot_be_is_refused) {
  for (const char* change :
       {"samples = 0", "samples = -1", "samples = 9", "samples = 4097", "samples = 9223372036854775807", "first_tick = -1",
        "first_tick = 8", "first_tick = 9223372036854775807", "last_tick = -9223372036854775808",
        "first_tick = 'x', last_tick = 'y', samples = 2", "samples = 4097, last_tick = 9223372036854775807"}) {
    const Hostile recording;
    recording.execute(std::string("UPDATE chunk SET ") + change);
    Recording opened(recording.path());
    EXPECT_NE(recording.words([&] { opened.extent(); }).find("; expected 1 to 4096 samples"), std::string::npos) << change;
    EXPECT_NE(recording.problem(), "") << change;
  }
  const Hostile at_the_end;
  at_the_end.execute("UPDATE chunk SET first_tick = 0, last_tick = 9223372036854775807");
  EXPECT_EQ(Recording(at_the_end.path()).extent().missing, (std::uint64_t{1} << 63) - kSamples);
}

TEST(recording, with_a_status_that_no_tick_has_is_refused) {
  const Hostile recording(7);
  Recording opened(recording.path());
  EXPECT_EQ(recording.words([&] { export_csv(opened, recording.path() + ".csv"); }), "tick 0 has status 7; expected 0 to 3");
}

TEST(recording, with_more_than_its_two_tables_is_refused_before_it_is_read) {
  const std::string expected = "expected the tables metadata and chunk of a recording";
  for (const auto& [change, words] : std::vector<std::pair<std::string, std::string>>{
           {"CREATE VIEW endless AS " + std::string(kEndless), " alone, got the view endless"},
           {"CREATE TABLE other(x)", " alone, got the table other"},
           {"CREATE TRIGGER late AFTER INSERT ON chunk BEGIN DELETE FROM chunk; END", " alone, got the trigger late"},
           {"CREATE INDEX quick ON chunk(first_tick)", " alone, got the index quick"},
           {"ALTER TABLE chunk ADD COLUMN more", " alone, got the table chunk"},
           {"DROP TABLE metadata; CREATE VIEW metadata(key, value) AS " + std::string(kEndless),
            " alone, got the view metadata"},
           {"DROP TABLE chunk; CREATE VIEW chunk(first_tick, last_tick) AS " + std::string(kEndless),
            " alone, got the view chunk"},
           {"DROP TABLE chunk", ", got 1 tables"}}) {
    const Hostile recording;
    recording.execute(change);
    EXPECT_EQ(recording.refusal(), expected + words) << change;
  }
  const Hostile escape;
  escape.execute("CREATE VIEW \"" + std::string(5000, 'v') + "\" AS SELECT 1");
  EXPECT_LT(escape.refusal().size(), 400U) << "a long name is cut";
}

// A view that goes by the name of the index that every recording has is not read either.
TEST(recording, with_a_view_in_the_place_of_its_index_is_refused) {
  const Hostile recording;
  recording.execute(
      "PRAGMA writable_schema = ON; INSERT INTO sqlite_schema VALUES('view', 'sqlite_autoindex_metadata_1', "
      "'sqlite_autoindex_metadata_1', 0, 'CREATE VIEW sqlite_autoindex_metadata_1 AS SELECT 1')");
  EXPECT_NE(recording.refusal(), "");
}

TEST(database, read_by_someone_who_does_not_trust_it_runs_no_view_and_nothing_without_end) {
  const Hostile recording;
  recording.execute("CREATE VIEW one AS SELECT 1 AS x");
  const auto words = [&](const std::string& sql) {
    return recording.words([&] { Database(recording.path(), Database::Access::read).integer(sql); });
  };
  EXPECT_EQ(words("SELECT count(*) FROM chunk"), "");
  EXPECT_NE(words("SELECT x FROM one"), "");
  EXPECT_EQ(words("SELECT max(x) FROM (" + std::string(kEndless) + ")"),
            "reading it takes more steps than a recording of its size needs");
  EXPECT_NE(words("SELECT length(zeroblob(2000000))"), "");
  EXPECT_NE(words("ATTACH ':memory:' AS other"), "");
  EXPECT_EQ(words("SELECT y FROM chunk"), "no such column: y");
  EXPECT_NE(words("DELETE FROM chunk"), "");
}

// Metadata that are twice there, where the index that forbids it was lost: which of the two holds is not known.
TEST(recording, with_a_key_twice_is_refused) {
  const Hostile recording;
  recording.execute("INSERT INTO metadata VALUES(NULL, 'a'); INSERT INTO metadata VALUES(NULL, 'b')");
  EXPECT_EQ(recording.refusal(), "has  twice in its metadata");
}

}  // namespace
}  // namespace forceshade::recorder
