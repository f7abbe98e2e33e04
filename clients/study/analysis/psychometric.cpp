// SPDX-License-Identifier: BSD-3-Clause
#include "study/analysis/psychometric.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "study/analysis/distributions.h"
#include "study/analysis/random.h"
#include "study/analysis/simplex.h"
#include "study/analysis/tables.h"

namespace forceshade::analysis {
namespace {

using Searched = std::array<double, 4>;  // threshold, scale, guess, lapse as angles u

struct Limits {
  std::array<double, 4> low, high;

  Limits(const std::vector<AngleCount>& points, const PsychometricModel& model) {
    const auto [first, last] = std::ranges::minmax(points, {}, &AngleCount::angle);
    const double reach = last.angle - first.angle;
    low = {first.angle - reach, reach / 1000, 0, 0};
    high = {last.angle + reach, 10 * reach, model.most_guess, model.most_lapse};
  }

  PsychometricParameters parameters(const Searched& at) const {
    std::array<double, 4> value;
    for (std::size_t i = 0; i < 4; ++i) {
      const double sine = std::sin(at[i]);
      value[i] = low[i] + (high[i] - low[i]) * sine * sine;
    }
    return {value[0], value[1], value[2], value[3]};
  }

  Searched searched(const PsychometricParameters& of) const {
    const std::array<double, 4> value{of.threshold, of.scale, of.guess, of.lapse};
    Searched at;
    for (std::size_t i = 0; i < 4; ++i)
      at[i] = high[i] == low[i] ? 0 : std::asin(std::sqrt(std::clamp((value[i] - low[i]) / (high[i] - low[i]), 0.0, 1.0)));
    return at;
  }

