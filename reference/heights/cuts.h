// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Finds where the parts of a map change their formulas along a straight line over the plane. Each kind has in its own header a
// cut(), which adds its places, and a jet_in(), its formula between two of them.

#include <type_traits>
#include <vector>

#include "reference/heights/jet.h"
#include "reference/numbers/interval_ends.h"
#include "reference/numbers/intervals.h"

namespace forceshade::reference {

// Over the plane from (x0, y0) at t = 0 to (x1, y1) at t = 1, two different points; mm.
struct Segment {
  float x0, y0, x1, y1;
};

// The index of the formula of a part that holds: the cell of a grid; of what has a rim, a column of the kind's own.
struct Cell {
  long column = 0, row = 0;
};

// Columns of what has a rim.
inline constexpr long kOutside = 0, kInside = 1, kTowardsApex = 2, kFromApex = 3;

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

// The cell at the start and the cuts after it, collected for one part after the other.
class Cuts {
 public:
  explicit Cuts(const Segment& way) : segment_(way) {}

  // The cells and cuts of the parts so far; a kind's cut() sets the last cell.
  std::vector<Cell> cells;
  std::vector<Cut> cuts;

  const Segment& segment() const { return segment_; }

  // t: a function object that gives the place in any of the reference's numbers.
  template <class T>
  void add(const T& t, const Cell& step) {
    cuts.push_back({t.template operator()<Exact>(), to_64_bits(t.template operator()<Enclosure>()), cells.size() - 1, step});
  }

  // Adds a rim, if the way goes into it and does not only touch it.
  template <class Radius>
  void circle(float x, float y, const Radius& radius, long on_the_way_in, long on_the_way_out) {
    const auto discriminant = [&]<class N>() -> N {
      const N across = from_centre<N>(static_cast<double>(segment_.x0), x) * along_y<N>() -
                       from_centre<N>(static_cast<double>(segment_.y0), y) * along_x<N>();
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
    return number<N>(segment_.x1) - number<N>(segment_.x0);
  }
  template <class N>
  N along_y() const {
    return number<N>(segment_.y1) - number<N>(segment_.y0);
  }
  template <class N>
  N length_squared() const {
    return along_x<N>() * along_x<N>() + along_y<N>() * along_y<N>();
  }
  // The t of the point nearest to a centre.
  template <class N>
  N nearest(float x, float y) const {
    return -(from_centre<N>(static_cast<double>(segment_.x0), x) * along_x<N>() +
             from_centre<N>(static_cast<double>(segment_.y0), y) * along_y<N>()) /
           length_squared<N>();
  }

  template <class N>
  static N number(float value) {
    return N(static_cast<double>(value));
  }

 private:
  const Segment& segment_;
};

// A place on the way, mm, in a cell of the part; dx, dy: mm per unit of t.
template <class N>
struct OnWay {
  const Cell& cell;
  const N &x, &y, &dx, &dy;

  // x, y: from a centre.
  N x_from(float centre) const { return x + from_centre<N>(0, centre); }
  N y_from(float centre) const { return y + from_centre<N>(0, centre); }
};

}  // namespace forceshade::reference
