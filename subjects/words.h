// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Words of options that the readers of this folder share. Included by source files alone.

#include <string>
#include <string_view>
#include <vector>

#include "forceshade/law.h"
#include "subjects/options.h"

namespace forceshade::subjects {

inline constexpr std::string_view kTexturePrefix = "texture:";

inline bool is_texture(const std::string& shading) {
  return shading.starts_with(kTexturePrefix) && shading.size() > kTexturePrefix.size();
}

// The keys that a file has.
inline std::vector<std::string> names_of_keys() {
  std::vector<std::string> names;
  for (const Key& key : kKeys)
    if (key.name != kDrag && key.name != kDampingFilter) names.emplace_back(key.name);
  return names;
}

// "--width is 100 mm; expected ...", with the name that the option has.
inline std::string words_of(const ParameterError& error, const Options& options) {
  if (error.arithmetic_fault != nullptr) return error.message();
  return options.name(error.parameter) + error.message().substr(std::string_view(error.parameter).size());
}

}  // namespace forceshade::subjects
