// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The triangles that a straight way leads past: those whose boxes, along the axes, have a point in common with it. They are
// counted exactly, because their number decides where a tick ends unfinished (docs/soups.md, "A tick").

#include <algorithm>
#include <array>
#include <cmath>

#include "fast/soups/points.h"

namespace forceshade::fast::soups {

// The box of a short way, with a margin beyond all roundings: triangles whose boxes miss it hold no point of the way.
class Surroundings {
 public:
  // The ends: within 2^-50, relative to 2^14 mm.
  Surroundings(const Vector3<double>& from, const Vector3<double>& to) noexcept {
    constexpr double kMargin = 0x1p-34;  // mm
    const std::array<double, 3> a{from.x, from.y, from.z}, b{to.x, to.y, to.z};
    for (std::size_t i = 0; i < 3; ++i) {
      low_[i] = static_cast<float>(std::min(a[i], b[i]) - kMargin);
      high_[i] = static_cast<float>(std::max(a[i], b[i]) + kMargin);
    }
  }

  // Rounded to binary32 their order stays that of the true numbers, for corners are such numbers.
  bool is_at(const Face& face) const noexcept {
    const auto& [a, b, c] = face.corner;
    bool meets = true;
    for (std::size_t i = 0; i < 3; ++i)
      meets = meets & ((a[i] >= low_[i]) | (b[i] >= low_[i]) | (c[i] >= low_[i])) &
              ((a[i] <= high_[i]) | (b[i] <= high_[i]) | (c[i] <= high_[i]));
    return meets;
  }

 private:
  std::array<float, 3> low_, high_;
};

class Looks {
 public:
  // The points outlive it.
  Looks(const Point& from, const Point& to) noexcept : from_(&from), to_(&to) {
    double largest = 0, error = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      is_across_[i] = sign_of([&]<class N>() { return along<N>(i); }) == 0;
      const Ball &a = at(from.get<Ball>().x, i), &b = at(to.get<Ball>().x, i);
      start_[i] = a.value;
      way_[i] = b.value - a.value;
      low_[i] = std::min(a.value, b.value);
      high_[i] = std::max(a.value, b.value);
      error_[i] = std::max(a.error, b.error);
      error = std::max(error, error_[i]);
      largest = std::max(largest, std::max(-low_[i], high_[i]));
    }
    // The numbers that is_at() multiplies are within 2 (error + 2^-36) of the true numbers, and below 2^18.
    relative_error_ = largest < 0x1p17 && error < 0x1p-10 ? 64 * (error + 0x1p-36) : HUGE_VAL;
  }

  // They are apart if, along an axis, both ends are on one side of the box; or if, seen along an axis, all corners of the box
  // are on one side of the line. If neither is so they meet: these are all the separating axes of a box and a segment. What
  // binary64 leaves in doubt is decided in integers.
  bool is_at(const Face& face) const noexcept {
    std::array<float, 3> low = face.corner[0], high = low;
    for (const auto& corner : face.corner)
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = corner[i] < low[i] ? corner[i] : low[i];
        high[i] = corner[i] > high[i] ? corner[i] : high[i];
      }
    std::array<bool, 3> is_sure{};
    std::array<double, 3> centre, extent;
    for (std::size_t i = 0; i < 3; ++i) {
      const double least = static_cast<double>(low[i]), most = static_cast<double>(high[i]);
      if (high_[i] + error_[i] < least || low_[i] - error_[i] > most) return false;
      is_sure[i] = !(error_[i] > 0) || (high_[i] - error_[i] > least && low_[i] + error_[i] < most);
      centre[i] = 0.5 * (least + most) - start_[i];
      extent[i] = 0.5 * (most - least);
    }
    for (std::size_t i = 0; i < 3; ++i)
      if (!is_sure[i] && is_apart_along(i, low[i], high[i])) return false;
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t k = j == 2 ? 0 : j + 1;
      // Then the line is on one side of the corners only if the way is, along an axis.
      if (is_across_[j] || is_across_[k]) continue;
      const double u = std::fabs(way_[j]), v = std::fabs(way_[k]);
      const double more = std::fabs(way_[j] * centre[k] - way_[k] * centre[j]) - (u * extent[k] + v * extent[j]);
      const double error = relative_error_ * (u + v + std::fabs(centre[j]) + std::fabs(centre[k]) + extent[j] + extent[k] + 1);
      if (more > error) return false;
      if (!(more < -error) && is_apart_across(j, k, low, high)) return false;
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
  [[gnu::noinline]] bool is_apart_along(std::size_t i, float low, float high) const noexcept {
    return compare(*from_, i, low) < 0 ? compare(*to_, i, low) < 0 : compare(*from_, i, high) > 0 && compare(*to_, i, high) > 0;
  }
  [[gnu::noinline]] bool is_apart_across(std::size_t j, std::size_t k, const std::array<float, 3>& low,
                                         const std::array<float, 3>& high) const noexcept {
    const int first = side(j, low[j], k, low[k]);
    return first != 0 && side(j, low[j], k, high[k]) == first && side(j, high[j], k, low[k]) == first &&
           side(j, high[j], k, high[k]) == first;
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
  std::array<double, 3> start_, way_, low_, high_, error_;
  double relative_error_;
};

}  // namespace forceshade::fast::soups
