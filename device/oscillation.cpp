// SPDX-License-Identifier: BSD-3-Clause
#include "device/oscillation.h"

#include <algorithm>
#include <cmath>

namespace forceshade::device {
namespace {

constexpr double kQuick = 0.025;    // s
constexpr float kDriven = 0.1F;     // N
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
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    Axis& axis = axes_[i];
    const auto here = static_cast<double>(position[static_cast<Eigen::Index>(i)]);
    if (!begun_) axis.last.position = axis.farthest.position = here;
    if (turned(axis, here, acted) && axis.row >= kRow) {
      quiet_ticks_ = 0;
      if ((axis.row - kRow) % kMore == 0) aim_ *= kLower;
    }
  }
  begun_ = true;
  if (quiet_ticks_ * period_ > kQuiet) aim_ = std::min(1.0, aim_ + period_ / kBack);
  gain_ += (aim_ - gain_) * period_ / (period_ + kSmoothing);
  if (aim_ == 1 && gain_ > 0.999) gain_ = 1;
  return gain_;
}

// Whether a swing has just ended; the axis' row then counts it or is over.
bool OscillationWatch::turned(Axis& axis, double position, const Eigen::Vector3f& acted) noexcept {
  ++axis.last.ticks;
  ++axis.farthest.ticks;
  const double beyond = position - axis.farthest.position;
  if (beyond * axis.direction >= 0) {
    axis.farthest = {position, acted, 0};
    return false;
  }
  if (std::fabs(beyond) <= shortest_) return false;
  const double length = std::fabs(axis.farthest.position - axis.last.position);
  const bool quick = (axis.last.ticks - axis.farthest.ticks) * period_ < kQuick;
  const bool driven = (axis.farthest.force - axis.last.force).norm() > kDriven;
  double& before = axis.lengths[static_cast<std::size_t>(axis.row) % axis.lengths.size()];
  const bool lives = axis.row < static_cast<int>(axis.lengths.size()) || length > kDying * before;
  axis.row = quick && driven && lives ? axis.row + 1 : 0;
  before = length;
  axis.last = axis.farthest;
  axis.farthest = {position, acted, 0};
  axis.direction = -axis.direction;
  return true;
}

}  // namespace forceshade::device
