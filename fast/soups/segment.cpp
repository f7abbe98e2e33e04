// SPDX-License-Identifier: BSD-3-Clause
#include "fast/soups/segment.h"

#include <algorithm>

namespace forceshade::fast::soups {
namespace {

bool has_side(const Face& f, const Face& of, std::size_t i) noexcept {
  const auto has = [&](std::uint32_t name) { return std::ranges::find(f.vertex, name) != f.vertex.end(); };
  return has(of.vertex[i]) && has(of.vertex[i == 2 ? 0 : i + 1]);
}

}  // namespace

// The point is the beginning x/w plus value/w times the direction, as point_along() has it; its divisor may be negative.
template <class N>
Quotient<N> Segment::value(const Time& t) const noexcept {
  switch (t.kind) {
    case Time::Kind::plane: {
      const Vector3<N> n = normal<N>(*t.f);
      return {-dot(n, from_corner<N>(t.f->corner[0].data(), *from_)), dot(n, along_.get<N>())};
    }
    case Time::Kind::side: {
      const Vector3<N> n = normal<N>(*t.f), e = side_of_face<N>(*t.f, t.side);
      return {-dot(cross(e, from_corner<N>(t.f->corner[t.side].data(), *from_)), n), dot(cross(e, along_.get<N>()), n)};
    }
    case Time::Kind::target: {
      if (t.share == kGrid) return {N::of(1), t.point->get<N>().w};
      return {N::of(t.share), N::of(kGrid) * t.point->get<N>().w};
    }
    case Time::Kind::foot: break;
  }
  const Scaled<N>&hand = t.point->get<N>(), &from = from_->get<N>();
  const Vector3<N> d = along_.get<N>();
  const Quotient<N> whole{dot(from.w * hand.x - hand.w * from.x, d), hand.w * squared(d)};
  if (t.share == kGrid) return whole;
  return {N::of(t.share) * whole.num, N::of(kGrid) * whole.den};
}

Time Segment::timed(Time t) const noexcept {
  const Quotient<Ball> its = value<Ball>(t);
  t.about = its.num / its.den;
  return t;
}

// The end of the edge on which all of it lies, if a triangle that is met there has it; a side that lies on the edge meets
// nothing.
std::uint32_t Segment::known_end(const Time& t) const noexcept {
  for (const std::uint32_t name : edge_) {
    if (name == kNone) continue;
    if (t.kind == Time::Kind::plane && std::ranges::count(t.f->vertex, name) > 0) return name;
    if (t.kind == Time::Kind::side && (t.f->vertex[t.side] == name || t.f->vertex[t.side == 2 ? 0 : t.side + 1] == name))
      return name;
  }
  return kNone;
}

int Segment::compare(const Time& a, const Time& b) const noexcept {
  const Ball more = a.about - b.about;
  if (more.is_sure()) return more.value > 0 ? 1 : -1;
  if (a.kind == Time::Kind::side && b.kind == Time::Kind::side && has_side(*a.f, *b.f, b.side) &&
      has_side(*b.f, *a.f, a.side) && (a.f != b.f || a.side == b.side))
    return 0;
  if (const std::uint32_t end = known_end(a); end != kNone && end == known_end(b)) return 0;
  note_exact_decision();
  const Quotient<Whole> one = value<Whole>(a), other = value<Whole>(b);
  return (one.num * other.den - other.num * one.den).sign() * one.den.sign() * other.den.sign();
}

Point Segment::point(const Time& t) const noexcept {
  Quotient<Whole> its = value<Whole>(t);
  if (its.den.sign() < 0) its = {-its.num, -its.den};
  Point x(point_along(from_->get<Whole>(), along_.get<Whole>(), its));
  x.edge = edge_;
  x.faces[0] = face_;
  if (t.kind == Time::Kind::plane) x.faces[1] = t.f;
  if (t.kind == Time::Kind::side) {
    const std::array<std::uint32_t, 2> side{t.f->vertex[t.side], t.f->vertex[t.side == 2 ? 0 : t.side + 1]};
    if (x.edge[0] == kNone) {
      x.edge = side;
    } else {
      for (const std::uint32_t name : side)
        if (name == x.edge[0] || name == x.edge[1]) x.vertex = name;
      x.faces[1] = t.f;
    }
  }
  return x;
}

// True if the line passes the triangle within its sides, for one that is not in its plane. slope: the sign of n·d.
bool Segment::passes(const Face& f, int slope) const noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    if (along_.kind == Direction::Kind::line && along_.line.is_side(f, i)) continue;
    const int side = sign_of([&]<class N>() {
      return dot(cross(from_corner<N>(f.corner[i].data(), *from_), side_of_face<N>(f, i)), along_.get<N>());
    });
    if (side * slope > 0) return false;
  }
  return true;
}

