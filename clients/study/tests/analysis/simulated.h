// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Results of the thesis's design, drawn from distributions of which the true values of every column are known.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "study/analysis/distributions.h"
#include "study/analysis/psychometric.h"
#include "study/analysis/random.h"
#include "study/experiments/results.h"

namespace forceshade::analysis::tests {

inline std::string person_named(std::size_t number) {
  return std::string("P").append(std::to_string(number));
}

inline double normal(Random& random) {
  return normal_quantile(random.uniform());
}

// A final radius is (intercept + slope * reference) * (1 + variation * z) with z normal, cut off at +-5; satisfaction is a
// normal number rounded and cut to 1 to 10, so it has a ceiling; steps are a rounded lognormal number, which is skewed.
struct Observer {
  double intercept, slope, variation;
  double satisfaction, satisfaction_sd;
  double log_steps, log_steps_sd;
};

inline constexpr std::array<double, 5> kReferences{600, 800, 1000, 1200, 1400};

inline void add_matching(std::vector<experiments::MatchingResult>& trials, Random& random, const Observer& observer,
                         const std::string& participant, const std::string& stimulus, bool vision) {
  using experiments::InitialRadius;
  for (const double reference : kReferences)
    for (const InitialRadius initial : {InitialRadius::large, InitialRadius::same, InitialRadius::small})
      for (int repetition = 1; repetition <= 4; ++repetition) {
        experiments::MatchingResult trial;
        trial.participant = participant;
        trial.trial = static_cast<int>(trials.size()) + 1;
        trial.vision = vision;
        trial.stimulus = stimulus;
        trial.initial = initial;
        trial.repetition = repetition;
        trial.reference_radius = reference;
        trial.initial_radius = initial == InitialRadius::large ? 1400 : initial == InitialRadius::small ? 600 : reference;
        const double z = std::clamp(normal(random), -5.0, 5.0);
        trial.final_radius = (observer.intercept + observer.slope * reference) * (1 + observer.variation * z);
        trial.satisfaction = static_cast<int>(
            std::clamp(std::round(observer.satisfaction + observer.satisfaction_sd * normal(random)), 1.0, 10.0));
        trial.steps = static_cast<int>(std::round(std::exp(observer.log_steps + observer.log_steps_sd * normal(random))));
        trial.seconds = 30 + 2.0 * trial.steps;
        trials.push_back(trial);
      }
}

// The expectation of satisfaction and of steps, by the probabilities of all whole numbers.
inline double expected_satisfaction(const Observer& observer) {
  double sum = 0;
  for (int answer = 1; answer <= 10; ++answer) {
    const auto below = [&](double edge) { return normal_cdf((edge - observer.satisfaction) / observer.satisfaction_sd); };
    sum += answer * ((answer == 10 ? 1 : below(answer + 0.5)) - (answer == 1 ? 0 : below(answer - 0.5)));
  }
  return sum;
}
inline double expected_steps(const Observer& observer) {
  double sum = 0;
  for (int steps = 1; steps <= 20000; ++steps) {
    const auto below = [&](double edge) { return normal_cdf((std::log(edge) - observer.log_steps) / observer.log_steps_sd); };
    sum += steps * (below(steps + 0.5) - below(steps - 0.5));
  }
  return sum;
}

inline const std::array<const char*, 7> kClassified{"bump-1p",        "bump-2p",        "bump-3p",       "bump-cylinder",
                                                    "bump-1p-shaded", "bump-2p-shaded", "bump-3p-shaded"};

// Answer 4 with the probability of the function at the polygon's angle, which for an unshaded polygon is a fifth of that; else
// mostly the true shape.
inline void add_classification(std::vector<experiments::ClassificationResult>& trials, Random& random,
                               const PsychometricParameters& observer, const std::string& participant) {
  for (const char* stimulus : kClassified)
    for (const double radius : {600.0, 1000.0, 1400.0})
      for (int repetition = 1; repetition <= 24; ++repetition) {
        const std::string name = stimulus;
        const bool is_smooth = name == "bump-cylinder" || name.ends_with("-shaded");
        const double smooth =
            probability_at(*polygon_angle(name, radius, 1000), observer, Shape::logistic) * (is_smooth ? 1 : 0.2);
        const int shape = name == "bump-cylinder" ? 3 : name[5] - '0';
        int answer = 4;
        if (random.uniform() >= smooth) answer = random.uniform() < 0.8 ? shape : 1 + static_cast<int>(random.below(3));
        trials.push_back({participant, static_cast<int>(trials.size()) + 1, name, radius, repetition, answer, 10});
      }
}

// 2400 and 2520 trials of five observers, made up to look like the thesis's.
inline experiments::Results simulated_study(std::uint64_t seed) {
  experiments::Results results;
  Random random(seed, "study");
  const std::array<const char*, 4> stimuli{"bump-cylinder", "bump-1p-shaded", "bump-2p-shaded", "bump-3p-shaded"};
  const std::array<double, 4> slopes{0.96, 0.5, 0.69, 0.74};
  for (int participant = 0; participant < 5; ++participant) {
    const std::string name = person_named(static_cast<std::size_t>(participant) + 1);
    const double own_slope = 0.08 * normal(random), own_variation = 0.11 + 0.03 * (random.uniform() - 0.5);
    for (std::size_t stimulus = 0; stimulus < stimuli.size(); ++stimulus)
      for (const bool vision : {false, true}) {
        const double slope = slopes[stimulus] + own_slope;
        add_matching(
            results.matching, random,
            {560 * (1 - slope), slope, own_variation, stimulus == 1 && !vision ? 5.5 : 8, 1.2, 3.0 + 0.2 * participant, 0.4},
            name, stimuli[stimulus], vision);
      }
    add_classification(results.classification, random, {58, 9, 0.2, 0.08}, name);
  }
  return results;
}

}  // namespace forceshade::analysis::tests
