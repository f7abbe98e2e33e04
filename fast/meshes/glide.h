// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Slides over edge after edge of a fine mesh, of which only the last decides what the tick leaves behind.

#include <cmath>
#include <optional>

#include "forceshade/fast/meshes/decide.h"

namespace forceshade::fast {

// Where a slide ends inside a triangle, and how many moves led there.
struct Glide {
  std::uint32_t face;
  Weights weights;
  int moves;
};

template <class Stages>
class Glider {
 public:
  // p: mm, in the domain and quantised. is_front: the god-object is in front of the surface. most_moves: of a tick.
  FORCESHADE_INLINE Glider(const Mesh& mesh, const float* p, bool is_front, int most_moves, const Stages& stages) noexcept
      : mesh_(mesh), p_(p), is_front_(is_front), most_moves_(most_moves), stages_(stages) {}

  // From a point of the edge h that is over 2^24 of the way from `low` to `high` along it
  FORCESHADE_INLINE std::optional<Glide> run(HalfEdge h, double low, double high, int& moves) const noexcept {
    const auto point = [](const float* at) {
      return Vector3<double>{static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2])};
    };
    const Vector3<double> p = point(p_);
    Vector3<double> S = point(mesh_.start_point(h)), E = point(mesh_.start_point(next(h))), e = E - S, w = p - S;
    double size_e = size_of(e);
    HalfEdge other = mesh_.twin(h);
    for (; moves < most_moves_ && other != kRim; ++moves) {
      const std::uint32_t f = face_of(other), c = corner_of(other);  // the edge from E to S
      const Face& face = mesh_.face(f);
      mesh_.fetch_neighbours(f);
      const Vector3<double> O = point(face.corner[before(c)].data()), o = O - S, n = cross(o, e);
      const double size_o = size_of(o), size_w = size_of(w), area = size_e * size_o;
      const double across = dot(n, w);
      if (!stages_.sure((is_front_ ? -across : across) > kAcross.error * area * size_w)) break;
      const double at_O = dot(cross(w, e), n), at_E = dot(cross(o, w), n), all = dot(n, n), at_S = all - (at_E + at_O);
      const double error = kThird.error * area * (size_w * (size_e + size_o) + area);
      if (!stages_.sure(at_O > error)) break;
      if (stages_.sure(at_S > error && at_E > error)) {
        Glide end{f, {}, ++moves};
        end.weights.corner[c] = {at_E, error};
        end.weights.corner[after(c)] = {at_S, error};
        end.weights.corner[before(c)] = {at_O, error};
        end.weights.all = {all, error};
        return end;
      }
      const bool is_over_O_E = at_S < 0;
      const double falling = is_over_O_E ? at_S : at_E, staying = is_over_O_E ? at_E : at_S;
      if (!stages_.sure(falling < -error && staying > error)) break;
      const double u_low = is_over_O_E ? 1 - high : low, u_high = is_over_O_E ? 1 - low : high;
      const double den_low = u_low * all - falling, den_high = u_high * all - falling;
      const double x_low = u_low * at_O / den_low - kStep, x_high = u_high * at_O / den_high + kStep;
      if (!stages_.sure(den_low > 0x1p28 * error && x_low > 0 && x_high < 1)) break;
      const std::uint32_t i = is_over_O_E ? before(c) : after(c);
      other = face.twin[i];
      if (is_over_O_E) {
        low = 1 - x_high;
        high = 1 - x_low;
        S = O;
        e = E - S;
        w = p - S;
        size_e = size_of(e);
      } else {
        low = x_low;
        high = x_high;
        E = O;
        e = o;
        size_e = size_o;
      }
      if (!stages_.sure(u_low * u_low * (all - error) > 9 * 0x1p-49 * (size_e * size_e) * (size_e * size_e))) break;
    }
    return std::nullopt;
  }

 private:
  static constexpr RoundingBound kThird = kArea - (kInside + kInside);
  static constexpr double kStep = 0x1p-23;

  const Mesh& mesh_;
  const float* p_;
  bool is_front_;
  int most_moves_;
  const Stages& stages_;
};

}  // namespace forceshade::fast
