// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The psychometric function behind theta-critical (thesis 5.2): how often a shaded bump is felt as a circular cylinder (answer
// 4), against the angle that each of its polygons subtends.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "study/analysis/bootstrap.h"
#include "study/experiments/results.h"

namespace forceshade::analysis {

// F below: 1 / (1 + exp(-t)), or the standard normal distribution.
enum class Shape { logistic, gaussian };

// The likelihood is that of a binomial number at each angle, with the probability
//   p(angle) = guess + (1 - guess - lapse) * F((threshold - angle) / scale),
// which falls from 1 - lapse, where the bump feels smooth, to guess, where its polygons are felt. theta-critical is the
// threshold, at which p is half way. Within [0, most_guess] and [0, most_lapse]; together they are below 1.
struct PsychometricModel {
  Shape shape = Shape::logistic;
  double most_guess = 0.5, most_lapse = 0.25;
};

struct AngleCount {
  double angle;  // degrees
  int chosen, trials;
};

struct PsychometricParameters {
  double threshold, scale;  // degrees, scale > 0
  double guess, lapse;
};

double probability_at(double angle, const PsychometricParameters& parameters, Shape shape);

// The maximum of the likelihood is sought from the best place of a grid for each of five scales by the simplex method of Nelder
// and Mead (1965), which is started once more from the best of the places found; refits of the bootstrap start from the fit and
// two places of the grid. A parameter x in [low, high] is searched as low + (high - low) * sin(u)^2, so that an end of its
// range can be the answer. The threshold may lie as far outside the angles as they reach, and the scale from 1/1000 to 10 times
// that reach.
struct PsychometricFit {
  PsychometricParameters parameters;
  double log_likelihood;  // without the binomial coefficients, which do not depend on the parameters
  double deviance;        // 2 * (log-likelihood of a probability of its own at each point - log_likelihood)
  bool is_at_limit;       // a parameter is at an end of its range: the data do not determine it
};

// None with fewer than four different angles: four parameters need as many.
std::optional<PsychometricFit> fit(const std::vector<AngleCount>& points, const PsychometricModel& model);

struct PsychometricEstimate {
  std::string participant;
  std::vector<AngleCount> points;
  PsychometricFit fit;
  // Intervals from the quantiles at (1 -+ level) / 2 of fits to data drawn from the fitted function (parametric bootstrap).
  Interval threshold, scale, guess, lapse;
  // Goodness of fit. The fraction of those fits with at least this deviance, the data counted as one of them; and by chi-square
  // with so many points less four degrees of freedom, which holds for many trials at each point only. NaN without such degrees.
  double p_bootstrap, p_chi_square;
};

std::optional<PsychometricEstimate> estimate(const std::string& participant, std::vector<AngleCount> points,
                                             const PsychometricModel& model, const Resampling& resampling);

// 2 asin(w / 2R) / n, degrees: n is 1, 2 or 3 for bump-1p to bump-3p, shaded or not; 0 for the circular cylinder, whose normal
// turns without steps. None for another stimulus, or where w > 2R. Any unit, the same for both.
std::optional<double> polygon_angle(std::string_view stimulus, double radius, double width);

// One point for each shaded bump or cylinder and radius, of one participant or kOverall; in the order of the angle. Several
// points may share an angle.
std::vector<AngleCount> angle_counts(const experiments::Results& results, double width, const std::string& participant);

}  // namespace forceshade::analysis
