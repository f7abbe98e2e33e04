// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How much must have been checked before a device is driven: also what certify checks unless told otherwise.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>

#include "forceshade/certificate/certificate.h"

namespace forceshade::properties {

inline constexpr std::uint64_t kPointsOfALaw = 1000000, kPointsOfAHeightMap = 200000;  // the reference is slower for maps
inline constexpr std::uint64_t kCases = 2000;                                          // per property

// Points of a certificate's spread over other parameters: a quarter as many as with those asked for, one at least.
constexpr std::uint64_t spread_points(std::uint64_t points) {
  return (points + 3) / 4;
}

// What is too little for driving, in words: "the certificate has 1 point for wall; driving needs at least 1000000". Each aim
// must be reached, with the parameters asked for and in the spread, and each stage that the law can reach in one of them. Which
// stages a height map can reach depends on its parts: binary64 is all that is expected of it.
std::optional<std::string> lacking(const LawResult& law);
std::optional<std::string> lacking(const HeightMapResult& map);

}  // namespace forceshade::properties
