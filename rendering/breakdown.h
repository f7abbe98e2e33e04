// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The words under which a certificate counts its points, each list in the order of the enumeration that it names.

#include <array>
#include <string_view>

namespace forceshade::properties {

inline constexpr std::array<std::string_view, 9> kAimNames{"any bits",   "volume", "surface", "facet line", "quantum",
                                                           "domain end", "tie",    "axis",    "few bits"};
inline constexpr std::array<std::string_view, 3> kStageNames{"binary64", "double-double", "wide"};
inline constexpr std::array<std::string_view, 3> kMethodNames{"filter", "enclosure", "exact"};
inline constexpr std::array<std::string_view, 3> kStatusNames{"free", "contact", "invalid"};

// A law or height map is certified by all of them.
inline constexpr std::array<std::string_view, 4> kPropertyNames{"equivalence", "continuity", "unit normals", "passivity"};

}  // namespace forceshade::properties
