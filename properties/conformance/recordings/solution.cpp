// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/recordings/solution.h"

#include <Eigen/SVD>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <unsupported/Eigen/NonLinearOptimization>

namespace forceshade::conformance {
namespace {

Misfit misfit_of(const Fitted& fitted, const Placement& first, double most) {
  return {fitted.renderer, fitted.path, fitted.samples, first, fitted.scale, fitted.unknowns, most};
}

Eigen::VectorXd first_numbers(const Misfit& misfit, double factor) {
  Eigen::VectorXd numbers = Eigen::VectorXd::Zero(misfit.inputs());
  numbers[0] = std::log(factor);
  return numbers;
}

// The number of samples that count as one independent one: 1 + 2Σρ over lags up to five times itself, as Sokal sums it.
double correlated_samples(const Eigen::VectorXd& residuals) {
  const double all = residuals.squaredNorm();
  double sum = 1;
  if (!(all > 0)) return sum;
  for (Eigen::Index lag = 1; 3 * lag < residuals.size() / 4 && static_cast<double>(lag) <= 5 * sum; ++lag) {
    const Eigen::Index count = residuals.size() - 3 * lag;
    sum += 2 * residuals.head(count).dot(residuals.tail(count)) / all;
  }
  return std::max(1.0, sum);
}

// The covariance of the sum of what each sample pushes the numbers by, with the weights of Bartlett.
Eigen::MatrixXd covariance_of_pushes(const Eigen::MatrixXd& derivatives, const Eigen::VectorXd& residuals,
                                     Eigen::Index window) {
  const Eigen::Index samples = residuals.size() / 3;
  Eigen::MatrixXd pushes(samples, derivatives.cols());
  for (Eigen::Index i = 0; i < samples; ++i)
    pushes.row(i) = residuals.segment<3>(3 * i).transpose() * derivatives.middleRows<3>(3 * i);
  Eigen::MatrixXd sum = pushes.transpose() * pushes;
  for (Eigen::Index lag = 1; lag <= std::min(window, samples - 1); ++lag) {
    const Eigen::MatrixXd product = pushes.topRows(samples - lag).transpose() * pushes.bottomRows(samples - lag);
    sum += (1 - static_cast<double>(lag) / static_cast<double>(window + 1)) * (product + product.transpose());
  }
  return sum;
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

RestForce rest_force_of(const std::vector<Measured>& samples) {
  constexpr std::size_t kLooked = 400;
  const std::size_t step = (samples.size() + kLooked - 1) / kLooked;
  std::vector<Eigen::Vector3d> forces;
  for (std::size_t i = 0; i < samples.size(); i += step) forces.push_back(samples[i].force);

  double closest = std::numeric_limits<double>::infinity();
  RestForce rest;
  for (const Eigen::Vector3d& each : forces) {
    std::vector<double> distances;
    for (const Eigen::Vector3d& other : forces) distances.push_back((other - each).norm());
    const auto tenth = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 10);
    std::ranges::nth_element(distances, tenth);
    if (!(*tenth < closest)) continue;
    closest = *tenth;
    rest = {each, closest};
  }
  // The mean of those within four standard deviations, which are then known better. Without noise a tenth of the forces are one
  // number, and a mean of it may be rounded to none of them.
  for (int round = 0; round < 10 && rest.noise > 0; ++round) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double squares = 0, count = 0;
    for (const Eigen::Vector3d& each : forces) {
      if ((each - rest.force).norm() > 4 * rest.noise) continue;
      sum += each;
      squares += (each - rest.force).squaredNorm();
      ++count;
    }
    rest = {sum / count, std::min(2 * rest.noise, std::sqrt(squares / count / 3))};
  }
  return rest;
}

double doubt_of(const Eigen::Vector3d& offset, const std::vector<RestForce>& rests, double largest) {
  double doubt = 1e-3 * largest;
  for (const RestForce& rest : rests) doubt = std::min(doubt, (offset - rest.force).norm());
  return std::max(doubt, 1e-6 * largest);
}

FitErrors fit_errors_of(const Eigen::MatrixXd& derivatives, const Eigen::VectorXd& residuals, double force, double rounding) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(derivatives, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::Index count = derivatives.cols();
  const double values = static_cast<double>(residuals.size()), together = correlated_samples(residuals);
  const double freedoms = std::max(1.0, values - static_cast<double>(count));
  const double deviation = std::sqrt(residuals.squaredNorm() / freedoms);
  const double least = std::max(1e-2 * force * std::sqrt(values / 3), 10 * deviation);

  FitErrors errors{Eigen::VectorXd::Zero(count), Eigen::VectorXd::Zero(count)};
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Eigen::VectorXd direction = svd.matrixV().col(i);
    if (const double singular = svd.singularValues()[i]; singular > least)
      inverse += direction * direction.transpose() / (singular * singular);
    else
      errors.free += direction.cwiseAbs2();
  }
  const auto with_window = [&](double samples) -> Eigen::VectorXd {
    const Eigen::MatrixXd pushes = covariance_of_pushes(derivatives, residuals, static_cast<Eigen::Index>(std::ceil(samples)));
    return values / freedoms * (inverse * pushes * inverse).diagonal();
  };
  const Eigen::VectorXd plain = deviation * deviation * together * inverse.diagonal();
  const Eigen::VectorXd robust = with_window(6 * together).cwiseMax(together * with_window(0));
  constexpr double kOneSide = 0.99996833;  // of the normal distribution: four standard deviations
  const boost::math::students_t student(std::max(2.0, values / together - static_cast<double>(count)));
  errors.error = boost::math::quantile(student, kOneSide) * plain.cwiseMax(robust).cwiseMax(0).cwiseSqrt() +
                 rounding * std::sqrt(values) * inverse.diagonal().cwiseSqrt();
  return errors;
}

