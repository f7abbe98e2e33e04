// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One picture of one law or height map each, from the fast path of this program; for a certificate's page and for files.

#include <array>
#include <string>
#include <vector>

#include "report/gnuplot.h"
#include "report/panels.h"
#include "report/side_view.h"

namespace forceshade::properties {

// Shades of one hue, distinct by lightness: the three depths of a profile.
inline constexpr std::array<const char*, 3> kDepthColours{"#85b8dc", "#2f7ab5", "#08315c"};
inline constexpr const char* kCurveColour = "#d55e00";

// Rows of text above a picture, in px: two of the heading, one of the legend.
inline constexpr int kHeadingHeight = 66;
// Draws the heading of a picture of this many pixels, and its legend in the row below; nothing without a title.
std::string heading_commands(const Heading& heading, int width, int height);

// Depths in mm that show what is special of each of the laws.
std::array<double, 3> profile_depths(const std::vector<Drawn>& laws);

// The force along the surface, at three depths below it.
struct ForceProfile {
  std::string block;        // x F_x F_z: a blank line at a jump, two between depths
  double side = 0, up = 0;  // N: largest |F_x|, largest F_z

  ForceProfile(const SideView& view, const std::array<double, 3>& depths);
};

// F_z above, F_x below, on axes with room for `side` and `up`, in N.
Picture force_profile(const SideView& view, const ForceProfile& profile, double side, double up);

// The surface on which the force begins, as long up as across, with the shape it stands for.
Picture cross_section(const SideView& view);

// The direction and size of the force over x and z.
Picture direction_field(const SideView& view);

// The circulation density κ over x and z: what a small counter-clockwise loop of the exact law gives for its area; and the
// lines on which the force jumps, which give energy in proportion to their length.
Picture energy_map(const SideView& view);

}  // namespace forceshade::properties
