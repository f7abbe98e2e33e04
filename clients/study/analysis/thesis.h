// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The numbers of tables 6.1 to 6.9 and 7.1 of Morgenbesser's thesis, as RLE Technical Report 606 (MIT, 1996) prints them, from
// study/analysis/thesis/*.csv.

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace forceshade::analysis {

// A row of tables 6.1 to 6.8 and 7.1. The order and the decimals of the columns are those of the thesis.
inline constexpr std::array<const char*, 4> kMatchingColumns{"slope", "mean SD (%)", "mean SI", "mean steps"};
inline constexpr std::array<int, 4> kMatchingDecimals{2, 1, 1, 0};

struct ThesisRow {
  std::string participant;  // TP, IU, AL, IG, KN; "overall" in the last row
  std::array<double, 4> values;
};

struct ThesisMatchingTable {
  std::string number;    // "6.1"
  std::string stimulus;  // the matching bump: a law's name
  bool vision;
  std::vector<ThesisRow> rows;

  const ThesisRow& overall() const { return rows.back(); }
};

struct ThesisSummaryRow {
  std::string stimulus;
  bool vision;
  std::array<double, 4> values;
};

struct ThesisClassificationRow {
  std::string stimulus;
  int radius;                   // mil
  std::array<int, 4> percents;  // of the answers 1 to 4
};

inline constexpr int kThesisParticipants = 5;
// Tables 5.1 and 5.2: trials of a participant in a table 6.1 to 6.8 at one reference radius, and of one row of table 6.9.
inline constexpr int kThesisTrialsPerRadius = 12, kThesisTrialsPerRow = 120;

const std::vector<ThesisMatchingTable>& thesis_matching();            // tables 6.1 to 6.8
const std::vector<ThesisClassificationRow>& thesis_classification();  // table 6.9
const std::vector<ThesisSummaryRow>& thesis_summary();                // table 7.1

// nullptr for a condition that the thesis does not have.
const ThesisMatchingTable* thesis_matching(std::string_view stimulus, bool vision);
const ThesisClassificationRow* thesis_classification(std::string_view stimulus, double radius);

// "Flat, shaded" for bump-1p-shaded; the name itself for a stimulus that the thesis does not have.
std::string title_of(std::string_view stimulus);

}  // namespace forceshade::analysis
