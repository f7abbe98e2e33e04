// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A way straight on from a point, and where triangles begin and end on it.

#include <span>
#include <vector>

#include "fast/soups/star.h"

namespace forceshade::fast::soups {

// The length of a part of a segment: to where it meets a triangle's plane, or a side of a triangle in whose plane it is, a
// point, or the foot of the hand. The latter two may be shared.
struct Time {
  enum class Kind : std::uint8_t { plane, side, target, foot };

  Kind kind = Kind::target;
  std::uint8_t side = 0;
  const Face* f = nullptr;
  const Point* point = nullptr;
  std::int64_t share = kGrid;
  Ball about{};
};

class Segment {
 public:
  // star: of the point, or null. The point and the star outlive the segment.
  Segment(const Point& from, const Star* star, const Direction& along) noexcept : from_(&from), star_(star), along_(along) {}

  const Direction& along() const noexcept { return along_; }
  // All of it that is looked at lies on this edge, or in this triangle.
  Segment& within(const std::array<std::uint32_t, 2>& edge) noexcept {
    edge_ = edge;
    return *this;
  }
  Segment& within(const Face* face) noexcept {
    face_ = face;
    return *this;
  }

  Time at_plane(const Face& f) const noexcept { return timed({Time::Kind::plane, 0, &f}); }
  Time at_side(const Face& f, std::size_t i) const noexcept {
    return timed({Time::Kind::side, static_cast<std::uint8_t>(i), &f});
  }
  // The direction is this point less where the segment begins, as way_between() gives it.
  Time at_target(const Point& point, std::int64_t share = kGrid) const noexcept {
    return timed({Time::Kind::target, 0, nullptr, &point, share});
  }
  Time at_foot(const Point& hand, std::int64_t share = kGrid) const noexcept {
    return timed({Time::Kind::foot, 0, nullptr, &hand, share});
  }

  // -1, 0 or 1.
  int compare(const Time& a, const Time& b) const noexcept;
  Point point(const Time& t) const noexcept;

  // The times after 0 and before `most`, or at it if it is included, at which the set of triangles changes: in order, with each
  // triangle. near: triangles among which are all that the segment meets. along: those in whose plane it is.
  void find_changes(std::span<const Face* const> near, const Time& most, bool is_included, std::vector<Time>& times,
                    std::vector<const Face*>& along) const;
  // The first of them.
  void find_first(std::span<const Face* const> near, const Time& most, bool is_included, std::vector<Time>& times) const;

 private:
  template <class N>
  Quotient<N> value(const Time& t) const noexcept;
  Time timed(Time t) const noexcept;
  bool passes(const Face& f, int slope) const noexcept;
  template <class Add>
  void add_in_plane(const Face& f, const Star::Held* held, const Add& add) const;
  std::uint32_t known_end(const Time& t) const noexcept;
  void look(std::span<const Face* const> near, Time most, bool is_included, std::vector<Time>& times,
            std::vector<const Face*>* along) const;

  const Point* from_;
  const Star* star_;
  Direction along_;
  std::array<std::uint32_t, 2> edge_{kNone, kNone};
  const Face* face_ = nullptr;
};

// From a to b, times a positive number.
inline Vector3<Whole> way_between(const Point& a, const Point& b) noexcept {
  const auto &from = a.get<Whole>(), &to = b.get<Whole>();
  return from.w * to.x - to.w * from.x;
}
inline Vector3<Ball> about_way(const Vector3<Whole>& way, const Point& a, const Point& b) noexcept {
  return ball_of(way, a.get<Whole>().w * b.get<Whole>().w);
}

}  // namespace forceshade::fast::soups