  bool reached_by(const PsychometricParameters& of) const {
    const std::array<double, 4> value{of.threshold, of.scale, of.guess, of.lapse};
    for (std::size_t i = 0; i < 4; ++i) {
      const double margin = 1e-6 * (high[i] - low[i]);
      if (value[i] - low[i] <= margin || high[i] - value[i] <= margin) return true;
    }
    return false;
  }
};

// y * log(p), 0 for y = 0.
double term(int count, double probability) {
  return count == 0 ? 0 : count * std::log(probability);
}

double log_likelihood(const std::vector<AngleCount>& points, const PsychometricParameters& parameters, Shape shape) {
  double sum = 0;
  for (const auto& [angle, chosen, trials] : points) {
    // Away from 0 and 1, where rounding in F could make the likelihood of what has happened 0.
    const double p = std::clamp(probability_at(angle, parameters, shape), 1e-12, 1 - 1e-12);
    sum += term(chosen, p) + term(trials - chosen, 1 - p);
  }
  return sum;
}

// The greatest that any function could reach.
double saturated(const std::vector<AngleCount>& points) {
  double sum = 0;
  for (const auto& [angle, chosen, trials] : points) {
    const double p = static_cast<double>(chosen) / trials;
    sum += term(chosen, p) + term(trials - chosen, 1 - p);
  }
  return sum;
}

constexpr std::size_t kScales = 5;  // of the grid below

struct Start {
  double value;
  PsychometricParameters parameters;
};

// The `most` best of the places of a grid that are best for their scale. A steep and a flat function are often both better than
// what lies between them.
std::vector<Start> starts(const std::vector<AngleCount>& points, const PsychometricModel& model, const Limits& limits,
                          std::size_t most) {
  const double first = limits.low[0] + (limits.high[0] - limits.low[0]) / 3, reach = (limits.high[0] - limits.low[0]) / 3;
  std::vector<Start> best;
  for (const double scale : {reach / 64, reach / 32, reach / 16, reach / 8, reach / 3}) {
    best.push_back({std::numeric_limits<double>::infinity(), {}});
    for (int step = 0; step <= 8; ++step)
      for (const double guess : {0.05, 0.5, 0.95})
        for (const double lapse : {0.05, 0.5}) {
          const PsychometricParameters at{first + reach * step / 8, scale, guess * model.most_guess, lapse * model.most_lapse};
          const double value = -log_likelihood(points, at, model.shape);
          if (value < best.back().value) best.back() = {value, at};
        }
  }
  std::ranges::stable_sort(best, {}, &Start::value);
  best.resize(std::min(best.size(), most));
  return best;
}

PsychometricFit best_of(const std::vector<AngleCount>& points, const PsychometricModel& model, const Limits& limits,
                        const std::vector<Start>& from) {
  const auto cost = [&](const Searched& at) { return -log_likelihood(points, limits.parameters(at), model.shape); };
  Vertex<4> best{{}, std::numeric_limits<double>::infinity()};
  for (const Start& start : from) {
    const Vertex<4> found = minimum<4>(cost, limits.searched(start.parameters), 0.3, 1e-6, 600);
    if (found.value < best.value) best = found;
  }
  best = minimum<4>(cost, best.at, 0.1, 1e-9, 1000);
  const PsychometricParameters parameters = limits.parameters(best.at);
  return {parameters, -best.value, std::max(2 * (saturated(points) + best.value), 0.0), limits.reached_by(parameters)};
}

bool can_be_fitted(const std::vector<AngleCount>& points) {
  std::set<double> angles;
  for (const AngleCount& point : points) angles.insert(point.angle);
  return angles.size() >= 4;
}

int drawn(Random& random, int trials, double probability) {
  int chosen = 0;
  for (int i = 0; i < trials; ++i) chosen += random.uniform() < probability;
  return chosen;
}

// The place of a parameter in Limits.
enum Place { kThreshold, kScale, kGuess, kLapse };

// The interval of one parameter. None where its ends are the same to what a search resolves: then nearly all data sets that
// were drawn are the same, or the parameter is at an end of its range in nearly all, and how far it may be from there is not
// known.
Interval quantiles(std::vector<double> values, double level, const Limits& limits, Place place) {
  std::ranges::sort(values);
  if (values.empty()) return {};
  const Interval interval{quantile(values, (1 - level) / 2), quantile(values, (1 + level) / 2)};
  return interval.high - interval.low > 1e-6 * (limits.high[place] - limits.low[place]) ? interval : Interval{};
}

}  // namespace

double probability_at(double angle, const PsychometricParameters& of, Shape shape) {
  const double t = (of.threshold - angle) / of.scale;
  const double f = shape == Shape::logistic ? 1 / (1 + std::exp(-t)) : std::erfc(-t / std::numbers::sqrt2) / 2;
  return of.guess + (1 - of.guess - of.lapse) * f;
}

std::optional<PsychometricFit> fit(const std::vector<AngleCount>& points, const PsychometricModel& model) {
  if (!can_be_fitted(points)) return std::nullopt;
  const Limits limits(points, model);
  return best_of(points, model, limits, starts(points, model, limits, kScales));
}

std::optional<PsychometricEstimate> estimate(const std::string& participant, std::vector<AngleCount> points,
                                             const PsychometricModel& model, const Resampling& resampling) {
  const std::optional<PsychometricFit> found = fit(points, model);
  if (!found) return std::nullopt;
  const Limits limits(points, model);
  Random random(resampling.seed, "psychometric/" + participant);
  std::vector<double> thresholds, scales, guesses, lapses;
  std::size_t as_large = 1;
  std::vector<AngleCount> again = points;
  for (std::size_t i = 0; i < resampling.count; ++i) {
    for (AngleCount& point : again)
      point.chosen = drawn(random, point.trials, probability_at(point.angle, found->parameters, model.shape));
    std::vector<Start> from = starts(again, model, limits, 2);
    from.push_back({0, found->parameters});
    const PsychometricFit other = best_of(again, model, limits, from);
    thresholds.push_back(other.parameters.threshold);
    scales.push_back(other.parameters.scale);
    guesses.push_back(other.parameters.guess);
    lapses.push_back(other.parameters.lapse);
    as_large += other.deviance >= found->deviance;
  }
  const double degrees = static_cast<double>(points.size()) - 4;
  return PsychometricEstimate{
      participant,
      std::move(points),
      *found,
      quantiles(thresholds, resampling.level, limits, kThreshold),
      quantiles(scales, resampling.level, limits, kScale),
      quantiles(guesses, resampling.level, limits, kGuess),
      quantiles(lapses, resampling.level, limits, kLapse),
      resampling.count == 0 ? kUndefined : static_cast<double>(as_large) / static_cast<double>(resampling.count + 1),
      degrees > 0 ? chi_square_tail(found->deviance, degrees) : kUndefined};
}

std::optional<double> polygon_angle(std::string_view stimulus, double radius, double width) {
  if (stimulus == "bump-cylinder") return 0;
  if (!stimulus.starts_with("bump-") || stimulus.size() < 7 || stimulus[6] != 'p') return std::nullopt;
  const int polygons = stimulus[5] - '0';
  const std::string_view rest = stimulus.substr(7);
  if (polygons < 1 || polygons > 3 || !(rest.empty() || rest == "-shaded") || width > 2 * radius) return std::nullopt;
  return 2 * std::asin(width / (2 * radius)) * 180 / std::numbers::pi / polygons;
}

std::vector<AngleCount> angle_counts(const experiments::Results& results, double width, const std::string& participant) {
  constexpr int kCylinder = 4;
  std::map<std::pair<std::string, double>, AngleCount> points;
  for (const experiments::ClassificationResult& trial : results.classification) {
    if (participant != kOverall && trial.participant != participant) continue;
    if (trial.stimulus != "bump-cylinder" && !trial.stimulus.ends_with("-shaded")) continue;
    const std::optional<double> angle = polygon_angle(trial.stimulus, trial.radius, width);
    if (!angle) continue;
    AngleCount& point = points.try_emplace({trial.stimulus, trial.radius}, AngleCount{*angle, 0, 0}).first->second;
    point.chosen += trial.answer == kCylinder;
    ++point.trials;
  }
  std::vector<AngleCount> list;
  list.reserve(points.size());
  for (const auto& [ignored, point] : points) list.push_back(point);
  std::ranges::stable_sort(list, {}, &AngleCount::angle);
  return list;
}

}  // namespace forceshade::analysis
