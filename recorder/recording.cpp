// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/recorder/recording.h"

#include <algorithm>
#include <cstring>
#include <optional>

#include "forceshade/csv/csv.h"
#include "forceshade/recorder/digest.h"
#include "forceshade/recorder/layout.h"

namespace forceshade::recorder {
namespace {

std::string ticks(std::uint64_t first, std::uint64_t last) {
  return first == last ? "tick " + std::to_string(first) : "ticks " + std::to_string(first) + " to " + std::to_string(last);
}

// For what SQLite itself says little about: a file that is absent or may not be read.
std::string readable(const std::string& path) {
  try {
    csv::open_input(path);
  } catch (const csv::Error& error) {
    throw RecordingError(error.what());
  }
  return path;
}

}  // namespace

Recording::Recording(const std::string& path) : database_(readable(path), Database::Access::read) {
  database_.execute("BEGIN");
  if (database_.integer("PRAGMA application_id") != kApplicationId)
    throw RecordingError(path + ": a database, but not a forceshade recording");
  if (const auto version = database_.integer("PRAGMA user_version"); version != kFormatVersion)
    throw RecordingError(path + ": expected a recording of format " + std::to_string(kFormatVersion) + ", got format " +
                         std::to_string(version));
  Statement rows = database_.prepare("SELECT key, value FROM metadata");
  while (rows.step()) metadata_[rows.text(0)] = rows.text(1);
  if (metadata_["layout"] != layout())
    throw RecordingError(path + ": expected samples of " + layout() + ", got " + metadata_["layout"]);
}

Recording::Extent Recording::extent() {
  Statement row = database_.prepare("SELECT sum(samples), min(first_tick), max(last_tick) FROM chunk");
  row.step();
  const auto number = [&](int column) { return static_cast<std::uint64_t>(row.integer(column)); };
  return {number(0), number(1), number(2)};
}

void Recording::for_each_chunk(const std::function<void(std::span<const device::Sample>)>& take) {
  Statement row = database_.prepare("SELECT first_tick, last_tick, samples, sha256, data FROM chunk ORDER BY id");
  std::vector<Sample> samples;
  while (row.step()) {
    const auto first = static_cast<std::uint64_t>(row.integer(0)), last = static_cast<std::uint64_t>(row.integer(1));
    const auto data = row.blob(4);
    const bool intact = data.size() == static_cast<std::size_t>(row.integer(2)) * sizeof(Sample) && !data.empty() &&
                        std::ranges::equal(row.blob(3), sha256(data));
    if (intact) {
      samples.resize(data.size() / sizeof(Sample));
      std::memcpy(samples.data(), data.data(), data.size());
    }
    if (!intact || samples.front().tick != first || samples.back().tick != last)
      throw RecordingError(path() + ": the chunk of " + ticks(first, last) + " is not what was written");
    take(samples);
  }
}

std::vector<std::string> problems_of(Recording& recording) {
  std::vector<std::string> problems;
  const auto found = [&](const std::string& words) { problems.push_back(recording.path() + ": " + words); };
  std::optional<std::uint64_t> last;
  std::uint64_t samples = 0;
  try {
    Statement check = recording.database_.prepare("PRAGMA integrity_check");
    while (check.step())
      if (const std::string words = check.text(0); words != "ok") found(words);

    recording.for_each_chunk([&](std::span<const Sample> chunk) {
      samples += chunk.size();
      for (const Sample& sample : chunk) {
        const std::uint64_t expected = last ? *last + 1 : 0;
        if (sample.tick > expected) found("missing: " + ticks(expected, sample.tick - 1));
        if (sample.tick < expected) found("twice or too late: " + ticks(sample.tick, sample.tick));
        last = sample.tick;
      }
    });
  } catch (const RecordingError& error) {
    problems.emplace_back(error.what());
  }
  const Metadata& metadata = recording.metadata();
  const auto said = [&](const char* key) { return metadata.contains(key) ? metadata.at(key) : "no"; };
  const std::string got = std::to_string(samples) + " samples";
  if (!recording.ended()) {
    found("no end: cut off, or still being made, after " + got);
    return problems;
  }
  if (said("samples") != std::to_string(samples)) found("expected " + said("samples") + ", got " + got);
  if (said("lost") != "0") found(said("lost") + " samples were lost while recording");
  return problems;
}

}  // namespace forceshade::recorder
