// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The functions that each kind of height map states in its own header: formula(), jet(), error_of(), cut() and jet_in(),
// constant_gradient(), tallest() and outline_of(). One that lacks any of them does not compile.

#include <cmath>
#include <optional>

#include "reference/heights/check.h"
#include "reference/heights/cuts.h"
#include "reference/heights/jet.h"
#include "reference/heights/outline.h"

namespace forceshade::reference {

// A transcendental height at a position is an Enclosure or an ExponentialSum.
enum class Formula { polynomial, with_roots, transcendental };
template <class Kind>
constexpr Formula formula();

// A gradient that is the same everywhere, mm/mm.
struct ConstantGradient {
  Rational x, y;
};
inline std::optional<ConstantGradient> level_if(bool is_level) {
  return is_level ? std::optional(ConstantGradient{0, 0}) : std::nullopt;
}

inline double size_of(float value) {
  return std::fabs(static_cast<double>(value));
}

}  // namespace forceshade::reference
