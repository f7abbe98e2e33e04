// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The reason why a window or its settings were refused, in words for the researcher.

#include <stdexcept>

namespace forceshade::window {

class Error : public std::runtime_error {
 public:
  using runtime_error::runtime_error;
};

}  // namespace forceshade::window
