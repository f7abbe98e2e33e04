// SPDX-License-Identifier: BSD-3-Clause
#include "device/quiet_watch.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <vector>

#include "device/simulated/model.h"
#include "system/system.h"

namespace forceshade::device {
namespace {

constexpr std::chrono::milliseconds kLongestFrame{100};

struct Watch {
  Device& device;
  double rate, seconds;
  const std::atomic<bool>& stop;

  std::optional<Fault> read_all(std::vector<Reading>& readings, Observed& seen) const {
    const std::int64_t begin = system::now();
    const double period = 1e9 / rate;
    const auto most = static_cast<std::size_t>(std::lround(seconds * rate));
    const bool paces = device.capabilities().paces;
    // A device whose frames do not come must not be waited for as often as there should be frames.
    const std::int64_t latest = begin + std::llround((2 * seconds + 1) * 1e9);
    for (std::size_t k = 0; k <= most && !stop && system::now() < latest; ++k) {
      if (paces) {
        device.wait_for_frame(system::now() + system::in_ns(kLongestFrame));
      } else {
        const std::int64_t due = begin + std::llround(static_cast<double>(k) * period);
        system::sleep_until(due);
        seen.latest_waking = std::max(seen.latest_waking.value_or(0), 1e-6 * static_cast<double>(system::now() - due));
      }
      const ReadResult read = device.read();
      seen.state = device.state();
      if (const Fault* fault = std::get_if<Fault>(&read)) return *fault;
      const Reading* reading = std::get_if<Reading>(&read);
      if (!reading) return std::nullopt;
      if (readings.empty() || reading->time > readings.back().time) readings.push_back(*reading);
      // A real device lets go, for good, when it hears nothing.
      if (const auto fault = device.command(Eigen::Vector3f::Zero())) return fault;
    }
    return std::nullopt;
  }
};

void time(const std::vector<Reading>& readings, Observed& seen) {
  if (readings.size() < 2) return;
  seen.seconds = readings.back().time - readings.front().time;
  const auto gaps = static_cast<double>(readings.size() - 1);
  const double mean = seen.seconds / gaps;
  double squares = 0, longest = 0;
  for (std::size_t k = 1; k < readings.size(); ++k) {
    const double gap = readings[k].time - readings[k - 1].time;
    squares += (gap - mean) * (gap - mean);
    longest = std::max(longest, gap);
  }
  seen.rate = 1 / mean;
  seen.jitter = 1e3 * std::sqrt(squares / gaps);
  seen.longest_gap = 1e3 * longest;
}

void place(const std::vector<Reading>& readings, Observed& seen) {
  Eigen::Vector3d low = readings.front().position.cast<double>(), high = low, sum{0, 0, 0}, squares{0, 0, 0};
  for (const Reading& reading : readings) {
    const Eigen::Vector3d at = reading.position.cast<double>();
    seen.finite = seen.finite && at.allFinite();
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
    sum += at;
  }
  const auto count = static_cast<double>(readings.size());
  for (const Reading& reading : readings) squares += (reading.position.cast<double>() - sum / count).cwiseAbs2();
  seen.extent = high - low;
  seen.noise = (squares / count).cwiseSqrt();
  seen.last = readings.back().position.cast<double>();
}

void count(const std::vector<Reading>& readings, Observed& seen) {
  const auto shows = [](const Reading& reading) { return reading.encoder.has_value(); };
  if (!std::all_of(readings.begin(), readings.end(), shows)) return;
  auto low = *readings.front().encoder, high = low;
  for (const Reading& reading : readings)
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], (*reading.encoder)[i]);
      high[i] = std::max(high[i], (*reading.encoder)[i]);
    }
  seen.counts_moved = {high[0] - low[0], high[1] - low[1], high[2] - low[2]};
}

void press(const std::vector<Reading>& readings, Observed& seen) {
  for (std::size_t k = 1; k < readings.size(); ++k) {
    const unsigned before = readings[k - 1].buttons, now = readings[k].buttons;
    seen.pressed = static_cast<std::uint16_t>(seen.pressed | (now & ~before));
    seen.released = static_cast<std::uint16_t>(seen.released | (before & ~now));
  }
}

// mm; infinite where an angle or a position is no number
double kinematic_error(const std::vector<Reading>& readings, const Arm& arm, double turret) {
  double most = 0;
  for (const Reading& reading : readings) {
    const auto& [a, b, c] = *reading.joints;
    const Eigen::Vector3d computed = turned_to_law(arm.forward(Joints(turret * a, b, c))) / kMillimetre;
    const double error = (reading.position.cast<double>() - computed).norm();
    most = std::isnan(error) ? HUGE_VAL : std::max(most, error);
  }
  return most;
}

// Sources differ in the sign of the turret's angle; whichever fits is the driver's.
void compare(const std::vector<Reading>& readings, std::string_view model_name, Observed& seen) {
  const auto model = model_named(model_name);
  const auto shows = [](const Reading& reading) { return reading.joints.has_value(); };
  if (!model || !std::all_of(readings.begin(), readings.end(), shows)) return;
  const double right = kinematic_error(readings, model->arm, 1), left = kinematic_error(readings, model->arm, -1);
  seen.kinematics = left < right ? Observed::Kinematics{left, true} : Observed::Kinematics{right, false};
}

}  // namespace

Observed observe_without_force(Device& device, double rate, double seconds, const std::atomic<bool>& stop) {
  Observed seen;
  seen.fault = device.start(rate);
  if (seen.fault) return seen;
  // So that a gap is the device's, as far as the system grants it.
  const system::RealTime real_time(std::nullopt);
  seen.granted = real_time.granted();
  std::vector<Reading> readings;
  readings.reserve(static_cast<std::size_t>(std::lround(seconds * rate)) + 1);
  seen.fault = Watch{device, rate, seconds, stop}.read_all(readings, seen);
  if (const auto refused = device.command(Eigen::Vector3f::Zero()); refused && !seen.fault) seen.fault = refused;
  seen.readings = readings.size();
  if (readings.empty()) return seen;
  time(readings, seen);
  place(readings, seen);
  count(readings, seen);
  press(readings, seen);
  compare(readings, device.capabilities().model, seen);
  return seen;
}

}  // namespace forceshade::device
