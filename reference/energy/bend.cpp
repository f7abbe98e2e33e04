// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/reference/energy/bend.h"

#include <cmath>
#include <stdexcept>

#include "forceshade/reference/heights/grid.h"
#include "forceshade/reference/heights/polygons.h"

namespace forceshade::reference {
namespace {

Bend flat() {
  return {Enclosure(0), Enclosure(0)};
}

Enclosure exactly(float value) {
  return Enclosure(static_cast<double>(value));
}

Enclosure from(const Enclosure& x, float centre) {
  return x + from_centre<Enclosure>(0, centre);
}

// The square of half the chord that the line y = 0 cuts out of a disk; exact at 192 bits, like all comparisons below.
Enclosure half_chord_squared(float radius_times_two, float centre_y) {
  const Enclosure half = exactly(radius_times_two) / 2, Y = from(Enclosure(0), centre_y);
  return half * half - Y * Y;
}

bool is_within(const Enclosure& X, const Enclosure& chord_squared) {
  return lower(Enclosure(X * X)) < lower(chord_squared);
}

// A rim or an edge of a disk strictly between two places.
bool has_rim(const Enclosure& A, const Enclosure& B, const Enclosure& chord_squared) {
  if (lower(chord_squared) <= 0) return false;
  const auto beyond = [&](const Enclosure& X) { return lower(Enclosure(X * X - chord_squared)); };
  if (beyond(A) <= 0 && beyond(B) <= 0) return false;
  return beyond(A) < 0 || beyond(B) < 0 || (lower(A) < 0) != (lower(B) < 0);
}

struct BendAt {
  const Enclosure& x;
  double inside;

  Bend operator()(const height::Plane& p) const { return {exactly(p.slope_x), Enclosure(0)}; }
  Bend operator()(const height::CylinderCap& c) const { return cap(c.x, 0, c.radius, c.width); }
  Bend operator()(const height::SphereCap& c) const { return cap(c.x, c.y, c.radius, c.width); }
  Bend operator()(const height::Cone& c) const {
    const Enclosure X = from(x, c.x), Y = from(Enclosure(0), c.y), fall = exactly(c.height) / exactly(c.radius);
    if (!is_within(from(Enclosure(inside), c.x), half_chord_squared(2 * c.radius, c.y))) return flat();
    if (lower(Y) == 0) return {lower(from(Enclosure(inside), c.x)) < 0 ? fall : -fall, Enclosure(0)};
    const Enclosure rho = sqrt(Enclosure(X * X + Y * Y));
    return {-fall * X / rho, -fall * Y * Y / (rho * rho * rho)};
  }
  Bend operator()(const height::Gaussian& g) const {
    const Enclosure X = from(x, g.x), Y = from(Enclosure(0), g.y), variance = exactly(g.sigma) * exactly(g.sigma);
    const Enclosure U = exactly(g.height) * exp(Enclosure(-(X * X + Y * Y) / (2 * variance)));
    return {-X / variance * U, (X * X / variance - 1) / variance * U};
  }
  Bend operator()(const height::Grating& g) const {
    const Enclosure wave = exactly(g.wave_x), angle = wave * x + exactly(g.phase);
    return {-exactly(g.height) * wave * sin(angle), -exactly(g.height) * wave * wave * cos(angle)};
  }
  Bend operator()(const height::Polygons& p) const { return {jet<Enclosure>(p, {inside, 0}).Ux, Enclosure(0)}; }
  // A quadratic in each cell, of the differences between columns.
  Bend operator()(const std::shared_ptr<const height::Grid>& grid) const {
    const auto column = GridCell::at(inside, grid->pitch, grid->columns), row = GridCell::at(0, grid->pitch, grid->rows);
    const auto weights = cubic_basis(row.t(Enclosure(0))).value;
    Enclosure value[4];
    for (std::size_t k = 0; k < 4; ++k) {
      value[k] = Enclosure(0);
      for (std::size_t l = 0; l < 4; ++l) {
        const std::size_t i = column.sample(static_cast<long>(k) - 1, grid->edge),
                          j = row.sample(static_cast<long>(l) - 1, grid->edge);
        value[k] += weights[l] * exactly(grid->values[j * grid->columns + i]);
      }
    }
    const Enclosure pitch = exactly(grid->pitch);
    const Enclosure t = column.t(x), s = 1 - t;
    const Enclosure a = value[1] - value[0], b = value[2] - value[1], c = value[3] - value[2];
    return {(s * s * a + (1 + 2 * t * s) * b + t * t * c) / (2 * pitch), (s * (b - a) + t * (c - b)) / (pitch * pitch)};
  }

