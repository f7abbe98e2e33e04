// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a property or a fixed loop finds, an exception included.

#include <functional>

#include "forceshade/properties.h"

namespace forceshade::properties {

Violation words_of_violation(const std::function<Violation()>& check);

}  // namespace forceshade::properties
