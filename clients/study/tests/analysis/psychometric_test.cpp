// SPDX-License-Identifier: BSD-3-Clause
#include "study/analysis/psychometric.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "study/analysis/distributions.h"
#include "study/analysis/simplex.h"
#include "study/analysis/tables.h"
#include "study/analysis/thesis.h"
#include "study/tests/analysis/simulated.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::analysis {
namespace {

std::vector<AngleCount> drawn_points(std::uint64_t seed, const PsychometricParameters& truth, Shape shape, int trials) {
  Random random(seed, "points");
  std::vector<AngleCount> points;
  for (const double angle : {0.0, 13.9, 20.0, 20.9, 30.0, 37.6, 41.8, 56.4, 60.0, 112.9}) {
    points.push_back({angle, 0, trials});
    for (int i = 0; i < trials; ++i) points.back().chosen += random.uniform() < probability_at(angle, truth, shape);
  }
  return points;
}

// Figure 5-5: 2 asin(w / 2R) / n, with w = 1000 mil. R = 1000: asin(1/2) = 30 degrees, so 60, 30 and 20.
TEST(polygon_angle, is_that_of_figure_5_5) {
  EXPECT_NEAR(polygon_angle("bump-1p-shaded", 1000, 1000).value(), 60, 1e-12);
  EXPECT_NEAR(polygon_angle("bump-2p-shaded", 1000, 1000).value(), 30, 1e-12);
  EXPECT_NEAR(polygon_angle("bump-3p", 1000, 1000).value(), 20, 1e-12);
  EXPECT_NEAR(polygon_angle("bump-1p", 600, 1000).value(), 112.885, 5e-4);
  EXPECT_NEAR(polygon_angle("bump-1p", 500, 1000).value(), 180, 1e-12);
  EXPECT_EQ(polygon_angle("bump-cylinder", 600, 1000), 0);
  for (const char* other : {"wall", "cylinder", "bump-4p", "bump-0p", "bump-2q", "bump-2p-shade", "bump-", ""})
    EXPECT_FALSE(polygon_angle(other, 600, 1000).has_value()) << other;
  EXPECT_FALSE(polygon_angle("bump-1p", 499, 1000).has_value());
}

TEST(angle_counts, count_answer_4_of_shaded_bumps_and_the_cylinder) {
  experiments::Results results;
  const auto add = [&](const char* participant, const char* stimulus, double radius, std::initializer_list<int> answers) {
    for (const int answer : answers) results.classification.push_back({participant, 1, stimulus, radius, 1, answer, 9});
  };
  add("A", "bump-1p-shaded", 1000, {4, 1, 4});
  add("B", "bump-1p-shaded", 1000, {4});
  add("A", "bump-1p", 1000, {4, 4, 4});
  add("A", "own-shape", 1000, {4});
  add("A", "bump-cylinder", 600, {3, 4});
  const std::vector<AngleCount> all = angle_counts(results, 1000, kOverall), b = angle_counts(results, 1000, "B");
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(std::tuple(all[0].angle, all[0].chosen, all[0].trials), std::tuple(0.0, 1, 2));
  EXPECT_EQ(std::tuple(all[1].chosen, all[1].trials), std::tuple(3, 4));
  ASSERT_EQ(b.size(), 1U);
  EXPECT_EQ(std::tuple(b[0].chosen, b[0].trials), std::tuple(1, 1));
}

// Half way between the asymptotes at the threshold; one scale below it, F is 1 / (1 + 1/e) or 0.8413.
TEST(psychometric, function_has_its_asymptotes_and_threshold) {
  const PsychometricParameters of{40, 5, 0.2, 0.1};
  for (const Shape shape : {Shape::logistic, Shape::gaussian}) {
    EXPECT_NEAR(probability_at(40, of, shape), 0.55, 1e-15);
    EXPECT_NEAR(probability_at(-1e3, of, shape), 0.9, 1e-15);
    EXPECT_NEAR(probability_at(1e3, of, shape), 0.2, 1e-15);
  }
  EXPECT_NEAR(probability_at(35, of, Shape::logistic), 0.2 + 0.7 / (1 + std::exp(-1)), 1e-15);
  EXPECT_NEAR(probability_at(35, of, Shape::gaussian), 0.2 + 0.7 * normal_cdf(1), 1e-15);
}

TEST(simplex, finds_the_minimum_of_rosenbrocks_valley) {
  const auto valley = [](const std::array<double, 2>& at) {
    const double bend = at[1] - at[0] * at[0];
    return 100 * bend * bend + (1 - at[0]) * (1 - at[0]);
  };
  const Vertex<2> found = minimum<2>(valley, {-1.2, 1}, 0.5, 1e-16, 2000);
  EXPECT_NEAR(found.at[0], 1, 1e-6);
  EXPECT_NEAR(found.at[1], 1, 1e-6);
}

// Expected counts as data: the maximum of the likelihood is the function that they come from.
TEST(psychometric, fit_finds_the_function_of_exact_proportions) {
  for (const Shape shape : {Shape::logistic, Shape::gaussian}) {
    const PsychometricParameters truth{45, 7, 0.2, 0.05};
    std::vector<AngleCount> points;
    constexpr int kTrials = 100000000;
    for (double angle = 0; angle <= 110; angle += 10)
      points.push_back({angle, static_cast<int>(std::lround(kTrials * probability_at(angle, truth, shape))), kTrials});
    const auto found = fit(points, {shape});
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->parameters.threshold, truth.threshold, 1e-3);
    EXPECT_NEAR(found->parameters.scale, truth.scale, 1e-3);
    EXPECT_NEAR(found->parameters.guess, truth.guess, 1e-4);
    EXPECT_NEAR(found->parameters.lapse, truth.lapse, 1e-4);
    EXPECT_LT(found->deviance, 1e-2);
    EXPECT_FALSE(found->is_at_limit);
  }
}

