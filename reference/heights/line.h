// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A height map along a straight line over the plane, cut wherever a part changes its formula. Callers hold exact_arithmetic and
// have set the precision to kEnergyBits.

#include <vector>

#include "forceshade/reference.h"
#include "reference/heights/cuts.h"
#include "reference/heights/jet.h"
#include "reference/numbers/taylor_coefficients.h"

namespace forceshade::reference {

// One order more than is integrated, for a derivative; enough for what two cubics make along a diagonal.
using SectionSeries = Series<7>;

// The numbers that the force is made of, at a t or over a stretch of it.
template <class N>
struct SectionSample {
  N surface;  // mm: the zero of the depth
  N climb;    // mm per unit of t: U_t
  N excess;   // mm per unit of t: that of the surface, less U_t
  N squared;  // n^2 = 1 + U_x^2 + U_y^2
  N upright;  // 1/n
};

class HeightLine {
 public:
  // Between two cuts: every part has one formula.
  struct Piece {
    Ball64 from, to;          // t
    std::vector<Cell> cells;  // of each part
    // The sum of the parts that are polynomials, of the map and of the surface: its series about the middle is all of it.
    double middle = 0;
    std::array<Jet<SectionSeries>, 2> polynomial;
  };

  // Both must outlive it.
  HeightLine(const HeightMapField& law, const Segment& way);

  // The pieces in order of t. Cuts at one and the same place are one.
  const std::vector<Piece>& pieces() const { return pieces_; }

  template <class N>
  SectionSample<N> ground(const Piece& piece, const N& t) const;

 private:
  // The sum of those parts that are polynomials along the way, or of those that are not; piece.cells[first] is the first's.
  template <class N>
  Jet<N> sum(const std::vector<height::Part>& parts, std::size_t first, const Piece& piece, const N& t,
             bool of_polynomials) const;

  const HeightMapField& law_;
  Segment segment_;
  struct {
    Ball64 x, y;  // mm per unit of t
  } along_;
  std::vector<Piece> pieces_;
};

extern template SectionSample<Ball64> HeightLine::ground(const Piece& piece, const Ball64& t) const;
extern template SectionSample<SectionSeries> HeightLine::ground(const Piece& piece, const SectionSeries& t) const;

}  // namespace forceshade::reference
