// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The words under which a certificate counts its points, each list in the order of the enumeration that it names.

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace forceshade::properties {

inline constexpr std::array<std::string_view, 9> kAimNames{"any bits",   "volume", "surface", "facet line", "quantum",
                                                           "domain end", "tie",    "axis",    "few bits"};
inline constexpr std::array<std::string_view, 3> kStageNames{"binary64", "double-double", "wide"};
inline constexpr std::array<std::string_view, 3> kMethodNames{"filter", "enclosure", "exact"};
inline constexpr std::array<std::string_view, 3> kStatusNames{"free", "contact", "invalid"};

// A law or height map is certified by all of them.
inline constexpr std::array<std::string_view, 4> kPropertyNames{"equivalence", "continuity", "unit normals", "passivity"};

// Cases of one property: passivity's case is a whole loop, so it has a tenth as many, one at least.
constexpr std::uint64_t cases_of(std::string_view property, std::uint64_t cases) {
  return property == "passivity" ? std::max<std::uint64_t>(1, cases / 10) : cases;
}

}  // namespace forceshade::properties
