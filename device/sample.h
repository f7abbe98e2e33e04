// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One tick as a recording keeps it, and who takes it while the loop runs. Position and forces are in the frame of the law or
// map, which is the device's unless it was placed elsewhere (device/placement.h).

#include <array>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace forceshade::device {

// Its bytes are a recording's format: recorder/layout.h lists them, and whoever changes them raises the version there.
struct Sample {
  static constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  static constexpr std::int64_t kNoCount = std::numeric_limits<std::int64_t>::min();  // from a device that shows no encoders
  static constexpr std::uint8_t kEnd = 3;

  std::uint64_t tick = 0;
  std::int64_t wall_ns = 0;                                              // since the loop started, position read
  double device_time = 0;                                                // s, by the device's own clock
  std::array<std::int64_t, 3> encoder = {kNoCount, kNoCount, kNoCount};  // counts, as the device gives them
  double energy = 0;                                                     // mJ, given to the hand less taken from it, so far
  std::int64_t compute_ns = 0;                                           // from position read to force commanded
  std::int64_t wakeup_ns = 0;                                            // from due to awake; 0 if nothing was due
  std::array<float, 3> position = {kUnknown, kUnknown, kUnknown};        // mm
  std::array<float, 3> law_force = {0, 0, 0};                            // N, as the law has it
  std::array<float, 3> force = {0, 0, 0};                                // N, as commanded
  std::array<float, 3> gimbal = {kUnknown, kUnknown, kUnknown};          // rad
  std::uint16_t buttons = 0;                                             // bit k is set while button k is down
  std::uint16_t limited = 0;  // bit Rules::bit_of(rule) is set if this rule of the supervisor changed the law's force
  std::uint8_t status = 0;    // free 0, contact 1, invalid 2; kEnd for the zero force that ends a run
  std::uint8_t late = 0;      // 1 if the force was commanded after the next tick was due
  std::uint8_t altered = 0;   // 1 if the passivity controller changed the supervisor's force
  std::uint8_t tripped = 0;   // the rule that stopped the run, from 1; 0 for none

  // The members from here on are new in format 4: with these the commanded force can be computed again (device/retrace.h).
  std::uint64_t shown = 0;                       // fast::Session::shown()
  double sent_work = 0;                          // mJ, Sent::work
  std::array<float, 3> sent_acted = {0, 0, 0};   // N, in the device's own frame, as the next
  std::array<float, 3> sent_acting = {0, 0, 0};  // N
  float temperature = 0;                         // State::temperature
  std::uint32_t device_state = 0;                // kCalibrated and so on, of this reading
  static constexpr std::uint32_t kCalibrated = 1, kForcesOn = 2, kReportsSent = 4, kUnfinished = 8;
};
static_assert(sizeof(Sample) == 176 && std::is_trivially_copyable_v<Sample>);

// push() is called from the servo loop: it must neither wait nor allocate.
class SampleSink {
 public:
  virtual ~SampleSink() = default;
  virtual void push(const Sample& sample) noexcept = 0;
};

}  // namespace forceshade::device
