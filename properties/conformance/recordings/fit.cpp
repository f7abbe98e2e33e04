// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/recordings/fit.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <variant>

#include "properties/binary32.h"
#include "properties/conformance/recordings/fit_beginning.h"
#include "properties/conformance/recordings/misfit.h"
#include "properties/conformance/recordings/solution.h"
#include "properties/conformance/recordings/words.h"
#include "rendering/mesh_rendering.h"

namespace forceshade::conformance {
namespace {

constexpr std::size_t kLeastContacts = 7;
constexpr std::size_t kMostSamples = 5000, kTriedSamples = 200;  // that are fitted, and that a beginning is tried on
constexpr std::size_t kTurns = 24, kBeginnings = 16;             // of each that is laid
constexpr int kRounds = 2, kLimits = 20, kLags = 20;
constexpr double kLagStep = 0.005;  // s
constexpr double kFree = 0.1, kAsGood = 1.1, kLittle = 1e-3;
constexpr double kNear = 0.02;  // mm
constexpr const char* kNeverLeaves =
    "the hand never leaves the surface, or hardly, so that the sensor's reading of no force is unknown; expected samples "
    "out of contact, or --offset 0,0,0 for a sensor that was zeroed";
constexpr double kOtherStiffness = 0.1;
constexpr double kNearly = 1e-6, kExactly = 1e-12;  // by how much of themselves numbers and residuals still change at the end
constexpr double kLessLimit = 0.99;

class Fitting {
 public:
  Fitting(const Measurements& measured, const properties::Subject& subject, float stiffness, const FitOptions& options,
          const Monitor& monitor)
      : measured_(measured),
        subject_(subject),
        stiffness_(static_cast<double>(stiffness)),
        options_(options),
        monitor_(monitor),
        path_(measured.samples),
        speed_(usual_speed_of(measured)),
        spots_(spots_of(subject, stiffness, options.seed)) {}

  Fit run() {
    Samples usable;
    for (const Measured& each : measured_.samples)
      if (each.force.allFinite()) usable.push_back(each);
    if (usable.empty()) return refused("no force is a number");
    const Samples some = thinned(usable, kTriedSamples), all = thinned(usable, kMostSamples);
    // A sensor that was zeroed, or what it seems to read where nothing is touched.
    std::vector<RestForce> rests{{options_.offset.value_or(Eigen::Vector3d::Zero()), 0}};
    if (!options_.offset)
      if (const RestForce rest = rest_force_of(usable); rest.force.norm() > options_.noise) rests.push_back(rest);
    Solution best;
    std::optional<RestForce> best_rest;
    std::vector<Solution> solutions;
    std::optional<std::string> refusal;
    for (const RestForce& rest : rests) {
      const std::variant<Solution, std::string> next = begun(usable, some, rest);
      if (const auto* words = std::get_if<std::string>(&next)) {
        if (!refusal) refusal = *words;
      } else {
        solutions.push_back(std::get<Solution>(next));
        if (!(solutions.back().rms < best.rms)) continue;
        best = solutions.back();
        best_rest = rest;
      }
    }
    if (!best_rest) return refused(refusal.value_or("no placement of the subject explains a force of the recording"));
    look_for_contacts(usable, {best.placement.offset, best_rest->noise});
    if (!options_.offset)
      look_for_contacts(usable, {rest_, std::max(best_rest->noise, doubt_of(rest_, rests, largest_force()))});
    Fit fit = trimmed(all, best);
    if (options_.offset || fit.refusal) return fit;
    for (const Solution& other : solutions)
      if (const Eigen::Vector3d off = (other.placement.offset - fit.placement.offset).cwiseAbs();
          other.rms < kAsGood * best.rms + kLittle * largest_force() && (off - 3 * fit.offset_error).maxCoeff() > kLittle)
        return refused("two offsets of the sensor explain these forces, " + shown(fit.placement.offset) + " N and " +
                       shown(other.placement.offset) + " N: " + kNeverLeaves);
    return fit;
  }

 private:
  // With noise at rest that is not declared, a force is one of contact above four standard deviations.
  void look_for_contacts(const Samples& usable, const RestForce& rest) {
    rest_ = rest.force;
    least_ = std::max(options_.noise, 4 * rest.noise);
    contacts_.clear();
    for (const Measured& each : usable)
      if (is_contact(each)) contacts_.push_back(each);
    scale_ = {};
    const auto count = static_cast<double>(contacts_.size());
    for (const Measured& each : contacts_) scale_.middle += each.position / count;
    for (const Measured& each : contacts_) scale_.lever = std::max(scale_.lever, (each.position - scale_.middle).norm());
    scale_.speed = speed_;
  }

  double largest_force() const {
    double largest = 0;
    for (const Measured& each : contacts_) largest = std::max(largest, (each.force - rest_).norm());
    return largest;
  }

