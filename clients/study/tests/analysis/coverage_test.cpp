// SPDX-License-Identifier: BSD-3-Clause
// The share of intervals of nominal coverage 0.95 that hold the true value, on simulated results. FORCESHADE_COVERAGE=N makes
// N data sets for each line (clients/study/analysis.md has the numbers of 5000); without it there are 200, and the allowance is wider by
// their own error.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>

#include "study/analysis/bootstrap.h"
#include "study/analysis/statistics.h"
#include "study/analysis/tables.h"
#include "study/analysis/thesis.h"
#include "study/tests/analysis/simulated.h"

namespace forceshade::analysis {
namespace {

using tests::Observer;

constexpr double kLevel = 0.95;

int data_sets() {
  const char* given = std::getenv("FORCESHADE_COVERAGE");
  return given == nullptr ? 200 : std::atoi(given);
}

// Two points; of few data sets also four standard errors of a fraction of 0.95.
double allowance(int sets) {
  return 0.02 + (data_sets() >= 5000 ? 0 : 4 * std::sqrt(kLevel * (1 - kLevel) / sets));
}

struct Count {
  int below = 0, above = 0;  // of the true value: the interval lies above or below it

  void add(const Interval& interval, double truth) {
    ASSERT_TRUE(interval.is_defined());
    below += truth < interval.low;
    above += truth > interval.high;
  }
  double coverage(int of) const { return 1 - static_cast<double>(below + above) / of; }
};

void print(const char* what, const char* column, const Count& count, int of) {
  std::printf("| %s | %s | %.1f | %.1f | %.1f |\n", what, column, 100 * count.coverage(of), 100.0 * count.below / of,
              100.0 * count.above / of);
}

// Checks the coverage of the four columns' intervals, of one observer or of several with fixed habits.
void check_trials(const char* what, const std::vector<Observer>& observers, int sets, std::size_t resamples) {
  std::array<double, 4> truth{};
  const auto people = static_cast<double>(observers.size());
  for (const Observer& observer : observers) {
    truth[0] += observer.slope / people;
    truth[2] += tests::expected_satisfaction(observer) / people;
    truth[3] += tests::expected_steps(observer) / people;
  }
  for (const double reference : tests::kReferences) {
    double mean = 0, squares = 0;
    for (const Observer& observer : observers) mean += (observer.intercept + observer.slope * reference) / people;
    for (const Observer& observer : observers) {
      const double own = observer.intercept + observer.slope * reference;
      squares += (own * observer.variation * own * observer.variation + (own - mean) * (own - mean)) / people;
    }
    truth[1] += 100 * std::sqrt(squares) / mean / 5;
  }
  std::array<Count, 4> counts;
  Random random(20, what);
  for (int set = 0; set < sets; ++set) {
    experiments::Results results;
    for (std::size_t i = 0; i < observers.size(); ++i)
      tests::add_matching(results.matching, random, observers[i], tests::person_named(i), "bump-cylinder", true);
    std::vector<Stratum> strata;
    for (std::size_t row = 0; row < results.matching.size(); ++row) {
      if (row % 12 == 0) strata.emplace_back();
      strata.back().push_back({row});
    }
    const Resampling resampling{static_cast<std::uint64_t>(set), resamples, kLevel};
    std::vector<std::size_t> people;
    for (std::size_t stratum = 0; stratum < strata.size(); ++stratum) people.push_back(stratum / 5);
    const std::vector<TrialNumbers> numbers = numbers_of(results.matching);
    const ResidualWorld world = residual_world(numbers, strata, people);
    const auto columns_of = [](const std::vector<TrialNumbers>& trials) {
      return [&trials](const std::vector<std::size_t>& rows) {
        const MatchingSummary summary = summary_of(trials, rows);
        return std::vector{summary.line.slope, summary.sd_percent, summary.satisfaction, summary.steps};
      };
    };
    const auto intervals = bca_intervals(strata, columns_of(numbers),
                                         World{world.strata, world.draws, columns_of(world.trials)}, resampling, what);
    for (std::size_t k = 0; k < 4; ++k) counts[k].add(intervals[k], truth[k]);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    print(what, kMatchingColumns[k], counts[k], sets);
    EXPECT_NEAR(counts[k].coverage(sets), kLevel, allowance(sets)) << what << ", " << kMatchingColumns[k];
  }
}

TEST(coverage, of_one_participants_row_is_nominal) {
  check_trials("one participant", {{60, 0.85, 0.13, 7.7, 1.3, 3.2, 0.4}}, data_sets(), 1000);
}

// Five people who differ: one precise and slow, one at the ceiling of satisfaction.
TEST(coverage, of_the_overall_row_is_nominal_for_these_participants) {
  check_trials("overall, these participants",
               {{60, 0.85, 0.13, 7.7, 1.3, 2.7, 0.4},
                {-20, 1.04, 0.133, 8.8, 1.1, 3.5, 0.3},
                {0, 0.99, 0.067, 8.1, 1.0, 3.0, 0.4},
                {-30, 1.03, 0.153, 8.8, 1.0, 3.0, 0.3},
                {40, 0.92, 0.079, 7.2, 1.4, 4.1, 0.5}},
               data_sets() / 5, 1000);
}

// Percentages of 120 answers in five strata of 24.
TEST(coverage, of_a_percentage_is_nominal_where_answers_are_not_rare) {
  for (const double truth : {0.5, 0.8}) {
    Count count;
    Random random(21, std::to_string(truth));
    for (int set = 0; set < data_sets(); ++set) {
      std::vector<int> chosen;
      std::vector<Stratum> strata(5);
      for (std::size_t row = 0; row < 120; ++row) {
        chosen.push_back(random.uniform() < truth);
        strata[row / 24].push_back({row});
      }
      const auto percent = [&](const std::vector<std::size_t>& rows) {
        double sum = 0;
        for (const std::size_t row : rows) sum += chosen[row];
        return std::vector{100 * sum / static_cast<double>(rows.size())};
      };
      count.add(bca_intervals(strata, percent, {static_cast<std::uint64_t>(set), 400, kLevel}, "percent")[0], 100 * truth);
    }
    print(truth == 0.5 ? "50 % of 120 answers" : "80 % of 120 answers", "percentage", count, data_sets());
    EXPECT_NEAR(count.coverage(data_sets()), kLevel, allowance(data_sets())) << truth;
  }
}

// Participants as units: the observers themselves are drawn. No claim of nominal coverage: few people hold little information
// about people. The test holds that coverage rises with their number and is what clients/study/analysis.md prints.
TEST(coverage, of_participants_as_units_rises_with_their_number) {
  double before = 0;
  for (const int people : {5, 10, 20}) {
    const int sets = data_sets() / 2;
    Count count;
    Random random(22, std::to_string(people));
    for (int set = 0; set < sets; ++set) {
      experiments::Results results;
      Stratum stratum;
      for (int person = 0; person < people; ++person) {
        const double slope = 0.75 + 0.12 * tests::normal(random);
        const std::size_t first = results.matching.size();
        tests::add_matching(results.matching, random, {600 * (1 - slope), slope, 0.12, 8, 1, 3, 0.4},
                            tests::person_named(static_cast<std::size_t>(person)), "bump-cylinder", true);
        stratum.emplace_back(results.matching.size() - first);
        std::iota(stratum.back().begin(), stratum.back().end(), first);
      }
      const std::vector<TrialNumbers> numbers = numbers_of(results.matching);
      const auto slope = [&](const std::vector<std::size_t>& rows) {
        return std::vector{summary_of(numbers, rows).line.slope};
      };
      count.add(bca_intervals({stratum}, slope, {static_cast<std::uint64_t>(set), 300, kLevel}, "people")[0], 0.75);
    }
    const std::string what = "overall, participants as units, " + std::to_string(people) + " of them";
    print(what.c_str(), "slope", count, sets);
    const double error = std::sqrt(0.1 * 0.9 / sets);  // of a coverage of 0.9
    EXPECT_GT(count.coverage(sets), before - 4 * error);
    EXPECT_LT(count.coverage(sets), kLevel + 4 * error);
    before = count.coverage(sets);
  }
}

TEST(coverage, of_theta_critical_is_nominal) {
  const int sets = data_sets() >= 5000 ? data_sets() / 10 : 0;
  if (sets == 0) GTEST_SKIP() << "set FORCESHADE_COVERAGE=10000: it fits some hundred thousand functions";
  const PsychometricParameters truth{45, 8, 0.2, 0.05};
  Count count;
  Random random(23, "theta");
  for (int set = 0; set < sets; ++set) {
    std::vector<AngleCount> points;
    for (const double angle : {0.0, 14.0, 20.0, 30.0, 38.0, 42.0, 56.0, 60.0, 113.0}) {
      points.push_back({angle, 0, 120});
      for (int i = 0; i < 120; ++i) points.back().chosen += random.uniform() < probability_at(angle, truth, Shape::logistic);
    }
    const auto found = estimate("P", points, {}, {static_cast<std::uint64_t>(set), 300, kLevel});
    ASSERT_TRUE(found.has_value());
    count.add(found->threshold, truth.threshold);
  }
  print("120 answers at each of 9 angles", "theta-critical", count, sets);
  EXPECT_NEAR(count.coverage(sets), kLevel, 0.02 + 3 * std::sqrt(kLevel * (1 - kLevel) / sets));
}

}  // namespace
}  // namespace forceshade::analysis
