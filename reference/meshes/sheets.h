// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The god-object's ways on a surface whose sheets may cross each other (docs/god-object.md, "Meshes that intersect
// themselves").

#include <optional>

#include "reference/meshes/crossings.h"
#include "reference/meshes/directions.h"

namespace forceshade::reference::meshes {

// The place where a way is blocked: s from 0 to 1 along it, excluding 0; 1 where its end lies on another feature, too.
struct Block {
  Fraction s;
  Feature feature;
};

// The end of a detour.
struct Reached {
  GridPoint at;
  mesh::Side side;
};

// The tries that a detour or a landing has left: points of the grid, lines and sheets.
class Tries {
 public:
  // Takes one more; false if there is none.
  bool take() {
    if (taken_ == kMost) return false;
    ++taken_;
    return true;
  }
  bool are_left() const { return taken_ < kMost; }
  unsigned taken() const { return taken_; }

 private:
  static constexpr unsigned kMost = 256;
  unsigned taken_ = 0;
};

// In one tick, towards p.
class Sheets {
 public:
  Sheets(const Surface& surface, const Crossings& crossings, mesh::Sides sides, const Vector& p)
      : surface_(surface), crossings_(crossings), sides_(sides), p_(p) {}

  // True if a move in direction u may not go on at a point of the feature.
  bool is_blocked(const Feature& feature, const Vector& u) const;

  // The first place at which the straight way from g to c is blocked.
  std::optional<Block> block(const Vector& g, const GridPoint& c) const;

  // True if a flight from g that has met the surface in x, at `over`/`scale`, may be rounded to c: no other feature is at x or
  // at c, and none is crossed from one to the other.
  bool is_apart(const Vector& g, const Vector& over, const Integer& scale, const GridPoint& c) const;

  // A point of the grid around x to which there is a clear way from g. `from`: g itself, where it is on the surface; then the
  // point is nearer to p than g.
  std::optional<Reached> landing(const Vector& g, const std::optional<Reached>& from, const SurfacePoint& x,
                                 Tries& tries) const;

  // The god-object's goal in place of e, in the closed triangle `carrier` as it is itself: a point nearer to p, or none.
  std::optional<Reached> detour(const Reached& from, const GridPoint& e, std::size_t carrier, const Block& block,
                                Tries& tries) const;

 private:
  using Weights = std::array<std::uint32_t, 3>;  // of a triangle's corners, times 2^24
  class Nearest;

  Integer distance(const GridPoint& c) const;
  std::vector<std::size_t> triangles_at(const Feature& feature) const;
  Weights weights(const GridPoint& at, std::size_t triangle) const;
  std::optional<mesh::Side> arrival(const Vector& g, const std::optional<Reached>& from, const GridPoint& c) const;
  std::vector<GridPoint> around(std::size_t triangle, const Fraction& k, const Fraction& l, Tries& tries) const;
  std::optional<Reached> landing(const Vector& g, const std::optional<Reached>& from, const Integer* limit,
                                 const std::vector<std::pair<std::size_t, std::array<std::uint32_t, 2>>>& bases,
                                 Tries& tries) const;
  bool is_long_enough(const Fraction& square, std::size_t triangle) const;
  void shorten(Nearest& best, const Reached& from, const GridPoint& e, std::size_t carrier, const Fraction& s,
               Tries& tries) const;
  void go_beside(Nearest& best, const Reached& from, std::size_t along, std::size_t beside, Tries& tries) const;
  void change_sheet(Nearest& best, const Reached& from, const GridPoint& e, std::size_t carrier, std::size_t to,
                    Tries& tries) const;

  const Surface& surface_;
  const Crossings& crossings_;
  const mesh::Sides sides_;
  const Vector& p_;
};

}  // namespace forceshade::reference::meshes
