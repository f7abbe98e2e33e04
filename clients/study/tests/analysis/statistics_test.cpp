// SPDX-License-Identifier: BSD-3-Clause
#include "study/analysis/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "study/analysis/bootstrap.h"
#include "study/analysis/distributions.h"
#include "study/analysis/number_words.h"
#include "study/analysis/random.h"
#include "study/analysis/tables.h"
#include "study/tests/analysis/simulated.h"

namespace forceshade::analysis {
namespace {

using experiments::MatchingResult;

// Two participants, three reference radii, three trials each. By hand:
//
//   A: 600: 540 600 660   mean 600, squares 7200,  SD sqrt(7200/2)  = 60,  10 %
//      800: 665 700 735   mean 700, squares 2450,  SD sqrt(2450/2)  = 35,   5 %
//     1000: 731 860 989   mean 860, squares 33282, SD sqrt(33282/2) = 129, 15 %      mean SD 10 %
//   slope = sum((x - 800)(mean - 720)) / sum((x - 800)^2) = (200*120 + 0 + 200*140) / 80000 = 0.65; 720 - 0.65*800 = 200
//   satisfaction (7+8+9 + 6+6+6 + 5+7+9) / 9 = 63/9 = 7; steps (10+20+30 + 12+14+16 + 8+20+23) / 9 = 153/9 = 17
//
//   B: 600: 570 600 630   mean 600,  squares 1800, SD 30,  5 %
//      800: 760 800 840   mean 800,  squares 3200, SD 40,  5 %
//     1000: 950 1000 1050 mean 1000, squares 5000, SD 50,  5 %                       mean SD 5 %
//   slope (200*200 + 0 + 200*200) / 80000 = 1; 800 - 800 = 0; satisfaction 9 always; steps 3 always
//
//   overall, pooled: slope (0.65 + 1) / 2 = 0.825; 760 - 0.825*800 = 100; satisfaction 8; steps 10;
//     600: mean 600, squares 7200 + 1800 = 9000
//     800: mean 750, squares 2450 + 3200 + 6 * 50^2 = 20650
//    1000: mean 930, squares 33282 + 5000 + 6 * 70^2 = 67682
//   mean SD = (100 sqrt(9000/5)/600 + 100 sqrt(20650/5)/750 + 100 sqrt(67682/5)/930) / 3
//           = (7.0711 + 8.5687 + 12.5103) / 3 = 9.3834
experiments::Results by_hand() {
  experiments::Results results;
  const auto add = [&](const char* participant, double reference, std::array<double, 3> finals, std::array<int, 3> satisfaction,
                       std::array<int, 3> steps) {
    for (std::size_t i = 0; i < 3; ++i) {
      MatchingResult trial;
      trial.participant = participant;
      trial.trial = static_cast<int>(results.matching.size()) + 1;
      trial.vision = false;
      trial.stimulus = "bump-cylinder";
      trial.reference_radius = reference;
      trial.final_radius = finals[i];
      trial.satisfaction = satisfaction[i];
      trial.steps = steps[i];
      results.matching.push_back(trial);
    }
  };
  add("A", 600, {540, 600, 660}, {7, 8, 9}, {10, 20, 30});
  add("A", 800, {665, 700, 735}, {6, 6, 6}, {12, 14, 16});
  add("A", 1000, {731, 860, 989}, {5, 7, 9}, {8, 20, 23});
  add("B", 600, {570, 600, 630}, {9, 9, 9}, {3, 3, 3});
  add("B", 800, {760, 800, 840}, {9, 9, 9}, {3, 3, 3});
  add("B", 1000, {950, 1000, 1050}, {9, 9, 9}, {3, 3, 3});
  return results;
}

void expect_values(const MatchingRow& row, const std::array<double, 4>& expected) {
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(row.columns[k].value, expected[k], 1e-12) << row.participant << ' ' << k;
}

TEST(statistics, equal_the_numbers_computed_by_hand) {
  const std::vector<MatchingTable> tables = matching_tables(by_hand(), {});
  ASSERT_EQ(tables.size(), 1U);
  EXPECT_FALSE(tables[0].vision);
  ASSERT_EQ(tables[0].rows.size(), 3U);
  expect_values(tables[0].rows[0], {0.65, 10, 7, 17});
  expect_values(tables[0].rows[1], {1, 5, 9, 3});
  const double pooled = (100 * std::sqrt(1800.0) / 600 + 100 * std::sqrt(4130.0) / 750 + 100 * std::sqrt(13536.4) / 930) / 3;
  expect_values(tables[0].overall(), {0.825, pooled, 8, 10});
  EXPECT_EQ(fixed(pooled, 4), "9.3834");
  EXPECT_NEAR(tables[0].rows[0].line.intercept, 200, 1e-9);
  EXPECT_NEAR(tables[0].overall().line.intercept, 100, 1e-9);
  EXPECT_EQ(tables[0].overall().trials, 18U);
  ASSERT_EQ(tables[0].rows[0].spreads.size(), 3U);
  EXPECT_NEAR(tables[0].rows[0].spreads[2].sd_percent, 15, 1e-12);
}

// Nine times 9 and nine times 3: every resample is the same. And of one trial at each radius no standard deviation is defined.
TEST(statistics, say_what_the_data_do_not_determine) {
  experiments::Results results = by_hand();
  const MatchingRow b = matching_tables(results, {})[0].rows[1];
  EXPECT_EQ(b.columns[2].interval.low, 9);
  EXPECT_EQ(b.columns[2].interval.high, 9);
  EXPECT_EQ(b.columns[3].interval.low, 3);
  results.matching.resize(1);
  const MatchingRow one = matching_tables(results, {})[0].overall();
  EXPECT_TRUE(std::isnan(one.columns[0].value));
  EXPECT_TRUE(std::isnan(one.columns[1].value));
  EXPECT_FALSE(one.columns[0].interval.is_defined());
  EXPECT_FALSE(one.columns[1].interval.is_defined());
  EXPECT_EQ(one.columns[2].value, 7);
  for (const Estimate& column : one.columns) EXPECT_FALSE(column.interval.is_defined()) << "one trial shows no deviation";
  EXPECT_EQ(fixed(one.columns[1].value, 1) + ' ' + fixed(one.columns[1].interval, 1), "- -");
}

// Table 6.9's percentages by hand: of A's 4 answers 3 are "4" and one is "2"; of B's 4 all are "4".
TEST(statistics, count_the_answers) {
  experiments::Results results;
  for (const int answer : {4, 2, 4, 4}) results.classification.push_back({"A", 1, "bump-2p-shaded", 600, 1, answer, 9});
  for (int i = 0; i < 4; ++i) results.classification.push_back({"B", 1, "bump-2p-shaded", 600, 1, 4, 9});
  const std::vector<ClassificationRow> rows = classification_rows(results, {});
  ASSERT_EQ(rows.size(), 3U);
  const auto values = [](const ClassificationRow& row) {
    std::vector<double> all;
    for (const Estimate& one : row.percents) all.push_back(one.value);
    return all;
  };
  EXPECT_EQ(rows[0].participant, kOverall);
  EXPECT_EQ(values(rows[0]), (std::vector<double>{0, 12.5, 0, 87.5}));
  EXPECT_EQ(rows[1].participant, "A");
  EXPECT_EQ(values(rows[1]), (std::vector<double>{0, 25, 0, 75}));
  EXPECT_EQ(values(rows[2]), (std::vector<double>{0, 0, 0, 100}));
  // Clopper and Pearson for 4 of 4: from 0.025^(1/4) = 0.39764 to 1; for 0 of 8: to 1 - 0.025^(1/8) = 0.36942.
  EXPECT_EQ(fixed(rows[2].percents[3].interval, 3), "39.764 to 100.000");
  EXPECT_EQ(fixed(rows[0].percents[0].interval, 3), "0.000 to 36.942");
}

TEST(statistics, order_the_tables_as_the_thesis_does) {
  experiments::Results results;
  for (const char* stimulus : {"own-bump", "bump-3p-shaded", "bump-cylinder", "a-bump", "bump-1p-shaded"})
    for (const bool vision : {true, false}) {
      MatchingResult trial;
      trial.participant = "P";
      trial.stimulus = stimulus;
      trial.vision = vision;
      results.matching.push_back(trial);
    }
  std::vector<std::string> order;
  for (const MatchingTable& table : matching_tables(results, {})) order.push_back(table.stimulus + (table.vision ? "+" : "-"));
  EXPECT_EQ(order,
            (std::vector<std::string>{"bump-cylinder-", "bump-cylinder+", "bump-1p-shaded-", "bump-1p-shaded+",
                                      "bump-3p-shaded-", "bump-3p-shaded+", "a-bump-", "a-bump+", "own-bump-", "own-bump+"}));
}

// Another participant's trials, and another order of the rows of a file, change no number of a participant's row.
TEST(statistics, of_a_participant_do_not_depend_on_the_others) {
  experiments::Results all = tests::simulated_study(3), one = all;
  std::erase_if(all.matching, [](const MatchingResult& trial) { return trial.stimulus != "bump-2p-shaded"; });
  std::erase_if(one.matching, [](const MatchingResult& trial) {
    return trial.participant != "P2" || trial.stimulus != "bump-2p-shaded" || trial.vision;
  });
  const Resampling resampling{7, 200};
  const MatchingRow in_all = matching_tables(all, resampling)[0].rows[1], alone = matching_tables(one, resampling)[0].rows[0];
  ASSERT_EQ(in_all.participant, "P2");
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(in_all.columns[k].value, alone.columns[k].value);
    EXPECT_EQ(in_all.columns[k].interval.low, alone.columns[k].interval.low);
    EXPECT_EQ(in_all.columns[k].interval.high, alone.columns[k].interval.high);
  }
}

// Efron and Tibshirani 1993, chapter 14: the variance of 26 spatial test scores is 171.5, the acceleration 0.061, and the
// BCa interval of nominal coverage 0.9 by 2000 resamples 115.8 to 259.6. An end has a Monte Carlo error of a few units there;
// 200 000 resamples leave their own error far below it.
const std::vector<double> kScores{48, 36, 20, 29, 42, 42, 20, 42, 22, 41, 45, 14, 6,
                                  0,  33, 28, 34, 4,  32, 24, 47, 41, 24, 26, 30, 41};

std::vector<double> variance_of(const std::vector<std::size_t>& rows) {
  double mean = 0, squares = 0;
  for (const std::size_t row : rows) mean += kScores[row] / static_cast<double>(rows.size());
  for (const std::size_t row : rows) squares += (kScores[row] - mean) * (kScores[row] - mean);
  return {squares / static_cast<double>(rows.size())};
}

std::vector<Stratum> one_stratum(std::size_t size) {
  Stratum stratum;
  for (std::size_t row = 0; row < size; ++row) stratum.push_back({row});
  return {stratum};
}

TEST(bootstrap, gives_the_interval_of_efron_and_tibshirani) {
  const std::vector<Stratum> strata = one_stratum(kScores.size());
  const Interval interval = bca_intervals(strata, variance_of, {1, 200000, 0.9}, "scores")[0];
  std::printf("variance: %.2f to %.2f; published, by 2000 resamples: 115.8 to 259.6\n", interval.low, interval.high);
  EXPECT_NEAR(interval.low, 115.8, 4);
  EXPECT_NEAR(interval.high, 259.6, 8);
}

// The whole distribution of the mean of {1, 2, 3, 7, 12}: 3125 resamples, each equally likely. Bias and acceleration by hand:
// mean 5, jackknife influences x - 5 = {-4, -3, -2, 2, 7}, a = sum(l^3) / (6 sum(l^2)^1.5) = 252 / (6 * 82^1.5) = 0.0565625.
TEST(bootstrap, equals_the_exact_interval_of_a_small_sample) {
  const std::array<double, 5> sample{1, 2, 3, 7, 12};
  std::vector<double> means;
  for (int code = 0; code < 3125; ++code) {
    double sum = 0;
    for (int place = 0, rest = code; place < 5; ++place, rest /= 5) sum += sample[static_cast<std::size_t>(rest % 5)];
    means.push_back(sum / 5);
  }
  std::ranges::sort(means);
  double below = 0;
  for (const double mean : means) below += mean < 5 ? 1 : mean == 5 ? 0.5 : 0;
  const double a = 252 / (6 * std::pow(82, 1.5)), bias = normal_quantile(below / 3125);
  EXPECT_NEAR(a, 0.0565625, 1e-7);
  const auto end = [&](double z) {
    const double p = normal_cdf(bias + (bias + z) / (1 - a * (bias + z)));
    return means[static_cast<std::size_t>(p * 3125)];
  };
  const auto mean_of = [&](const std::vector<std::size_t>& rows) {
    double sum = 0;
    for (const std::size_t row : rows) sum += sample[row];
    return std::vector{sum / static_cast<double>(rows.size())};
  };
  const Interval interval = bca_intervals(one_stratum(5), mean_of, {1, 400000, 0.9}, "small")[0];
  std::printf("exact: %.2f to %.2f\n", end(-1.6448536269514722), end(1.6448536269514722));
  // The means are multiples of 0.2, and a quantile of a discrete distribution may be off by one of them.
  EXPECT_NEAR(interval.low, end(-1.6448536269514722), 0.21);
  EXPECT_NEAR(interval.high, end(1.6448536269514722), 0.21);
}

// The bias correction of resamples that are all on one side of the value is as large as so many can show, 0.5 of 1000: both
// ends are then the outermost resample.
TEST(bootstrap, ends_at_the_outermost_resample_where_all_are_on_one_side) {
  const auto zero = [](const std::vector<std::size_t>& rows) { return std::vector{rows.size() > 99 ? 1.0 : 0.0}; };
  for (const double side : {-1.0, 1.0}) {
    const auto beyond = [&](const std::vector<std::size_t>& rows) {
      return std::vector{side * (10 + static_cast<double>(rows.at(0)))};
    };
    const World world{one_stratum(5), {1}, beyond};
    const Interval interval = bca_intervals(one_stratum(4), zero, world, {1, 1000, 0.95}, "one side")[0];
    EXPECT_EQ(interval.low, side * 10);
    EXPECT_EQ(interval.high, side * 10);
  }
}

// Two participants with the same answers: their resamples are not the same, or errors of chance would be common to all rows.
TEST(bootstrap, draws_other_resamples_for_each_participant) {
  experiments::Results results = tests::simulated_study(3);
  std::erase_if(results.matching, [](const MatchingResult& trial) {
    return trial.participant != "P2" || trial.stimulus != "bump-2p-shaded" || trial.vision;
  });
  std::vector<MatchingResult> twin = results.matching;
  for (MatchingResult& trial : twin) trial.participant = "twin";
  results.matching.insert(results.matching.end(), twin.begin(), twin.end());
  const MatchingTable table = matching_tables(results, {7, 200})[0];
  ASSERT_EQ(table.rows.size(), 3U);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(table.rows[0].columns[k].value, table.rows[1].columns[k].value);
  EXPECT_NE(table.rows[0].columns[0].interval.low, table.rows[1].columns[0].interval.low);
}

// Strata of different sizes, 20 and 2. The world is the standard normal distribution, so that the ends of the interval are
// z / (1 - a z) and show the acceleration a. By hand, for the sum of the two means, with the deviations l of each stratum:
// sum(l^2) / n^2 = (19 + 361) / 400 + 3.8 / 4 = 1.9 and sum(l^3) / n^3 = (6859 - 19) / 8000 + 0 = 0.855, so
// a = 0.855 / (6 * 1.9^1.5) = 0.054410. A jackknife without its (n - 1) / n would have a = 0.0155.
TEST(bootstrap, weighs_strata_of_different_sizes_by_their_sizes) {
  std::vector<Stratum> strata(2);
  std::vector<double> values;
  for (std::size_t row = 0; row < 22; ++row) {
    strata[row < 20 ? 0 : 1].push_back({row});
    values.push_back(row < 19 ? -1 : row == 19 ? 19 : row == 20 ? -std::sqrt(1.9) : std::sqrt(1.9));
  }
  const auto sum_of_means = [&](const std::vector<std::size_t>& rows) {
    std::array<double, 2> sum{}, count{};
    for (const std::size_t row : rows) {
      const std::size_t which = row < 20 ? 0 : 1;
      sum[which] += values[row];
      ++count[which];
    }
    return std::vector{sum[0] / count[0] + sum[1] / count[1]};
  };
  constexpr std::size_t kPlaces = 10'001;
  const auto normal = [](const std::vector<std::size_t>& rows) {
    return std::vector{normal_quantile((static_cast<double>(rows.at(0)) + 0.5) / kPlaces)};
  };
  const World world{one_stratum(kPlaces), {1}, normal};
  const Interval interval = bca_intervals(strata, sum_of_means, world, {1, 400'000, 0.95}, "sizes")[0];
  const double a = 0.855 / (6 * std::pow(1.9, 1.5)), z = 1.959963984540054;
  std::printf("%.4f to %.4f; by hand %.4f to %.4f\n", interval.low, interval.high, -z / (1 + a * z), z / (1 - a * z));
  EXPECT_NEAR(interval.low, -z / (1 + a * z), 0.02);
  EXPECT_NEAR(interval.high, z / (1 - a * z), 0.02);
}

// Fixed digits: another compiler, library or machine draws the same resamples.
TEST(bootstrap, draws_the_same_numbers_everywhere) {
  Random random(1, "fixed");
  std::vector<std::uint64_t> drawn;
  for (int i = 0; i < 6; ++i) drawn.push_back(random.below(1000));
  EXPECT_EQ(drawn, (std::vector<std::uint64_t>{388, 532, 145, 950, 609, 259}));
  const Interval interval = bca_intervals(one_stratum(kScores.size()), variance_of, {1, 1000, 0.95}, "fixed")[0];
  EXPECT_EQ(fixed(interval, 6), "104.040352 to 265.836044");
}

TEST(bootstrap, draws_every_unit_equally_often) {
  Random random(2, "even");
  std::array<int, 7> counts{};
  constexpr int kDraws = 70000;
  for (int i = 0; i < kDraws; ++i) ++counts[random.below(7)];
  double chi_square = 0;
  for (const int count : counts) chi_square += (count - kDraws / 7.0) * (count - kDraws / 7.0) / (kDraws / 7.0);
  std::printf("chi-square of 6 degrees: %.2f\n", chi_square);
  EXPECT_GT(chi_square_tail(chi_square, 6), 1e-4);
  EXPECT_LT(chi_square_tail(chi_square, 6), 1 - 1e-4);
  EXPECT_NE(Random(2, "even").below(1U << 30), Random(2, "other").below(1U << 30));
  EXPECT_NE(Random(2, "even").below(1U << 30), Random(3, "even").below(1U << 30));
}

// Whole strata stay as large as they are, and units of several rows stay whole.
TEST(bootstrap, keeps_the_design) {
  const std::vector<Stratum> strata{{{0}, {1}, {2}}, {{3, 4}, {5, 6}}};
  std::set<std::vector<std::size_t>> seen;
  const auto check = [&](const std::vector<std::size_t>& rows) {
    const auto in_first = std::ranges::count_if(rows, [](std::size_t row) { return row < 3; });
    const bool is_resample = rows.size() == 7;
    EXPECT_EQ(in_first, is_resample || rows.size() == 5 ? 3 : 2);
    for (std::size_t i = static_cast<std::size_t>(in_first); i < rows.size(); i += 2) EXPECT_EQ(rows[i] + 1, rows[i + 1]);
    seen.insert(rows);
    return std::vector{0.0};
  };
  bca_intervals(strata, check, {1, 2000}, "design");
  const auto resamples = std::ranges::count_if(seen, [](const auto& rows) { return rows.size() == 7; });
  std::printf("%zd different resamples of 108, and %zu jackknife samples\n", resamples,
              seen.size() - static_cast<std::size_t>(resamples));
  EXPECT_EQ(resamples, 27 * 4);
  EXPECT_EQ(seen.size(), 27U * 4 + 5);
}

TEST(bootstrap, takes_participants_as_units_for_the_overall_row_alone) {
  const experiments::Results results = by_hand();
  const Resampling trials{1, 500}, participants{1, 500, 0.95, Unit::participants};
  const MatchingTable by_trials = matching_tables(results, trials)[0], by_people = matching_tables(results, participants)[0];
  EXPECT_EQ(by_trials.rows[0].columns[0].interval.low, by_people.rows[0].columns[0].interval.low);
  // The slope of a resample of two people is that of A, of B, or of both.
  EXPECT_NEAR(by_people.overall().columns[0].interval.low, 0.65, 1e-12);
  EXPECT_NEAR(by_people.overall().columns[0].interval.high, 1, 1e-12);
  EXPECT_NE(by_trials.overall().columns[0].interval.low, by_people.overall().columns[0].interval.low);
}

// One participant with {8, 10, 12} at 600 and {16, 20, 24, 20} at 800 mil. In percent of the means the deviations are -20, 0,
// 20 and -20, 0, 20, 0: squares 4 * 0.04, root mean square sqrt(0.16 / 7). The standard deviations are 2 and sqrt(32 / 3). So
// -20 % becomes 10 - 2 * 0.2 / sqrt(0.16 / 7) = 10 - sqrt(7) and 20 - sqrt(32 / 3) * sqrt(7) / 2.
TEST(residual_world, has_the_means_and_deviations_computed_by_hand) {
  std::vector<TrialNumbers> numbers;
  for (const double final : {8, 10, 12}) numbers.push_back({600, final, 5, final});
  for (const double final : {16, 20, 24, 20}) numbers.push_back({800, final, 5, 1});
  const ResidualWorld world = residual_world(numbers, {{{0}, {1}, {2}}, {{3}, {4}, {5}, {6}}}, {9, 9});
  EXPECT_EQ(world.draws, (std::vector<std::size_t>{3, 4}));
  ASSERT_EQ(world.strata[0].size(), 7U);
  ASSERT_EQ(world.strata[1].size(), 7U);
  const auto finals = [&](std::size_t stratum) {
    std::vector<double> all;
    for (const auto& unit : world.strata[stratum]) all.push_back(world.trials[unit.front()].final);
    std::ranges::sort(all);
    return all;
  };
  const double first = std::sqrt(7), second = std::sqrt(32 / 3.0) * std::sqrt(7) / 2;
  const std::vector<double> at_600{10 - first, 10 - first, 10, 10, 10, 10 + first, 10 + first};
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(finals(0)[i], at_600[i], 1e-12);
  EXPECT_NEAR(finals(1)[0], 20 - second, 1e-12);
  EXPECT_NEAR(finals(1)[6], 20 + second, 1e-12);
  for (const TrialNumbers& trial : world.trials) EXPECT_EQ(trial.satisfaction, 5);
  EXPECT_EQ(world.trials[world.strata[1][0].front()].steps, 1);  // always 1 at 800 mil
  EXPECT_EQ(world.trials[world.strata[1][0].front()].reference, 800);
}

// Two participants at one radius: {9, 11} and {19, 21}. Means 10 and 20, each with the variance 2 / 2 = 1; between them 25, of
// which (2 - 1) / 4 * (1 + 1) = 0.5 are errors. So the means become 15 -+ 5 * sqrt(24.5 / 25).
TEST(residual_world, draws_the_means_of_participants_together) {
  const std::vector<TrialNumbers> numbers{{600, 9, 1, 1}, {600, 11, 1, 1}, {600, 19, 3, 3}, {600, 21, 3, 3}};
  const ResidualWorld world = residual_world(numbers, {{{0}, {1}}, {{2}, {3}}}, {0, 1});
  const auto middle = [&](std::size_t k, double TrialNumbers::*number) {
    return (world.trials[world.strata[k][0].front()].*number + world.trials[world.strata[k][1].front()].*number) / 2;
  };
  EXPECT_NEAR(middle(0, &TrialNumbers::final), 15 - 5 * std::sqrt(0.98), 1e-12);
  EXPECT_NEAR(middle(1, &TrialNumbers::final), 15 + 5 * std::sqrt(0.98), 1e-12);
  EXPECT_EQ(middle(0, &TrialNumbers::steps), 1);
  EXPECT_EQ(middle(1, &TrialNumbers::steps), 3);
}

TEST(distributions, equal_tabulated_values) {
  EXPECT_NEAR(normal_cdf(1.959963984540054), 0.975, 1e-15);
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-14);
  EXPECT_NEAR(normal_quantile(1e-300), -37.0471, 1e-4);
  EXPECT_EQ(normal_quantile(0.5), 0);
  EXPECT_TRUE(std::isinf(normal_quantile(0)) && std::isinf(normal_quantile(1)));
  EXPECT_NEAR(chi_square_tail(3.841458820694124, 1), 0.05, 1e-14);
  EXPECT_NEAR(chi_square_tail(15.50731305586545, 8), 0.05, 1e-13);
  EXPECT_EQ(chi_square_tail(0, 3), 1);
}

TEST(quantile, interpolates_between_neighbours) {
  const std::vector<double> sorted{10, 20, 30};
  EXPECT_EQ(quantile(sorted, 0.25), 10);
  EXPECT_EQ(quantile(sorted, 0.5), 20);
  EXPECT_EQ(quantile(sorted, 0.625), 25);
  EXPECT_EQ(quantile(sorted, 0), 10);
  EXPECT_EQ(quantile(sorted, 1), 30);
}

}  // namespace
}  // namespace forceshade::analysis
