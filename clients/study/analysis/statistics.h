// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The numbers of the thesis's tables 6.1 to 6.8 (section 6.1.1), of any set of matching trials.

#include <cstddef>
#include <vector>

#include "study/analysis/bootstrap.h"
#include "study/experiments/results.h"

namespace forceshade::analysis {

// A trial's numbers, which in a resample need not be whole.
struct TrialNumbers {
  double reference, final;  // radii, mil
  double satisfaction, steps;
};

std::vector<TrialNumbers> numbers_of(const std::vector<experiments::MatchingResult>& trials);

// mil: final = intercept + slope * reference
struct Line {
  double slope = kUndefined, intercept = kUndefined;
};

// NaN: undefined. A slope needs two reference radii, a standard deviation two trials at every reference radius, the means one
// trial.
struct MatchingSummary {
  Line line;  // of least squares, through all trials
  // At each reference radius, the standard deviation of the final radii in percent of their mean; averaged. It divides by n -
  // 1, which the thesis does not say.
  double sd_percent;
  double satisfaction;  // mean
  double steps;         // mean number of changes of the radius
};

// The summary of the trials at these places, each as often as it is named.
MatchingSummary summary_of(const std::vector<TrialNumbers>& trials, const std::vector<std::size_t>& rows);

// The "varper" that the thesis prints beside each scatter plot: one reference radius, mil, and the percentage there.
struct Spread {
  double reference;
  double mean, sd_percent;
};

// The spreads in ascending order of the reference radius.
std::vector<Spread> spreads_of(const std::vector<TrialNumbers>& trials, const std::vector<std::size_t>& rows);

// The source of resamples of trials: rows of `trials`, in strata that correspond to those of the data.
struct ResidualWorld {
  std::vector<TrialNumbers> trials;
  std::vector<Stratum> strata;
  std::vector<std::size_t> draws;  // as many as the stratum of the data has trials
  // True where each participant has two trials at some reference radius. Else nothing shows how far a trial of theirs deviates.
  bool is_determined = true;
};

// Resampling of residuals (Davison and Hinkley 1997, section 3.2). A stratum holds the trials of one participant at one
// reference radius; `people` has one number for each stratum, the same for strata of the same participant. A drawn trial has
// the stratum's mean plus a deviation from the mean that any of the participant's trials had, at any radius, scaled to the
// stratum's own standard deviation, which divides by n - 1; that of a stratum of one trial is the participant's, of all strata.
// Deviations of the radius are compared in percent of the mean. So
// the shape of the distribution is that of all of a participant's trials: 12 trials alone have shorter tails than what they
// were drawn from, and intervals for a standard deviation would be too short. At each reference radius the participants' mean
// radii are drawn together until the variance between them is the unbiased estimate: as observed it holds the errors of the
// means, which resampling adds once more.
ResidualWorld residual_world(const std::vector<TrialNumbers>& trials, const std::vector<Stratum>& strata,
                             const std::vector<std::size_t>& people);

}  // namespace forceshade::analysis
