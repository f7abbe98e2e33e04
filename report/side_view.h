// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A picture's view of a law or a height map: the plane in which y is constant, x to the right and z up.

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "properties/rendered.h"
#include "report/panels.h"

namespace forceshade::properties {

// The text above a picture in a file of its own; a page prints it beside the picture. Empty: nothing.
struct Heading {
  std::string title, parameters;
};

struct SideView {
  std::string name;
  double left, right;            // mm, what is shown
  Heights shown;                 // the surface and some way into it
  Heights nominal;               // the surface alone
  std::array<double, 3> depths;  // mm, below the surface: of a profile
  std::vector<Sample> across;
  std::vector<double> jumps;                               // mm: x of the lines on which the force jumps
  std::function<double(double x)> surface;                 // mm: where the force begins
  std::function<double(double x)> stands_for;              // mm: the shape that it is felt as; NaN where that is no other
  std::function<Eigen::Vector3f(float x, float z)> force;  // N, by the fast path
  std::function<double(double x, double z)> density;       // mJ/mm²: what a small counter-clockwise loop gives for its area
  Heading heading{};
};

SideView side_view(const Drawn& law);

// The part of a height map that is drawn, mm.
struct Range {
  float y, from, to;
};

// `renderer` draws the force; the rest is the reference's.
SideView side_view(const RenderedHeightMap& rendered, const std::string& name, const Range& range);

}  // namespace forceshade::properties
