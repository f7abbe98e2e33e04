// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The summary of a drive, for people and for programs.

#include <nlohmann/json_fwd.hpp>

#include "device/servo_loop.h"

namespace forceshade::apps {

void print(const device::ServoResult& run);

// The part of --json that is about the run.
nlohmann::ordered_json to_json(const device::ServoResult& run);

}  // namespace forceshade::apps
