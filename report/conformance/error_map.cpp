// SPDX-License-Identifier: BSD-3-Clause
#include "report/conformance/error_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "report/conformance/error_size.h"
#include "report/gnuplot.h"
#include "report/panels.h"
#include "report/plot_text.h"

namespace forceshade::conformance {
namespace {

using properties::plotted;

struct Plane {
  Eigen::Index up = 2;                            // the axis that is drawn upwards; x is drawn to the right
  double left = 0, right = 0, low = 0, high = 0;  // mm
  std::string lines;                              // x and the other coordinate, what lies beneath the positions
  const char* what_is_drawn = "";
  bool is_to_scale = false;
};

Plane plane_of(const DescribedLaw& its) {
  const properties::Drawn law(its.law, its.parameters);
  const auto [low, high] = heights(law);
  Plane plane{2, -law.reach(), law.reach(), low, high, "", "The line is the nominal surface.", false};
  for (const properties::Sample& sample : across(law)) {
    const auto x = static_cast<double>(sample.x);
    plane.lines += plotted(x) + ' ' + plotted(law.surface(x)) + '\n';
  }
  return plane;
}

// The edges of the mesh, and a fifth of its size around them.
Plane plane_of(const mesh::TriangleMesh& mesh) {
  constexpr std::size_t kMostEdges = 6000;
  Plane plane{1, HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL, "", "", true};
  for (const mesh::Vertex& vertex : mesh.vertices) {
    plane.left = std::min(plane.left, static_cast<double>(vertex[0]));
    plane.right = std::max(plane.right, static_cast<double>(vertex[0]));
    plane.low = std::min(plane.low, static_cast<double>(vertex[1]));
    plane.high = std::max(plane.high, static_cast<double>(vertex[1]));
  }
  const double room = std::max(0.1 * std::max(plane.right - plane.left, plane.high - plane.low), 1e-3);
  plane.left -= room, plane.right += room, plane.low -= room, plane.high += room;
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& triangle : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) edges.insert(std::minmax(triangle[i], triangle[(i + 1) % 3]));
  if (edges.size() > kMostEdges) return plane;
  for (const auto& [a, b] : edges) {
    for (const std::uint32_t at : {a, b})
      plane.lines +=
          plotted(static_cast<double>(mesh.vertices[at][0])) + ' ' + plotted(static_cast<double>(mesh.vertices[at][1])) + '\n';
    plane.lines += '\n';
  }
  plane.what_is_drawn = "The lines are the edges of the mesh.";
  return plane;
}

// A height map has no end but that of the domain: what four fifths of the positions are in.
Plane plane_of(const std::vector<Place>& places) {
  Plane plane{1, -1, 1, -1, 1, "", "", false};
  for (const Eigen::Index axis : {0, 1}) {
    std::vector<double> all;
    for (const Place& place : places)
      if (std::isfinite(place.position[axis])) all.push_back(static_cast<double>(place.position[axis]));
    if (all.empty()) continue;
    std::ranges::sort(all);
    const double low = all[all.size() / 10], high = all[all.size() - 1 - all.size() / 10];
    const double room = std::max(0.05 * (high - low), 1e-3);
    (axis == 0 ? plane.left : plane.low) = low - room;
    (axis == 0 ? plane.right : plane.high) = high + room;
  }
  return plane;
}

Plane plane_of(const Description& subject, const std::vector<Place>& places) {
  return subject.visit([](const DescribedLaw& law) { return plane_of(law); },
                       [](const MeshRendering& rendering) { return plane_of(rendering.mesh()); },
                       [&](const auto&) { return plane_of(places); });
}

}  // namespace

ErrorMap error_map(const Judgement& found, const Description& subject) {
  std::vector<Place> places = found.right.values();
  const std::vector<Place> wrong = found.wrong.values();
  places.insert(places.end(), wrong.begin(), wrong.end());
  const Plane plane = plane_of(subject, places);

  ErrorMap map{plane.up == 2 ? "from the side: <i>x</i> and <i>z</i>" : "from above: <i>x</i> and <i>y</i>", "",
               plane.what_is_drawn};
  std::array<std::string, kErrorSizes.size()> blocks;
  for (const Place& place : places) {
    const auto x = static_cast<double>(place.position.x()), up = static_cast<double>(place.position[plane.up]);
    if (x >= plane.left && x <= plane.right && up >= plane.low && up <= plane.high)
      blocks[static_cast<std::size_t>(&size_of(place.ulps) - kErrorSizes.data())] += plotted(x) + ' ' + plotted(up) + '\n';
    else
      ++map.outside;
  }

  // px
  constexpr int kWidth = 600, kBeside = 58, kAbove = 34, kBelow = 48;
  const double across = kWidth - 1.3 * kBeside;
  const double up =
      plane.is_to_scale ? std::clamp(across * (plane.high - plane.low) / (plane.right - plane.left), 160.0, 520.0) : 300;
  const int height = static_cast<int>(up) + kAbove + kBelow;
  std::string script = "$lines << EOD\n" + plane.lines + "EOD\n", plots;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    if (blocks[i].empty()) continue;
    const std::string name = "$errors" + std::to_string(i);
    script += name + " << EOD\n" + blocks[i] + "EOD\n";
    plots += (plots.empty() ? "" : ", ") + name + " with points pt 7 ps " + (i == 0 ? "0.22" : "0.45") + " lc rgb '" +
             kErrorSizes[i].colour + '\'';
  }
  if (!plane.lines.empty())
    plots = "$lines with lines lw " + std::string(plane.up == 2 ? "1.4 lc rgb '#222222'" : "0.6 lc rgb '#9aa7b3'") +
            (plots.empty() ? "" : ", ") + plots;
  else if (plots.empty())
    plots = "NaN";
  map.svg = properties::svg_plot(
      {kWidth, height, "error-map", "Positions of answers, coloured by how far they are from the correctly rounded force"},
      script + properties::kPlain +
          properties::margins(kBeside / double(kWidth), 1 - 0.3 * kBeside / double(kWidth), 1 - kAbove / double(height),
                              kBelow / double(height)) +
          properties::range("x", plane.left, plane.right) + properties::range("y", plane.low, plane.high) + properties::kXName +
          properties::vertical_name(plane.up == 2 ? "{/:Italic z} (mm)" : "{/:Italic y} (mm)") + "plot " + plots + '\n');
  return map;
}

}  // namespace forceshade::conformance
