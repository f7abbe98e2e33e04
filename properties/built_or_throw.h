// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Takes the result of a build(), or throws.

#include <stdexcept>
#include <utility>
#include <variant>

#include "forceshade/law.h"

namespace forceshade::properties {

// Throws std::invalid_argument with the error's message.
template <class T>
T built_or_throw(std::variant<T, ParameterError> result) {
  if (const auto* error = std::get_if<ParameterError>(&result)) throw std::invalid_argument(error->message());
  return std::get<T>(std::move(result));
}

}  // namespace forceshade::properties
