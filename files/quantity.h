// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Quantities as people write them: lengths (15.24, 15.24mm, 600mil, 0.6in, 2.54cm, 0.01m), stiffnesses (0.5, 0.5N/mm, 500N/m)
// dampings (0.002, 0.002Ns/mm, 2Ns/m), forces, times and angles (30, 30deg, 0.5rad). A space may stand before the unit. Number
// times unit is exact until it is rounded.

#include <string>
#include <vector>

#include "files/decimal.h"

namespace forceshade::files {

// These throw Error. `name` is what a message calls the quantity.

// Millimetres, and the binary32 number nearest to them.
Decimal exact_length(const std::string& name, const std::string& text);
float parse_length(const std::string& name, const std::string& text);

// The binary32 number of N/mm nearest to a stiffness in N/mm, with or without that unit, or in N/m.
float parse_stiffness(const std::string& name, const std::string& text);

// The binary32 number of N·s/mm nearest to a damping in Ns/mm, with or without that unit, or in Ns/m.
float parse_damping(const std::string& name, const std::string& text);

// The binary32 number of N nearest to a force with or without that unit.
float parse_force(const std::string& name, const std::string& text);

// The binary32 number of s nearest to a time, which has a unit, s or ms.
float parse_time(const std::string& name, const std::string& text);

// The binary32 number nearest to one without a unit.
float parse_binary32(const std::string& name, const std::string& text);

struct Angle {
  Decimal number;  // degrees
  bool is_radians = false;
};

// An angle in degrees, with or without that unit, or in rad.
Angle exact_angle(const std::string& name, const std::string& text);
// The binary64 number of degrees nearest to it. An angle in rad whose first 300 digits of degrees leave that open is refused.
double parse_angle(const std::string& name, const std::string& text);

// The parts of a list with commas between them, such as "10mm,0,-1in"; one more than there are commas, each as it stands.
std::vector<std::string> at_commas(const std::string& text);

}  // namespace forceshade::files
