// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/recordings/fit.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <unsupported/Eigen/NonLinearOptimization>

#include "properties/binary32.h"
#include "properties/conformance/recordings/misfit.h"
#include "properties/conformance/recordings/words.h"

namespace forceshade::conformance {
namespace {

constexpr std::size_t kLeastContacts = 7;
constexpr std::size_t kMostSamples = 5000, kTriedSamples = 200;     // that are fitted, and that a beginning is tried on
constexpr std::size_t kPlaces = 64, kTurns = 24, kBeginnings = 16;  // of each that is laid
constexpr int kRounds = 2, kLimits = 20;
constexpr double kOtherStiffness = 0.1;
constexpr double kLessLimit = 0.99, kAnySize = std::numeric_limits<double>::infinity();

using Samples = std::vector<Measured>;

// At most so many of them, evenly.
Samples thinned(const Samples& samples, std::size_t most) {
  const std::size_t step = (samples.size() + most - 1) / most;
  Samples some;
  for (std::size_t i = 0; i < samples.size(); i += step) some.push_back(samples[i]);
  return some;
}

// A point on the surface of the scene, and the direction of the force there.
struct Spot {
  Eigen::Vector3d point, direction;
};

std::vector<Spot> spots_of(const properties::Subject& subject, float stiffness, std::uint64_t seed) {
  const auto positions = subject.positions(seed);
  const auto session = subject.renderer().open();
  std::vector<Spot> spots;
  for (int i = 0; i < 100000 && spots.size() < kPlaces; ++i) {
    const properties::Aimed aimed = positions->next();
    const fast::Evaluation answer = session->step(aimed.position);
    const bool is_near = aimed.aim == properties::Aim::volume || aimed.aim == properties::Aim::surface;
    if (!is_near || answer.status != Status::contact || !(answer.force.norm() > 0)) continue;
    const Eigen::Vector3d force = answer.force.cast<double>();
    spots.push_back({aimed.position.cast<double>() + force / static_cast<double>(stiffness), force.normalized()});
  }
  return spots;
}

// How well the renderer's forces explain the measured ones at best, with any factor.
struct Beginning {
  Placement placement;
  double factor = 0, share = 1;  // of the squared force that is left
};

Beginning tried(const Renderer& renderer, const Samples& samples, const Placement& placement) {
  const Eigen::VectorXd forces = rendered_forces(renderer, samples, placement);
  double both = 0, measured = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    both += samples[i].force.dot(forces.segment<3>(3 * static_cast<Eigen::Index>(i)));
    measured += samples[i].force.squaredNorm();
  }
  const double size = forces.squaredNorm();
  if (!(size > 0)) return {placement};
  return {placement, both / size, 1 - both * both / (size * measured)};
}

class Fitting {
 public:
  Fitting(const Measurements& measured, const properties::Subject& subject, float stiffness, const FitOptions& options,
          const Monitor& monitor)
      : measured_(measured),
        subject_(subject),
        stiffness_(static_cast<double>(stiffness)),
        options_(options),
        monitor_(monitor) {}

  Fit run() {
    Samples usable;
    for (const Measured& each : measured_.samples)
      if (each.force.allFinite()) usable.push_back(each);
    for (const Measured& each : usable)
      if (is_contact(each)) contacts_.push_back(each);
    if (contacts_.size() < kLeastContacts) {
      const std::string where =
          contacts_.empty() ? "" : ", the first one at " + measured_.file + ':' + std::to_string(contacts_.front().line);
      return refused("expected " + std::to_string(kLeastContacts) + " samples in contact at least, with a force of more than " +
                     brief(options_.noise) + " N, got " + std::to_string(contacts_.size()) + where);
    }
    for (const Measured& each : contacts_) middle_ += each.position / static_cast<double>(contacts_.size());
    for (const Measured& each : contacts_) lever_ = std::max(lever_, (each.position - middle_).norm());
    if (lever_ == 0) return refused("all samples in contact are at one position; expected a hand that moves");

    std::ranges::sort(contacts_, {}, [](const Measured& each) { return each.force.norm(); });
    const Samples some = thinned(usable, kTriedSamples), all = thinned(usable, kMostSamples);
    Solution best;
    double laid_at = 0;
    // Once more where the samples were laid at a wrong depth, since the recording's stiffness was not known.
    for (int round = 0; round < kRounds && std::fabs(best.factor * stiffness_ / laid_at - 1) > kOtherStiffness; ++round) {
      laid_at = best.factor * stiffness_;
      const std::vector<Beginning> beginnings = beginnings_of(some, laid_at);
      if (round == 0 && beginnings.empty())
        return refused("no placement of the subject has a force where the recording has one");
      if (round == 0 && beginnings.front().factor < 0)
        return refused("the stiffness that fits best is below zero: the forces pull towards the surface");
      for (const Beginning& each : beginnings) {
        if (each.factor < 0) continue;
        const Solution solution = settled(some, each);
        if (solution.rms < best.rms) best = solution;
      }
    }
    return trimmed(all, best);
  }

