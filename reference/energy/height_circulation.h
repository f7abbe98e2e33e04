// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The circulation under a slice of a height map. With t along it, the depth δ and 1/n the normal's share upwards, it is
// K·f per t and δ, f = δ·(1/n)_t + (surface - U)_t/n, and ½Kδ² times the jump of 1/n on a line. Callers hold exact_arithmetic.

#include "reference/energy/height_stretch.h"
#include "reference/height_energy.h"

namespace forceshade::reference {

inline Segment segment_of(const Slice& s) {
  return s.along == Slice::Along::x ? Segment{s.from, s.at, s.to, s.at} : Segment{s.at, s.from, s.at, s.to};
}

// No height of the surface that depths are measured from is larger in size, mm.
double tallest(const HeightMapField& law, const Slice& slice);

struct Generated {
  Ball64 counter_clockwise, clockwise;
};

class Circulation {
 public:
  // depth: mm.
  Circulation(const HeightMapField& law, const Slice& slice, float depth);

  const HeightLine& line() const { return line_; }

  // The energy that the lines on which 1/n jumps generate, over K; and with them, the stretches between.
  Generated lines() const;
  Generated generated(const std::vector<Stretch>& stretches) const;

  // The energy that is generated between them, over K; certain to `relative` of all. In order of t.
  std::vector<Stretch> stretches(long double relative, const Monitor& monitor = {}) const;

  // The rise of 1/n where a piece begins; not for the first piece.
  Ball64 rise(std::size_t piece) const;

  // f at the surface and at the depth, at one t.
  std::array<Ball64, 2> density(const HeightLine::Piece& piece, const Ball64& t) const;

  Ball64 depth() const { return depth_; }

 private:
  void judge(Stretch& stretch) const;

  HeightLine line_;
  Ball64 depth_;
};

}  // namespace forceshade::reference
