// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/reference/heights/line.h"

#include <algorithm>

#include "forceshade/reference/heights/cap.h"
#include "forceshade/reference/heights/cone.h"
#include "forceshade/reference/heights/gaussian.h"
#include "forceshade/reference/heights/grating.h"
#include "forceshade/reference/heights/grid.h"
#include "forceshade/reference/heights/plane.h"
#include "forceshade/reference/heights/polygons.h"
#include "forceshade/reference/laws/slow_geometry.h"
#include "forceshade/reference/numbers/intervals.h"

namespace forceshade::reference {
namespace {

using height::Rendering;

// Columns of what has a rim.
constexpr long kOutside = 0, kInside = 1, kTowardsApex = 2, kFromApex = 3;

template <class N>
N number(float value) {
  return N(static_cast<double>(value));
}

// A cut: the part's cell changes by `step`.
struct Cut {
  Exact exact;
  Ball64 t;
  std::size_t part;
  Cell step;

  int sign() const { return t.low() > 0 ? 1 : t.high() < 0 ? -1 : exact.sign(); }
  bool is_before(const Cut& other) const {
    if (t.high() < other.t.low()) return true;
    return t.low() <= other.t.high() && exact < other.exact;
  }
};

// Where the parts' formulas change, for one part after the other: the cell at the start, the cuts after it.
class Cuts {
 public:
  explicit Cuts(const Way& way) : way_(way) {}

  void add(const height::Part& part) {
    cells.emplace_back();
    std::visit([&](const auto& shape) { of(shape); }, part.shape);
  }

  std::vector<Cell> cells;
  std::vector<Cut> cuts;

 private:
  void of(const height::Plane&) {}
  void of(const height::Gaussian&) {}
  void of(const height::Grating&) {}

  void of(const height::CylinderCap& cap) {
    if (way_.x0 == way_.x1) {
      const Rational half = Rational(static_cast<double>(cap.width)) / Rational(2);
      const bool is_in = is_inside(from_centre<Rational>(static_cast<double>(way_.x0), cap.x), Rational(0), half);
      cells.back().column = is_in ? kInside : kOutside;
      return;
    }
    const float first = way_.x0 < way_.x1 ? -cap.width : cap.width;
    for (const float side : {first, -first}) {
      const auto rim = [&]<class N>() -> N {
        return (number<N>(side) / N(2.0) - from_centre<N>(static_cast<double>(way_.x0), cap.x)) / along_x<N>();
      };
      add(rim, {side == first ? kInside - kOutside : kOutside - kInside, 0});
    }
  }

  void of(const height::SphereCap& cap) {
    const auto half = [&]<class N>() -> N { return number<N>(cap.width) / N(2.0); };
    circle(cap.x, cap.y, half, kInside, kInside);
  }

  void of(const height::Cone& cone) {
    const Rational x = from_centre<Rational>(static_cast<double>(way_.x0), cone.x);
    const Rational y = from_centre<Rational>(static_cast<double>(way_.y0), cone.y);
    const bool is_through_apex = sign(Rational(x * along_y<Rational>() - y * along_x<Rational>())) == 0;
    const auto radius = [&]<class N>() -> N { return number<N>(cone.radius); };
    circle(cone.x, cone.y, radius, is_through_apex ? kTowardsApex : kInside, is_through_apex ? kFromApex : kInside);
    if (!is_through_apex) return;
    const auto apex = [&]<class N>() -> N { return nearest<N>(cone.x, cone.y); };
    add(apex, {kFromApex - kTowardsApex, 0});
  }

  // The column counts the knots that lie behind, seen from smaller x.
  void of(const height::Polygons& polygons) {
    const auto from = static_cast<double>(way_.x0), to = static_cast<double>(way_.x1);
    for (const height::Knot& knot : polygons.knots) {
      const auto x = -from_centre<double>(0, knot.x);
      if (x < from || (x == from && !(to < from))) ++cells.back().column;
      if (!((from < x && x < to) || (to < x && x < from))) continue;
      const auto t = [&]<class N>() -> N { return (N(x) - number<N>(way_.x0)) / along_x<N>(); };
      add(t, {from < to ? 1 : -1, 0});
    }
  }

  void of(const std::shared_ptr<const height::Grid>& grid) {
    cells.back().column = lines(*grid, grid->columns, way_.x0, way_.x1, {1, 0});
    cells.back().row = lines(*grid, grid->rows, way_.y0, way_.y1, {0, 1});
  }

