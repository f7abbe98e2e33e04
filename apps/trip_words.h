// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The reason why the supervisor ended a run, in words for the person who has to change something.

#include <string>

#include "forceshade/servo_loop.h"

namespace forceshade::apps {

// The name of the rule that tripped. Where ticks were too late, also how late, whether the system or the tick before was the
// cause, and which option or setting of the system helps. `run.trip` is there.
std::string words_of_trip(const device::ServoResult& run);

}  // namespace forceshade::apps
