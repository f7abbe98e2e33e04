// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/properties/height_shape.h"

#include <algorithm>
#include <cmath>

#include "forceshade/reference/height_energy.h"
#include "forceshade/vocabulary/number_text.h"

namespace forceshade::properties {
namespace {

constexpr double kSlack = 1e-11;  // mm: more than binary64 loses on any coordinate

float placed(float centre) {
  return std::fabs(centre) < 0x1p-30F ? 0 : centre;
}

PartShape shape_of(const height::Plane& p) {
  PartShape shape{.kind = "plane", .steepest = std::hypot(static_cast<double>(p.slope_x), static_cast<double>(p.slope_y))};
  shape.xs = shape.ys = {0};
  return shape;
}

PartShape round_shape(const char* kind, float x, float y, float radius) {
  const float cx = placed(x), cy = placed(y);
  PartShape shape{.kind = kind, .x = static_cast<double>(cx), .y = static_cast<double>(cy)};
  shape.reach = 1.3 * static_cast<double>(radius);
  shape.xs = {cx, cx - radius, cx + radius};
  shape.ys = {cy, cy - radius, cy + radius};
  return shape;
}

PartShape shape_of(const height::Cone& cone) {
  PartShape shape = round_shape("cone", cone.x, cone.y, cone.radius);
  const auto radius = static_cast<double>(cone.radius);
  shape.steepest = std::fabs(static_cast<double>(cone.height)) / radius;
  shape.rim = Rim{shape.x, shape.y, radius};
  if (cone.height != 0) shape.kinks = {"its apex", "its rim"};
  shape.bend = [rim = *shape.rim, fall = shape.steepest](double x, double y, double reach) {
    const double rho = std::hypot(x - rim.x, y - rim.y), nearest = rho - reach;
    if (nearest > rim.radius + kSlack) return Bend{};
    return Bend{fall / std::max(nearest, kSlack), nearest <= reach + kSlack || rho + reach >= rim.radius - kSlack};
  };
  return shape;
}

// rho: from the axis or centre, mm.
Bend bend_of_cap(double radius, double half, double rho, double reach) {
  if (rho - reach > half + kSlack) return {};
  const double farthest = std::min(rho + reach, half);
  return {radius * radius / std::pow(radius * radius - farthest * farthest, 1.5), rho + reach >= half - kSlack};
}

double steepest_of_cap(double radius, double half) {
  return half / std::sqrt((radius - half) * (radius + half));
}

PartShape shape_of(const height::SphereCap& cap) {
  PartShape shape = round_shape("sphere-cap", cap.x, cap.y, cap.width / 2);
  const auto radius = static_cast<double>(cap.radius), half = 0.5 * static_cast<double>(cap.width);
  shape.steepest = steepest_of_cap(radius, half);
  shape.rim = Rim{shape.x, shape.y, half};
  shape.kinks = {"its rim"};
  shape.bend = [rim = *shape.rim, radius](double x, double y, double reach) {
    return bend_of_cap(radius, rim.radius, std::hypot(x - rim.x, y - rim.y), reach);
  };
  return shape;
}

PartShape shape_of(const height::CylinderCap& cap) {
  PartShape shape = round_shape("cylinder-cap", cap.x, 0, cap.width / 2);
  const auto radius = static_cast<double>(cap.radius), half = 0.5 * static_cast<double>(cap.width);
  shape.steepest = steepest_of_cap(radius, half);
  shape.kinks = {"its two edges"};
  shape.bend = [axis = shape.x, radius, half](double x, double, double reach) {
    return bend_of_cap(radius, half, std::fabs(x - axis), reach);
  };
  return shape;
}

PartShape shape_of(const height::Polygons& polygons) {
  PartShape shape{.kind = "polygons"};
  const std::vector<height::Knot>& knots = polygons.knots;
  const auto slope = [&](std::size_t i) {
    const double run = static_cast<double>(placed(knots[i + 1].x)) - static_cast<double>(placed(knots[i].x));
    return (static_cast<double>(knots[i + 1].height) - static_cast<double>(knots[i].height)) / run;
  };
  for (std::size_t i = 0; i + 1 < knots.size(); ++i) shape.steepest = std::max(shape.steepest, std::fabs(slope(i)));
  for (const height::Knot& knot : knots) shape.xs.push_back(placed(knot.x));
  shape.x = 0.5 * (static_cast<double>(shape.xs.front()) + static_cast<double>(shape.xs.back()));
  shape.reach = 1.3 * (static_cast<double>(shape.xs.back()) - shape.x);
  if (shape.steepest > 0) shape.kinks = {"its knots"};
  shape.bend = [xs = shape.xs](double x, double, double reach) {
    const auto is_near = [&](float knot) { return std::fabs(static_cast<double>(knot) - x) <= reach + kSlack; };
    return Bend{0, std::any_of(xs.begin(), xs.end(), is_near)};
  };
  return shape;
}

PartShape shape_of(const height::Gaussian& hill) {
  PartShape shape = round_shape("gaussian", hill.x, hill.y, hill.sigma);
  shape.reach *= 3;
  const double height = std::fabs(static_cast<double>(hill.height)), sigma = static_cast<double>(hill.sigma);
  shape.steepest = height / sigma * std::exp(-0.5);
  // The second derivatives are those of exp(-u²/2), u = ρ/σ: at most exp(-u²/2), or (u² - 1)·exp(-u²/2), largest at u = √3.
  shape.bend = [x0 = shape.x, y0 = shape.y, height, sigma](double x, double y, double reach) {
    const double u = std::max(0.0, std::hypot(x - x0, y - y0) - reach) / sigma, fallen = std::exp(-0.5 * u * u);
    const double size = u * u < 3 ? std::max(fallen, 2 * std::exp(-1.5)) : (u * u - 1) * fallen;
    return Bend{height / (sigma * sigma) * size, false};
  };
  return shape;
}

PartShape shape_of(const height::Grating& grating) {
  const double wave = std::hypot(static_cast<double>(grating.wave_x), static_cast<double>(grating.wave_y));
  const double height = std::fabs(static_cast<double>(grating.height));
  PartShape shape{.kind = "grating", .steepest = height * wave};
  shape.reach = std::clamp(20 / std::max(wave, 1e-6), 0.01, 1000.0);
  for (const auto& [along, marks] : {std::pair(grating.wave_x, &shape.xs), std::pair(grating.wave_y, &shape.ys)}) {
    *marks = {0};
    if (along != 0) marks->push_back(-grating.phase / along);  // a crest
  }
  shape.bend = [rate = height * wave * wave](auto...) { return Bend{rate, false}; };
  return shape;
}

// Largest sizes of the differences between neighbouring values, edges included.
struct Differences {
  double along = 0, across = 0;                // of two side by side in x, in y
  double second_along = 0, second_across = 0;  // of three
  double mixed = 0;                            // of four around a cell
  double kink = 0;                             // of second_along and second_across the larger
  long kink_column = 0, kink_row = 0;          // and where it is

