// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/recordings/stays.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "properties/conformance/quantile.h"

namespace forceshade::conformance {
namespace {

// A slow hand moves a sensor by one of its steps at a time, which may be along three axes at once, or by two.
constexpr double kFewSteps = 4;

// Copies to which noise was added move by less than this share of a large step. A hand that turns does so, too, but not after
// each second sample, or each third one.
constexpr double kNearly = 0.001;

}  // namespace

Stays::Stays(const Measurements& measured) : samples_(measured.samples) {
  divide(0);
  are_copied_ = are_copied();
  if (!are_copied_) {
    std::vector<double> steps;
    for (std::size_t i = 1; i < samples_.size(); ++i) steps.push_back(step(i));
    divide(kNearly * quantile(steps, 0.995));
    are_copied_ = are_copied();
    if (!are_copied_) divide(0);
  }
  std::vector<double> speeds, steps;
  for (const Stay& stay : stays_) {
    if (!has_neighbours(stay)) continue;
    steps.push_back(step_after(stay));
    if (const double time = seconds(stay); time > 0) speeds.push_back(step_after(stay) / time);
  }
  usual_speed_ = quantile(speeds, 0.5);
  small_step_ = quantile(steps, 0.01);
}

void Stays::divide(double nearly) {
  stays_.clear();
  for (std::size_t i = 0; i < samples_.size(); ++i)
    if (i > 0 && step(i) <= nearly)
      stays_.back().last = i;
    else
      stays_.push_back({i, i});
}

double Stays::step(std::size_t i) const {
  return (samples_[i].position - samples_[i - 1].position).norm();
}

double Stays::seconds(const Stay& stay) const {
  double sum = 0;
  for (std::size_t i = stay.first + 1; i <= stay.last + 1 && i < samples_.size(); ++i) sum += samples_[i].interval;
  return sum;
}

// Ten intervals of 1 ms may add up to a little more than 10 ms.
bool Stays::is_long(const Stay& stay) const {
  return seconds(stay) > kLongestHold * (1 + 1e-9);
}

bool Stays::is_stale(const Stay& stay) const {
  if (stay.first == stay.last || !has_neighbours(stay)) return false;
  const double before = seconds(*(&stay - 1)), last = samples_[stay.last + 1].interval, held = seconds(stay);
  if (!(before > 0) || !(last > 0)) return false;
  const double speed = step_before(stay) / before, jump = step_after(stay);
  return jump > speed * (held + last) / 2 && speed >= usual_speed_ / 2 && (are_copied_ || jump > kFewSteps * small_step_);
}

// Positions that were copied to a higher rate stay for the same number of samples, or for one of two numbers, however fast the
// hand is and wherever it goes. Those of a sensor with coarse steps do so only at one speed along one line.
bool Stays::are_copied() const {
  if (stays_.size() < 10) return false;
  std::vector<double> counts;
  for (const Stay& stay : stays_)
    if (has_neighbours(stay)) counts.push_back(static_cast<double>(stay.last - stay.first + 1));
  const double usual = quantile(counts, 0.5);
  if (usual < 2 || quantile(counts, 0.95) - quantile(counts, 0.05) > 1) return false;
  const Stay& first = stays_[1];
  const Eigen::Vector3d along = samples_[first.first].position - samples_[first.first - 1].position;
  return std::ranges::any_of(stays_, [&](const Stay& stay) {
    if (!has_neighbours(stay)) return false;
    const Eigen::Vector3d other = samples_[stay.last + 1].position - samples_[stay.last].position;
    return along.cross(other).norm() > 0.5 * along.norm() * other.norm();
  });
}

double Stays::rate() const {
  double time = 0;
  std::size_t positions = 0;
  for (const Stay& stay : stays_) {
    if (!has_neighbours(stay) || (is_long(stay) && !is_stale(stay))) continue;
    time += seconds(stay);
    ++positions;
  }
  return time > 0 ? static_cast<double>(positions) / time : 0;
}

}  // namespace forceshade::conformance
