// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Why there is no window, or why its settings were refused, in words for the researcher.

#include <stdexcept>

namespace forceshade::window {

class Error : public std::runtime_error {
 public:
  using runtime_error::runtime_error;
};

}  // namespace forceshade::window
