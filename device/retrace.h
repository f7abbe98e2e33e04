// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Computes the commanded forces of a recorded run again: what the supervisor and the passivity controller made of the law's
// force, from the recorded positions and the recorded settings.

#include <optional>

#include "device/passivity_controller.h"
#include "device/supervisor.h"
#include "forceshade/servo_loop.h"

namespace forceshade::device {

// A tick's command, and what was recorded beside it. In the device's frame.
struct Retraced {
  Eigen::Vector3f force{0, 0, 0};  // N
  std::uint16_t limited = 0;
  bool altered = false;
  std::uint8_t tripped = 0;
  double energy = 0;  // mJ
};

// Both are functions of what a sample holds and of the ticks before it, so one Retrace goes through a run from its first tick.
// Exactly true where positions and forces were recorded in the device's frame (Placement{}: a law that was placed elsewhere has
// its position rounded, and the device's own is not recorded), by a program with the same code of this module, and with the
// same exponential function of the C library. That each force was commanded is the recording's word; what the motors made of
// it is not computed: Sent is the device's own report and is taken as recorded.
class Retrace {
 public:
  explicit Retrace(const SafetySettings& settings);

  // The next tick of the run, not the zero force that ends it.
  Retraced next(const Sample& sample) noexcept;

 private:
  std::optional<Supervisor> supervisor_;
  PassivityController controller_;
};

// True if the recorded tick is the retraced one, to the bit.
bool is_same(const Retraced& retraced, const Sample& sample) noexcept;

}  // namespace forceshade::device