// A function with more guesses or lapses than are allowed, and every other parameter inside its range.
TEST(psychometric, fit_says_that_it_ends_at_the_most_guesses_or_lapses) {
  for (const PsychometricParameters& truth : {PsychometricParameters{45, 7, 0.55, 0.05}, {45, 7, 0.1, 0.3}}) {
    std::vector<AngleCount> points;
    constexpr int kTrials = 1000000;
    for (double angle = 0; angle <= 110; angle += 10)
      points.push_back(
          {angle, static_cast<int>(std::lround(kTrials * probability_at(angle, truth, Shape::logistic))), kTrials});
    const PsychometricModel model;
    const auto found = fit(points, model);
    ASSERT_TRUE(found.has_value());
    const bool has_most_guesses = truth.guess > model.most_guess;
    EXPECT_NEAR(has_most_guesses ? found->parameters.guess : found->parameters.lapse,
                has_most_guesses ? model.most_guess : model.most_lapse, 1e-6);
    const double other = has_most_guesses ? found->parameters.lapse : found->parameters.guess;
    EXPECT_TRUE(other > 0.01 && other < 0.2) << other;
    EXPECT_TRUE(found->parameters.threshold > 0 && found->parameters.threshold < 110) << found->parameters.threshold;
    EXPECT_TRUE(found->parameters.scale > 1 && found->parameters.scale < 100) << found->parameters.scale;
    EXPECT_TRUE(found->is_at_limit);
  }
}

// Against every point of a fine grid, on data of many kinds: no likelihood there is higher.
TEST(psychometric, no_place_of_a_grid_is_better_than_the_fit) {
  const std::vector<PsychometricParameters> truths{
      {45, 8, 0.2, 0.05}, {20, 2, 0, 0}, {80, 20, 0.4, 0.2}, {-10, 5, 0.1, 0.1}, {200, 10, 0.3, 0.1}};
  int at_limit = 0, inside = 0;
  for (std::size_t i = 0; i < truths.size(); ++i)
    for (const int trials : {5, 24, 120}) {
      const std::vector<AngleCount> points = drawn_points(i, truths[i], Shape::logistic, trials);
      const PsychometricModel model;
      const auto found = fit(points, model);
      ASSERT_TRUE(found.has_value());
      ++(found->is_at_limit ? at_limit : inside);
      double best = -1e300;
      for (double threshold = -110; threshold <= 220; threshold += 5)
        for (const double scale : {0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 100.0, 500.0})
          for (double guess = 0; guess <= model.most_guess; guess += 0.05)
            for (double lapse = 0; lapse <= model.most_lapse; lapse += 0.05) {
              double sum = 0;
              for (const AngleCount& point : points) {
                const double p =
                    std::clamp(probability_at(point.angle, {threshold, scale, guess, lapse}, model.shape), 1e-12, 1 - 1e-12);
                sum += point.chosen * std::log(p) + (point.trials - point.chosen) * std::log(1 - p);
              }
              best = std::max(best, sum);
            }
      EXPECT_GE(found->log_likelihood, best - 1e-6) << i << ", " << trials << " trials";
    }
  std::printf("%d fits at a limit, %d inside\n", at_limit, inside);
  EXPECT_GT(at_limit, 0);
  EXPECT_GT(inside, 0);
}

