// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The texts of --origin and --turn.

#include <string>

#include "forceshade/servo_loop.h"

namespace forceshade::device {

// "X,Y,Z", lengths with or without units, within 10^4 mm; and AXIS and ANGLE, for instance "z90" or "x-90,z180deg": turns about
// the device's axes, one after the other. An empty text is no shift, or no turn. Throw Error.
device::Placement parse_placement(const std::string& origin, const std::string& turn);

}  // namespace forceshade::device
