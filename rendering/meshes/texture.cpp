// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/texture.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "rendering/half_edges.h"
#include "rendering/meshes/bounded_number.h"
#include "rendering/meshes/creases.h"
#include "rendering/meshes/interval.h"
#include "rendering/meshes/readers.h"
#include "rendering/vectors.h"

namespace forceshade::mesh {
namespace {

using Points = std::array<TexturePoint, 3>;

constexpr double kSteepest = 1000, kLeastGradient = 0x1p-30;  // mm/mm
constexpr int kFirstTextureBits = 320, kLastTextureBits = 1280;

std::string face(std::size_t i) {
  return "face " + std::to_string(i);
}

// 1 where the triangle is as in the texture, -1 where it is turned over there, 0 where it has no area there.
int orientation(const Points& points) {
  const auto in_plane = [](const TexturePoint& p) { return Vertex{p[0], p[1], 0}; };
  return turn(2, in_plane(points[0]), in_plane(points[1]), in_plane(points[2]));
}

class Gradients {
 public:
  Gradients(const TriangleMesh& mesh, const std::vector<Points>& points, double crease_degrees)
      : mesh_(mesh), points_(points), opposite_(opposite_half_edges(mesh)), separates_(3 * mesh.triangles.size()) {
    std::vector<int> orientations;
    for (std::size_t i = 0; i < points.size(); ++i) {
      orientations.push_back(orientation(points[i]));
      if (orientations.back() == 0)
        throw std::invalid_argument(face(i) + " has no area in the texture: its three points lie on a line");
    }
    for (std::uint32_t h = 0; h < separates_.size(); ++h) {
      const std::uint32_t other = opposite_[h];
      separates_[h] = other == kNoEdge || orientations[h / 3] != orientations[other / 3] ||
                      point_at(h) != point_at(next_in_triangle(other)) || point_at(next_in_triangle(h)) != point_at(other) ||
                      (crease_degrees < 180 && turns_by_more(triangle(h / 3), triangle(other / 3), crease_degrees));
    }
  }

  CornerTextures run() const {
    CornerTextures corners(mesh_.triangles.size());
    std::vector<bool> is_done(separates_.size());
    std::vector<std::uint32_t> group;
    for (std::uint32_t h = 0; h < separates_.size(); ++h) {
      if (is_done[h]) continue;
      gather(h, group);
      const std::array<Normal, 2> gradient{gradient_of(group, 0), gradient_of(group, 1)};
      for (const std::uint32_t at : group) {
        corners[at / 3][at % 3] = {point_at(at), gradient[0], gradient[1]};
        is_done[at] = true;
      }
    }
    return corners;
  }

 private:
  const TexturePoint& point_at(std::uint32_t h) const { return points_[h / 3][h % 3]; }
  TrianglePoints triangle(std::size_t i) const {
    const auto& [a, b, c] = mesh_.triangles[i];
    return {mesh_.vertices[a], mesh_.vertices[b], mesh_.vertices[c]};
  }

  // The corners at the vertex of corner h that no edge separates from it.
  void gather(std::uint32_t h, std::vector<std::uint32_t>& group) const {
    group = {h};
    std::uint32_t at = h;
    while (!separates_[previous_in_triangle(at)]) {
      at = opposite_[previous_in_triangle(at)];
      if (at == h) return;
      group.push_back(at);
    }
    for (at = h; !separates_[at];) {
      at = next_in_triangle(opposite_[at]);
      group.push_back(at);
    }
  }

  // With the sides e and f from corner 0, n = e x f, and d and g the steps of the coordinate along them, a triangle's gradient
  // is (d f x n + g n x e)/n², and twice its area is |n|.
  // zero: of the numbers that it is computed in; exact(number) is a binary32 number as one of them.
  template <class N, class Exact>
  std::array<N, 3> mean(const std::vector<std::uint32_t>& group, std::size_t axis, const N& zero, const Exact& exact) const {
    std::array<N, 3> sum{zero, zero, zero};
    N areas = zero;
    for (const std::uint32_t h : group) {
      const TrianglePoints t = triangle(h / 3);
      const Points& p = points_[h / 3];
      const auto e = side_of_triangle(t, 1, exact), f = side_of_triangle(t, 2, exact);
      const auto n = cross(e, f), along_e = cross(f, n), along_f = cross(n, e);
      const N length = sqrt(dot(n, n));
      const N d = exact(p[1][axis]) - exact(p[0][axis]), g = exact(p[2][axis]) - exact(p[0][axis]);
      for (std::size_t i = 0; i < 3; ++i) sum[i] = sum[i] + (d * along_e[i] + g * along_f[i]) / length;
      areas = areas + length;
    }
    for (N& component : sum) component = component / areas;
    return sum;
  }

  // Rounds the ends of the enclosures; false where they leave a doubt. Then, of two neighbours, the gradient is the
  // middle rounded: a tie goes to the even one.
  template <class N>
  static bool round(const std::array<N, 3>& mean, Normal& gradient) {
    bool is_decided = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto low = static_cast<double>(mean[i].nearest_to_low()), high = static_cast<double>(mean[i].nearest_to_high());
      const bool is_tiny = low > -kLeastGradient && high < kLeastGradient;
      is_decided &= is_tiny || low == high;
      gradient[i] = is_tiny ? 0.0F : static_cast<float>(0.5 * (low + high));
    }
    return is_decided;
  }

  Normal gradient_of(const std::vector<std::uint32_t>& group, std::size_t axis) const {
    Normal gradient{};
    bool is_decided = round(mean(group, axis, BoundedNumber{}, &in_binary64), gradient);
    for (int bits = kFirstTextureBits; !is_decided && bits <= kLastTextureBits; bits *= 2) {
      const auto in_intervals = [bits](float number) { return Interval(bits, static_cast<double>(number)); };
      is_decided = round(mean(group, axis, Interval(bits), in_intervals), gradient);
    }
    for (const float component : gradient)
      if (!(std::fabs(static_cast<double>(component)) <= kSteepest))
        throw std::invalid_argument(face(group.front() / 3) + " has a texture that goes by at " +
                                    shortest(static_cast<double>(component)) + " mm/mm; expected 1000 at most");
    return gradient;
  }

  const TriangleMesh& mesh_;
  const std::vector<Points>& points_;
  std::vector<std::uint32_t> opposite_;
  std::vector<bool> separates_;  // by half-edge
};

}  // namespace

CornerTextures corner_textures(const CheckedMesh& checked, const std::vector<Points>& points, double crease_degrees) {
  const TriangleMesh& mesh = checked.mesh();
  if (points.size() != mesh.triangles.size()) throw std::invalid_argument("expected points of the texture for each face");
  return Gradients(mesh, points, crease_degrees).run();
}

}  // namespace forceshade::mesh
