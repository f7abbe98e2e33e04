// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The text of --place.

#include <string>

#include "forceshade/servo_loop.h"

namespace forceshade::device {

// "X,Y,Z", lengths with or without units, within 10^4 mm; turns about the device's axes, one after the other, each an AXIS and
// an ANGLE, for instance "z90" or "x-90,z180deg"; or both, "X,Y,Z,x90". An empty text is no shift and no turn. Throws Error.
device::Placement parse_placement(const std::string& text);

}  // namespace forceshade::device