  explicit Differences(const height::Grid& grid) {
    const long columns = grid.columns, rows = grid.rows;
    const auto beyond = [&](long i, long n) {
      return grid.edge == height::Edge::tile ? (i + n) % n : std::clamp(i, 0L, n - 1);
    };
    const auto grow = [](double& largest, double size) { largest = std::max(largest, std::fabs(size)); };
    for (long j = 0; j < rows; ++j)
      for (long i = 0; i < columns; ++i) {
        const auto value = [&](long k, long l) {
          return static_cast<double>(
              grid.values[static_cast<std::size_t>(beyond(j + l, rows) * columns + beyond(i + k, columns))]);
        };
        const double here = value(0, 0), right = value(1, 0), up = value(0, 1);
        grow(along, right - here);
        grow(across, up - here);
        grow(mixed, value(1, 1) - right - up + here);
        const double in_x = right - 2 * here + value(-1, 0), in_y = up - 2 * here + value(0, -1);
        grow(second_along, in_x);
        grow(second_across, in_y);
        if (const double size = std::max(std::fabs(in_x), std::fabs(in_y)); size > kink) {
          kink = size;
          kink_column = i;
          kink_row = j;
        }
      }
  }
};

PartShape shape_of(const std::shared_ptr<const height::Grid>& grid) {
  const Differences differences(*grid);
  const auto pitch = static_cast<double>(grid->pitch);
  const Lines columns{pitch, grid->columns}, rows{pitch, grid->rows};
  const bool is_bilinear = grid->interpolant == height::Interpolant::bilinear;
  PartShape shape{.kind = is_bilinear ? "bilinear grid" : "cubic-spline grid",
                  .steepest = std::hypot(differences.along, differences.across) / pitch};
  shape.reach = std::min(0.6 * pitch * std::max(grid->columns, grid->rows), 1e4);
  shape.columns = columns;
  shape.rows = rows;
  if (is_bilinear) {
    if (differences.kink > 0)
      shape.kinks = {"its cell lines, the gradient by up to " + digits(differences.kink / pitch, 3) + " at (" +
                     digits(columns.at(differences.kink_column), 6) + ", " + digits(rows.at(differences.kink_row), 6) + ") mm"};
    shape.bend = [=, rate = differences.mixed / (pitch * pitch)](double x, double y, double reach) {
      return Bend{rate, std::min(columns.distance(x), rows.distance(y)) <= reach + kSlack};
    };
  } else {
    // The second derivatives are averages of second differences, with weights that add up to 1.
    const double rate = std::max(differences.second_along, differences.second_across) + differences.mixed;
    shape.bend = [rate = rate / (pitch * pitch)](auto...) { return Bend{rate, false}; };
  }
  return shape;
}

}  // namespace

double Lines::distance(double coordinate) const {
  const double place = coordinate / pitch + 0.5 * (count - 1.0);
  return std::fabs(place - std::round(place)) * pitch;
}

HeightShape::HeightShape(const reference::HeightMapField& law)
    : rendering(law.rendering()),
      stiffness(static_cast<double>(law.stiffness())),
      is_conservative(reference::potential(law).has_value()) {
  const auto add = [&](const std::vector<height::Part>& all, double& sum) {
    for (const height::Part& part : all) {
      parts.push_back(std::visit([](const auto& shape) { return shape_of(shape); }, part.shape));
      sum += parts.back().steepest;
    }
  };
  add(law.map().parts, steepest);
  map_parts = parts.size();
  add(law.map().surface, steepest_surface);
  if (rendering != height::Rendering::force_shaded) steepest_surface = steepest;
}

Bend HeightShape::bend(double x, double y, double reach) const {
  Bend sum;
  for (std::size_t i = 0; i < map_parts; ++i) {
    const Bend one = parts[i].bend(x, y, reach);
    sum.rate += one.rate;
    sum.kink = sum.kink || one.kink;
  }
  return sum;
}

std::vector<std::string> HeightShape::jumps() const {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < map_parts; ++i)
    for (const std::string& kink : parts[i].kinks)
      words.push_back("part " + std::to_string(i + 1) + ", " + parts[i].kind + ": " + kink);
  return words;
}

}  // namespace forceshade::properties
