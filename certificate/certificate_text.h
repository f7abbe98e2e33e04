// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The sentences that all certificates share: written, and expected when read; and the words for people about a renderer.

#include "forceshade/certificate.h"

namespace forceshade::properties {

inline constexpr const char* kStatement =
    "At every point checked, each component of the fast path's force is the exact force rounded to binary32, nearest, ties to "
    "even; and the four properties held on every case.";
inline constexpr const char* kMethod =
    "Each answer is compared, bit for bit, with the rounded reference: a 64-bit enclosure where it decides, MPFI intervals of "
    "growing precision where it does not, CGAL's exact algebraic numbers for facets and rounding ties. Half of the points are "
    "aimed at surface neighbours, facet lines (of a height map: cell lines, edges and rims), the position quantum, domain "
    "ends, near-ties, the axis (centres, apexes and crests) and few-bit numbers. So are those of the spread, whose parameters "
    "are drawn from all of the domain. At every point the single call, and the calls by the code of each instruction set under "
    "points_by_instruction_set, were compared.";
inline constexpr const char* kDomain = R"({"radius_mm": [0.1, 10000.0], "width_mm": [0.001, "2 radius"],
  "stiffness_N_per_mm": [0.001, 1000.0], "position_mm": [-10000.0, 10000.0], "position_quantum_mm": "2^-30"})";

// Words behind a subject's name where another renderer than the library's was compared.
constexpr const char* words_behind_name(RenderedBy who) {
  if (who == RenderedBy::library) return "";
  return who == RenderedBy::program ? " (a program's own renderer)" : " (renderer unknown)";
}

}  // namespace forceshade::properties