  // The best solution that a search on some samples finds, or the reason why it finds nothing.
  std::variant<Solution, std::string> begun(const Samples& usable, const Samples& some, const RestForce& rest) {
    look_for_contacts(usable, rest);
    if (contacts_.size() < kLeastContacts) {
      const std::string where =
          contacts_.empty() ? "" : ", the first one at " + measured_.file + ':' + std::to_string(contacts_.front().line);
      return "expected " + std::to_string(kLeastContacts) + " samples in contact at least, with a force of more than " +
             brief(least_) + " N, got " + std::to_string(contacts_.size()) + where;
    }
    if (scale_.lever == 0) return "all samples in contact are at one position; expected a hand that moves";
    std::ranges::sort(contacts_, {}, [&](const Measured& each) { return (each.force - rest_).norm(); });
    Solution best;
    double laid_at = 0;
    // Once more where the samples were laid at a wrong depth, since the recording's stiffness was not known.
    for (int round = 0; round < kRounds && std::fabs(best.factor * stiffness_ / laid_at - 1) > kOtherStiffness; ++round) {
      laid_at = best.factor * stiffness_;
      const std::vector<Beginning> beginnings = beginnings_of(some, laid_at);
      if (round == 0 && beginnings.empty()) return "no placement of the subject has a force where the recording has one";
      for (const Solution& each : first_solutions(some, beginnings)) {
        if (!(each.rms < best.rms)) break;
        if (const Solution solution = settled(some, each, unknowns(), kNearly); solution.rms < best.rms) best = solution;
      }
      // Some place far from the true one explains a part of nearly every recording by attraction.
      if (round == 0 && beginnings.front().factor < 0 && !(share_left(some, best) < beginnings.front().share))
        return "the stiffness that fits best is below zero: the forces pull towards the surface";
    }
    return with_other_lags(some, best);
  }

  // The share of the squared force that a solution leaves, as Beginning has it.
  double share_left(const Samples& samples, const Solution& solution) const {
    double measured = 0;
    for (const Measured& each : samples) measured += (each.force - rest_).squaredNorm();
    return solution.rms * solution.rms * static_cast<double>(samples.size()) / measured;
  }

  // The different ones that the beginnings lead to while all samples count in full, the best one first. A limit to what a
  // sample counts only makes the root mean square of all larger, so that one that is not better by then cannot become the best.
  std::vector<Solution> first_solutions(const Samples& some, const std::vector<Beginning>& beginnings) const {
    std::vector<Solution> all;
    for (const Beginning& each : beginnings)
      if (each.factor >= 0) all.push_back(solution(some, each, unknowns(), kAnySize, kNearly));
    return different(std::move(all));
  }

  // A search that begins without a lag stays there if the hand turns around within it.
  Solution with_other_lags(const Samples& some, const Solution& from) const {
    if (options_.lag || !std::isfinite(from.rms)) return from;
    Beginning best;
    for (int step = -kLags; step <= kLags; ++step) {
      Placement placement = from.placement;
      placement.lag = kLagStep * step;
      if (const Beginning next = tried(subject_.renderer(), path_, some, placement); next.share < best.share) best = next;
    }
    if (!(best.factor > 0)) return from;
    const Solution other = settled(some, best, unknowns(), kNearly);
    return other.rms < from.rms ? other : from;
  }

  Unknowns unknowns() const { return {!options_.turn, !options_.offset, !options_.lag}; }

  bool is_contact(const Measured& sample) const { return (sample.force - rest_).norm() > least_; }

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
    const Eigen::Vector3d force = laid.force - rest_, position = path_.position(laid, options_.lag.value_or(0));
    const auto consider = [&](const Eigen::Matrix3d& turn, const Spot& spot, double sign) {
      const Eigen::Vector3d there = spot.point - force.norm() / stiffness * spot.direction;
      const Beginning next =
          tried(subject_.renderer(), path_, some, {turn, there - turn * position, rest_, options_.lag.value_or(0)});
      if (next.factor * sign > 0) best.push_back(next);
    };
    for (const Spot& spot : spots_) {
      monitor_.at(0);
      for (const double sign : {1.0, -1.0}) {
        if (options_.turn) {
          consider(*options_.turn, spot, sign);
          continue;
        }
        const Eigen::Matrix3d onto = Eigen::Quaterniond::FromTwoVectors(sign * force, spot.direction).toRotationMatrix();
        for (std::size_t i = 0; i < kTurns; ++i) {
          const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(kTurns);
          consider(Eigen::AngleAxisd(angle, spot.direction) * onto, spot, sign);
        }
      }
      std::ranges::sort(best, {}, &Beginning::share);
      std::size_t attracting = 0, other = 0;  // of attraction the best one alone, since no fit begins there
      std::erase_if(best, [&](const Beginning& each) { return each.factor < 0 ? attracting++ > 0 : other++ >= kBeginnings; });
    }
    return best;
  }

