// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The words of recordings and summaries about a run: the rendering, the device, the build and the settings.

#include <string>
#include <utility>
#include <vector>

#include "forceshade/identity.h"
#include "forceshade/recording.h"
#include "forceshade/servo_loop.h"

namespace forceshade::run {

// "height_map": the kind of a rendering as a key.
std::string key_of_kind(const Identity& identity);

// The identity as a recording keeps it.
recorder::Metadata metadata_of(const Identity& identity);

// The build, the device by its name and by its own words, the pace, the settings of supervisor and controller, and damping.
recorder::Metadata metadata_of_run(const std::string& device, const device::Capabilities& capabilities,
                                   const device::ServoOptions& servo);

// Model, serial, driver and firmware, as far as the device gives them.
std::vector<std::pair<std::string, std::string>> words_of(const device::Capabilities& capabilities);

// "0.002 N s/mm along the force, which it lengthens to 2 times at most; ...".
std::string words_of(const damping::Parameters& damping);

// "X,Y,Z" in mm, each in the shortest form that reads back the same.
std::string origin_words(const device::Placement& placement);

// Along which of the device's axes the subject's x, y and z point: "+x,+y,+z" where it is not turned.
std::string axes_words(const device::Placement& placement);

}  // namespace forceshade::run
