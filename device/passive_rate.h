// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The rate that a loop needs so that a sampled spring can be passive: the condition b ≥ KT/2 (Colgate and Schenkel 1997), with
// damping b ≥ KT/2 + γB (docs/damping.md).

#include <string>

#include "forceshade/damping.h"
#include "forceshade/device.h"

namespace forceshade::device {

// Words for people where a spring of this stiffness (N/mm) cannot be passive in a loop of this rate (Hz): where KT/2 is more
// than the damping of the device, as far as it is known, and of a hand's flesh together. Empty where it may be passive, and for
// devices without a finite peak force. A sample of latency takes three times the damping; the arm behind the hand has some,
// too. Besides, words where one count of the device changes a damped force by more than 0.02 N.
std::string words_if_active(double stiffness, const Capabilities& capabilities, double rate,
                            const damping::Parameters& damping = {});

}  // namespace forceshade::device
