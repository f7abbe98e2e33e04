// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What came of checking a renderer, property by property and loop by loop.

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace forceshade::properties {

struct PropertyResult {
  std::string name;  // one of kPropertyNames
  std::uint64_t cases = 0;
  bool held = true;
  std::string counterexample;  // the shrunk one, empty if held
};

// Cases of one property: passivity's case is a whole loop, so it has a tenth as many, one at least.
constexpr std::uint64_t cases_of(std::string_view property, std::uint64_t cases) {
  return property == "passivity" ? std::max<std::uint64_t>(1, cases / 10) : cases;
}

// How much energy simple loops of one depth can give to the hand, and how much one of them gives (docs/energy.md).
struct LoopEnergy {
  double depth_mm = 0;
  std::array<double, 2> bound_mJ{};  // an interval around the supremum
  double witness_mJ = 0;             // around the witness loop by the exact law
  double measured_mJ = 0;            // and by the fast path
};

}  // namespace forceshade::properties