  // The lines of a grid across one axis; returns the cell at the start. Beyond a clamped grid nothing changes.
  long lines(const height::Grid& grid, std::uint32_t count, float from, float to, const Cell& one) {
    const bool is_clamped = grid.edge == height::Edge::clamp;
    const long least = -3, most = static_cast<long>(count);
    const auto place = [&](long line) {
      return (static_cast<double>(line) - 0.5 * (count - 1.0)) * static_cast<double>(grid.pitch);  // exact: 41 bits
    };
    long cell = GridCell::at(static_cast<double>(from), grid.pitch, count).index;
    const bool is_backwards = to < from;
    if (is_clamped) cell = std::clamp(cell, least, most);
    const long step = is_backwards ? -1 : 1;
    for (long line = is_backwards ? cell : cell + 1;; line += step) {
      const double at = place(line);
      if (is_backwards ? at <= static_cast<double>(to) : at >= static_cast<double>(to)) break;
      if (is_clamped && (line <= least || line > most)) break;
      const auto t = [&]<class N>() -> N { return (N(at) - number<N>(from)) / (number<N>(to) - number<N>(from)); };
      add(t, {step * one.column, step * one.row});
    }
    return cell;
  }

  // A rim, if the way goes into it; one that is only touched is none.
  template <class Radius>
  void circle(float x, float y, const Radius& radius, long on_the_way_in, long on_the_way_out) {
    const auto discriminant = [&]<class N>() -> N {
      const N across = from_centre<N>(static_cast<double>(way_.x0), x) * along_y<N>() -
                       from_centre<N>(static_cast<double>(way_.y0), y) * along_x<N>();
      const N r = radius.template operator()<N>();
      return r * r * length_squared<N>() - across * across;
    };
    if (sign(discriminant.template operator()<Rational>()) <= 0) return;
    for (const int side : {-1, 1}) {
      const auto rim = [&]<class N>() -> N {
        N under_root = discriminant.template operator()<N>();
        if constexpr (std::is_same_v<N, Enclosure>) under_root = larger(0, under_root);
        return nearest<N>(x, y) + N(static_cast<double>(side)) * sqrt(under_root) / length_squared<N>();
      };
      add(rim, {side < 0 ? on_the_way_in - kOutside : kOutside - on_the_way_out, 0});
    }
  }

  template <class N>
  N along_x() const {
    return number<N>(way_.x1) - number<N>(way_.x0);
  }
  template <class N>
  N along_y() const {
    return number<N>(way_.y1) - number<N>(way_.y0);
  }
  template <class N>
  N length_squared() const {
    return along_x<N>() * along_x<N>() + along_y<N>() * along_y<N>();
  }
  // The t of the point nearest to a centre.
  template <class N>
  N nearest(float x, float y) const {
    return -(from_centre<N>(static_cast<double>(way_.x0), x) * along_x<N>() +
             from_centre<N>(static_cast<double>(way_.y0), y) * along_y<N>()) /
           length_squared<N>();
  }

  template <class T>
  void add(const T& t, const Cell& step) {
    cuts.push_back({t.template operator()<Exact>(), filter_of(t.template operator()<Enclosure>()), cells.size() - 1, step});
  }

  const Way& way_;
};

bool is_polynomial(const height::Part& part) {
  return std::holds_alternative<height::Plane>(part.shape) || std::holds_alternative<height::Polygons>(part.shape) ||
         std::holds_alternative<std::shared_ptr<const height::Grid>>(part.shape);
}

// A part's own formula in its cell.
template <class N>
struct JetIn {
  const Cell& cell;
  const N &x, &y, &dx, &dy;

  Jet<N> operator()(const height::Plane& plane) const { return plane_jet(plane, x, y); }
  Jet<N> operator()(const height::Gaussian& g) const { return hill_jet(g, relative(x, g.x), relative(y, g.y)); }
  Jet<N> operator()(const height::Grating& grating) const { return wave_jet(grating, x, y); }
  Jet<N> operator()(const height::CylinderCap& cap) const {
    return cell.column == kOutside ? Jet<N>::flat() : ridge_jet(cap, relative(x, cap.x));
  }
  Jet<N> operator()(const height::SphereCap& cap) const {
    if (cell.column == kOutside) return Jet<N>::flat();
    return cap_jet(cap.radius, cap.width, relative(x, cap.x), relative(y, cap.y));
  }
  Jet<N> operator()(const height::Cone& cone) const {
    if (cell.column == kOutside) return Jet<N>::flat();
    const N X = relative(x, cone.x), Y = relative(y, cone.y);
    if (cell.column == kInside) return slope_jet(cone, X, Y);
    // Along a ray: ρ itself is linear in t.
    const N length = sqrt(N(dx * dx + dy * dy)), sign(cell.column == kFromApex ? 1.0 : -1.0);
    const N along_x = sign * dx / length, along_y = sign * dy / length;
    return ray_jet(cone, N(X * along_x + Y * along_y), along_x, along_y);
  }
  Jet<N> operator()(const height::Polygons& polygons) const {
    return stretch_jet(polygons, static_cast<std::size_t>(cell.column), x);
  }
  Jet<N> operator()(const std::shared_ptr<const height::Grid>& grid) const {
    const GridCell column{cell.column, grid->pitch, grid->columns}, row{cell.row, grid->pitch, grid->rows};
    return cell_jet(*grid, column, row, within(*grid, column, x), within(*grid, row, y));
  }