// A cardinal cubic spline through independent noise of positions, which is noise of forces with the variance e, has 0.76 e
// halfway between two samples, and there a slope with 3.42 e/T^2. So the mean square of residuals at a lag t from the true one,
// which is at a sample, is about a t^2 + e (0.88 + 0.12 cos 2 pi t / T), and where it is least, |t| <= 0.12 pi e / (a T).
double pull_of_noisy_positions(const Eigen::VectorXd& slopes, const Eigen::VectorXd& residuals,
                               const std::vector<Measured>& samples) {
  double slope = 0, squares = 0, rest = 0, interval = 0;
  Eigen::Index contacts = 0;
  for (Eigen::Index i = 0; i < residuals.size(); i += 3) {
    const bool is_rest = slopes.segment<3>(i).isZero(0);
    contacts += is_rest ? 0 : 1;
    interval += samples[static_cast<std::size_t>(i / 3)].interval / static_cast<double>(samples.size());
    slope += slopes.segment<3>(i).squaredNorm();
    (is_rest ? rest : squares) += residuals.segment<3>(i).squaredNorm();
  }
  const Eigen::Index rests = residuals.size() / 3 - contacts;
  if (contacts == 0 || !(slope > 0) || !(interval > 0)) return 0;
  const auto mean = [](double sum, Eigen::Index count) { return count > 0 ? sum / static_cast<double>(count) : 0; };
  const double noise = std::max(0.0, mean(squares, contacts) - mean(rest, rests)) / 0.76;
  const double own_slope = mean(slope, contacts) - 3.42 * noise / (interval * interval);
  return std::min(interval / 2, own_slope > 0 ? 0.12 * std::numbers::pi * noise / (own_slope * interval) : interval);
}

Eigen::MatrixXd without_weak_forces(Eigen::MatrixXd derivatives, double least) {
  for (Eigen::Index i = 0; i < derivatives.rows(); i += 3)
    if (derivatives.block<3, 1>(i, 0).norm() <= least) derivatives.middleRows<3>(i).setZero();
  return derivatives;
}

}  // namespace forceshade::conformance
