// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Checks that the commands of a recording follow from what it recorded.

#include <cstdint>
#include <optional>
#include <string>

#include "device/retrace.h"
#include "forceshade/recording.h"
#include "forceshade/servo_loop.h"

namespace forceshade::apps {

// Goes through the commands of one recording, chunk by chunk, where it has what that takes.
class CommandCheck {
 public:
  // In a recording from before format 4, or of a law that was placed elsewhere, the commands cannot be computed: why_not() says
  // so. Throws Error for settings that cannot be read.
  explicit CommandCheck(const recorder::Recording& recording);

  const std::string& why_not() const { return why_not_; }

  // In order from the first tick of the run; samples of a run in parts one part after the other. False where it differs.
  bool is_same(const device::Sample& sample);
  std::uint64_t ticks() const { return ticks_; }
  std::uint64_t changed() const { return changed_; }  // in how many of them the command is not the renderer's force
  std::uint64_t differences() const { return differences_; }

 private:
  std::optional<device::Retrace> retrace_;
  std::string why_not_;
  std::uint64_t ticks_ = 0, changed_ = 0, differences_ = 0;
};

}  // namespace forceshade::apps
