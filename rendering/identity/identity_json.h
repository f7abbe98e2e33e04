// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An identity's parameters in JSON, the same in a certificate, a summary and a report of properties.

#include <nlohmann/json.hpp>

#include "forceshade/identity.h"

namespace forceshade {

// Binary32 numbers are written as the binary64 numbers they are, so they come back the same.
inline nlohmann::ordered_json parameters_json(const Identity& identity) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [key, value] : identity.parameters) {
    if (const auto* number = std::get_if<float>(&value))
      json[key] = static_cast<double>(*number);
    else
      json[key] = std::get<std::string>(value);
  }
  return json;
}

}  // namespace forceshade
