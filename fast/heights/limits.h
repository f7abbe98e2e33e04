// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The numbers of the domain of height maps (docs/height-maps.md). What proofs assume of sizes follows from them, which
// tests/fast/height_bounds_test.cpp computes.

#include <cstddef>
#include <cstdint>

namespace forceshade::fast::height_limits {

inline constexpr float kSmallestStiffness = 1e-3F, kLargestStiffness = 1e3F;  // N/mm
inline constexpr float kLargestHeight = 1e4F;                                 // mm
inline constexpr float kLargestSlope = 1e3F;                                  // mm/mm, and rad/mm, rad of a grating
inline constexpr float kSmallestReach = 1e-3F, kLargestReach = 1e4F;          // mm: rim of a cone, sigma, step of knots
inline constexpr float kSmallestRadius = 0.1F, kLargestRadius = 1e4F;         // mm: of the cylinder or sphere of a cap
inline constexpr float kSmallestWidth = 1e-3F;                                // mm
inline constexpr float kSmallestPitch = 1e-3F, kLargestPitch = 1e2F;          // mm
inline constexpr std::uint32_t kFewestSamples = 2, kMostSamples = 1U << 15;
inline constexpr float kFewestKnots = 2, kMostKnots = 1025;
inline constexpr std::size_t kMostParts = 16;

}  // namespace forceshade::fast::height_limits
