// SPDX-License-Identifier: BSD-3-Clause
#include "study/experiments/results_csv.h"

#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "files/csv.h"
#include "files/input_file.h"
#include "files/output_file.h"
#include "files/printable.h"

namespace forceshade::experiments {
namespace {

namespace fs = std::filesystem;

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
const std::vector<std::string> kRadiusColumns{"participant", "trial", "step", "seconds", "radius_mil"};
const std::vector<std::string> kOriginColumns{"answered_by", "device", "certified"};  // a file may lack them
constexpr std::array<std::string_view, 3> kInitials{"large", "same", "small"};
constexpr int kLargestMil = 1'000'000, kMostSeconds = 1'000'000, kMostSteps = 1'000'000;

std::vector<std::string> with_origin(std::vector<std::string> columns) {
  columns.insert(columns.end(), kOriginColumns.begin(), kOriginColumns.end());
  return columns;
}

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + '"';
}

template <class Rows, class Write>
void write_file(const fs::path& file, const std::vector<std::string>& columns, const Rows& rows, const Write& write) {
  if (rows.empty()) return;
  files::OutputFile out(file.string());
  for (std::size_t i = 0; i < columns.size(); ++i) out.stream() << (i == 0 ? "" : ",") << columns[i];
  out.stream() << '\n';
  for (const auto& row : rows) {
    write(out.stream(), row);
    out.stream() << '\n';
  }
  out.commit();
}

int whole_in(const files::Reader& reader, std::size_t column, int least, int largest) {
  const std::string& text = reader.text(column);
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < least || value > largest)
    throw reader.unexpected(column, "a whole number from " + std::to_string(least) + " to " + std::to_string(largest));
  return value;
}

double radius_in(const files::Reader& reader, std::size_t column) {
  const double value = reader.binary64(column);
  if (!(value > 0 && value <= kLargestMil)) throw reader.unexpected(column, "a radius above 0 and at most 1000000 mil");
  return value;
}

double seconds_in(const files::Reader& reader, std::size_t column) {
  const double value = reader.binary64(column);
  if (!(value >= 0 && value <= kMostSeconds)) throw reader.unexpected(column, "a time from 0 to 1000000 s");
  return value;
}

std::string words_in(const files::Reader& reader, std::size_t column) {
  if (reader.text(column).empty()) throw reader.unexpected(column, "a name");
  return reader.text(column);
}

InitialRadius initial_in(const files::Reader& reader, std::size_t column) {
  for (std::size_t i = 0; i < kInitials.size(); ++i)
    if (reader.text(column) == kInitials[i]) return static_cast<InitialRadius>(i);
  throw reader.unexpected(column, "large, same or small");
}

std::string cells_of(const Origin& origin) {
  const char* certified = !origin.certified ? "" : *origin.certified ? "yes" : "no";
  return std::string(name_of(origin.answered_by)) + ',' + quoted(origin.device) + ',' + certified;
}

// first: the index of the first of its columns.
Origin origin_in(const files::Reader& reader, std::size_t first) {
  Origin origin;
  if (reader.has(first)) {
    for (const AnsweredBy who : {AnsweredBy::person, AnsweredBy::model})
      if (reader.text(first) == name_of(who)) origin.answered_by = who;
    if (reader.text(first) != name_of(origin.answered_by))
      throw reader.unexpected(first, "person, virtual participant or nothing");
  }
  if (reader.has(first + 1)) origin.device = files::printable(reader.text(first + 1));
  if (reader.has(first + 2) && !reader.text(first + 2).empty()) {
    origin.certified = reader.text(first + 2) == "yes";
    if (!*origin.certified && reader.text(first + 2) != "no") throw reader.unexpected(first + 2, "yes, no or nothing");
  }
  return origin;
}

