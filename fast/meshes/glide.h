// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Several slides over smooth parts of a mesh in one go.

#include "fast/meshes/rests.h"

namespace forceshade::fast {

// True if a slide to an edge ends nearer to p by more than the rounding takes away. weight: of the corner opposite to the
// edge, at the slide's start; n_n, e_e: the squares of the triangle's normal and of the edge. The slide's length d is at
// least the start's distance from the edge, weight/2^24·|n|/|e|. It brings the square of the distance to p down by d² at
// least, and the rounding up by (|e|/2^24)²/4 at most.
FORCESHADE_INLINE bool is_surely_nearer(double weight, double n_n, double e_e) noexcept {
  return 4 * weight * weight * n_n > (1 + 0x1p-40) * (e_e * e_e);
}

// The slides that follow one which leaves its triangle over the edge h, until one rests inside a triangle, and that rest. So
// are the moves of most ticks on fine meshes. Nothing but the rest stays of them, so their ends are not rounded: it suffices
// where on its edge each rounded end is, about. False, and nothing is done, where binary64 does not prove each of the
// decisions: that p is behind the triangle, so that no edge leads away from the surface; through which edge the slide leaves
// it, not at a vertex; and that its rounded end is nearer to p. num/den: where it crosses h; weight, n_n: as in
// is_surely_nearer(). glide_from: with fewer moves, a further glide of the tick would meet the same doubt again.
//
// S and E are the ends of the edge, O the corner beyond it. With u the weight at the start of the corner whose weight falls
// to 0, that of O is then u·at_O/(u·all - falling), which grows with u. So the ends of an interval for u give those of one
// for it. To each is added a step of the grid for the rounding, and one for all errors, which are less than 2^-24: those of
// den and of num are below 2^-26 den together, or each of the three numbers has one below 2^-28 den.
template <class Stages>
[[gnu::noinline]] bool glide(const Rests<Stages>& rests, Arrival& at, HalfEdge h, const DoubleWithError& num,
                             const DoubleWithError& den, double weight, const DoubleWithError& n_n, int most_moves,
                             int& glide_from) noexcept {
  constexpr double kTwoSteps = 0x1p-23;
  const Mesh& mesh = rests.mesh_;
  const Stages& stages = rests.stages_;
  const mesh::Side side = at.grid_point.side;
  const auto point = [](const float* at) {
    return Vector3<double>{static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
  };
  const Vector3<double> p = point(rests.p_.data());
  Vector3<double> S = point(mesh.start_point(h)), E = point(mesh.start_point(next(h))), e = E - S, w = p - S;
  double size_e = size_of(e), low = num.value / den.value - kTwoSteps, high = num.value / den.value + kTwoSteps;
  bool is_sure =
      den.value > 0x1p26 * (num.error + den.error) && is_surely_nearer(weight, n_n.value - n_n.error, 3 * size_e * size_e);
  int moves = at.moves;
  const auto is_going_on = [&] { return stages.sure(is_sure && low > 0 && high < 1) && moves < most_moves; };
  for (HalfEdge other = mesh.twin(h); other != kRim && is_going_on(); ++moves) {
    const std::uint32_t f = face_of(other), c = corner_of(other);  // the edge from E to S
    const Face& face = mesh.face(f);
    const HalfEdge over_O_E = face.twin[before(c)], over_S_O = face.twin[after(c)];
    mesh.fetch_beyond(over_O_E);
    mesh.fetch_beyond(over_S_O);
    const Vector3<double> O = point(face.corner[before(c)].data()), o = O - S, n = cross(o, e);
    const double size_o = size_of(o), size_w = size_of(w), area = size_e * size_o, across = dot(n, w);
    const double outward = side == mesh::Side::front ? across : -across;
    if (!stages.sure(outward < -kAcross.error * area * size_w)) break;
    const double at_O = dot(cross(w, e), n), at_E = dot(cross(o, w), n), all = dot(n, n), at_S = third_weight(all, at_E, at_O);
    const double error = kThird.error * area * (size_w * (size_e + size_o) + area);
    if (!stages.sure(at_O > error)) break;
    if (stages.sure(at_S > error && at_E > error)) {
      Weights weights;
      weights.corner[c] = {at_E, error};
      weights.corner[after(c)] = {at_S, error};
      weights.corner[before(c)] = {at_O, error};
      weights.all = {all, error};
      at.moves = moves + 1;
      at.plane = {n, across, all, area, size_w};
      rests.put(rests.rest_in_triangle(f, weights, side));
      at.rest = RestKind::in_triangle;
      return true;
    }
    bool is_over_O_E = at_S < 0;  // out over the edge from O to E; else over that from S to O
    if (stages.sure(at_S < -error && at_E < -error)) {
      // Both fall to 0: this is positive where S's does so first, and grows along the edge.
      is_over_O_E = (1 - low) * at_E - low * at_S > 2 * error;
      if (!stages.sure(is_over_O_E || (1 - high) * at_E - high * at_S < -2 * error)) break;
    } else if (!stages.sure(is_over_O_E ? at_S < -error && at_E > error : at_E < -error && at_S > error)) {
      break;
    }
    const double falling = is_over_O_E ? at_S : at_E;
    const double least = is_over_O_E ? 1 - high : low, most = is_over_O_E ? 1 - low : high;
    const double den_low = least * all - falling, den_high = most * all - falling;
    const double x_low = least * at_O / den_low - kTwoSteps, x_high = most * at_O / den_high + kTwoSteps;
    if (is_over_O_E) {
      other = over_O_E;
      low = 1 - x_high;
      high = 1 - x_low;
      S = O;
      e = E - S;
      w = p - S;
      size_e = size_of(e);
    } else {
      other = over_S_O;
      low = x_low;
      high = x_high;
      E = O;
      e = o;
      size_e = size_o;
    }
    is_sure = den_low > 0x1p28 * error && is_surely_nearer(0x1p24 * least, all - error, 3 * size_e * size_e);
  }
  glide_from = moves + 1;
  return false;
}

}  // namespace forceshade::fast
