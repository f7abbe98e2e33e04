// SPDX-License-Identifier: BSD-3-Clause
#include "study/analysis/statistics.h"

#include <algorithm>
#include <cmath>

namespace forceshade::analysis {
namespace {

// Mean and sum of squared deviations, one number at a time: Welford's method, which does not cancel.
struct Moments {
  double reference = 0, count = 0, mean = 0, squares = 0;

  void add(double value) {
    ++count;
    const double before = value - mean;
    mean += before / count;
    squares += before * (value - mean);
  }
};

// Few radii: a search along them is faster than a tree.
std::vector<Moments> moments_of(const std::vector<TrialNumbers>& trials, const std::vector<std::size_t>& rows) {
  std::vector<Moments> all;
  for (const std::size_t row : rows) {
    const double reference = trials[row].reference;
    auto found = std::ranges::find(all, reference, &Moments::reference);
    if (found == all.end()) {
      all.push_back({reference});
      found = all.end() - 1;
    }
    found->add(trials[row].final);
  }
  std::ranges::sort(all, {}, &Moments::reference);  // sums must not depend on the order of the rows
  return all;
}

// Through the means, each with the weight of its trials, which is the line through all trials.
Line line_through(const std::vector<Moments>& all) {
  double count = 0, x = 0, y = 0;
  for (const Moments& one : all) {
    count += one.count;
    x += one.count * one.reference;
    y += one.count * one.mean;
  }
  x /= count;
  y /= count;
  double xx = 0, xy = 0;
  for (const Moments& one : all) {
    xx += one.count * (one.reference - x) * (one.reference - x);
    xy += one.count * (one.reference - x) * (one.mean - y);
  }
  if (!(xx > 0)) return {};
  return {xy / xx, y - xy / xx * x};
}

double percent_of(const Moments& one) {
  if (one.count < 2) return kUndefined;
  return 100 * std::sqrt(one.squares / (one.count - 1)) / one.mean;
}

// Without bias; 0 of one number, which then counts as fixed.
double variance_of(const Moments& one) {
  return one.count < 2 ? 0 : one.squares / (one.count - 1);
}

std::vector<double> means_of(const std::vector<Moments>& strata) {
  std::vector<double> means;
  for (const Moments& one : strata) means.push_back(one.mean);
  return means;
}

// The strata of one reference radius are different participants'. Of P means with the variances v the variance between them,
// which divides by P, is expected to be larger than without these errors by (P - 1) / P^2 * sum(v).
std::vector<double> drawn_together(const std::vector<Moments>& strata) {
  std::vector<double> means = means_of(strata);
  for (std::size_t k = 0; k < strata.size(); ++k) {
    double people = 0, common = 0, errors = 0, between = 0;
    const auto each = [&](auto&& add) {
      for (const Moments& one : strata)
        if (one.reference == strata[k].reference) add(one);
    };
    each([&](const Moments& one) {
      ++people;
      common += one.mean;
      errors += variance_of(one) / one.count;
    });
    common /= people;
    each([&](const Moments& one) { between += (one.mean - common) * (one.mean - common) / people; });
    if (between > 0)
      means[k] =
          common + std::sqrt(std::max(0.0, 1 - (people - 1) / (people * people) * errors / between)) * (means[k] - common);
  }
  return means;
}

}  // namespace

std::vector<TrialNumbers> numbers_of(const std::vector<experiments::MatchingResult>& trials) {
  std::vector<TrialNumbers> numbers;
  for (const experiments::MatchingResult& trial : trials)
    numbers.push_back({trial.reference_radius, trial.final_radius, static_cast<double>(trial.satisfaction),
                       static_cast<double>(trial.steps)});
  return numbers;
}

MatchingSummary summary_of(const std::vector<TrialNumbers>& trials, const std::vector<std::size_t>& rows) {
  const std::vector<Moments> all = moments_of(trials, rows);
  MatchingSummary summary{line_through(all), 0, 0, 0};
  for (const Moments& one : all) summary.sd_percent += percent_of(one) / static_cast<double>(all.size());
  if (all.empty()) summary.sd_percent = kUndefined;
  double satisfaction = 0, steps = 0;
  for (const std::size_t row : rows) {
    satisfaction += trials[row].satisfaction;
    steps += trials[row].steps;
  }
  summary.satisfaction = satisfaction / static_cast<double>(rows.size());
  summary.steps = steps / static_cast<double>(rows.size());
  return summary;
}

std::vector<Spread> spreads_of(const std::vector<TrialNumbers>& trials, const std::vector<std::size_t>& rows) {
  std::vector<Spread> spreads;
  for (const Moments& one : moments_of(trials, rows)) spreads.push_back({one.reference, one.mean, percent_of(one)});
  return spreads;
}

ResidualWorld residual_world(const std::vector<TrialNumbers>& trials, const std::vector<Stratum>& strata,
                             const std::vector<std::size_t>& people) {
  ResidualWorld world;
  world.strata.resize(strata.size());
  for (const Stratum& stratum : strata) world.draws.push_back(stratum.size());
  for (std::size_t k = 0; k < strata.size(); ++k) {
    std::size_t pooled = 0, freedom = 0;
    for (std::size_t other = 0; other < strata.size(); ++other)
      if (people[other] == people[k]) {
        pooled += strata[other].size();
        freedom += strata[other].size() - 1;
      }
    if (freedom == 0) world.is_determined = false;
    for (std::size_t i = 0; i < pooled; ++i) {
      world.strata[k].push_back({world.trials.size()});
      world.trials.push_back({trials[strata[k].front().front()].reference, 0, 0, 0});
    }
  }
  for (double TrialNumbers::*number : {&TrialNumbers::final, &TrialNumbers::satisfaction, &TrialNumbers::steps}) {
    const bool is_radius = number == &TrialNumbers::final;
    std::vector<Moments> moments;
    for (const Stratum& stratum : strata) {
      moments.push_back({trials[stratum.front().front()].reference});
      for (const std::vector<std::size_t>& unit : stratum) moments.back().add(trials[unit.front()].*number);
    }
    const std::vector<double> means = is_radius ? drawn_together(moments) : means_of(moments);
    for (std::size_t k = 0; k < strata.size(); ++k) {
      std::vector<double> deviations;
      double squares = 0, freedom = 0;
      for (std::size_t other = 0; other < strata.size(); ++other)
        if (people[other] == people[k]) {
          freedom += moments[other].count - 1;
          for (const std::vector<std::size_t>& unit : strata[other]) {
            const double deviation = trials[unit.front()].*number - moments[other].mean;
            deviations.push_back(is_radius ? deviation / moments[other].mean : deviation);
            squares += deviations.back() * deviations.back();
          }
        }
      const double size = is_radius ? moments[k].mean : 1;
      const double variance = moments[k].count < 2 ? size * size * squares / freedom : variance_of(moments[k]);
      const double scale = squares > 0 ? std::sqrt(variance * static_cast<double>(deviations.size()) / squares) : 0;
      for (std::size_t i = 0; i < deviations.size(); ++i)
        world.trials[world.strata[k][i].front()].*number = means[k] + scale * deviations[i];
    }
  }
  return world;
}

}  // namespace forceshade::analysis
