// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Bootstrap intervals: bias-corrected and accelerated, BCa (Efron 1987, J. Am. Stat. Assoc. 82:171-185).

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string_view>
#include <vector>

namespace forceshade::analysis {

inline constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

struct Interval {
  double low = kUndefined, high = kUndefined;  // both undefined where there is no interval

  bool is_defined() const { return low <= high; }
  bool contains(double value) const { return low <= value && value <= high; }
};

struct Estimate {
  double value = kUndefined;
  Interval interval;
};

// The units drawn with replacement. `trials`: each participant's trials within a reference radius, for statements about the
// participants who took part. `participants`: whole participants with all their trials, for statements about others like them,
// which needs many of them (clients/study/analysis.md has the measured coverage).
enum class Unit { trials, participants };

struct Resampling {
  std::uint64_t seed = 1;
  std::size_t count = 4000;  // resamples for each interval
  double level = 0.95;       // nominal coverage
  Unit unit = Unit::trials;
};

// Units of the data that are exchangeable. A unit is a set of rows, which are drawn together.
using Stratum = std::vector<std::vector<std::size_t>>;

// Several statistics of the rows that are named, some more than once; always as many. NaN: undefined for these rows.
using Statistic = std::function<std::vector<double>(const std::vector<std::size_t>& rows)>;

// One interval for each statistic. Every resample draws from each stratum as many units as it has. The bias correction counts
// the resamples below the statistic of the data, and half of those equal to it; the acceleration is that of several samples
// (Davison and Hinkley 1997, section 5.3), by the jackknife over all units. There is no interval where the statistic is
// undefined for the data, a resample or a jackknife sample, or where no stratum has two units: one trial does not show how much
// another would differ. `purpose` chooses the random stream.
std::vector<Interval> bca_intervals(const std::vector<Stratum>& strata, const Statistic& statistic,
                                    const Resampling& resampling, std::string_view purpose);

// The source of resamples where that is not the data themselves: strata of other rows, how many units to draw from each,
// and the statistic of these rows. The statistic of the data is to be the one of the whole of it, or near it.
struct World {
  std::vector<Stratum> strata;
  std::vector<std::size_t> draws;
  Statistic statistic;
};
std::vector<Interval> bca_intervals(const std::vector<Stratum>& strata, const Statistic& statistic, const World& world,
                                    const Resampling& resampling, std::string_view purpose);

// The value below which the fraction `probability` of the sorted numbers lies, interpolated between neighbours at places
// probability * (n + 1), as Efron and Tibshirani take it; the first or last number beyond them.
double quantile(const std::vector<double>& sorted, double probability);

}  // namespace forceshade::analysis
