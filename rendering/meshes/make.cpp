// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/make.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "rendering/meshes/readers.h"

namespace forceshade::mesh {
namespace {

using Point = std::array<double, 3>;

void require(bool holds, const char* words) {
  if (!holds) throw std::invalid_argument(words);
}

void require_length(double length) {
  require(length > 0 && std::isfinite(length), "expected a length above 0 mm");
}

void require_triangles(double triangles) {
  require(triangles <= static_cast<double>(kMost), "expected at most 2^28 triangles");
}

Vertex rounded(const Point& point) {
  Vertex vertex;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto kept = coordinate(static_cast<float>(point[i]));
    require(kept.has_value(), "expected coordinates within 10000 mm");
    vertex[i] = *kept;
  }
  return vertex;
}

// Vertices of a grid, row by row, as triangles: columns x rows cells.
void add_cells(std::vector<Triangle>& triangles, std::uint32_t columns, std::uint32_t rows) {
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column) {
      const std::uint32_t a = row * (columns + 1) + column, b = a + 1, d = a + columns + 1, c = d + 1;
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
}

// The icosahedron with corners (0, 1, g) and so on, g the golden ratio.
const std::array<Point, 12>& corners() {
  constexpr double g = std::numbers::phi;
  static const std::array<Point, 12> points{{{-1, g, 0},
                                             {1, g, 0},
                                             {-1, -g, 0},
                                             {1, -g, 0},
                                             {0, -1, g},
                                             {0, 1, g},
                                             {0, -1, -g},
                                             {0, 1, -g},
                                             {g, 0, -1},
                                             {g, 0, 1},
                                             {-g, 0, -1},
                                             {-g, 0, 1}}};
  return points;
}
constexpr std::array<Triangle, 20> kFaces{{{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                                           {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                                           {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

// Numbers the vertices of an icosphere: those of the corners, then those inside edges, then those inside faces.
class Icosphere {
 public:
  Icosphere(std::uint32_t frequency, double radius) : frequency_(frequency), radius_(radius) {
    for (std::uint32_t i = 0; i < 12; ++i) add({{{i, frequency}}});
    for (auto& row : edge_) row.fill(0);
    for (const Triangle& face : kFaces)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = face[k], b = face[(k + 1) % 3];
        if (a > b) continue;
        edge_[a][b] = edge_[b][a] = static_cast<std::uint32_t>(mesh_.vertices.size());
        for (std::uint32_t i = 1; i < frequency; ++i) add({{{a, frequency - i}, {b, i}}});
      }
    for (const Triangle& face : kFaces) add_face(face);
  }

  TriangleMesh take() { return std::move(mesh_); }

 private:
  struct Part {
    std::uint32_t corner, weight;
  };

  // The mean of corners with these weights, on the sphere. Parts come in one order for each vertex, so that it is the same
  // however it is reached.
  void add(const std::vector<Part>& parts) {
    Point point{};
    for (const Part& part : parts)
      for (std::size_t i = 0; i < 3; ++i) point[i] += corners()[part.corner][i] * part.weight;
    const double length = std::sqrt(point[0] * point[0] + point[1] * point[1] + point[2] * point[2]);
    for (double& x : point) x *= radius_ / length;
    mesh_.vertices.push_back(rounded(point));
  }

  // The vertex inside the edge from a to b, i steps from a.
  std::uint32_t inside_edge(std::uint32_t a, std::uint32_t b, std::uint32_t i) const {
    return edge_[a][b] + (a < b ? i : frequency_ - i) - 1;
  }

  void add_face(const Triangle& face) {
    const std::uint32_t a = face[0], b = face[1], c = face[2];
    const auto inside = static_cast<std::uint32_t>(mesh_.vertices.size());
    for (std::uint32_t k = 1; k < frequency_; ++k)
      for (std::uint32_t i = 1; i + k < frequency_; ++i) add({{{a, frequency_ - i - k}, {b, i}, {c, k}}});
    // i steps towards b and k towards c.
    const auto vertex = [&](std::uint32_t i, std::uint32_t k) {
      if (i == 0 && k == 0) return a;
      if (i == frequency_) return b;
      if (k == frequency_) return c;
      if (k == 0) return inside_edge(a, b, i);
      if (i == 0) return inside_edge(a, c, k);
      if (i + k == frequency_) return inside_edge(b, c, k);
      // Row k has frequency - k - 1 of them.
      return inside + (k - 1) * (frequency_ - 1) - k * (k - 1) / 2 + i - 1;
    };
    for (std::uint32_t k = 0; k < frequency_; ++k)
      for (std::uint32_t i = 0; i + k < frequency_; ++i) {
        mesh_.triangles.push_back({vertex(i, k), vertex(i + 1, k), vertex(i, k + 1)});
        if (i + k + 1 < frequency_) mesh_.triangles.push_back({vertex(i + 1, k), vertex(i + 1, k + 1), vertex(i, k + 1)});
      }
  }

  std::uint32_t frequency_;
  double radius_;
  std::array<std::array<std::uint32_t, 12>, 12> edge_{};  // the first vertex inside it, in the order from its lower corner
  TriangleMesh mesh_;
};

// The height of a cap of this radius and width at a distance from its middle.
double cap(double radius, double width, double distance) {
  if (distance >= width / 2) return 0;
  return std::sqrt((radius - distance) * (radius + distance)) - std::sqrt((radius - width / 2) * (radius + width / 2));
}

void require_cap(double radius, double width) {
  require_length(radius);
  require_length(width);
  require(width <= 2 * radius, "expected a width of at most twice the radius");
}

}  // namespace

std::vector<std::array<TexturePoint, 3>> texture_from_above(const TriangleMesh& mesh) {
  std::vector<std::array<TexturePoint, 3>> points;
  for (const Triangle& triangle : mesh.triangles) {
    points.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) points.back()[i] = {mesh.vertices[triangle[i]][0], mesh.vertices[triangle[i]][1]};
  }
  return points;
}

std::vector<std::array<TexturePoint, 3>> texture_from_box(const TriangleMesh& mesh) {
  std::vector<std::array<TexturePoint, 3>> points;
  for (const Triangle& triangle : mesh.triangles) {
    const auto side = [&](std::size_t end, std::size_t axis) {
      return static_cast<double>(mesh.vertices[triangle[end]][axis]) - static_cast<double>(mesh.vertices[triangle[0]][axis]);
    };
    std::size_t longest = 0;
    double most = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t j = (axis + 1) % 3, k = (axis + 2) % 3;
      const double component = side(1, j) * side(2, k) - side(1, k) * side(2, j);
      if (std::fabs(component) <= std::fabs(most)) continue;
      longest = axis;
      most = component;
    }
    points.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const Vertex& vertex = mesh.vertices[triangle[i]];
      const float across = vertex[(longest + 1) % 3];
      points.back()[i] = {most < 0 ? 0.0F - across : across, vertex[(longest + 2) % 3]};
    }
  }
  return points;
}

TriangleMesh icosphere(std::uint32_t frequency, double radius) {
  require(frequency >= 1, "expected a frequency of 1 or more");
  require_length(radius);
  require_triangles(20.0 * frequency * frequency);
  return Icosphere(frequency, radius).take();
}

TriangleMesh box(double size_x, double size_y, double size_z) {
  for (const double size : {size_x, size_y, size_z}) require_length(size);
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 8; ++i)
    mesh.vertices.push_back(rounded(
        {((i & 1U) != 0 ? 0.5 : -0.5) * size_x, ((i & 2U) != 0 ? 0.5 : -0.5) * size_y, ((i & 4U) != 0 ? 0.5 : -0.5) * size_z}));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

TriangleMesh cube(double size) {
  return box(size, size, size);
}

TriangleMesh thin_wall(double size_x, double size_y, std::uint32_t columns, std::uint32_t rows) {
  return height_map(size_x, size_y, columns, rows, [](double, double) { return 0.0; });
}

TriangleMesh torus(double radius, double across_radius, std::uint32_t around, std::uint32_t across) {
  require_length(radius);
  require_length(across_radius);
  require(across_radius < radius, "expected a radius across that is less than the radius");
  require(around >= 3 && across >= 3, "expected 3 sections and 3 corners or more");
  require_triangles(2.0 * around * across);
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t k = 0; k < across; ++k) {
      const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * k / across;
      const double distance = radius + across_radius * std::cos(v);
      mesh.vertices.push_back(rounded({distance * std::cos(u), distance * std::sin(u), across_radius * std::sin(v)}));
    }
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t k = 0; k < across; ++k) {
      const std::uint32_t next_i = (i + 1) % around, next_k = (k + 1) % across;
      const std::uint32_t a = i * across + k, b = next_i * across + k, c = next_i * across + next_k, d = i * across + next_k;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  return mesh;
}

