// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Quantities as people write them: lengths (15.24, 15.24mm, 600mil, 0.6in, 2.54cm, 0.01m), stiffnesses (0.5, 0.5N/mm, 500N/m)
// and angles (30, 30deg, 0.5rad). A space may stand before the unit.

#include <string>
#include <vector>

namespace forceshade::files {

// The binary32 number of millimetres nearest to the length. `name` is what a message calls it. Throws BadInput.
float parse_length(const std::string& name, const std::string& text);

// A stiffness in N/mm, with or without that unit, or in N/m; rounded once, too. Throws BadInput.
float parse_stiffness(const std::string& name, const std::string& text);

// Degrees, of an angle in degrees, with or without that unit, or in rad. Throws BadInput.
double parse_angle(const std::string& name, const std::string& text);

// The parts of a list with commas between them, such as "10mm,0,-1in"; one more than there are commas, each as it stands.
std::vector<std::string> at_commas(const std::string& text);

}  // namespace forceshade::files
