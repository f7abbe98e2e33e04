// SPDX-License-Identifier: BSD-3-Clause
// Prints next() of device/phantom/ending.h for proofs/device/phantom.pml.

#include <array>
#include <cstdio>

#include "device/phantom/ending.h"

int main() {
  using namespace forceshade::device;
  constexpr std::array kStates{Ending::held, Ending::closing, Ending::interrupting, Ending::released, Ending::over};
  constexpr std::array kNames{"held", "closing", "interrupting", "released", "over"};
  for (std::size_t i = 0; i < kNames.size(); ++i) std::printf("#define %s %zu\n", kNames[i], i);
  std::printf("inline next_state(state, alone, due, closed, late) {\n  if\n");
  for (std::size_t i = 0; i < kStates.size(); ++i)
    for (unsigned bits = 0; bits < 16; ++bits) {
      const auto is = [&](unsigned bit) { return (bits >> bit & 1U) != 0; };
      const EndingSeen seen{.is_alone = is(0), .words_are_due = is(1), .is_closed = is(2), .is_late = is(3)};
      std::printf("  :: state == %s && (alone) == %d && (due) == %d && (closed) == %d && (late) == %d -> state = %s\n",
                  kNames[i], is(0), is(1), is(2), is(3), kNames[static_cast<std::size_t>(next(kStates[i], seen))]);
    }
  std::printf("  fi\n}\n");
}