  Solution solution(const Samples& samples, const Beginning& from, const Unknowns& unknowns, double most,
                    double tolerance) const {
    monitor_.at(0);
    return solved({subject_.renderer(), path_, samples, scale_, unknowns}, from, most, tolerance);
  }

  Solution settled(const Samples& samples, const Beginning& from, const Unknowns& unknowns, double tolerance) const {
    return settled(samples, solution(samples, from, unknowns, kAnySize, tolerance), unknowns, tolerance);
  }

  // A sample that is far off the others counts as one at a limit, which becomes smaller as the fit becomes better: neither a
  // fault in some samples, nor a sample that a small shift moves over a jump of the force, spoils the fit of the rest.
  Solution settled(const Samples& samples, const Solution& first, const Unknowns& unknowns, double tolerance) const {
    Solution best = first;
    double most = kAnySize;
    for (int i = 0; i < kLimits; ++i) {
      const double next = limit(samples, best.residuals);
      if (!(next < kLessLimit * most)) break;
      most = next;
      best = solution(samples, best.beginning(), unknowns, most, tolerance);
    }
    return best;
  }

  // The fit without the samples beyond the limit, and those whose position before the lag was not recorded. An offset or a lag
  // that may be zero is left out.
  Fit trimmed(const Samples& all, const Solution& from) const {
    const Solution first = settled(all, from.beginning(), unknowns(), kExactly);
    Samples reached;
    for (const Measured& each : all)
      if (path_.reaches(each, first.placement.lag)) reached.push_back(each);
    const Solution best = settled(reached, first.beginning(), unknowns(), kExactly);
    Fit fit = stated(all.size(), reached, best, unknowns());
    const bool has_offset = (fit.placement.offset.cwiseAbs() - fit.offset_error).maxCoeff() > 0;
    const bool has_lag = std::fabs(fit.placement.lag) > fit.lag_error;
    Unknowns fewer = unknowns();
    Beginning without = best.beginning();
    if (fewer.offset && !has_offset) {
      fewer.offset = false;
      without.placement.offset.setZero();
    }
    if (fewer.lag && !has_lag) {
      fewer.lag = false;
      without.placement.lag = 0;
    }
    if (fit.refusal || fewer.count() == unknowns().count()) return fit;
    const Samples& known = without.placement.lag == 0 ? all : reached;
    Fit simple = stated(all.size(), known, settled(known, without, fewer, kExactly), fewer);
    if (simple.refusal) return fit;
    simple.undetermined = fit.undetermined;
    simple.stiffness_error = fit.stiffness_error + std::fabs(simple.stiffness - fit.stiffness);
    simple.offset_error = fit.offset_error + (simple.placement.offset - fit.placement.offset).cwiseAbs();
    simple.lag_error = fit.lag_error + std::fabs(simple.placement.lag - fit.placement.lag);
    simple.turn_error = fit.turn_error;
    simple.shift_error = fit.shift_error;
    return simple;
  }

  // Five standard deviations, if the half of the samples in contact that fits better is normally distributed; no less than
  // what positions and forces are rounded by.
  double limit(const Samples& samples, const Eigen::VectorXd& residuals) const {
    std::vector<double> sizes;
    double largest = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (!is_contact(samples[i])) continue;
      sizes.push_back(residuals.segment<3>(3 * static_cast<Eigen::Index>(i)).norm());
      largest = std::max(largest, (samples[i].force - rest_).norm());
    }
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    return std::max(5 * 1.4826 * *middle, 1e-5 * largest);
  }

