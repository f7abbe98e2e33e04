// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "window/text.h"

namespace forceshade::window {

// A font whose characters are all half as wide as they are high.
class EvenFont : public Measure {
 public:
  double width(std::string_view words, double size) const override {
    return 0.5 * size * static_cast<double>(code_points(words).size());
  }
};

}  // namespace forceshade::window
