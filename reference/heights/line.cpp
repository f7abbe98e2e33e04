// SPDX-License-Identifier: BSD-3-Clause
#include "reference/heights/line.h"

#include <algorithm>

#include "reference/heights/all.h"

namespace forceshade::reference {
namespace {

using height::Mode;

bool is_polynomial(const height::Part& part) {
  return std::visit([]<class T>(const T&) { return kFormula<T> == Formula::polynomial; }, part.shape);
}

}  // namespace

HeightLine::HeightLine(const HeightMapField& law, const Segment& way)
    : law_(law),
      segment_(way),
      along_{Ball64(static_cast<double>(way.x1)) - Ball64(static_cast<double>(way.x0)),
             Ball64(static_cast<double>(way.y1)) - Ball64(static_cast<double>(way.y0))} {
  Cuts found(segment_);
  for (const auto* parts : {&law.map().parts, &law.map().surface})
    for (const height::Part& part : *parts) {
      found.cells.emplace_back();
      std::visit([&](const auto& shape) { cut(as_shape(shape), found); }, part.shape);
    }
  std::vector<Cut>& cuts = found.cuts;
  std::sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) { return a.is_before(b); });
  const auto pass = [&](const Cut& one) {
    found.cells[one.part].column += one.step.column;
    found.cells[one.part].row += one.step.row;
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
    const auto all = SectionSeries::variable(piece.middle, 1.0);
    piece.polynomial = {sum(law.map().parts, 0, piece, all, true),
                        sum(law.map().surface, law.map().parts.size(), piece, all, true)};
  }
}

template <class N>
Jet<N> HeightLine::sum(const std::vector<height::Part>& parts, std::size_t first, const Piece& piece, const N& t,
                       bool of_polynomials) const {
  const N dx(along_.x), dy(along_.y);
  const N x = N(static_cast<double>(segment_.x0)) + dx * t, y = N(static_cast<double>(segment_.y0)) + dy * t;
  Jet<N> sum = Jet<N>::flat();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (is_polynomial(parts[i]) != of_polynomials) continue;
    const OnWay<N> at{piece.cells[first + i], x, y, dx, dy};
    const Jet<N> one = std::visit([&](const auto& shape) { return jet_in(as_shape(shape), at); }, parts[i].shape);
    sum = sum + (parts[i].negated ? -one : one);
  }
  return sum;
}

template <class N>
SectionSample<N> HeightLine::ground(const Piece& piece, const N& t) const {
  const auto at = [s = t - N(piece.middle)](const SectionSeries& polynomial) {
    N sum(0.0);
    for (std::size_t k = polynomial.length(); k-- > 0;) sum = s * sum + N(polynomial[k]);
    return sum;
  };
  const auto jet = [&](const std::vector<height::Part>& parts, std::size_t first, const Jet<SectionSeries>& polynomial) {
    return Jet<N>{at(polynomial.U), at(polynomial.Ux), at(polynomial.Uy)} + sum(parts, first, piece, t, false);
  };
  const auto slope = [&](const Jet<N>& jet) -> N { return N(along_.x) * jet.Ux + N(along_.y) * jet.Uy; };
  const HeightMap& map = law_.map();
  const Jet<N> U = jet(map.parts, 0, piece.polynomial[0]);
  const N climb = slope(U), squared = square(U.Ux) + square(U.Uy) + N(1.0), upright = N(1.0) / sqrt(squared);
  if (law_.mode() != Mode::force_shaded) return {U.U, climb, N(0.0), squared, upright};
  const Jet<N> surface = jet(map.surface, map.parts.size(), piece.polynomial[1]);
  return {surface.U, climb, slope(surface) - climb, squared, upright};
}

template SectionSample<Ball64> HeightLine::ground(const Piece& piece, const Ball64& t) const;
template SectionSample<SectionSeries> HeightLine::ground(const Piece& piece, const SectionSeries& t) const;

}  // namespace forceshade::reference
