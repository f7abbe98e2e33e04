// SPDX-License-Identifier: BSD-3-Clause
#include "study/experiments/results_csv.h"

#include <gtest/gtest.h>

#include "files/csv.h"
#include "files/output_file.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::experiments {
namespace {

using tests::TemporaryDirectory;

Results some_results() {
  Results results;
  results.matching = {{"P 1, left-handed",
                       1,
                       true,
                       "flat",
                       InitialRadius::large,
                       1,
                       600,
                       1400,
                       0.1 + 0.2,
                       7,
                       12,
                       61.25,
                       {AnsweredBy::person, "phantom:Left, the \"old\" one", true}},
                      {"\"P2\"", 2, false, "round", InitialRadius::same, 4, 800, 800, 812.5, 10, 0, 0},
                      {"P3",
                       3,
                       false,
                       "two",
                       InitialRadius::small,
                       2,
                       1400,
                       600,
                       1e-7,
                       1,
                       100000,
                       1e6,
                       {AnsweredBy::model, "simulated", false}}};
  results.classification = {{"P3", 1, "three", 1400, 24, 4, 9.5}, {"P3", 2, "bump-1p", 600, 1, 1, 1 / 3.0}};
  results.radius_changes = {{"P3", 3, 0, 0, 600}, {"P3", 3, 1, 2.5, 620}};
  return results;
}

constexpr const char* kHeader =
    "participant,trial,vision,stimulus,initial,repetition,reference_radius_mil,initial_radius_mil,final_radius_mil,"
    "satisfaction,"
    "steps,seconds\n";
constexpr const char* kClassificationHeader = "participant,trial,stimulus,radius_mil,repetition,answer,seconds\n";

std::string error_of(const TemporaryDirectory& folder) {
  try {
    read_results(folder.path());
  } catch (const std::runtime_error& error) {
    std::string words = error.what();
    const std::size_t at = words.find(folder.path());
    return at == std::string::npos ? words : words.erase(at, folder.path().size());
  }
  return "no error";
}

TEST(results_csv, reads_back_what_it_writes) {
  const TemporaryDirectory folder;
  const Results written = some_results();
  write_results(written, folder.path());
  const Results read = read_results(folder.path());
  ASSERT_EQ(read.matching.size(), written.matching.size());
  for (std::size_t i = 0; i < read.matching.size(); ++i) {
    const MatchingResult &a = read.matching[i], &b = written.matching[i];
    EXPECT_EQ(std::tie(a.participant, a.trial, a.vision, a.stimulus, a.initial, a.repetition, a.reference_radius,
                       a.initial_radius, a.final_radius, a.satisfaction, a.steps, a.seconds, a.origin),
              std::tie(b.participant, b.trial, b.vision, b.stimulus, b.initial, b.repetition, b.reference_radius,
                       b.initial_radius, b.final_radius, b.satisfaction, b.steps, b.seconds, b.origin));
  }
  ASSERT_EQ(read.classification.size(), written.classification.size());
  for (std::size_t i = 0; i < read.classification.size(); ++i) {
    const ClassificationResult &a = read.classification[i], &b = written.classification[i];
    EXPECT_EQ(std::tie(a.participant, a.trial, a.stimulus, a.radius, a.repetition, a.answer, a.seconds),
              std::tie(b.participant, b.trial, b.stimulus, b.radius, b.repetition, b.answer, b.seconds));
  }
  ASSERT_EQ(read.radius_changes.size(), written.radius_changes.size());
  for (std::size_t i = 0; i < read.radius_changes.size(); ++i) {
    const RadiusChange &a = read.radius_changes[i], &b = written.radius_changes[i];
    EXPECT_EQ(std::tie(a.participant, a.trial, a.step, a.seconds, a.radius),
              std::tie(b.participant, b.trial, b.step, b.seconds, b.radius));
  }
  const auto with_origin = [](std::string header) { return header.insert(header.size() - 1, ",answered_by,device,certified"); };
  EXPECT_TRUE(folder.read("matching.csv").starts_with(with_origin(kHeader)));
  EXPECT_TRUE(folder.read("classification.csv").starts_with(with_origin(kClassificationHeader)));
  EXPECT_NE(folder.read("matching.csv").find(",1e+06,virtual participant,simulated,no\n"), std::string::npos);
  EXPECT_EQ(folder.entries(), 3);
}

TEST(results_csv, reads_the_file_that_is_there) {
  const TemporaryDirectory folder;
  EXPECT_EQ(error_of(folder), ": expected matching.csv, classification.csv or both, found neither");
  folder.write("classification.csv", std::string(kClassificationHeader).append("P1,1,bump-1p,600,1,1,9\n"));
  EXPECT_EQ(read_results(folder.path()).classification.size(), 1U);
  EXPECT_TRUE(read_results(folder.path()).matching.empty());
}

TEST(results_csv, names_file_line_and_column_of_a_wrong_field) {
  struct Case {
    const char *row, *error;
  };
  const std::vector<Case> matching{
      {",1,yes,bump-1p,large,1,600,1400,600,7,3,60", "column 1 (participant): expected a name, got \"\""},
      {"P,0,yes,bump-1p,large,1,600,1400,600,7,3,60", "column 2 (trial): expected a whole number from 1 to 1000000, got \"0\""},
      {"P,1,true,bump-1p,large,1,600,1400,600,7,3,60", "column 3 (vision): expected yes or no, got \"true\""},
      {"P,1,yes,,large,1,600,1400,600,7,3,60", "column 4 (stimulus): expected a name, got \"\""},
      {"P,1,yes,bump-1p,+,1,600,1400,600,7,3,60", "column 5 (initial): expected large, same or small, got \"+\""},
      {"P,1,yes,bump-1p,large,1.5,600,1400,600,7,3,60",
       "column 6 (repetition): expected a whole number from 1 to 1000000, got \"1.5\""},
      {"P,1,yes,bump-1p,large,1,0,1400,600,7,3,60",
       "column 7 (reference_radius_mil): expected a radius above 0 and at most 1000000 mil, got \"0\""},
      {"P,1,yes,bump-1p,large,1,600,nan,600,7,3,60",
       "column 8 (initial_radius_mil): expected a radius above 0 and at most 1000000 mil, got \"nan\""},
      {"P,1,yes,bump-1p,large,1,600,1400,inf,7,3,60",
       "column 9 (final_radius_mil): expected a radius above 0 and at most 1000000 mil, got \"inf\""},
      {"P,1,yes,bump-1p,large,1,600,1400,600,11,3,60",
       "column 10 (satisfaction): expected a whole number from 1 to 10, got \"11\""},
      {"P,1,yes,bump-1p,large,1,600,1400,600,0,3,60",
       "column 10 (satisfaction): expected a whole number from 1 to 10, got \"0\""},
      {"P,1,yes,bump-1p,large,1,600,1400,600,7,-1,60",
       "column 11 (steps): expected a whole number from 0 to 1000000, got \"-1\""},
      {"P,1,yes,bump-1p,large,1,600,1400,600,7,99999999999,60",
       "column 11 (steps): expected a whole number from 0 to 1000000, got \"99999999999\""},
      {"P,1,yes,bump-1p,large,1,600,1400,600,7,3,-1", "column 12 (seconds): expected a time from 0 to 1000000 s, got \"-1\""},
      {"P,1,yes,bump-1p,large,1,600,1400,600,7,3,soon", "column 12 (seconds): expected a number, got \"soon\""},
      {"P,1,yes,bump-1p,large,1,600,1400,600,7,3", "expected 12 fields, got 11: column 12 (seconds) is missing"}};
  for (const auto& [row, error] : matching) {
    const TemporaryDirectory folder;
    folder.write("matching.csv",
                 std::string(kHeader).append("P,7,no,bump-1p,small,1,600,600,600,7,3,60\n").append(row).append("\n"));
    EXPECT_EQ(error_of(folder), std::string("/matching.csv:3: ") + error);
  }
  const std::vector<Case> classification{
      {"P,2,bump-1p,-600,1,1,9", "column 4 (radius_mil): expected a radius above 0 and at most 1000000 mil, got \"-600\""},
      {"P,2,bump-1p,600,1,5,9", "column 6 (answer): expected a whole number from 1 to 4, got \"5\""},
      {"P,2,bump-1p,600,1,0,9", "column 6 (answer): expected a whole number from 1 to 4, got \"0\""},
      {"P,1,bump-1p,600,1,1,9", "trial 1 of participant P is in line 2, too"}};
  for (const auto& [row, error] : classification) {
    const TemporaryDirectory folder;
    folder.write("classification.csv",
                 std::string(kClassificationHeader).append("P,1,bump-1p,600,1,1,9\n").append(row).append("\n"));
    EXPECT_EQ(error_of(folder), std::string("/classification.csv:3: ") + error);
  }
}

// A file of an earlier version or of another program has none of these columns, or some; an unknown word is refused.
TEST(results_csv, reads_where_an_answer_comes_from_if_the_file_says_it) {
  const auto read = [](const std::string& columns, const std::string& cells) {
    const TemporaryDirectory folder;
    std::string header = kClassificationHeader;
    header.insert(header.size() - 1, columns);
    folder.write("classification.csv", header + "P,1,bump-1p,600,1,1,9" + cells + '\n');
    const std::string error = error_of(folder);
    if (error != "no error") return error;
    const Origin origin = read_results(folder.path()).classification.front().origin;
    return std::string(name_of(origin.answered_by)) + '|' + origin.device + '|' +
           (!origin.certified   ? ""
            : *origin.certified ? "yes"
                                : "no");
  };
  EXPECT_EQ(read("", ""), "||");
  EXPECT_EQ(read(",device", ",phantom"), "|phantom|");
  EXPECT_EQ(read(",certified,answered_by", ",no,person"), "person||no");
  EXPECT_EQ(read(",answered_by,device,certified", ",virtual participant,simulated,yes"), "virtual participant|simulated|yes");
  EXPECT_EQ(read(",answered_by", ",robot"),
            "/classification.csv:2: column 8 (answered_by): expected person, virtual participant or nothing, got \"robot\"");
  EXPECT_EQ(read(",certified", ",maybe"),
            "/classification.csv:2: column 8 (certified): expected yes, no or nothing, got \"maybe\"");
}

TEST(results_csv, says_which_column_is_missing) {
  const TemporaryDirectory folder;
  folder.write("matching.csv", "participant,trial\nP,1\n");
  EXPECT_TRUE(error_of(folder).starts_with("/matching.csv:1: no column vision: expected columns participant, trial, vision"))
      << error_of(folder);
}

TEST(results_csv, makes_the_folder_and_refuses_a_file_in_its_place) {
  const TemporaryDirectory folder;
  write_results(some_results(), folder.file("new"));
  EXPECT_EQ(read_results(folder.file("new")).matching.size(), some_results().matching.size());
  folder.write("file", "");
  EXPECT_THROW(write_results(some_results(), folder.file("file")), files::OutputError);
}

}  // namespace
}  // namespace forceshade::experiments
