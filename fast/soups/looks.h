// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The triangles that a straight way leads past: those whose boxes, along the axes, have a point in common with it. They are
// counted exactly, because their number decides where a tick ends unfinished (docs/soups.md, "A tick").

#include <array>

#include "fast/soups/points.h"

namespace forceshade::fast::soups {

class Looks {
 public:
  // The points outlive it.
  Looks(const Point& from, const Point& to) noexcept : from_(&from), to_(&to) {
    for (std::size_t i = 0; i < 3; ++i) is_across_[i] = sign_of([&]<class N>() { return along<N>(i); }) == 0;
  }

  // They are apart if, along an axis, both ends are on one side of the box; or if, seen along an axis, all corners of the box
  // are on one side of the line. If neither is so they meet: these are all the separating axes of a box and a segment.
  bool is_at(const Face& face) const noexcept {
    std::array<float, 3> low = face.corner[0], high = low;
    for (const auto& corner : face.corner)
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = corner[i] < low[i] ? corner[i] : low[i];
        high[i] = corner[i] > high[i] ? corner[i] : high[i];
      }
    for (std::size_t i = 0; i < 3; ++i)
      if (compare(*from_, i, low[i]) < 0 ? compare(*to_, i, low[i]) < 0
                                         : compare(*from_, i, high[i]) > 0 && compare(*to_, i, high[i]) > 0)
        return false;
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t k = j == 2 ? 0 : j + 1;
      // Then the line is on one side of the corners only if the way is, along an axis.
      if (is_across_[j] || is_across_[k]) continue;
      const int first = side(j, low[j], k, low[k]);
      if (first != 0 && side(j, low[j], k, high[k]) == first && side(j, high[j], k, low[k]) == first &&
          side(j, high[j], k, high[k]) == first)
        return false;
    }
    return true;
  }

 private:
  template <class N>
  static const N& at(const Vector3<N>& a, std::size_t i) noexcept {
    return i == 0 ? a.x : i == 1 ? a.y : a.z;
  }
  static int compare(const Point& x, std::size_t i, float bound) noexcept {
    return sign_of([&]<class N>() {
      const Scaled<N>& its = x.get<N>();
      return at(its.x, i) - its.w * coordinate<N>(bound);
    });
  }
  template <class N>
  N along(std::size_t i) const noexcept {
    const Scaled<N>&from = from_->get<N>(), &to = to_->get<N>();
    return from.w * at(to.x, i) - to.w * at(from.x, i);
  }
  // The side of the line, seen along the third axis, that a corner is on.
  int side(std::size_t j, float at_j, std::size_t k, float at_k) const noexcept {
    return sign_of([&]<class N>() {
      const Scaled<N>& from = from_->get<N>();
      return along<N>(j) * (from.w * coordinate<N>(at_k) - at(from.x, k)) -
             along<N>(k) * (from.w * coordinate<N>(at_j) - at(from.x, j));
    });
  }

  const Point *from_, *to_;
  std::array<bool, 3> is_across_{};  // whether the way is at a right angle to the axis
};

}  // namespace forceshade::fast::soups
