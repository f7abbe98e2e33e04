// SPDX-License-Identifier: BSD-3-Clause
#include "apps/surface_cut.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "forceshade/meshes.h"
#include "properties/mesh_properties.h"
#include "window/contact_border.h"

namespace forceshade::apps {
namespace {

using window::Column;
using window::ProfilePoint;
using window::Region;
using window::Section;
using Segment = std::array<ProfilePoint, 2>;

constexpr double kAspect = 1.9;
constexpr int kColumns = 400, kRows = 160;  // places at which contact is looked for
constexpr double kSeen = 0.3;               // mm: by which a shape that is felt differs from the surface

Region region_around(double x, double z, double width, double share_below) {
  const double height = width / kAspect;
  return {x - width / 2, x + width / 2, z - share_below * height, z + (1 - share_below) * height};
}

// A bump as wide as this with some of the plane beside it.
Region region_of(double width) {
  return region_around(0, 0, 2.6 * width, 0.35);
}

Eigen::Vector3d vector_of(const mesh::Vertex& vertex) {
  const auto& [x, y, z] = vertex;
  return {static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
}

// All of a mesh, with room around it for a hand.
Region region_of(const mesh::Facts& facts) {
  const Eigen::Vector3d low = vector_of(facts.low), high = vector_of(facts.high), size = high - low, middle = (low + high) / 2;
  const double width = 1.25 * std::max({size.x(), kAspect * size.z(), 1.0});
  return region_around(middle.x(), middle.z(), width, 0.5 - std::min(0.1, 0.1 * width / kAspect / std::max(size.z(), 1e-3)));
}

double x_of_column(const Region& region, int column) {
  return region.left + (region.right - region.left) * column / kColumns;
}

// Stretches with contact, from the top downwards, turned around in the end.
Section cut_field(fast::Session& session, const Region& region, double y) {
  Section section;
  const double step = (region.top - region.bottom) / kRows;
  for (int i = 0; i <= kColumns; ++i) {
    Column column{x_of_column(region, i), {}};
    const auto is_inside = [&](double z) {
      return finished(session.step({static_cast<float>(column.x), static_cast<float>(y), static_cast<float>(z)}).status) ==
             Status::contact;
    };
    bool was_inside = is_inside(region.top);
    if (was_inside) column.inside.push_back({region.bottom, region.top});
    for (int k = 1; k <= kRows; ++k) {
      const double z = region.top - k * step;
      if (is_inside(z) == was_inside) continue;
      if (was_inside)
        column.inside.back().low = window::contact_border(z + step, z, is_inside);
      else
        column.inside.push_back({region.bottom, window::contact_border(z, z + step, is_inside)});
      was_inside = !was_inside;
    }
    std::ranges::reverse(column.inside);
    section.columns.push_back(std::move(column));
  }
  for (std::size_t i = 1; i < section.columns.size(); ++i) {
    const Column &a = section.columns[i - 1], &b = section.columns[i];
    if (a.inside.size() != b.inside.size()) continue;
    for (std::size_t k = 0; k < a.inside.size(); ++k) {
      section.border.push_back({{{a.x, a.inside[k].high}, {b.x, b.inside[k].high}}});
      if (std::max(a.inside[k].low, b.inside[k].low) > region.bottom)
        section.border.push_back({{{a.x, a.inside[k].low}, {b.x, b.inside[k].low}}});
    }
  }
  return section;
}

// The curve that begins with the surface, and is everywhere at right angles to the force just below it. It begins again where
// the surface breaks off.
std::vector<Segment> felt_shape(fast::Session& session, const std::vector<Column>& columns, const Region& region, double y) {
  struct Place {
    double surface, slope;
  };
  const auto place_of = [&](const Column& column) -> std::optional<Place> {
    if (column.inside.size() != 1 || column.inside[0].low > region.bottom) return std::nullopt;
    const double surface = column.inside[0].high;
    const Eigen::Vector3d force =
        session.step(Eigen::Vector3d(column.x, y, surface - 2 * window::kBorderAccuracy).cast<float>()).force.cast<double>();
    if (!(force.z() > 0.1 * force.norm())) return std::nullopt;
    return Place{surface, -force.x() / force.z()};
  };
  std::vector<Segment> shape;
  std::optional<Place> before;
  double height = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::optional<Place> here = place_of(columns[i]);
    if (here && before) {
      const double x = columns[i - 1].x, next = height + (columns[i].x - x) * (before->slope + here->slope) / 2;
      if (std::max(std::fabs(height - before->surface), std::fabs(next - here->surface)) > kSeen)
        shape.push_back({{{x, height}, {columns[i].x, next}}});
      height = next;
    } else if (here) {
      height = here->surface;
    }
    before = here;
  }
  return shape;
}

// The lines in which the plane cuts triangles. A vertex in the plane counts as behind it, so that no line comes twice.
std::vector<Segment> cut_triangles(const mesh::TriangleMesh& mesh, double y) {
  std::vector<Segment> lines;
  for (const mesh::Triangle& triangle : mesh.triangles) {
    std::array<ProfilePoint, 2> ends{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d a = vector_of(mesh.vertices[triangle[i]]), b = vector_of(mesh.vertices[triangle[(i + 1) % 3]]);
      if ((a.y() < y) == (b.y() < y)) continue;
      const Eigen::Vector3d at = a + (y - a.y()) / (b.y() - a.y()) * (b - a);
      ends[count++] = {at.x(), at.z()};
    }
    if (count == 2) lines.push_back(ends);
  }
  return lines;
}

// A point above an even number of lines is outside; so is one above the last line of a surface without an underside.
Section cut_mesh(const mesh::TriangleMesh& mesh, const Region& region, double y) {
  Section section;
  section.border = cut_triangles(mesh, y);
  std::array<std::vector<double>, kColumns + 1> crossings;
  const double step = (region.right - region.left) / kColumns;
  for (const auto& [a, b] : section.border) {
    const auto& [low, high] = std::minmax(a, b, [](const ProfilePoint& p, const ProfilePoint& q) { return p.x < q.x; });
    const int from = std::max(0, static_cast<int>(std::ceil((low.x - region.left) / step)));
    for (int i = from; i <= kColumns && x_of_column(region, i) < high.x; ++i)
      crossings[static_cast<std::size_t>(i)].push_back(low.z +
                                                       (x_of_column(region, i) - low.x) / (high.x - low.x) * (high.z - low.z));
  }
  for (int i = 0; i <= kColumns; ++i) {
    std::vector<double>& heights = crossings[static_cast<std::size_t>(i)];
    if (heights.size() % 2 != 0) heights.push_back(region.bottom);
    std::ranges::sort(heights);
    Column column{x_of_column(region, i), {}};
    for (std::size_t k = 0; k + 1 < heights.size(); k += 2) column.inside.push_back({heights[k], heights[k + 1]});
    section.columns.push_back(std::move(column));
  }
  return section;
}

}  // namespace

SurfaceCut::SurfaceCut(const Description& what, const Rendering& rendering) : region_(region_of(25.4)) {
  what.visit(
      [&](const DescribedLaw& law) {
        if (has_bump_geometry(law.law)) region_ = region_of(static_cast<double>(law.parameters.width));
      },
      [&](const MeshRendering& its) {
        mesh_ = &its.mesh();
        const mesh::Facts facts = mesh::facts_of(its.checked);
        region_ = region_of(facts);
        middle_y_ = (vector_of(facts.low).y() + vector_of(facts.high).y()) / 2;
      },
      [](const DescribedHeightMap&) {}, [&](const DescribedScene&) { has_felt_shape_ = false; });
  if (mesh_ == nullptr) session_ = rendering.renderer.open();
}

const window::Section& SurfaceCut::at(double y) {
  if (section_ && std::fabs(y - y_) < kKept) return *section_;
  y_ = y;
  section_ = mesh_ != nullptr ? cut_mesh(*mesh_, region_, y) : cut_field(*session_, region_, y);
  if (mesh_ == nullptr && has_felt_shape_) section_->felt = felt_shape(*session_, section_->columns, region_, y);
  return *section_;
}

std::optional<window::Position> place_on(const mesh::TriangleMesh& mesh, const mesh::GodObject& state) {
  if (state.place == mesh::Place::nowhere || state.place == mesh::Place::free) return std::nullopt;
  const Eigen::Vector3d at = properties::point_of(mesh, state);
  return window::Position{at.x(), at.y(), at.z()};
}

}  // namespace forceshade::apps