  static N relative(const N& coordinate, float centre) { return coordinate + from_centre<N>(0, centre); }

  // Beyond a clamped grid all places are alike.
  static N within(const height::Grid& grid, const GridCell& axis, const N& coordinate) {
    if (grid.edge == height::Edge::tile || (axis.index > -3 && axis.index < static_cast<long>(axis.count))) return coordinate;
    return N((static_cast<double>(axis.index) - 0.5 * (axis.count - 1.0)) * static_cast<double>(grid.pitch));
  }
};

}  // namespace

HeightLine::HeightLine(const HeightMapField& law, const Way& way)
    : law_(law),
      way_(way),
      along_{Ball64(static_cast<double>(way.x1)) - Ball64(static_cast<double>(way.x0)),
             Ball64(static_cast<double>(way.y1)) - Ball64(static_cast<double>(way.y0))} {
  Cuts found(way_);
  for (const height::Part& part : law.map().parts) found.add(part);
  for (const height::Part& part : law.map().surface) found.add(part);
  std::vector<Cut>& cuts = found.cuts;
  std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.is_before(b); });
  const auto pass = [&](const Cut& cut) {
    found.cells[cut.part].column += cut.step.column;
    found.cells[cut.part].row += cut.step.row;
  };
  const Cut end{Exact(1), Ball64(1.0), 0, {}};
  auto cut = cuts.begin();
  for (; cut != cuts.end() && cut->sign() <= 0; ++cut) pass(*cut);
  pieces_.push_back({Ball64(0.0), Ball64(1.0), found.cells, 0, {}});
  for (; cut != cuts.end() && cut->is_before(end); ++cut) {
    const bool is_same_place = cut != cuts.begin() && (cut - 1)->sign() > 0 && !(cut - 1)->is_before(*cut);
    pass(*cut);
    if (!is_same_place) {
      pieces_.back().to = cut->t;
      pieces_.push_back({cut->t, Ball64(1.0), {}, 0, {}});
    }
    pieces_.back().cells = found.cells;
  }
  for (Piece& piece : pieces_) {
    piece.middle = static_cast<double>((piece.from.mid() + piece.to.mid()) / 2);
    const auto all = GroundSeries::variable(piece.middle, 1.0);
    piece.polynomial = {sum(law.map().parts, 0, piece, all, true),
                        sum(law.map().surface, law.map().parts.size(), piece, all, true)};
  }
}

template <class N>
Jet<N> HeightLine::sum(const std::vector<height::Part>& parts, std::size_t first, const Piece& piece, const N& t,
                       bool of_polynomials) const {
  const N dx(along_.x), dy(along_.y);
  const N x = N(static_cast<double>(way_.x0)) + dx * t, y = N(static_cast<double>(way_.y0)) + dy * t;
  Jet<N> sum = Jet<N>::flat();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (is_polynomial(parts[i]) != of_polynomials) continue;
    const Jet<N> one = std::visit(JetIn<N>{piece.cells[first + i], x, y, dx, dy}, parts[i].shape);
    sum = sum + (parts[i].negated ? -one : one);
  }
  return sum;
}

template <class N>
Ground<N> HeightLine::ground(const Piece& piece, const N& t) const {
  const auto at = [s = t - N(piece.middle)](const GroundSeries& polynomial) {
    N sum(0.0);
    for (std::size_t k = polynomial.length(); k-- > 0;) sum = s * sum + N(polynomial[k]);
    return sum;
  };
  const auto jet = [&](const std::vector<height::Part>& parts, std::size_t first, const Jet<GroundSeries>& polynomial) {
    return Jet<N>{at(polynomial.U), at(polynomial.Ux), at(polynomial.Uy)} + sum(parts, first, piece, t, false);
  };
  const auto slope = [&](const Jet<N>& jet) -> N { return N(along_.x) * jet.Ux + N(along_.y) * jet.Uy; };
  const HeightMap& map = law_.map();
  const Jet<N> U = jet(map.parts, 0, piece.polynomial[0]);
  const N climb = slope(U), squared = square(U.Ux) + square(U.Uy) + N(1.0), upright = N(1.0) / sqrt(squared);
  if (law_.rendering() != Rendering::force_shaded) return {U.U, climb, N(0.0), squared, upright};
  const Jet<N> surface = jet(map.surface, map.parts.size(), piece.polynomial[1]);
  return {surface.U, climb, slope(surface) - climb, squared, upright};
}

template Ground<Ball64> HeightLine::ground(const Piece& piece, const Ball64& t) const;
template Ground<GroundSeries> HeightLine::ground(const Piece& piece, const GroundSeries& t) const;

}  // namespace forceshade::reference