  Fit stated(std::size_t count, const Samples& samples, const Solution& settled, const Unknowns& unknowns) const {
    const double most = limit(samples, settled.residuals);
    Samples kept;
    for (std::size_t i = 0; i < samples.size(); ++i)
      if (settled.residuals.segment<3>(3 * static_cast<Eigen::Index>(i)).norm() <= most) kept.push_back(samples[i]);
    const Solution best = solution_at({subject_.renderer(), path_, kept, scale_, unknowns}, settled.beginning());
    Fit fit;
    fit.placement = best.placement;
    fit.stiffness = best.factor * stiffness_;
    fit.samples = kept.size();
    fit.outliers = count - kept.size();
    fit.contacts =
        static_cast<std::size_t>(std::ranges::count_if(kept, [&](const Measured& each) { return is_contact(each); }));
    fit.rms = best.rms;
    fit.middle = scale_.middle;
    const Eigen::VectorXd exact = rendered_forces(subject_.renderer(), path_, kept, best.placement);
    double force = 0;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const auto at = 3 * static_cast<Eigen::Index>(i);
      force += (kept[i].force - best.placement.offset).squaredNorm() / static_cast<double>(kept.size());
      const double size = best.residuals.segment<3>(at).norm();
      if (exact.segment<3>(at).isZero(0)) {
        ++fit.rests;
        fit.noise_at_rest += size * size;
      }
      if (size < fit.largest) continue;
      fit.largest = size;
      fit.largest_at = kept[i].line;
    }
    force = std::sqrt(force);
    if (fit.rests > 0) fit.noise_at_rest = std::sqrt(fit.noise_at_rest / static_cast<double>(fit.rests));
    if (fit.contacts < kLeastContacts || !(fit.rms <= force / 2))
      return refused("the subject does not explain these forces: the best fit leaves " + brief(fit.rms) + " N of " +
                     brief(force) + " N (root mean square)");
    if (error_of_stiffness(static_cast<float>(fit.stiffness)))
      return refused("the stiffness that fits best is " + brief(fit.stiffness) + " N/mm; expected 0.001 to 1000 N/mm");
    determine(fit, best, kept, force, unknowns);
    return fit;
  }

  // The directions in which the numbers can go without a change of the forces, and the errors in the others.
  void determine(Fit& fit, const Solution& best, const Samples& kept, double force, const Unknowns& unknowns) const {
    const std::vector<std::string> names = names_of(unknowns);
    const Eigen::VectorXd unit = units_of(unknowns, scale_.lever, force);
    const Eigen::MatrixXd derivatives = derivatives_at({subject_.renderer(), path_, kept, scale_, unknowns}, best);
    // The renderer rounds positions to binary32, in the worst case all of them in the same sense.
    const double farthest = (best.placement.turn * scale_.middle + best.placement.shift).cwiseAbs().maxCoeff() + scale_.lever;
    const double rounding = fit.stiffness * properties::half_spacing(static_cast<float>(farthest));
    // The lowest samples of a hand that never leaves the surface tell nothing, though some offset makes their forces zero.
    const double near = std::max(kNear, 5 * best.rms / fit.stiffness);
    const bool is_free = clearly_free(subject_.renderer(), path_, kept, best.placement, near) >= kLeastContacts;
    const FitErrors found =
        fit_errors_of((is_free ? derivatives : without_weak_forces(derivatives, 2 * near * fit.stiffness)) * unit.asDiagonal(),
                      best.residuals, force, rounding);
    for (std::size_t i = 0; i < names.size(); ++i)
      if (found.free[static_cast<Eigen::Index>(i)] > kFree) fit.undetermined.push_back(names[i]);
    const auto listed = [&](const std::string& before) {
      std::string words = before;
      for (const std::string& name : fit.undetermined) words += (words.size() == before.size() ? " " : " and ") + name;
      return words;
    };
    if (found.free[0] > kFree) {
      fit = refused(listed("these samples determine neither of") +
                    ": the same forces fit a stiffer surface elsewhere; expected contacts of different depths");
      return;
    }
    const Eigen::Index offset_at = unknowns.turns ? 7 : 4;
    for (Eigen::Index i = offset_at; unknowns.offset && i < offset_at + 3; ++i)
      if (found.free[i] > kFree) {
        fit = refused(listed("these samples determine neither of") + ": " + kNeverLeaves);
        return;
      }
    const Eigen::VectorXd errors = unit.cwiseProduct(found.error);
    fit.stiffness_error = fit.stiffness * errors[0];
    if (unknowns.turns) fit.turn_error = errors.segment<3>(1).norm() / scale_.lever * 180 / std::numbers::pi;
    fit.shift_error = errors.segment<3>(unknowns.turns ? 4 : 1).norm();
    if (unknowns.offset) fit.offset_error = errors.segment<3>(offset_at);
    if (unknowns.lag)
      fit.lag_error = errors[errors.size() - 1] / scale_.speed +
                      pull_of_noisy_positions(derivatives.rightCols<1>() * scale_.speed, best.residuals, kept);
  }

  const Measurements& measured_;
  const properties::Subject& subject_;
  const double stiffness_;
  const FitOptions& options_;
  const Monitor& monitor_;
  const RecordedPath path_;
  const double speed_;  // mm/s, that is usual
  const std::vector<Spot> spots_;
  Samples contacts_;
  Eigen::Vector3d rest_ = Eigen::Vector3d::Zero();  // N, what the sensor reads of no force, as far as is known
  double least_ = 0;                                // N, beyond which a force is one of contact
  Scale scale_;
};

}  // namespace

Fit fit_of(const Measurements& measured, const properties::Subject& subject, float stiffness, const FitOptions& options,
           const Monitor& monitor) {
  return Fitting(measured, subject, stiffness, options, monitor).run();
}

}  // namespace forceshade::conformance
