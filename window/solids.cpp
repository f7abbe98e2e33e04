// SPDX-License-Identifier: BSD-3-Clause
#include "window/solids.h"

#include <cmath>

namespace forceshade::window {
namespace {

constexpr Colour kLit{0.867F, 0.894F, 0.914F}, kShade{0.357F, 0.435F, 0.506F};
constexpr Colour kCut{0.443F, 0.525F, 0.596F};
constexpr Colour kFrontEdge{0.176F, 0.239F, 0.298F}, kBackEdge{0.541F, 0.612F, 0.671F}, kRidge{0.318F, 0.396F, 0.463F};

Colour blend(Colour from, Colour to, double share) {
  const auto between = [&](float a, float b) { return static_cast<float>(a + share * (b - a)); };
  return {between(from.red, to.red), between(from.green, to.green), between(from.blue, to.blue)};
}

// The colour of a face that climbs by `rise` over `run`. Light comes from 50 degrees to the left of the vertical, so that a
// plane is of a middle shade, the left flank of a bump brighter and its right flank darker.
Colour shade(double rise, double run) {
  const double light = std::cos(std::atan2(rise, run) - 0.87);
  return blend(kShade, kLit, std::fmin(1, std::fmax(0, light)));
}

void add_quadrangle(Triangles& triangles, const std::array<Vertex, 4>& corners) {
  for (const int i : {0, 1, 2, 0, 2, 3}) triangles.vertices.push_back(corners[static_cast<std::size_t>(i)]);
}

}  // namespace

std::vector<Item> drawn_out(std::span<const ProfilePoint> profile, const Solid& solid) {
  const double front = -solid.depth / 2, back = solid.depth / 2;
  Triangles faces;
  Line near{{}, kFrontEdge, 1.5 * solid.edge}, far{{}, kBackEdge, solid.edge};
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const ProfilePoint b = profile[i];
    const Point near_b = solid.pixel({b.x, front, b.z}), far_b = solid.pixel({b.x, back, b.z});
    near.points.push_back(near_b);
    far.points.push_back(far_b);
    if (i == 0) continue;
    const ProfilePoint a = profile[i - 1];
    const Point near_a = near.points[i - 1], far_a = far.points[i - 1];
    const Colour colour = shade(b.z - a.z, b.x - a.x);
    add_quadrangle(faces, {{{near_a, colour}, {far_a, colour}, {far_b, colour}, {near_b, colour}}});
    add_quadrangle(faces, {{{near_a, kCut},
                            {near_b, kCut},
                            {solid.pixel({b.x, front, -solid.thickness}), kCut},
                            {solid.pixel({a.x, front, -solid.thickness}), kCut}}});
  }
  std::vector<Item> items{faces};
  for (std::size_t i = 1; solid.has_ridges && i + 1 < profile.size(); ++i)
    items.emplace_back(Line{{near.points[i], far.points[i]}, kRidge, solid.edge});
  items.emplace_back(far);
  items.emplace_back(near);
  return items;
}

}  // namespace forceshade::window
