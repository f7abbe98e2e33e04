// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The pictures of a conformance run: how large the errors are, and where.

#include <cstdint>
#include <string>
#include <vector>

#include "forceshade/description.h"
#include "properties/conformance/invariants/invariant.h"
#include "properties/conformance/judge.h"
#include "properties/conformance/recordings/judged_recording.h"

namespace forceshade::conformance {

// One <figure> after another, from this number on; empty where nothing was judged. Throws Error.
std::string figures(const Judgement& found, const Description& subject, int first = 1);

// The measured and the exact force of a recording over time. Throws Error.
std::string course_figure(int number, const std::vector<TimedForce>& course);

// The largest deviation of each invariant that measured one, over the allowed one; empty where none did. Throws Error.
std::string deviations_figure(const std::vector<Invariant>& invariants);

// A map of the errors: positions in a plane, coloured by the error.

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
