// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The parts of a picture.

#include <variant>
#include <vector>

#include "window/picture.h"

namespace forceshade::window {

template <class Kind>
std::vector<Kind> all_of(const Picture& picture) {
  std::vector<Kind> found;
  for (const Item& item : picture.items)
    if (const auto* its = std::get_if<Kind>(&item)) found.push_back(*its);
  return found;
}

}  // namespace forceshade::window