template <class Add>
void Segment::add_in_plane(const Face& f, const Star::Held* held, const Add& add) const {
  Time first, last;
  bool has_first = false, has_last = false, is_first_ahead = false, is_last_ahead = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const bool is_along = along_.kind == Direction::Kind::line && along_.line.is_side(f, i);
    const int inside = held != nullptr && held->has_side(i) ? 0 : sign_inside(f, i, *from_);
    const int grows =
        is_along ? 0 : sign_of([&]<class N>() { return dot(cross(side_of_face<N>(f, i), along_.get<N>()), normal<N>(f)); });
    if (grows == 0) {
      if (inside < 0) return;
      continue;
    }
    if (grows < 0 && inside < 0) return;  // it is beyond the triangle already
    const Time t = at_side(f, i);
    if (grows > 0) {
      if (!has_first || compare(t, first) > 0) {
        first = t;
        is_first_ahead = inside < 0;
      }
      has_first = true;
    } else {
      if (!has_last || compare(t, last) < 0) {
        last = t;
        is_last_ahead = inside > 0;
      }
      has_last = true;
    }
  }
  if (!is_last_ahead) return;
  if (is_first_ahead && compare(first, last) > 0) return;
  if (is_first_ahead) add(first);
  add(last);
}

// Only the first time is kept without a list of those along it.
void Segment::look(std::span<const Face* const> near, Time most, bool is_included, std::vector<Time>& times,
                   std::vector<const Face*>* along) const {
  times.clear();
  const Scaled<Ball>& from = from_->get<Ball>();
  const Vector3<Ball>& d = along_.about;
  Vector3<Ball> to = from.x + most.about * d;
  const auto add = [&](const Time& t) {
    if (const int sign = compare(t, most); sign > 0 || (sign == 0 && !is_included)) return;
    if (along == nullptr) {
      times.clear();
      most = t;
      is_included = false;
      to = from.x + most.about * d;
    }
    times.push_back(t);
  };
  const auto look_in_plane = [&](const Face& f, const Star::Held* held) {
    if (along != nullptr) along->push_back(&f);
    add_in_plane(f, held, add);
  };
  for (const Face* const face : near) {
    const Face& f = *face;
    if (const Star::Held* const held = star_ == nullptr ? nullptr : star_->held(f); held != nullptr) {
      if (star_->across(held->plane, along_) == 0) look_in_plane(f, held);
      continue;
    }
    const Corners<Ball> c = corners<Ball>(f);
    const Vector3<Ball> n = c.normal();
    const Ball num = -dot(n, from.x - c[0]), den = dot(n, d);
    if (most.kind == Time::Kind::side && &f != most.f && den.is_sure() && !is_included && has_side(f, *most.f, most.side))
      continue;  // it meets the segment's plane in that side
    int height = num.value > 0 ? 1 : -1, slope = den.value > 0 ? 1 : -1;
    if (num.is_sure() && den.is_sure()) {
      if (height != slope) continue;
      if ((num / den - most.about).is_sure() && num.value / den.value > most.about.value) continue;
    } else {
      bool is_beside = false;
      for (std::size_t i = 0; i < 3 && !is_beside; ++i) {
        const Vector3<Ball> inward = cross(n, c.side(i));
        const Ball here = dot(inward, from.x - c[i]), there = dot(inward, to - c[i]);
        is_beside = here.is_sure() && there.is_sure() && here.value < 0 && there.value < 0;
      }
      if (is_beside) continue;
      const Ball there = dot(n, to - c[0]);
      if (num.is_sure() && there.is_sure() && (num.value > 0) == (there.value < 0)) continue;
      height = -side_of_plane(f, *from_);
      slope = sign_of([&]<class N>() { return dot(normal<N>(f), along_.get<N>()); });
      if (slope == 0) {
        if (height == 0) look_in_plane(f, nullptr);
        continue;
      }
      if (height != slope) continue;
    }
    if (!passes(f, slope)) continue;
    add(at_plane(f));
  }
}

void Segment::find_first(std::span<const Face* const> near, const Time& most, bool is_included,
                         std::vector<Time>& times) const {
  look(near, most, is_included, times, nullptr);
}

void Segment::find_changes(std::span<const Face* const> near, const Time& most, bool is_included, std::vector<Time>& times,
                           std::vector<const Face*>& along) const {
  along.clear();
  look(near, most, is_included, times, &along);
  if (times.size() > 1) std::sort(times.begin(), times.end(), [&](const Time& a, const Time& b) { return compare(a, b) < 0; });
}

}  // namespace forceshade::fast::soups
