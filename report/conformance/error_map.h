// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A map of the errors: positions in a plane, coloured by the error.

#include <cstdint>
#include <string>

#include "forceshade/description.h"
#include "properties/conformance/judge.h"

namespace forceshade::conformance {

struct ErrorMap {
  std::string plane;  // HTML: from where one looks
  std::string svg;
  std::string what_is_drawn;  // a sentence, of the lines beneath the positions
  std::uint64_t outside = 0;  // positions that are not in the picture
};

// The kept positions of the judgement: of a law over x and z with its surface, of a height map or a mesh over x and y, with the
// edges of the mesh. Throws Error.
ErrorMap error_map(const Judgement& found, const Description& subject);

}  // namespace forceshade::conformance