// Calls `read` for each row; whether there was a file. The first two columns are participant and trial, which come once.
template <class Read>
bool read_file(const fs::path& file, const std::vector<std::string>& columns, bool is_once, const Read& read) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return false;
  std::ifstream in = files::open_input(file.string());
  files::Reader reader(in, file.string(), columns, kOriginColumns);
  std::map<std::pair<std::string, int>, std::size_t> seen;
  while (reader.next()) {
    std::string participant = words_in(reader, 0);
    const int trial = whole_in(reader, 1, 1, kMostSteps);
    const auto [earlier, is_new] = seen.try_emplace({participant, trial}, reader.line());
    if (is_once && !is_new)
      throw Error(file, reader.line(),
                  "trial " + std::to_string(trial) + " of participant " + files::printable(participant) + " is in line " +
                      std::to_string(earlier->second) + ", too");
    read(reader, std::move(participant), trial);
  }
  return true;
}

}  // namespace

void write_results(const Results& results, const fs::path& path) {
  files::OutputFolder whole(path);
  write_results(results, whole);
  whole.commit();
}

void write_results(const Results& results, const files::OutputFolder& whole) {
  const fs::path& folder = whole.so_far();
  write_file(folder / "matching.csv", with_origin(kMatchingColumns), results.matching,
             [](std::ostream& out, const MatchingResult& r) {
               out << quoted(r.participant) << ',' << r.trial << ',' << (r.vision ? "yes" : "no") << ',' << quoted(r.stimulus)
                   << ',' << kInitials[static_cast<std::size_t>(r.initial)] << ',' << r.repetition << ','
                   << shortest(r.reference_radius) << ',' << shortest(r.initial_radius) << ',' << shortest(r.final_radius)
                   << ',' << r.satisfaction << ',' << r.steps << ',' << shortest(r.seconds) << ',' << cells_of(r.origin);
             });
  write_file(folder / "classification.csv", with_origin(kClassificationColumns), results.classification,
             [](std::ostream& out, const ClassificationResult& r) {
               out << quoted(r.participant) << ',' << r.trial << ',' << quoted(r.stimulus) << ',' << shortest(r.radius) << ','
                   << r.repetition << ',' << r.answer << ',' << shortest(r.seconds) << ',' << cells_of(r.origin);
             });
  write_file(folder / "radius.csv", kRadiusColumns, results.radius_changes, [](std::ostream& out, const RadiusChange& r) {
    out << quoted(r.participant) << ',' << r.trial << ',' << r.step << ',' << shortest(r.seconds) << ',' << shortest(r.radius);
  });
}

Results read_results(const fs::path& folder) {
  Results all;
  const bool has_matching = read_file(
      folder / "matching.csv", kMatchingColumns, true, [&](const files::Reader& in, std::string participant, int trial) {
        if (in.text(2) != "yes" && in.text(2) != "no") throw in.unexpected(2, "yes or no");
        all.matching.push_back({std::move(participant), trial, in.text(2) == "yes", words_in(in, 3), initial_in(in, 4),
                                whole_in(in, 5, 1, kMostSteps), radius_in(in, 6), radius_in(in, 7), radius_in(in, 8),
                                whole_in(in, 9, 1, 10), whole_in(in, 10, 0, kMostSteps), seconds_in(in, 11),
                                origin_in(in, 12)});
      });
  const bool has_classification =
      read_file(folder / "classification.csv", kClassificationColumns, true,
                [&](const files::Reader& in, std::string participant, int trial) {
                  all.classification.push_back({std::move(participant), trial, words_in(in, 2), radius_in(in, 3),
                                                whole_in(in, 4, 1, kMostSteps), whole_in(in, 5, 1, 4), seconds_in(in, 6),
                                                origin_in(in, 7)});
                });
  if (!has_matching && !has_classification)
    throw Error(folder, "expected matching.csv, classification.csv or both, found neither");
  read_file(folder / "radius.csv", kRadiusColumns, false, [&](const files::Reader& in, std::string participant, int trial) {
    all.radius_changes.push_back(
        {std::move(participant), trial, whole_in(in, 2, 0, kMostSteps), seconds_in(in, 3), radius_in(in, 4)});
  });
  return all;
}

}  // namespace forceshade::experiments
