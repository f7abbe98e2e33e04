// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The settings of the supervisor and the passivity controller of a run, and its damping, as its recording keeps them.

#include <optional>
#include <string>

#include "forceshade/recording.h"
#include "forceshade/servo_loop.h"

namespace forceshade::recorder {

// One key for each number, `supervisor_*` and `passivity_*`, in the shortest form that reads back the same.
Metadata metadata_of(const device::SafetySettings& settings);

// Nothing without any of these keys, as in a recording of an earlier version. Throws Error, naming the file and
// the key, where one is missing or is not what metadata_of() writes.
std::optional<device::SafetySettings> safety_settings_in(const Metadata& metadata, const std::string& path);

// `damping_*`; nothing where it is off.
Metadata metadata_of(const damping::Parameters& damping);

// Nothing where the run had none. Throws Error as above, and where the rate is not that of the run.
std::optional<damping::Parameters> damping_in(const Metadata& metadata, const std::string& path);

}  // namespace forceshade::recorder
