// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Meshes that cross themselves and short paths on them that are hard for a god-object: needles, plates at tiny angles, sharp
// tips.

#include <array>
#include <cmath>
#include <cstdint>

#include "forceshade/mesh.h"
#include "properties/positions.h"

namespace forceshade::tests {

using Place = std::array<double, 3>;  // mm

inline constexpr std::array<const char*, 6> kHardFamilies{"a needle through a cube",
                                                          "two needles through a cube",
                                                          "plates at a tiny angle",
                                                          "three plates through a point",
                                                          "two pyramids",
                                                          "plates and a needle"};
inline constexpr std::size_t kHardPositions = 4;

struct HardCase {
  mesh::TriangleMesh mesh;
  mesh::Sides sides = mesh::Sides::front;
  std::array<std::array<float, 3>, kHardPositions> positions{};  // mm; the first one is free
};

class HardDraws : public properties::Draws {
 public:
  explicit HardDraws(std::uint64_t seed) : Draws(seed) {}
  // Every decade as likely.
  double size(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  Place direction();
  std::size_t below(std::size_t count) { return bits() % count; }
};

Place normalised(const Place& a);
// Two directions at a right angle to it and to each other.
std::array<Place, 2> across(HardDraws& random, const Place& along);
// The point middle + a u + b v + c w.
std::array<float, 3> at(const Place& middle, const Place& u, double a, const Place& v, double b, const Place& w, double c);

// a, b, c: half the sides of a box along u, v, w; these are right-handed.
void add_box(mesh::TriangleMesh& mesh, const Place& middle, const Place& u, double a, const Place& v, double b, const Place& w,
             double c);
// With sides of 10 mm.
void add_cube(mesh::TriangleMesh& mesh);

// family: in kHardFamilies. Not every mesh is one that may be rendered.
HardCase drawn_hard_case(std::size_t family, HardDraws& random);
// The same with one thing changed.
HardCase nudged(HardCase one, HardDraws& random);

}  // namespace forceshade::tests
