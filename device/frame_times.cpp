// SPDX-License-Identifier: BSD-3-Clause
#include "device/frame_times.h"

#include "text/formatted.h"

namespace forceshade::device {

std::string words_of(const FrameTimes::Window& seen) {
  return formatted("%.1f frames a second, %.2f %% of them late, longest gap %.2f ms", seen.rate, 100 * seen.late,
                   1000 * seen.longest_gap);
}

const char* grade_of(const FrameTimes::Window& seen) noexcept {
  return seen.late <= 0.001 ? "good" : seen.late <= 0.02 ? "fair" : "poor: forces are held too long now and then";
}

}  // namespace forceshade::device