 private:
  Bend cap(float centre_x, float centre_y, float radius, float width) const {
    if (!is_within(from(Enclosure(inside), centre_x), half_chord_squared(width, centre_y))) return flat();
    const Enclosure X = from(x, centre_x), Y = from(Enclosure(0), centre_y);
    const Enclosure square = exactly(radius) * exactly(radius) - Y * Y, above_axis = sqrt(Enclosure(square - X * X));
    return {-X / above_axis, -square / (above_axis * above_axis * above_axis)};
  }
};

struct KinkBetween {
  double a, b;

  std::optional<const char*> operator()(const height::CylinderCap& c) const { return rim(c.x, 0, c.width); }
  std::optional<const char*> operator()(const height::SphereCap& c) const { return rim(c.x, c.y, c.width); }
  std::optional<const char*> operator()(const height::Cone& c) const {
    const bool crosses_apex = from_centre<double>(a, c.x) < 0 && from_centre<double>(b, c.x) > 0;
    if (crosses_apex && from_centre<double>(0, c.y) == 0) return "the apex of a cone";
    return rim(c.x, c.y, 2 * c.radius);
  }
  std::optional<const char*> operator()(const height::Polygons& p) const {
    for (const height::Knot& knot : p.knots)
      if (from_centre<double>(a, knot.x) < 0 && from_centre<double>(b, knot.x) > 0) return "a knot of polygons";
    return std::nullopt;
  }
  std::optional<const char*> operator()(const std::shared_ptr<const height::Grid>& grid) const {
    return grid->interpolant == height::Interpolant::bilinear ? std::optional("grid lines of a bilinear map") : std::nullopt;
  }
  template <class Smooth>
  std::optional<const char*> operator()(const Smooth&) const {
    return std::nullopt;
  }

 private:
  std::optional<const char*> rim(float centre_x, float centre_y, float diameter) const {
    const bool has =
        has_rim(from(Enclosure(a), centre_x), from(Enclosure(b), centre_x), half_chord_squared(diameter, centre_y));
    return has ? std::optional("the rim of a cap or cone") : std::nullopt;
  }
};

}  // namespace

Bend bend(const std::vector<height::Part>& parts, const Enclosure& x, double inside) {
  Bend sum = flat();
  for (const height::Part& part : parts) {
    const Bend one = std::visit(BendAt{x, inside}, part.shape);
    sum = part.negated ? Bend{sum.slope - one.slope, sum.curvature - one.curvature}
                       : Bend{sum.slope + one.slope, sum.curvature + one.curvature};
  }
  return sum;
}

std::optional<const char*> kink_between(const height::Part& part, double from, double to) {
  return std::visit(KinkBetween{from, to}, part.shape);
}

void add_grid_lines(const height::Part& part, double from, double to, std::size_t most, std::vector<double>& lines) {
  const auto* grid = std::get_if<std::shared_ptr<const height::Grid>>(&part.shape);
  if (grid == nullptr) return;
  const double pitch = static_cast<double>((*grid)->pitch), middle = 0.5 * ((*grid)->columns - 1.0);
  if ((to - from) / pitch > static_cast<double>(most))
    throw std::invalid_argument("the section crosses too many cells of a grid");
  // A product of at most 26 and 24 bits: exact.
  for (double i = std::floor(from / pitch + middle); (i - middle) * pitch < to; ++i)
    if ((i - middle) * pitch > from) lines.push_back((i - middle) * pitch);
}

}  // namespace forceshade::reference