// p is (1 + b) / (1 + n) for b of n resamples whose deviance is as large (Davison and Hinkley 1997, section 4.2): 1 where
// nothing deviates, 1 / (1 + n) where no resample deviates as much. With two degrees of freedom the tail of chi-square is
// exp(-D / 2).
TEST(psychometric, p_values_are_those_of_their_definitions) {
  const PsychometricParameters truth{20, 4, 0.05, 0.05};
  std::vector<AngleCount> exact, far;
  for (const double angle : {5.0, 12.0, 17.0, 21.0, 26.0, 40.0}) {
    constexpr int kTrials = 1'000'000;
    exact.push_back({angle, static_cast<int>(std::lround(kTrials * probability_at(angle, truth, Shape::logistic))), kTrials});
    far.push_back({angle, exact.size() % 2 == 0 ? 90 : 10, 100});
  }
  constexpr std::size_t kCount = 19;
  const auto right = estimate("P", exact, {}, {1, kCount}), wrong = estimate("P", far, {}, {1, kCount});
  ASSERT_TRUE(right && wrong);
  EXPECT_DOUBLE_EQ(right->p_bootstrap, 1);
  EXPECT_DOUBLE_EQ(wrong->p_bootstrap, 1.0 / (kCount + 1));
  EXPECT_TRUE(std::isnan(estimate("P", exact, {}, {1, 0})->p_bootstrap));
  int compared = 0;
  for (int seed = 1; seed <= 12; ++seed) {
    std::vector<AngleCount> points = exact;
    Random random(static_cast<std::uint64_t>(seed), "p-values");
    for (AngleCount& point : points) {
      const double probability = probability_at(point.angle, truth, Shape::logistic);
      point = {point.angle, 0, 200};
      for (int i = 0; i < point.trials; ++i) point.chosen += random.uniform() < probability ? 1 : 0;
    }
    const auto found = estimate("P", points, {}, {1, 100});
    EXPECT_NEAR(found->p_chi_square, std::exp(-found->fit.deviance / 2), 1e-12);
    compared += found->p_chi_square > 0.05 && found->p_chi_square < 0.95 ? 1 : 0;
    EXPECT_NEAR(found->p_bootstrap, found->p_chi_square, 0.25);  // of large samples they are the same
  }
  EXPECT_GT(compared, 6);
}

// A function with so many answers that each interval is narrow, and with parameters that are far apart.
TEST(psychometric, interval_of_each_parameter_is_about_that_parameter) {
  const PsychometricParameters truth{20, 4, 0.05, 0.2};
  std::vector<AngleCount> points;
  for (const double angle : {2.0, 8.0, 14.0, 18.0, 22.0, 26.0, 34.0, 45.0}) {
    constexpr int kTrials = 4000;
    points.push_back({angle, static_cast<int>(std::lround(kTrials * probability_at(angle, truth, Shape::logistic))), kTrials});
  }
  const auto found = estimate("P", points, {}, {1, 40});
  ASSERT_TRUE(found);
  const auto expect_about = [](const Interval& interval, double value, double reach) {
    EXPECT_GT(interval.low, value - reach);
    EXPECT_LT(interval.high, value + reach);
    EXPECT_LT(interval.low, interval.high);
  };
  expect_about(found->threshold, 20, 2);
  expect_about(found->scale, 4, 1.5);
  expect_about(found->guess, 0.05, 0.06);
  expect_about(found->lapse, 0.2, 0.06);
}

TEST(psychometric, needs_four_angles) {
  EXPECT_FALSE(fit({{0, 9, 10}, {20, 8, 10}, {20, 7, 10}, {40, 2, 10}}, {}).has_value());
  EXPECT_TRUE(fit({{0, 9, 10}, {10, 8, 10}, {20, 7, 10}, {40, 2, 10}}, {}).has_value());
  EXPECT_FALSE(estimate("P", {}, {}, {}).has_value());
}

// Data of the function fit it; data that differ from trial to trial at the same angle do not.
TEST(psychometric, deviance_tells_a_function_from_none) {
  const PsychometricParameters truth{45, 8, 0.2, 0.05};
  const auto good = estimate("P", drawn_points(1, truth, Shape::logistic, 120), {}, {1, 200});
  ASSERT_TRUE(good.has_value());
  EXPECT_GT(good->p_bootstrap, 0.02);
  EXPECT_GT(good->p_chi_square, 0.02);
  EXPECT_TRUE(good->threshold.contains(good->fit.parameters.threshold));
  std::vector<AngleCount> bad = drawn_points(1, truth, Shape::logistic, 120);
  for (std::size_t i = 0; i < bad.size(); ++i) bad[i].chosen = i % 2 == 0 ? 30 : 90;
  const auto none = estimate("P", bad, {}, {1, 200});
  ASSERT_TRUE(none.has_value());
  EXPECT_LE(none->p_bootstrap, 1.0 / 201 + 1e-12);
  EXPECT_LT(none->p_chi_square, 1e-10);
}

