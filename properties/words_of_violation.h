// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Takes the violation of a property or a fixed loop, an exception included.

#include <functional>

#include "forceshade/properties.h"

namespace forceshade::properties {

Violation words_of_violation(const std::function<Violation()>& check);

}  // namespace forceshade::properties