 private:
  struct Solution {
    Placement placement;
    double factor = 1, rms = std::numeric_limits<double>::infinity();
    Eigen::VectorXd residuals = {};
    Eigen::MatrixXd derivatives = {};
  };

  bool is_contact(const Measured& sample) const { return sample.force.norm() > options_.noise; }

  static Fit refused(const std::string& words) {
    Fit fit;
    fit.refusal = words;
    return fit;
  }

  // The best one first. stiffness: N/mm, of the recording.
  std::vector<Beginning> beginnings_of(const Samples& some, double stiffness) const {
    std::vector<Beginning> all;
    for (const std::size_t quarter : {1U, 2U, 3U}) {
      const std::vector<Beginning> best = search(some, contacts_[quarter * contacts_.size() / 4], stiffness);
      all.insert(all.end(), best.begin(), best.end());
    }
    std::ranges::sort(all, {}, &Beginning::share);
    return all;
  }

  // One sample of the recording is laid below a spot of the scene, as deep as its force says, with its force in the direction
  // of the force there, and is turned about this direction in steps. Also with the opposite force, by which attraction is
  // found. The best ones, the best one first.
  std::vector<Beginning> search(const Samples& some, const Measured& laid, double stiffness) const {
    std::vector<Beginning> best;
    const auto consider = [&](const Eigen::Matrix3d& turn, const Spot& spot, double sign) {
      const Eigen::Vector3d there = spot.point - laid.force.norm() / stiffness * spot.direction;
      const Beginning next = tried(subject_.renderer(), some, {turn, there - turn * laid.position});
      if (next.factor * sign > 0) best.push_back(next);
    };
    for (const Spot& spot : spots_of(subject_, static_cast<float>(stiffness_), options_.seed)) {
      monitor_.at(0);
      for (const double sign : {1.0, -1.0}) {
        if (options_.turn) {
          consider(*options_.turn, spot, sign);
          continue;
        }
        const Eigen::Matrix3d onto = Eigen::Quaterniond::FromTwoVectors(sign * laid.force, spot.direction).toRotationMatrix();
        for (std::size_t i = 0; i < kTurns; ++i) {
          const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(kTurns);
          consider(Eigen::AngleAxisd(angle, spot.direction) * onto, spot, sign);
        }
      }
      std::ranges::sort(best, {}, &Beginning::share);
      best.resize(std::min(best.size(), kBeginnings));
    }
    return best;
  }

  // most: N, as Misfit has it.
  Solution solved(const Samples& samples, const Beginning& from, double most = kAnySize) const {
    Misfit misfit(subject_.renderer(), samples, from.placement, middle_, lever_, !options_.turn, most);
    Eigen::VectorXd numbers = Eigen::VectorXd::Zero(misfit.inputs());
    numbers[0] = std::log(from.factor);
    Eigen::LevenbergMarquardt<Misfit> search(misfit);
    search.parameters.xtol = search.parameters.ftol = 1e-12;
    search.minimize(numbers);
    monitor_.at(0);
    return at(samples, {misfit.placement(numbers), Misfit::factor(numbers)});
  }

  Solution at(const Samples& samples, const Beginning& place) const {
    const Misfit misfit(subject_.renderer(), samples, place.placement, middle_, lever_, !options_.turn, kAnySize);
    Eigen::VectorXd numbers = Eigen::VectorXd::Zero(misfit.inputs());
    numbers[0] = std::log(place.factor);
    Solution found{place.placement, place.factor};
    misfit(numbers, found.residuals);
    misfit.df(numbers, found.derivatives);
    found.rms = std::sqrt(found.residuals.squaredNorm() / static_cast<double>(samples.size()));
    return found;
  }

  // A sample that is far off the others counts as one at a limit, which becomes smaller as the fit becomes better: neither a
  // fault in some samples, nor a sample that a small shift moves over a jump of the force, spoils the fit of the rest.
  Solution settled(const Samples& samples, const Beginning& from) const {
    Solution best = solved(samples, from);
    double most = kAnySize;
    for (int i = 0; i < kLimits; ++i) {
      const double next = limit(samples, best.residuals);
      if (!(next < kLessLimit * most)) break;
      most = next;
      best = solved(samples, {best.placement, best.factor}, most);
    }
    return best;
  }

  // The fit without the samples beyond the limit.
  Fit trimmed(const Samples& all, const Solution& from) const {
    const Solution best = settled(all, {from.placement, from.factor});
    const double most = limit(all, best.residuals);
    Samples kept;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (best.residuals.segment<3>(3 * static_cast<Eigen::Index>(i)).norm() <= most) kept.push_back(all[i]);
    return stated(all.size(), kept, at(kept, {best.placement, best.factor}));
  }

