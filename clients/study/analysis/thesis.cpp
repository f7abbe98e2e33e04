// SPDX-License-Identifier: BSD-3-Clause
#include "study/analysis/thesis.h"

#include <cmath>
#include <sstream>

#include "files/csv.h"
#include "study/analysis/thesis_texts.h"

namespace forceshade::analysis {
namespace {

// The order of section 6.1: without vision first.
constexpr std::array<const char*, 4> kMatchingStimuli{"bump-cylinder", "bump-1p-shaded", "bump-2p-shaded", "bump-3p-shaded"};

// A table as rows of its columns.
template <class Row>
std::vector<Row> rows_of(std::size_t file, const std::string& name, const std::vector<std::string>& columns,
                         Row (*row)(const files::Reader&)) {
  std::istringstream in(kThesisTexts[file]);
  files::Reader reader(in, name, columns);
  std::vector<Row> rows;
  while (reader.next()) rows.push_back(row(reader));
  return rows;
}

ThesisMatchingTable read_table(std::size_t index) {
  const std::string number = std::to_string(index + 1);
  return {"6." + number, kMatchingStimuli[index / 2], index % 2 == 1,
          rows_of<ThesisRow>(index, "table_6_" + number + ".csv",
                             {"participant", "slope", "mean_sd_percent", "mean_satisfaction", "mean_steps"},
                             [](const files::Reader& in) -> ThesisRow {
                               return {in.text(0), {in.binary64(1), in.binary64(2), in.binary64(3), in.binary64(4)}};
                             })};
}

std::vector<ThesisMatchingTable> read_tables() {
  std::vector<ThesisMatchingTable> tables;
  for (std::size_t index = 0; index < 8; ++index) tables.push_back(read_table(index));
  return tables;
}

ThesisClassificationRow classification_row(const files::Reader& in) {
  const auto percent = [&](std::size_t column) { return static_cast<int>(std::lround(in.binary64(column))); };
  return {in.text(0), percent(1), {percent(2), percent(3), percent(4), percent(5)}};
}

ThesisSummaryRow summary_row(const files::Reader& in) {
  return {in.text(0), in.text(1) == "yes", {in.binary64(2), in.binary64(3), in.binary64(4), in.binary64(5)}};
}

}  // namespace

const std::vector<ThesisMatchingTable>& thesis_matching() {
  static const std::vector<ThesisMatchingTable> tables = read_tables();
  return tables;
}

const std::vector<ThesisClassificationRow>& thesis_classification() {
  static const auto rows = rows_of<ThesisClassificationRow>(
      8, "table_6_9.csv", {"stimulus", "radius_mil", "percent_1", "percent_2", "percent_3", "percent_4"}, classification_row);
  return rows;
}

const std::vector<ThesisSummaryRow>& thesis_summary() {
  static const auto rows = rows_of<ThesisSummaryRow>(
      9, "table_7_1.csv", {"stimulus", "vision", "slope", "mean_sd_percent", "mean_satisfaction", "mean_steps"}, summary_row);
  return rows;
}

const ThesisMatchingTable* thesis_matching(std::string_view stimulus, bool vision) {
  for (const ThesisMatchingTable& table : thesis_matching())
    if (table.stimulus == stimulus && table.vision == vision) return &table;
  return nullptr;
}

const ThesisClassificationRow* thesis_classification(std::string_view stimulus, double radius) {
  for (const ThesisClassificationRow& row : thesis_classification())
    if (row.stimulus == stimulus && row.radius == radius) return &row;
  return nullptr;
}

std::string title_of(std::string_view stimulus) {
  std::string_view name = stimulus;
  if (name == "bump-cylinder") return "Circular cylinder";
  const std::string_view kind = name.substr(0, 7);
  const std::string words = kind == "bump-1p"   ? "Flat"
                            : kind == "bump-2p" ? "Two polygons"
                            : kind == "bump-3p" ? "Three polygons"
                                                : "";
  if (words.empty()) return std::string(stimulus);
  name.remove_prefix(7);
  return name == "-shaded" ? words + ", shaded" : name.empty() ? words + ", unshaded" : std::string(stimulus);
}

}  // namespace forceshade::analysis
