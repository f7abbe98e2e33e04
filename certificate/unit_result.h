// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The result of a unit of work, as text: identical for identical work. It has no time, no host and no processor.

#include <cstdint>
#include <string>

#include "certificate/work.h"

namespace forceshade::properties {

// plan: the digest of the plan that the unit is of. One line of JSON, without its end. Throws Error where an energy
// is not finite.
std::string text_of_unit(const std::string& plan, std::uint64_t number, const Units& units, const Found& found);

// Throws Error, naming the file, where the text is of another plan or unit, or is no such text.
Found unit_from_text(const std::string& text, const std::string& plan, std::uint64_t number, const Units& units,
                     const std::string& file);

}  // namespace forceshade::properties
