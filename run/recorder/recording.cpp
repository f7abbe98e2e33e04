// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/recording.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <system_error>

#include "files/csv.h"
#include "files/file_kind.h"
#include "run/recorder/checksum.h"
#include "run/recorder/layout.h"
#include "run/recorder/sqlite.h"

namespace forceshade::recorder {
namespace {

// Bytes of a text from the file that a message quotes at most.
constexpr std::size_t kLongestQuote = 200;

// Bytes at the beginning of a file that are read to tell what it is.
constexpr std::size_t kMostRead = 4096;
constexpr std::string_view kSqliteHeader{"SQLite format 3\0", 16};

std::string ticks(std::uint64_t first, std::uint64_t last) {
  return first == last ? "tick " + std::to_string(first) : "ticks " + std::to_string(first) + " to " + std::to_string(last);
}

// Gives better errors than SQLite for a file that is absent, may not be read, or is not its own. A pipe would keep the reader
// waiting for ever.
std::string readable(const std::string& path) {
  std::error_code none;
  const auto status = std::filesystem::status(path, none);
  if (is_directory(status)) throw Error(path + ": expected a recording (.fsr), got a folder");
  if (exists(status) && !is_regular_file(status)) throw Error(path + ": expected a recording, got no regular file");
  std::ifstream in = files::open_input(path);
  std::string beginning(kMostRead, '\0');
  in.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<std::size_t>(in.gcount()));
  if (!beginning.starts_with(kSqliteHeader))
    throw Error(path + ": expected a recording (.fsr), got " + files::kind_of_file(beginning));
  return path;
}

}  // namespace

Recording::Recording(const std::string& path) : database_(std::make_unique<Database>(readable(path), Database::Access::read)) {
  database_->execute("BEGIN");
  if (database_->integer("PRAGMA application_id") != kApplicationId)
    throw Error(path + ": a database, but not a forceshade recording");
  const auto version = database_->integer("PRAGMA user_version");
  if (version < kFormatWithoutDigest || version > kFormatOfDamping)
    throw Error(path + ": expected a recording of format " + std::to_string(kFormatWithoutDigest) + " to " +
                std::to_string(kFormatOfDamping) + ", got format " + std::to_string(version));
  const bool has_fewer = version <= kFormatOfFewerColumns;
  if (has_fewer) sample_bytes_ = kFewerBytes;
  expect_tables_of_a_recording();
  read_metadata();
  const std::string expected = has_fewer ? layout(kFewerColumns) : layout();
  if (const auto found = metadata_.find("layout"); found == metadata_.end() || found->second != expected)
    throw Error(path + ": expected samples of " + expected + ", got " +
                (found == metadata_.end() ? "none" : found->second.substr(0, kLongestQuote)));
  if (has_digest() != (version != kFormatWithoutDigest))
    metadata_problem_ = std::string("of format ") + std::to_string(version) + (has_digest() ? " with" : " without") +
                        " a digest of its metadata: one of the two is not what was written";
  else if (has_digest() && metadata_.at(kDigestKey) != digest_of(metadata_, kDigestKey))
    metadata_problem_ = "the metadata (law, parameters, certificate, device and so on) are not what was written";
}

Recording::~Recording() = default;
Recording::Recording(Recording&&) noexcept = default;
Recording& Recording::operator=(Recording&&) noexcept = default;

const std::string& Recording::path() const noexcept {
  return database_->path();
}

bool Recording::has_digest() const {
  return metadata_.contains(kDigestKey);
}

bool Recording::has_all_columns() const noexcept {
  return sample_bytes_ == sizeof(device::Sample);
}

// Before anything else is read: a view or a trigger could make a reading of any length of it.
void Recording::expect_tables_of_a_recording() {
  Statement rows = database_->prepare(
      "SELECT type, name, sql FROM sqlite_schema "
      "WHERE type <> 'index' OR name <> 'sqlite_autoindex_metadata_1'");
  std::size_t found = 0;
  while (rows.step()) {
    if (rows.text(0) != "table" || std::ranges::find(kTables, rows.text(2)) == kTables.end())
      throw Error(path() + ": expected the tables metadata and chunk of a recording alone, got the " +
                  rows.text(0).substr(0, kLongestQuote) + ' ' + rows.text(1).substr(0, kLongestQuote));
    ++found;
  }
  if (found != kTables.size())
    throw Error(path() + ": expected the tables metadata and chunk of a recording, got " + std::to_string(found) + " tables");
}

void Recording::read_metadata() {
  Statement rows = database_->prepare("SELECT key, value FROM metadata");
  while (rows.step())
    if (!metadata_.emplace(rows.text(0), rows.text(1)).second)
      throw Error(path() + ": has " + rows.text(0).substr(0, kLongestQuote) + " twice in its metadata");
}

