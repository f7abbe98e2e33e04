// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The colours by which pictures tell errors apart.

#include <array>
#include <cstdint>

#include "properties/conformance/distance.h"

namespace forceshade::conformance {

struct ErrorSize {
  std::uint64_t least;  // ulp, up to that of the next one
  const char* colour;   // each darker than the one before, so that no sight of colours is needed
  const char* words;
};

inline constexpr std::array<ErrorSize, 6> kErrorSizes{{{0, "#c6c1b4", "0"},
                                                       {1, "#f0a830", "1"},
                                                       {2, "#d55e00", "2 to 255"},
                                                       {256, "#a31621", "256 to 65\u202F535"},
                                                       {65536, "#541388", "65\u202F536 and more"},
                                                       {kNoNumber, "#000000", "no finite force"}}};

inline const ErrorSize& size_of(std::uint64_t ulps) {
  std::size_t i = kErrorSizes.size() - 1;
  while (ulps < kErrorSizes[i].least) --i;
  return kErrorSizes[i];
}

}  // namespace forceshade::conformance
