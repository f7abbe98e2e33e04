// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Sets this thread's control words while it lives, as a third-party library could.

#include "rendering/control_words.h"

namespace forceshade::tests {

// The x87's control word of WSL 1: a long double has 53 bits.
inline constexpr unsigned short kX87Of53Bits = 0x27F;

class SetControlWords {
 public:
  explicit SetControlWords(const ControlWords& words) : words_(words) { set_control_words(words); }
  // Those that were set are still in force; exceptions that were raised do not count.
  bool are_still_set() const {
    constexpr unsigned kRaised = 0x3F;
    const ControlWords now = control_words();
    return (now.mxcsr & ~kRaised) == (words_.mxcsr & ~kRaised) && now.x87 == words_.x87;
  }

 private:
  KeptControlWords before_;
  ControlWords words_;
};

}  // namespace forceshade::tests
