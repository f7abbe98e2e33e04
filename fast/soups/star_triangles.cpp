// SPDX-License-Identifier: BSD-3-Clause
// The triangles that hold a point, and their planes.

#include <algorithm>
#include <cmath>
#include <utility>

#include "fast/soups/star.h"

namespace forceshade::fast::soups {
namespace {

// True if the triangle holds x; then `sides` has a bit for each that does.
bool holds(const Face& f, const Point& x, unsigned& sides) noexcept {
  sides = 0;
  if (x.vertex != kNone)
    for (std::size_t i = 0; i < 3; ++i)
      if (f.vertex[i] == x.vertex) {
        sides = 1U << i | 1U << (i == 0 ? 2 : i - 1);
        return true;
      }
  const Vector3<Ball>& at = x.get<Ball>().x;
  const auto is_beyond = [](const Ball& c, float one, float two, float three) {
    const double low = static_cast<double>(std::min({one, two, three})),
                 high = static_cast<double>(std::max({one, two, three}));
    return c.value + c.error < low || c.value - c.error > high;
  };
  if (is_beyond(at.x, f.corner[0][0], f.corner[1][0], f.corner[2][0]) ||
      is_beyond(at.y, f.corner[0][1], f.corner[1][1], f.corner[2][1]) ||
      is_beyond(at.z, f.corner[0][2], f.corner[1][2], f.corner[2][2]))
    return false;
  bool is_known = std::ranges::find(x.faces, &f) != x.faces.end();
  std::size_t known_side = 3;
  if (x.edge[0] != kNone)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = f.vertex[i], b = f.vertex[i == 2 ? 0 : i + 1];
      if ((a == x.edge[0] && b == x.edge[1]) || (a == x.edge[1] && b == x.edge[0])) known_side = i;
    }
  is_known = is_known || known_side < 3;
  const Corners<Ball> c = corners<Ball>(f);
  const Vector3<Ball> n = c.normal();
  if (!is_known && dot(n, at - c[0]).is_sure()) return false;
  std::array<Ball, 3> about;
  for (std::size_t i = 0; i < 3; ++i) {
    if (i == known_side) continue;
    about[i] = dot(cross(c.side(i), at - c[i]), n);
    if (about[i].is_sure() && about[i].value < 0) return false;
  }
  if (!is_known && side_of_plane(f, x) != 0) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const int sign = i == known_side ? 0 : about[i].is_sure() ? 1 : sign_inside(f, i, x);
    if (sign < 0) return false;
    if (sign == 0) sides |= 1U << i;
  }
  return true;
}

bool is_as(const Star::Held& a, const Star::Held& b) noexcept {
  return a.face == b.face && a.sides == b.sides;
}

}  // namespace

void find_held(const Point& x, std::span<const Face* const> near, std::vector<Star::Held>& held) {
  held.clear();
  for (const Face* const face : near)
    if (unsigned sides = 0; holds(*face, x, sides)) held.push_back({face, sides, 0, false});
  std::ranges::sort(held, {}, [](const Star::Held& each) { return each.face->index(); });
  held.erase(std::unique(held.begin(), held.end(), is_as), held.end());
}

bool Star::is_of(std::span<const Held> held) const noexcept {
  return std::ranges::equal(triangles_, held, is_as);
}

void Star::find_planes() {
  planes_.clear();
  normals_.clear();
  is_rough_ = false;
  for (Held& held : triangles_) {
    is_rough_ = is_rough_ || soup_->static_friction(*held.face) > 0;
    const NormalOf n(*held.face);
    const auto next = static_cast<std::uint32_t>(planes_.size());
    held.plane = normals_.find(n.about, next, [&](std::uint32_t plane) { return are_parallel(planes_[plane].normal, n); });
    if (held.plane == next) {
      normals_.add(n.about, next);
      planes_.push_back(Plane{.normal = n});
    }
    Plane& plane = planes_[held.plane];
    held.is_flipped = held.face != plane.normal.face && sign_of_dot(plane.normal, n) < 0;
    ++plane.triangles;
    plane.widen(held);
  }
  std::uint32_t first = 0;
  for (Plane& plane : planes_) {
    plane.first = first;
    first += std::exchange(plane.triangles, 0);
  }
  by_plane_.resize(triangles_.size());
  for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
    Plane& plane = planes_[triangles_[i].plane];
    by_plane_[plane.first + plane.triangles++] = i;
  }
}

// Takes in the box of the directions of a triangle's cone, of length 1. That of a sector of less than a right angle is little
// larger than that of its sides: no direction in it is farther from their chord than the middle one.
void Star::Plane::widen(const Held& held) noexcept {
  const auto take_in = [&](double x, double y, double z, double more) {
    const std::array<double, 3> at{x, y, z};
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], at[i] - more);
      high[i] = std::max(high[i], at[i] + more);
    }
  };
  const std::size_t corner = held.sides == 3 ? 1 : held.sides == 6 ? 2 : 0;
  const Face& f = *held.face;
  const auto towards = [&](std::size_t other) {
    std::array<double, 3> d{};
    for (std::size_t i = 0; i < 3; ++i)
      d[i] = static_cast<double>(f.corner[other][i]) - static_cast<double>(f.corner[corner][i]);
    const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    return std::array{d[0] / length, d[1] / length, d[2] / length};
  };
  const std::array<double, 3> a = towards(corner == 2 ? 0 : corner + 1), b = towards(corner == 0 ? 2 : corner - 1);
  const double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  if ((held.sides != 3 && held.sides != 5 && held.sides != 6) || !(cosine > 0)) return take_in(0, 0, 0, 2);
  const double sagitta = 1 - std::sqrt(0.5 * (1 + std::min(cosine, 1.0))) + 0x1p-30;
  take_in(a[0], a[1], a[2], sagitta);
  take_in(b[0], b[1], b[2], sagitta);
}

const Star::Held* Star::held(const Face& f) const noexcept {
  const auto found = std::ranges::lower_bound(triangles_, f.index(), {}, [](const Held& held) { return held.face->index(); });
  return found == triangles_.end() || found->face != &f ? nullptr : &*found;
}

}  // namespace forceshade::fast::soups
