// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Options with which lateness ends nothing: what a test waits for comes, however late any thread is.

#include <chrono>

#include "device/frames/link.h"
#include "forceshade/servo_loop.h"

namespace forceshade::device {

// As long as CTest lets a test run, and any rate.
inline constexpr std::chrono::minutes kLongest{10};
inline constexpr FramedOptions kPatient{.watchdog_timeout = kLongest,
                                        .answer = kLongest,
                                        .open = kLongest,
                                        .start = kLongest,
                                        .calibration = kLongest,
                                        .end = kLongest,
                                        .rate_tolerance = 100};

inline ServoOptions patient_loop() {
  return {.max_seconds = 3600, .watchdog_timeout = 10};  // the longest that may be asked for
}

}  // namespace forceshade::device
