// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/experiments/results_csv.h"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "forceshade/csv/csv.h"
#include "forceshade/csv/output_file.h"

namespace forceshade::experiments {
namespace {

constexpr std::array<std::string_view, 3> kInitialNames{"large", "same", "small"};

const std::vector<std::string> kMatchingColumns{"participant",
                                                "trial",
                                                "vision",
                                                "stimulus",
                                                "initial",
                                                "repetition",
                                                "reference_radius_mil",
                                                "initial_radius_mil",
                                                "final_radius_mil",
                                                "satisfaction",
                                                "steps",
                                                "seconds"};
const std::vector<std::string> kClassificationColumns{"participant", "trial",  "stimulus", "radius_mil",
                                                      "repetition",  "answer", "seconds"};

// As RFC 4180 quotes it, where it has to be.
std::string csv_field(const std::string& text) {
  const bool is_plain = text.find_first_of(",\"\r\n") == std::string::npos && !text.starts_with(' ') && !text.ends_with(' ');
  if (is_plain) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string row_of(const std::vector<std::string>& fields) {
  std::string row;
  for (const std::string& field : fields) {
    if (&field != &fields.front()) row += ',';
    row += csv_field(field);
  }
  return row + '\n';
}

std::string text_of(const csv::Reader& reader, std::size_t column) {
  if (reader.text(column).empty()) throw reader.unexpected(column, "a name");
  return reader.text(column);
}

int whole(const csv::Reader& reader, std::size_t column, int least, int most, std::string_view expected) {
  const std::string& text = reader.text(column);
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < least || value > most)
    throw reader.unexpected(column, expected);
  return value;
}

int count_from(const csv::Reader& reader, std::size_t column, int least) {
  return whole(reader, column, least, std::numeric_limits<int>::max(), "a whole number from " + std::to_string(least));
}

double radius_in(const csv::Reader& reader, std::size_t column) {
  const double value = reader.binary64(column);
  if (!(value > 0 && std::isfinite(value))) throw reader.unexpected(column, "a radius above 0 mil");
  return value;
}

double seconds_in(const csv::Reader& reader, std::size_t column) {
  const double value = reader.binary64(column);
  if (!(value >= 0 && std::isfinite(value))) throw reader.unexpected(column, "a time from 0 s");
  return value;
}

bool vision_in(const csv::Reader& reader, std::size_t column) {
  const std::string& text = reader.text(column);
  if (text != "yes" && text != "no") throw reader.unexpected(column, "yes or no");
  return text == "yes";
}

InitialRadius initial_in(const csv::Reader& reader, std::size_t column) {
  for (std::size_t i = 0; i < kInitialNames.size(); ++i)
    if (reader.text(column) == kInitialNames[i]) return static_cast<InitialRadius>(i);
  throw reader.unexpected(column, "large, same or small");
}

// Refuses a second row of a participant's trial.
class Trials {
 public:
  void add(const csv::Reader& reader, const std::string& participant, int trial) {
    if (!seen_.emplace(participant, trial).second) throw reader.unexpected(1, "a trial that the participant has not had yet");
  }

 private:
  std::set<std::pair<std::string, int>> seen_;
};

std::vector<MatchingResult> read_matching(const std::filesystem::path& path) {
  std::ifstream in = csv::open_input(path.string());
  csv::Reader reader(in, path.string(), kMatchingColumns);
  std::vector<MatchingResult> rows;
  Trials trials;
  while (reader.next()) {
    MatchingResult row;
    row.participant = text_of(reader, 0);
    row.trial = count_from(reader, 1, 1);
    trials.add(reader, row.participant, row.trial);
    row.vision = vision_in(reader, 2);
    row.stimulus = text_of(reader, 3);
    row.initial = initial_in(reader, 4);
    row.repetition = count_from(reader, 5, 1);
    row.reference_radius = radius_in(reader, 6);
    row.initial_radius = radius_in(reader, 7);
    row.final_radius = radius_in(reader, 8);
    row.satisfaction = whole(reader, 9, 1, 10, "a whole number from 1 to 10");
    row.steps = count_from(reader, 10, 0);
    row.seconds = seconds_in(reader, 11);
    rows.push_back(std::move(row));
  }
  return rows;
}

std::vector<ClassificationResult> read_classification(const std::filesystem::path& path) {
  std::ifstream in = csv::open_input(path.string());
  csv::Reader reader(in, path.string(), kClassificationColumns);
  std::vector<ClassificationResult> rows;
  Trials trials;
  while (reader.next()) {
    ClassificationResult row;
    row.participant = text_of(reader, 0);
    row.trial = count_from(reader, 1, 1);
    trials.add(reader, row.participant, row.trial);
    row.stimulus = text_of(reader, 2);
    row.radius = radius_in(reader, 3);
    row.repetition = count_from(reader, 4, 1);
    row.answer = whole(reader, 5, 1, 4, "a whole number from 1 to 4");
    row.seconds = seconds_in(reader, 6);
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

void write_results(const Results& results, const std::filesystem::path& folder) {
  csv::OutputFile matching((folder / kMatchingFile).string());
  matching.stream() << row_of(kMatchingColumns);
  for (const MatchingResult& row : results.matching)
    matching.stream() << row_of({row.participant, std::to_string(row.trial), row.vision ? "yes" : "no", row.stimulus,
                                 std::string(kInitialNames[static_cast<std::size_t>(row.initial)]),
                                 std::to_string(row.repetition), csv::shortest(row.reference_radius),
                                 csv::shortest(row.initial_radius), csv::shortest(row.final_radius),
                                 std::to_string(row.satisfaction), std::to_string(row.steps), csv::shortest(row.seconds)});
  csv::OutputFile classification((folder / kClassificationFile).string());
  classification.stream() << row_of(kClassificationColumns);
  for (const ClassificationResult& row : results.classification)
    classification.stream() << row_of({row.participant, std::to_string(row.trial), row.stimulus, csv::shortest(row.radius),
                                       std::to_string(row.repetition), std::to_string(row.answer), csv::shortest(row.seconds)});
  matching.commit();
  classification.commit();
}

Results read_results(const std::filesystem::path& folder) {
  const std::filesystem::path matching = folder / kMatchingFile, classification = folder / kClassificationFile;
  const bool has_matching = std::filesystem::exists(matching), has_classification = std::filesystem::exists(classification);
  if (!has_matching && !has_classification)
    throw csv::Error(folder.string() + ": expected a folder with " + kMatchingFile + " or " + kClassificationFile);
  Results results;
  if (has_matching) results.matching = read_matching(matching);
  if (has_classification) results.classification = read_classification(classification);
  return results;
}

}  // namespace forceshade::experiments