TriangleMesh height_map(double size_x, double size_y, std::uint32_t columns, std::uint32_t rows,
                        const std::function<double(double x, double y)>& height) {
  require_length(size_x);
  require_length(size_y);
  require(columns >= 1 && rows >= 1, "expected 1 cell or more each way");
  require_triangles(2.0 * columns * rows);
  TriangleMesh mesh;
  mesh.vertices.reserve((std::size_t{columns} + 1) * (std::size_t{rows} + 1));
  mesh.triangles.reserve(2 * std::size_t{columns} * rows);
  for (std::uint32_t row = 0; row <= rows; ++row)
    for (std::uint32_t column = 0; column <= columns; ++column) {
      const double x = size_x * (static_cast<double>(column) / columns - 0.5),
                   y = size_y * (static_cast<double>(row) / rows - 0.5);
      mesh.vertices.push_back(rounded({x, y, height(x, y)}));
    }
  add_cells(mesh.triangles, columns, rows);
  return mesh;
}

TriangleMesh bump(double radius, double width, double size, std::uint32_t cells) {
  require_cap(radius, width);
  return height_map(size, size, cells, cells, [&](double x, double y) { return cap(radius, width, std::hypot(x, y)); });
}

TriangleMesh cylinder_bump(double radius, double width, double size, std::uint32_t cells) {
  require_cap(radius, width);
  return height_map(size, size, cells, cells, [&](double x, double) { return cap(radius, width, std::fabs(x)); });
}

}  // namespace forceshade::mesh
