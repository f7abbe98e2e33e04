// SPDX-License-Identifier: BSD-3-Clause
#include "study/analysis/bootstrap.h"

#include <algorithm>
#include <cmath>

#include "study/analysis/distributions.h"
#include "study/analysis/random.h"

namespace forceshade::analysis {
namespace {

void append(std::vector<std::size_t>& rows, const std::vector<std::size_t>& unit) {
  rows.insert(rows.end(), unit.begin(), unit.end());
}

std::vector<std::size_t> resample(const World& world, Random& random) {
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < world.strata.size(); ++k)
    for (std::size_t i = 0; i < world.draws[k]; ++i) append(rows, world.strata[k][random.below(world.strata[k].size())]);
  return rows;
}

std::vector<std::size_t> all_but(const std::vector<Stratum>& strata, const std::vector<std::size_t>* left_out) {
  std::vector<std::size_t> rows;
  for (const Stratum& stratum : strata)
    for (const std::vector<std::size_t>& unit : stratum)
      if (&unit != left_out) append(rows, unit);
  return rows;
}

// The acceleration of each statistic: with the influence l = (n - 1) * (mean - value without the unit) of a unit among n in its
// stratum, sum(l^3 / n^3) / (6 * sum(l^2 / n^2)^1.5). NaN where a jackknife value is. 0 where no unit has an influence.
std::vector<double> accelerations(const std::vector<Stratum>& strata, const Statistic& statistic, std::size_t statistics) {
  std::vector<double> squares(statistics), cubes(statistics);
  for (const Stratum& stratum : strata) {
    if (stratum.size() < 2) continue;  // without its only unit there is no such stratum: it counts as fixed
    std::vector<std::vector<double>> without;
    std::vector<double> mean(statistics);
    const auto n = static_cast<double>(stratum.size());
    for (const std::vector<std::size_t>& unit : stratum) {
      without.push_back(statistic(all_but(strata, &unit)));
      for (std::size_t k = 0; k < statistics; ++k) mean[k] += without.back()[k] / n;
    }
    for (const std::vector<double>& values : without)
      for (std::size_t k = 0; k < statistics; ++k) {
        const double influence = (n - 1) / n * (mean[k] - values[k]);
        squares[k] += influence * influence;
        cubes[k] += influence * influence * influence;
      }
  }
  std::vector<double> result;
  for (std::size_t k = 0; k < statistics; ++k)
    result.push_back(squares[k] == 0 ? 0 : cubes[k] / (6 * std::pow(squares[k], 1.5)));
  return result;
}

Interval bca(double value, std::vector<double> resampled, double acceleration, double level) {
  const auto is_undefined = [](double number) { return !std::isfinite(number); };
  if (is_undefined(value) || is_undefined(acceleration) || std::ranges::any_of(resampled, is_undefined)) return {};
  std::ranges::sort(resampled);
  const auto count = static_cast<double>(resampled.size());
  double below = 0;
  for (const double other : resampled) below += other < value ? 1 : other == value ? 0.5 : 0;
  // All on one side: the correction is as large as so many resamples can show.
  const double bias = normal_quantile(std::clamp(below / count, 0.5 / count, 1 - 0.5 / count));
  const auto end = [&](double probability) {
    const double z = bias + normal_quantile(probability), divisor = 1 - acceleration * z;
    // Beyond the pole, which only very skewed small samples reach, the outermost resample stands.
    if (divisor <= 0) return z < 0 ? resampled.front() : resampled.back();
    return quantile(resampled, normal_cdf(bias + z / divisor));
  };
  return {end((1 - level) / 2), end((1 + level) / 2)};
}

}  // namespace

double quantile(const std::vector<double>& sorted, double probability) {
  const double place =
      std::clamp(probability * static_cast<double>(sorted.size() + 1) - 1, 0.0, static_cast<double>(sorted.size() - 1));
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double fraction = place - static_cast<double>(below);
  return sorted[below] + fraction * (sorted[above] - sorted[below]);
}

std::vector<Interval> bca_intervals(const std::vector<Stratum>& strata, const Statistic& statistic,
                                    const Resampling& resampling, std::string_view purpose) {
  std::vector<std::size_t> sizes;
  sizes.reserve(strata.size());
  for (const Stratum& stratum : strata) sizes.push_back(stratum.size());
  return bca_intervals(strata, statistic, World{strata, sizes, statistic}, resampling, purpose);
}

std::vector<Interval> bca_intervals(const std::vector<Stratum>& strata, const Statistic& statistic, const World& world,
                                    const Resampling& resampling, std::string_view purpose) {
  const std::vector<double> values = statistic(all_but(strata, nullptr));
  const bool has_units = std::ranges::any_of(strata, [](const Stratum& stratum) { return stratum.size() > 1; });
  if (!has_units || resampling.count == 0) return std::vector<Interval>(values.size());
  Random random(resampling.seed, purpose);
  std::vector<std::vector<double>> resampled(values.size());
  for (std::size_t i = 0; i < resampling.count; ++i) {
    const std::vector<double> again = world.statistic(resample(world, random));
    for (std::size_t k = 0; k < values.size(); ++k) resampled[k].push_back(again[k]);
  }
  const std::vector<double> acceleration = accelerations(strata, statistic, values.size());
  std::vector<Interval> intervals;
  for (std::size_t k = 0; k < values.size(); ++k)
    intervals.push_back(bca(values[k], std::move(resampled[k]), acceleration[k], resampling.level));
  return intervals;
}

}  // namespace forceshade::analysis
