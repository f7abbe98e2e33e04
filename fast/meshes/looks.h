// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The triangles that a straight way leads past: those whose boxes, along the axes, have a point in common with it. They are
// counted exactly, because their number decides where a tick ends unfinished (docs/god-object.md, "A tick").

#include <array>
#include <cmath>

#include "fast/meshes/flight.h"

namespace forceshade::fast {

// A point in units of 2^-77 mm.
using GridPlace = Vector3<FixedInteger<92>>;

inline GridPlace place_of(const Point& g) noexcept {
  const auto coordinate = [&](std::size_t axis) {
    FixedInteger<92> sum;
    for (int c = 0; c < g.count; ++c) {
      const auto i = static_cast<std::size_t>(c);
      // No partial sum exceeds 2^24 times the largest coordinate: the weights add up to 2^24.
      const auto next = sum + in_units(g.corner[i][axis]) * FixedInteger<25>(static_cast<std::int64_t>(g.weight[i]));
      sum = FixedInteger<92>(next.words());
    }
    return sum;
  };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

class Looks {
 public:
  using Part = FixedInteger<304>;

  // A way from g towards p, of which left/all is not gone; about_left: the same quotient with its error. start, end: g and p,
  // within 2^-36 mm.
  Looks(const Point& g, const float* p, const Part& left, const Part& all, const DoubleWithError& about_left,
        const Vector3<double>& start, const Vector3<double>& end) noexcept
      : from_(place_of(g)), along_(exact_offset_from(g, p)), all_(all), start_(in_order(start)) {
    const GridPlace to = place_of(Point::at(p));
    const auto stop = [&](const auto& at, const auto& by) { return at * all - by * left; };
    stop_ = {stop(to.x, along_.x), stop(to.y, along_.y), stop(to.z, along_.z)};
    const auto share = [](double gone) { return gone < 0 ? 0.0 : gone > 1 ? 1.0 : gone; };
    const double least = share(1 - about_left.value - about_left.error - 0x1p-40),
                 most = share(1 - about_left.value + about_left.error + 0x1p-40);
    const std::array<double, 3> to_about = in_order(end);
    is_across_ = {along_.x.is_zero(), along_.y.is_zero(), along_.z.is_zero()};
    for (std::size_t i = 0; i < 3; ++i) {
      direction_[i] = to_about[i] - start_[i];
      nearest_stop_[i] = start_[i] + least * direction_[i];
      farthest_stop_[i] = start_[i] + most * direction_[i];
    }
  }

  // Their number, or `most` if there are more.
  int count(const Mesh& mesh, int most) const noexcept {
    int found = 0;
    const auto vector = [](const std::array<double, 3>& a) { return Vector3<double>{a[0], a[1], a[2]}; };
    mesh.tree().along(vector(start_), vector(farthest_stop_), [&](std::uint32_t f) {
      if (found == most) return;
      found += is_met(Box(mesh.face(f)));
    });
    return found;
  }

 private:
  struct Box {
    std::array<float, 3> low, high;

    explicit Box(const Face& face) noexcept : low(face.corner[0]), high(face.corner[0]) {
      for (const auto& corner : face.corner)
        for (std::size_t i = 0; i < 3; ++i) {
          low[i] = corner[i] < low[i] ? corner[i] : low[i];
          high[i] = corner[i] > high[i] ? corner[i] : high[i];
        }
    }
  };
  // True if the box meets the way. They are apart if, along an axis, both ends of the way are on one side of the box; or if,
  // seen along an axis, all corners of the box are on one side of the way's line. If neither is so, they meet: these are all
  // the separating axes of a box and a segment. Every number below is within kAbout of the true one, where it is a coordinate,
  // and sums of products within kAbout times the sum of the sizes. What binary64 leaves in doubt is decided in integers.
  bool is_met(const Box& box) const noexcept {
    constexpr double kAbout = 0x1p-32;
    std::array<bool, 3> is_sure_along{}, is_sure_across{};
    std::array<double, 3> centre, extent;
    for (std::size_t i = 0; i < 3; ++i) {
      const double low = static_cast<double>(box.low[i]), high = static_cast<double>(box.high[i]), a = start_[i];
      const double near = nearest_stop_[i], far = farthest_stop_[i];
      if ((a < low - kAbout && far < low - kAbout) || (a > high + kAbout && far > high + kAbout)) return false;
      is_sure_along[i] = (a > low + kAbout || near > low + kAbout) && (a < high - kAbout || near < high - kAbout);
      centre[i] = 0.5 * (low + high) - a;
      extent[i] = 0.5 * (high - low);
    }
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t k = j == 2 ? 0 : j + 1;
      // Then the line is on one side of the corners only if the way is, along an axis.
      is_sure_across[j] = is_across_[j] || is_across_[k];
      if (is_sure_across[j]) continue;
      const double u = std::fabs(direction_[j]), v = std::fabs(direction_[k]);
      const double off = std::fabs(direction_[j] * centre[k] - direction_[k] * centre[j]),
                   reach = u * extent[k] + v * extent[j];
      const double error = kAbout * (u + v + std::fabs(centre[j]) + std::fabs(centre[k]) + extent[j] + extent[k] + 1);
      if (off > reach + error) return false;
      is_sure_across[j] = off + error < reach;
    }
    for (std::size_t i = 0; i < 3; ++i)
      if (!is_sure_along[i] && is_apart_along(i, box)) return false;
    for (std::size_t j = 0; j < 3; ++j)
      if (!is_sure_across[j] && is_apart_across(j, box)) return false;
    return true;
  }

  template <class T>
  static std::array<T, 3> in_order(const Vector3<T>& a) noexcept {
    return {a.x, a.y, a.z};
  }
  static auto unit(float coordinate) noexcept { return in_units(coordinate).template shifted<24>(); }
  [[gnu::noinline]] bool is_apart_along(std::size_t i, const Box& box) const noexcept {
    const auto from = in_order(from_)[i];
    const auto stop = in_order(stop_)[i];
    const auto low = unit(box.low[i]), high = unit(box.high[i]);
    return (from.compare(low) < 0 && stop.compare(low * all_) < 0) || (from.compare(high) > 0 && stop.compare(high * all_) > 0);
  }
  [[gnu::noinline]] bool is_apart_across(std::size_t j, const Box& box) const noexcept {
    const std::size_t k = j == 2 ? 0 : j + 1;
    const auto from = in_order(from_);
    const auto along = in_order(along_);
    int before = 0, behind = 0;
    for (const float at_j : {box.low[j], box.high[j]})
      for (const float at_k : {box.low[k], box.high[k]}) {
        const int side = (along[j] * (unit(at_k) - from[k]) - along[k] * (unit(at_j) - from[j])).sign();
        before += side < 0;
        behind += side > 0;
      }
    return before == 4 || behind == 4;
  }

  GridPlace from_;
  ExactOffset along_;  // from g to p, in the same units
  Part all_;
  Vector3<decltype(FixedInteger<92>() * Part() - FixedInteger<95>() * Part())> stop_;  // where it stops, times all
  std::array<bool, 3> is_across_{};  // whether the way is at a right angle to the axis
  std::array<double, 3> start_, direction_, nearest_stop_, farthest_stop_;
};

// Those that a flight from g to p leads past as far as it goes, or `most` if there are more.
template <class Stages>
[[gnu::noinline]] int exact_looks(const Flight<Stages>& flight, const Mesh& mesh, const Point& g, const float* p,
                                  int most) noexcept {
  const bool has_landed = flight.landing().part != Hit::Part::none;
  typename Flight<Stages>::Fraction left{Looks::Part(0), Looks::Part(1)};
  if (has_landed) left = flight.left_at_landing();
  return Looks(g, p, left.num, left.den, has_landed ? flight.landing().remaining : DoubleWithError::exactly(0),
               flight.about_start(), flight.about_end())
      .count(mesh, most);
}

}  // namespace forceshade::fast
