// SPDX-License-Identifier: BSD-3-Clause
#include "device/retrace.h"

#include <bit>

namespace forceshade::device {
namespace {

Eigen::Vector3f vector_of(const std::array<float, 3>& a) noexcept {
  return {a[0], a[1], a[2]};
}

Reading reading_of(const Sample& sample) noexcept {
  Reading reading{.position = vector_of(sample.position), .time = sample.device_time, .buttons = sample.buttons};
  if ((sample.device_state & Sample::kReportsSent) != 0)
    reading.sent = Sent{vector_of(sample.sent_acted), vector_of(sample.sent_acting), sample.sent_work};
  return reading;
}

State state_of(const Sample& sample) noexcept {
  return {.calibrated = (sample.device_state & Sample::kCalibrated) != 0,
          .forces_on = (sample.device_state & Sample::kForcesOn) != 0,
          .temperature = sample.temperature};
}

bool has_same_bits(const Eigen::Vector3f& a, const std::array<float, 3>& b) noexcept {
  return std::bit_cast<std::uint32_t>(a.x()) == std::bit_cast<std::uint32_t>(b[0]) &&
         std::bit_cast<std::uint32_t>(a.y()) == std::bit_cast<std::uint32_t>(b[1]) &&
         std::bit_cast<std::uint32_t>(a.z()) == std::bit_cast<std::uint32_t>(b[2]);
}

}  // namespace

Retrace::Retrace(const SafetySettings& settings) : controller_(settings.passivity_settings, settings.passivity) {
  if (settings.supervised) supervisor_.emplace(settings.limits, settings.rate_hz);
}

Retraced Retrace::next(const Sample& sample) noexcept {
  const Reading reading = reading_of(sample);
  const Eigen::Vector3f desired = vector_of(sample.law_force);
  Verdict verdict{.force = desired};
  if (supervisor_)
    verdict = supervisor_->supervise(reading, state_of(sample), desired, sample.law_status(),
                                     static_cast<double>(sample.wakeup_ns) / 1e9);
  Retraced retraced;
  retraced.force = controller_.limited(reading, verdict.force);
  if (supervisor_) supervisor_->commanded(retraced.force, controller_.account().owed());
  retraced.limited = verdict.limited.bits();
  retraced.altered = retraced.force != verdict.force;
  retraced.tripped = verdict.trip ? static_cast<std::uint8_t>(1 + static_cast<int>(*verdict.trip)) : 0;
  retraced.energy = controller_.account().net();
  return retraced;
}

bool is_same(const Retraced& retraced, const Sample& sample) noexcept {
  return has_same_bits(retraced.force, sample.force) && retraced.limited == sample.limited &&
         retraced.altered == (sample.altered != 0) && retraced.tripped == sample.tripped &&
         std::bit_cast<std::uint64_t>(retraced.energy) == std::bit_cast<std::uint64_t>(sample.energy);
}

}  // namespace forceshade::device