  // Five standard deviations, if the half of the samples in contact that fits better is normally distributed; no less than
  // what positions and forces are rounded by.
  double limit(const Samples& samples, const Eigen::VectorXd& residuals) const {
    std::vector<double> sizes;
    double largest = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (!is_contact(samples[i])) continue;
      sizes.push_back(residuals.segment<3>(3 * static_cast<Eigen::Index>(i)).norm());
      largest = std::max(largest, samples[i].force.norm());
    }
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    return std::max(5 * 1.4826 * *middle, 1e-5 * largest);
  }

  Fit stated(std::size_t samples, const Samples& kept, const Solution& best) const {
    Fit fit;
    fit.placement = best.placement;
    fit.stiffness = best.factor * stiffness_;
    fit.samples = kept.size();
    fit.outliers = samples - kept.size();
    fit.contacts =
        static_cast<std::size_t>(std::ranges::count_if(kept, [&](const Measured& each) { return is_contact(each); }));
    fit.rms = best.rms;
    double force = 0;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      force += kept[i].force.squaredNorm() / static_cast<double>(kept.size());
      const double size = best.residuals.segment<3>(3 * static_cast<Eigen::Index>(i)).norm();
      if (size < fit.largest) continue;
      fit.largest = size;
      fit.largest_at = kept[i].line;
    }
    force = std::sqrt(force);
    if (fit.contacts < kLeastContacts || !(fit.rms <= force / 2))
      return refused("the subject does not explain these forces: the best fit leaves " + brief(fit.rms) + " N of " +
                     brief(force) + " N (root mean square)");
    determine(fit, best, force, kept.size());
    return fit;
  }

  // The directions in which the seven numbers can go without a change of the forces, and the errors in the others.
  void determine(Fit& fit, const Solution& best, double force, std::size_t samples) const {
    const Eigen::Index count = best.derivatives.cols();
    // In the units 100 % of stiffness and the lever, in mm, moving by one unit changes the forces by about themselves.
    Eigen::VectorXd units = Eigen::VectorXd::Constant(count, lever_);
    units[0] = 1;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(best.derivatives * units.asDiagonal(),
                                                Eigen::ComputeThinU | Eigen::ComputeThinV);
    const double freedoms = std::max<double>(1, static_cast<double>(best.residuals.size() - count));
    const double deviation = std::sqrt(best.residuals.squaredNorm() / freedoms);
    const double least = std::max(1e-2 * force * std::sqrt(static_cast<double>(samples)), 10 * deviation);
    // The renderer rounds positions to binary32, in the worst case all of them in the same sense.
    const double farthest = (best.placement.turn * middle_ + best.placement.shift).cwiseAbs().maxCoeff() + lever_;
    const double rounding = fit.stiffness * properties::half_spacing(static_cast<float>(farthest)) *
                            std::sqrt(static_cast<double>(best.residuals.size()));
    Eigen::VectorXd variance = Eigen::VectorXd::Zero(count), free = variance;
    for (Eigen::Index i = 0; i < count; ++i) {
      const Eigen::VectorXd squares = svd.matrixV().col(i).cwiseAbs2();
      if (const double singular = svd.singularValues()[i]; singular > least)
        variance += squares * std::pow((3 * deviation + rounding) / singular, 2);
      else
        free += squares;
    }
    const Eigen::VectorXd errors = units.cwiseProduct(variance.cwiseSqrt());
    constexpr std::array kNames{"the stiffness",   "a turn about x",  "a turn about y", "a turn about z",
                                "a shift along x", "a shift along y", "a shift along z"};
    for (Eigen::Index i = 0; i < count; ++i)
      if (free[i] > 0.1) fit.undetermined.emplace_back(kNames[static_cast<std::size_t>(i == 0 ? 0 : i + 7 - count)]);
    if (free[0] > 0.1) {
      std::string words = "these samples determine neither of";
      for (const std::string& name : fit.undetermined) words += (words.ends_with("of") ? " " : " and ") + name;
      fit = refused(words + ": the same forces fit a stiffer surface elsewhere; expected contacts of different depths");
      return;
    }
    fit.stiffness_error = fit.stiffness * errors[0];
    if (count == 7) fit.turn_error = errors.segment<3>(1).norm() / lever_ * 180 / std::numbers::pi;
    fit.shift_error = errors.tail<3>().norm();
  }

  const Measurements& measured_;
  const properties::Subject& subject_;
  const double stiffness_;
  const FitOptions& options_;
  const Monitor& monitor_;
  Samples contacts_;
  Eigen::Vector3d middle_ = Eigen::Vector3d::Zero();
  double lever_ = 0;  // mm, of the sample in contact that is the farthest from the middle
};

}  // namespace

Fit fit_of(const Measurements& measured, const properties::Subject& subject, float stiffness, const FitOptions& options,
           const Monitor& monitor) {
  return Fitting(measured, subject, stiffness, options, monitor).run();
}

}  // namespace forceshade::conformance