Recording::Extent Recording::extent() {
  Statement row = database_->prepare("SELECT first_tick, last_tick, samples FROM chunk ORDER BY id");
  Extent extent;
  std::uint64_t next = 0;  // behind the last tick so far
  for (bool is_first = true; row.step(); is_first = false) {
    const std::int64_t begin = row.integer(0), end = row.integer(1), count = row.integer(2);
    // In this order no difference overflows.
    if (begin < 0 || end < begin || count < 1 || count > static_cast<std::int64_t>(kLongestChunk) || count - 1 > end - begin)
      throw Error(path() + ": a chunk of " + std::to_string(count) + " samples from tick " + std::to_string(begin) + " to " +
                  std::to_string(end) + "; expected 1 to " + std::to_string(kLongestChunk) +
                  " samples, of as many ticks or more");
    const auto first = static_cast<std::uint64_t>(begin), last = static_cast<std::uint64_t>(end),
               samples = static_cast<std::uint64_t>(count);
    if (is_first) extent.first_tick = next = first;
    extent.samples += samples;
    if (first < next) {
      extent.repeated += std::min(samples, next - first);
      extent.first_tick = std::min(extent.first_tick, first);
    } else {
      extent.missing += first - next + (last - first + 1 - samples);
    }
    next = std::max(next, last + 1);
    extent.last_tick = next - 1;
  }
  return extent;
}

// SQLite reads what is missing of the last page as zeros, which may be just what stood there. While a log lies beside the file,
// pages of it may be missing or half-written and the recording whole all the same.
std::string Recording::words_of_cut() {
  std::error_code none;
  if (std::filesystem::exists(path() + "-wal", none)) return "";
  const auto expected =
      static_cast<std::uintmax_t>(database_->integer("PRAGMA page_count") * database_->integer("PRAGMA page_size"));
  const std::uintmax_t size = std::filesystem::file_size(path(), none);
  if (none || size >= expected) return "";
  return "cut off: expected " + std::to_string(expected) + " bytes, got " + std::to_string(size);
}

void Recording::for_each_chunk(const std::function<void(std::span<const device::Sample>)>& take) {
  Statement row = database_->prepare("SELECT first_tick, last_tick, samples, sha256, data FROM chunk ORDER BY id");
  std::vector<Sample> samples;
  while (row.step()) {
    const auto first = static_cast<std::uint64_t>(row.integer(0)), last = static_cast<std::uint64_t>(row.integer(1));
    const auto data = row.blob(4);
    const bool intact = data.size() == static_cast<std::size_t>(row.integer(2)) * sample_bytes_ && !data.empty() &&
                        std::ranges::equal(row.blob(3), sha256(data));
    if (intact) {
      samples.assign(data.size() / sample_bytes_, Sample{});
      for (std::size_t i = 0; i < samples.size(); ++i) std::memcpy(&samples[i], data.data() + i * sample_bytes_, sample_bytes_);
    }
    if (!intact || samples.front().tick != first || samples.back().tick != last)
      throw Error(path() + ": the chunk of " + ticks(first, last) + " is not what was written");
    take(samples);
  }
}

std::vector<std::string> problems_of(Recording& recording) {
  std::vector<std::string> problems;
  const auto found = [&](const std::string& words) { problems.push_back(recording.path() + ": " + words); };
  std::optional<std::uint64_t> last;
  std::uint64_t samples = 0;
  try {
    Statement check = recording.database_->prepare("PRAGMA integrity_check");
    while (check.step())
      if (const std::string words = check.text(0); words != "ok") found(words);
    if (const std::string words = recording.words_of_cut(); !words.empty()) found(words);

    recording.for_each_chunk([&](std::span<const Sample> chunk) {
      samples += chunk.size();
      for (const Sample& sample : chunk) {
        const std::uint64_t expected = last ? *last + 1 : 0;
        if (sample.tick > expected) found("missing: " + ticks(expected, sample.tick - 1));
        if (sample.tick < expected) found("twice or too late: " + ticks(sample.tick, sample.tick));
        last = sample.tick;
      }
    });
  } catch (const Error& error) {
    problems.emplace_back(error.what());
  }
  const Metadata& metadata = recording.metadata();
  const auto said = [&](const char* key) { return metadata.contains(key) ? metadata.at(key).substr(0, kLongestQuote) : "no"; };
  const std::string got = std::to_string(samples) + " samples";
  if (!recording.ended()) {
    found("no end: cut off, or still being made, after " + got);
  } else {
    if (said("samples") != std::to_string(samples)) found("expected " + said("samples") + ", got " + got);
    if (said("lost") != "0") found(said("lost") + " samples were lost while recording");
  }
  if (!recording.metadata_problem().empty()) found(recording.metadata_problem());
  return problems;
}

}  // namespace forceshade::recorder
