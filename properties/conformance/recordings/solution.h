// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The best place of a recording near another, by the method of Levenberg and Marquardt.

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "properties/conformance/recordings/fit_beginning.h"
#include "properties/conformance/recordings/misfit.h"
#include "properties/conformance/recordings/recording.h"

namespace forceshade::conformance {

// The numbers that are fitted, and the samples that they are fitted to. All of it is to outlive the call.
struct Fitted {
  const Renderer& renderer;
  const RecordedPath& path;
  const Samples& samples;
  const Scale& scale;
  const Unknowns& unknowns;
};

struct Solution {
  Placement placement;
  double factor = 1, rms = std::numeric_limits<double>::infinity();  // on the stiffness; N
  Eigen::VectorXd residuals = {};                                    // N, none of them shortened

  Beginning beginning() const { return {placement, factor}; }
};

Solution solution_at(const Fitted& fitted, const Beginning& place);

// The derivatives of the residuals, as Misfit has them.
Eigen::MatrixXd derivatives_at(const Fitted& fitted, const Solution& place);

inline constexpr double kAnySize = std::numeric_limits<double>::infinity();

// most: N, as Misfit has it, or kAnySize. tolerance: by which share numbers and residuals may still change in the last step.
Solution solved(const Fitted& fitted, const Beginning& from, double most, double tolerance);

// Those that differ by more than the accuracy of a beginning, the best one first.
std::vector<Solution> different(std::vector<Solution> all);

// Finds the force sensor's reading out of contact, before the place of the surface is known.

struct RestForce {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  // N
  double noise = 0;                                 // N, the standard deviation of a component
};

// The force around which a tenth of the samples lie closest together: a hand in the air feels the same force wherever it is. Of
// a hand that never leaves the surface it is some force. There is one sample at least, and all forces are finite.
RestForce rest_force_of(const std::vector<Measured>& samples);

// The distance (N) that the fitted offset may have from what the sensor reads of no force: that from the nearest of these, at
// least a millionth and at most a thousandth of the largest force. No fit finds it to the last digit, nor noisy positions to
// many.
double doubt_of(const Eigen::Vector3d& offset, const std::vector<RestForce>& rests, double largest);

// The errors of a fit's numbers that its samples leave.

struct FitErrors {
  Eigen::VectorXd error;  // of each number, in its unit
  Eigen::VectorXd free;   // from 0 to 1: how much of each number the samples do not determine
};

// derivatives: of the residuals (N, three of each sample, in the order of time), by the numbers in their units, each of which
// changes the forces by about themselves. force: N, root mean square of a sample. rounding: N, the worst that one residual may
// be off by in the same sense as all others.
//
// A direction of the numbers is not determined if moving by its unit changes forces by less than 1 %, or by less than ten
// standard deviations of one residual. The errors of the others are four standard errors, or what is as likely in Student's
// distribution of as many independent samples, with the largest of three variances: that of independent residuals, times how
// many samples their autocorrelation lasts; that of what each sample pushes the numbers by, so that noise which is larger in
// contact counts where it is, times the same; and that of Newey and West, which sums the products of neighbours' pushes.
FitErrors fit_errors_of(const Eigen::MatrixXd& derivatives, const Eigen::VectorXd& residuals, double force, double rounding);

// The most (s) by which a fit's lag is pulled towards the middle between two samples: a spline through noisy positions has less
// noise there than at a sample. slopes: of the residuals by the lag, 0 where there is no force, so that the residuals there are
// the noise of forces, and what those in contact have more is that of positions.
double pull_of_noisy_positions(const Eigen::VectorXd& slopes, const Eigen::VectorXd& residuals,
                               const std::vector<Measured>& samples);

// The derivatives, with zeros for the samples whose force, which is the first column, is at most `least` (N).
Eigen::MatrixXd without_weak_forces(Eigen::MatrixXd derivatives, double least);

}  // namespace forceshade::conformance