// The percentages of table 6.9 as counts of 120. As clients/study/analysis.md states, the fit ends at the largest guess that is
// allowed, and the angle alone does not explain the answers.
TEST(psychometric, angle_alone_does_not_explain_table_6_9) {
  std::vector<AngleCount> points;
  for (const ThesisClassificationRow& row : thesis_classification())
    if (row.stimulus == "bump-cylinder" || row.stimulus.ends_with("-shaded"))
      points.push_back({*polygon_angle(row.stimulus, row.radius, 1000),
                        static_cast<int>(std::lround(kThesisTrialsPerRow * row.percents[3] / 100.0)), kThesisTrialsPerRow});
  ASSERT_EQ(points.size(), 12U);
  const auto found = estimate(kOverall, points, {}, {1, 300});
  ASSERT_TRUE(found.has_value());
  std::printf("theta-critical %.1f (%.1f to %.1f), guess %.2f, lapse %.2f, deviance %.1f, p %.3f\n",
              found->fit.parameters.threshold, found->threshold.low, found->threshold.high, found->fit.parameters.guess,
              found->fit.parameters.lapse, found->fit.deviance, found->p_bootstrap);
  EXPECT_TRUE(found->fit.is_at_limit);
  EXPECT_NEAR(found->fit.parameters.guess, 0.5, 1e-6);
  EXPECT_LT(found->p_bootstrap, 0.01);
  EXPECT_LT(found->p_chi_square, 0.01);
}

std::string without_commas(std::string text) {
  std::ranges::replace(text, ',', ' ');
  return text;
}

// psignifit 2.5.6, the program of Wichmann and Hill (2001), where it is installed. It fits rising functions, so it is given
// -angle, with the same limits for guess (gamma) and lapse (lambda).
TEST(psychometric, fits_equal_those_of_psignifit) {
  if (std::system("command -v psignifit > /dev/null 2>&1") != 0) GTEST_SKIP() << "psignifit is not installed";
  const forceshade::tests::TemporaryDirectory folder;
  int compared = 0, agreed = 0;
  for (const Shape shape : {Shape::logistic, Shape::gaussian})
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      const std::vector<AngleCount> points = drawn_points(seed, {45, 8, 0.2, 0.05}, shape, 120);
      std::ostringstream data, options;
      for (const AngleCount& point : points)
        data << -point.angle << ' ' << point.chosen << ' ' << point.trials - point.chosen << '\n';
      folder.write("data", data.str());
      options << "#shape " << (shape == Shape::logistic ? "logistic" : "cumulative Gaussian")
              << "\n#n_intervals 1\n#matrix_format xrw\n#gamma_limits 0 0.5\n#lambda_limits 0 0.25\n#runs 0\n#verbose false\n"
              << "#write_pa_est " << folder.file("parameters") << "\n#write_st_est " << folder.file("statistics") << '\n';
      folder.write("options", options.str());
      const std::string command = "psignifit " + folder.file("data") + ' ' + folder.file("options") + " > /dev/null 2>&1";
      ASSERT_EQ(std::system(command.c_str()), 0) << command;
      std::array<double, 4> theirs{};
      std::istringstream parameters(without_commas(folder.read("parameters")));
      for (double& value : theirs) ASSERT_TRUE(parameters >> value) << folder.read("parameters");
      double deviance = 0;
      std::istringstream statistics(without_commas(folder.read("statistics")));
      ASSERT_TRUE(statistics >> deviance) << folder.read("statistics");
      const auto mine = fit(points, {shape});
      ASSERT_TRUE(mine.has_value());
      const auto& [threshold, scale, guess, lapse] = mine->parameters;
      std::printf("psignifit %.4f %.4f %.4f %.4f, deviance %.5f; here %.4f %.4f %.4f %.4f, %.5f\n", -theirs[0], theirs[1],
                  theirs[2], theirs[3], deviance, threshold, scale, guess, lapse, mine->deviance);
      // psignifit stops a little below the top, which is flat, and prints six digits. It is never better; sometimes it ends
      // elsewhere.
      ++compared;
      EXPECT_LE(mine->deviance, deviance + 1e-5 * deviance);
      if (mine->deviance < deviance - 1e-2) continue;
      ++agreed;
      EXPECT_NEAR(threshold, -theirs[0], 0.1);
      EXPECT_NEAR(scale, theirs[1], 0.1);
      EXPECT_NEAR(guess, theirs[2], 0.01);
      EXPECT_NEAR(lapse, theirs[3], 0.01);
    }
  std::printf("%d of %d agree; in the others psignifit ends at a less likely function\n", agreed, compared);
  EXPECT_EQ(compared, 20);
  EXPECT_GE(agreed, 18);
}

}  // namespace
}  // namespace forceshade::analysis
