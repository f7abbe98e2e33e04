// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/recordings/solution.h"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/NonLinearOptimization>

namespace forceshade::conformance {
namespace {

constexpr double kAnySize = std::numeric_limits<double>::infinity();

Misfit misfit_of(const Fitted& fitted, const Placement& first, double most) {
  return {fitted.renderer, fitted.path, fitted.samples, first, fitted.scale, fitted.unknowns, most};
}

Eigen::VectorXd first_numbers(const Misfit& misfit, double factor) {
  Eigen::VectorXd numbers = Eigen::VectorXd::Zero(misfit.inputs());
  numbers[0] = std::log(factor);
  return numbers;
}

}  // namespace

Solution solution_at(const Fitted& fitted, const Beginning& place) {
  const Misfit misfit = misfit_of(fitted, place.placement, kAnySize);
  Solution found{place.placement, place.factor};
  misfit(first_numbers(misfit, place.factor), found.residuals);
  found.rms = std::sqrt(found.residuals.squaredNorm() / static_cast<double>(fitted.samples.size()));
  return found;
}

Eigen::MatrixXd derivatives_at(const Fitted& fitted, const Solution& place) {
  const Misfit misfit = misfit_of(fitted, place.placement, kAnySize);
  Eigen::MatrixXd derivatives;
  misfit.df(first_numbers(misfit, place.factor), derivatives);
  return derivatives;
}

Solution solved(const Fitted& fitted, const Beginning& from, double most, double tolerance) {
  Misfit misfit = misfit_of(fitted, from.placement, most);
  Eigen::VectorXd numbers = first_numbers(misfit, from.factor);
  Eigen::LevenbergMarquardt<Misfit> search(misfit);
  search.parameters.xtol = search.parameters.ftol = tolerance;
  search.minimize(numbers);
  return solution_at(fitted, {misfit.placement(numbers), Misfit::factor(numbers)});
}

std::vector<Solution> different(std::vector<Solution> all) {
  constexpr double kShare = 1e-3, kShift = 0.02;  // mm
  std::ranges::sort(all, {}, &Solution::rms);
  const auto is_same = [](const Solution& one, const Solution& other) {
    return other.rms - one.rms <= kShare * one.rms && std::fabs(other.factor - one.factor) <= kShare * one.factor &&
           (other.placement.turn - one.placement.turn).norm() <= kShare &&
           (other.placement.shift - one.placement.shift).norm() <= kShift;
  };
  all.erase(std::ranges::unique(all, is_same).begin(), all.end());
  return all;
}

}  // namespace forceshade::conformance
