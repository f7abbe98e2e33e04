// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A height map at one position, exactly, and the questions about its force that no enclosure can answer: whether there is
// contact, and on which side of a tie a component lies.
//
// The gap U - z and the slopes U_x and U_y are sums of a part with square roots, of multiples of e^(-q) from Gaussians, and of
// multiples of cosines and sines from gratings. Like terms are collected in exact arithmetic, so that what cancels is gone. A
// question is the sign of a polynomial P in gap and slopes. If waves are left, it is not answered here: then P is not 0 but for
// identities that no one has met, and an enclosure has found its sign. Otherwise, with the Gaussians' sum δ beside the other
// part, P(base + δ) = P(base) + P₁(δ) + P₂(δ, δ) + ..., where P(base) and the factor of each e^(-q) in P₁ and of each e^(-q-q')
// in P₂ are exact numbers. Those that are 0 are left out; the others, each enclosed at its own size, add up to the answer,
// however small (fast/heights/ties.md).

#include <array>
#include <cstddef>

#include "fast/heights/exact_terms.h"
#include "fast/heights/jet.h"
#include "fast/heights/shape.h"
#include "fast/numbers/root_field.h"
#include "forceshade/height_map.h"

namespace forceshade::fast {

// A bound of the bits that the exact numbers of a map take, at any position. Maps that take more than a Fraction has are not
// built.
std::size_t bits_of_exact_numbers(const HeightMap& map) noexcept;

// Gap, U_x and U_y as factors of one term.
using GapAndSlopes = std::array<Fraction, 3>;

class ExactPlace {
 public:
  ExactPlace(const Place& at, double z, height::Mode mode, double stiffness) noexcept;

  // The fault of exact.cpp, as arithmetic_fault_here() of fast/numbers/arithmetic.h.
  static const char* arithmetic_fault() noexcept;

  // Adds a part, whose centre is quantised.
  using Use = ExactTerms::Use;
  void add(const EvaluatedShape& shape, const Use& use) noexcept;

  // The sign of the gap, and that of component `axis` (0 to 2) less `tie`, which is not 0 and of the component's sign; there
  // is contact. Unknown where the numbers outgrow their room.
  Sign sign_of_gap() const noexcept;
  Sign sign_of_excess(std::size_t axis, double tie) const noexcept;
  // The sign of the slope along `axis` (0 or 1) less `tie`.
  Sign sign_of_slope_excess(std::size_t axis, double tie) const noexcept;

 private:
  enum class Kind { rational, root, decay, wave };
  struct Term {
    Kind kind = Kind::rational;
    Fraction key;          // of a root: the radicand; of e^(-q): q; of a wave: the size of its angle
    GapAndSlopes factors;  // of a root: the slopes times the radicand, whose square would else stand in every denominator
  };
  // The largest numbers of parts and terms that there can be: a cap has two roots.
  static constexpr std::size_t kMostParts = 32, kMostTerms = 2 * kMostParts + 1;

  friend class ExactTerms;
  void add_term(Kind kind, const Fraction& key, const Jet<Fraction>& factors, const Use& use) noexcept;
  template <class Polynomial>
  Sign sign_of(const Polynomial& polynomial, const std::array<bool, 3>& reads, bool is_quadratic) const noexcept;

  Place at_;
  height::Mode mode_;
  Fraction stiffness_;
  std::array<Term, kMostTerms> terms_;
  std::size_t count_ = 1;  // the first: the rational part
};

}  // namespace forceshade::fast
