// SPDX-License-Identifier: BSD-3-Clause
#include "device/phantom/phantom_limits.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "device/simulated/arm.h"
#include "files/csv.h"

namespace forceshade::device {
namespace {

constexpr double kBelow = 0.95;                       // of what the driver ends a run for
constexpr double kMostPeak = 40;                      // N: the strongest PHANToM's sheet has 37.5
constexpr double kLeastContinuous = 0.88;             // N: Omni's
const Eigen::Vector3f kLeastWorkspace{160, 70, 120};  // mm, in the laws' frame: Omni's

// So that a limit of 1e300 mm/s is not called one.
constexpr double kMostSpeed = 1e5, kMostImpulse = 1e4;
constexpr double kMostReach = 2000, kLeastWidth = 10;  // mm

bool is_within(const std::optional<double>& value, double most) {
  return value && *value > 0 && *value <= most;
}

std::string said(const std::optional<double>& value) {
  return value ? "says " + shortest(*value) : "does not say";
}

// The box in the laws' frame, if it is one.
std::optional<Eigen::AlignedBox<float, 3>> box_of(const std::optional<std::array<double, 6>>& corners) {
  if (!corners) return std::nullopt;
  for (const double coordinate : *corners)
    if (!(std::fabs(coordinate) <= kMostReach)) return std::nullopt;
  const auto& c = *corners;
  for (const std::size_t axis : {0, 1, 2})
    if (!(c[axis + 3] - c[axis] >= kLeastWidth)) return std::nullopt;
  Eigen::AlignedBox<float, 3> box;
  box.extend(turned_to_law({c[0], c[1], c[2]}).cast<float>());
  box.extend(turned_to_law({c[3], c[4], c[5]}).cast<float>());
  return box;
}

}  // namespace

std::variant<PhantomLimits, std::string> phantom_limits(const DriversLimits& driver) {
  if (!is_within(driver.peak, kMostPeak))
    return "the PHANToM's highest force: expected a number of newtons above 0 and at most " + shortest(kMostPeak) +
           ", and the driver " + said(driver.peak);
  constexpr double kNone = std::numeric_limits<double>::infinity();
  PhantomLimits limits{
      .peak = kBelow * *driver.peak, .continuous = 0, .speed = kNone, .slew = kNone, .low = {}, .high = {}, .words = ""};

  limits.continuous = std::min(limits.peak, kLeastContinuous);
  if (is_within(driver.continuous, *driver.peak))
    limits.continuous = std::min(limits.peak, *driver.continuous);
  else
    limits.words += "continuous force: the driver " + said(driver.continuous) + "; " + shortest(limits.continuous) +
                    " N is used, the lowest of all data sheets\n";

  const auto ours_alone = [&](const char* what, const std::optional<double>& value) {
    limits.words += std::string(what) + ": the driver " + said(value) + "; the supervisor's own limit holds alone\n";
  };
  if (is_within(driver.speed, kMostSpeed))
    limits.speed = kBelow * *driver.speed;
  else
    ours_alone("highest velocity", driver.speed);
  if (is_within(driver.impulse, kMostImpulse))
    limits.slew = kBelow * 1000 * *driver.impulse;
  else
    ours_alone("highest change of force", driver.impulse);

  const auto box = box_of(driver.workspace);
  limits.low = box ? box->min() : -0.5F * kLeastWorkspace;
  limits.high = box ? box->max() : 0.5F * kLeastWorkspace;
  if (!box)
    limits.words += std::string("workspace: the driver ") + (driver.workspace ? "gives no box" : "does not say") +
                    "; 160 x 70 x 120 mm about the origin is used, the smallest of all data sheets\n";
  return limits;
}

}  // namespace forceshade::device
