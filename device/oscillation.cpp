// SPDX-License-Identifier: BSD-3-Clause
#include "device/oscillation.h"

#include <algorithm>
#include <cmath>

namespace forceshade::device {
namespace {

constexpr double kQuick = 0.025;    // s
constexpr double kCycle = 0.075;    // s: 13.3 Hz, between tremor and limit cycles
constexpr double kFed = 0.1;        // mJ: under 1 N/mm at 1 kHz a tremor of 0.2 mm takes 0.014 mJ a cycle
constexpr double kDriven = 0.1;     // N
constexpr int kRow = 8, kMore = 4;  // swings
constexpr double kDying = 0.7;      // of the swing four before: a hand's flesh alone makes that 0.35
constexpr double kLower = 0.7;
constexpr double kQuiet = 0.5, kBack = 5;  // s
constexpr double kSmoothing = 0.01;        // s, so that to lower it is no jerk

}  // namespace

OscillationWatch::OscillationWatch(double resolution, double period) noexcept
    : shortest_(std::max(3 * resolution, 0.05)), period_(period) {}

double OscillationWatch::next(const Eigen::Vector3f& position, const Eigen::Vector3f& acted) noexcept {
  ++quiet_ticks_;
  const bool begins = !last_position_;
  if (!begins) work_ += acted.cast<double>().dot(position.cast<double>() - last_position_->cast<double>());
  last_position_ = position;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    Axis& axis = axes_[i];
    const auto here = static_cast<double>(position[static_cast<Eigen::Index>(i)]);
    if (begins) {
      axis.last.position = axis.farthest.position = here;
      axis.between = axis.since = {acted, acted};
    }
    if (turned(axis, here, acted) && axis.row >= kRow) {
      quiet_ticks_ = 0;
      if ((axis.row - kRow) % kMore == 0) aim_ *= kLower;
    }
  }
  if (quiet_ticks_ * period_ > kQuiet) aim_ = std::min(1.0, aim_ + period_ / kBack);
  gain_ += (aim_ - gain_) * period_ / (period_ + kSmoothing);
  if (aim_ == 1 && gain_ > 0.999) gain_ = 1;
  return gain_;
}

void OscillationWatch::Range::add(const Range& other) noexcept {
  low = low.cwiseMin(other.low);
  high = high.cwiseMax(other.high);
}

// True where a swing has just ended; the axis' row then counts it or is over.
bool OscillationWatch::turned(Axis& axis, double position, const Eigen::Vector3f& acted) noexcept {
  ++axis.last.ticks;
  ++axis.farthest.ticks;
  axis.since.add({acted, acted});
  const double beyond = position - axis.farthest.position;
  if (beyond * axis.direction >= 0) {
    axis.between.add(axis.since);
    axis.since = {acted, acted};
    axis.farthest = {position, work_, 0};
    return false;
  }
  if (std::fabs(beyond) <= shortest_) return false;
  const double length = std::fabs(axis.farthest.position - axis.last.position);
  const double took = (axis.last.ticks - axis.farthest.ticks) * period_, fed = axis.farthest.work - axis.last.work;
  const bool is_of_a_cycle = took < kQuick || (took + axis.before < kCycle && fed + axis.before_fed > kFed);
  const bool driven = axis.between.size() > kDriven;
  double& before = axis.lengths[static_cast<std::size_t>(axis.row) % axis.lengths.size()];
  const bool lives = axis.row < static_cast<int>(axis.lengths.size()) || length > kDying * before;
  axis.row = is_of_a_cycle && driven && lives ? axis.row + 1 : 0;
  before = length;
  axis.before = took;
  axis.before_fed = fed;
  axis.last = axis.farthest;
  axis.between = axis.since;
  axis.farthest = {position, work_, 0};
  axis.since = {acted, acted};
  axis.direction = -axis.direction;
  return true;
}

}  // namespace forceshade::device
