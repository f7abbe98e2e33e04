// SPDX-License-Identifier: BSD-3-Clause
// Ticks that come late, on the loop's clock as VirtualClock has it; and arithmetic that is not what the proofs assume.

#include <cfenv>
#include <memory>

#include "tests/device/faults/press.h"

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace forceshade::faults {
namespace {

using Since = Wrong::Since;

// Called with the loop's clock as a tick's force is commanded.
Fault late(std::string what, std::string reaction, std::optional<double> to_zero,
           std::function<void(VirtualClock&, Since)> at_command) {
  return {.kind = Kind::timing,
          .what = std::move(what),
          .reaction = std::move(reaction),
          .to_zero = to_zero,
          .unit = "ms",
          .run = [=](const Bench& bench) {
            VirtualClock clock;
            const Wrong wrong{.tick = kGrowing, .command = [&](Eigen::Vector3f&, Since since) {
                                at_command(clock, since);
                                return std::nullopt;
                              }};
            return press(wrong, bench, {.in_ms = true, .clock = &clock});
          }};
}

std::function<void(VirtualClock&, Since)> once(double ms) {
  return [=](VirtualClock& clock, Since since) {
    if (since == 0) clock.pass(ms);
  };
}

Fault odd_arithmetic(std::string what, std::string reaction, std::function<void()> set) {
  return {.kind = Kind::timing,
          .what = std::move(what),
          .reaction = std::move(reaction),
          .to_zero = 0,
          .under_force = false,
          .run = [=](const Bench& bench) { return press({.tick = 0}, bench, {.before = set}); }};
}

}  // namespace

std::vector<Fault> timing_faults() {
  std::vector<Fault> faults {
    late("one tick is 2 ms late", "limited: missed deadlines", std::nullopt, once(3)),
        late("ticks are late for 5 ms", "limited: missed deadlines", std::nullopt, once(6.5)),
        // The stall, and no more.
        late("the loop stalls for 30 ms", "trip: watchdog", 31, once(31)),
        // 3 ms of the first, 3 ticks held, and the ramp.
        late("every tick is 2 ms late", "trip: missed deadlines", 3 + 3 + 20,
             [](VirtualClock& clock, Since since) { clock.pass(since == 0 ? 3 : 1); }),
        // 10 ticks until they are a period late, 3 held, and the ramp, of 1.1 ms.
        late("every tick takes 1.1 ms", "trip: missed deadlines", 1.1 * (10 + 1 + 3 + 20),
             [](VirtualClock& clock, Since) { clock.pass(1.1); }),
        late("signals cut the sleep short", "goes on, same forces", std::nullopt,
             [](VirtualClock& clock, Since) { clock.interrupt(5); }),
        odd_arithmetic("rounding upward before the start", "refused: rounding other than to nearest",
                       [] { std::fesetround(FE_UPWARD); }),
#if defined(__SSE2__)
        odd_arithmetic("subnormals flushed before the start", "refused: flushed subnormals",
                       [] { _mm_setcsr(_mm_getcsr() | 0x8040U); }),
#endif
  };
  return faults;
}

}  // namespace forceshade::faults
