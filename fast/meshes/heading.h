// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Finds the way that the surface leads from a point of it, and the side of it to which a direction points:
// docs/god-object.md, "Directions".

#include "fast/meshes/decide.h"

namespace forceshade::fast {

// The side to which a direction points, seen from a point of the surface.
enum class DirectionKind { on, open, front, back };

// The steepest way along the surface.
struct Slide {
  enum class Along { nothing, edge, triangle } along = Along::nothing;
  HalfEdge half = 0;         // edge: one of its halves; triangle: one of its edges
  bool is_reversed = false;  // edge: from the half's end to its start
};

struct Heading {
  DirectionKind kind;
  Slide way;
  int triangles = 0;  // that were looked at, at a vertex
};

// Beside an edge with two triangles, d being on neither; first, second: the signs of n·d.
FORCESHADE_INLINE DirectionKind kind_between(const Mesh& mesh, HalfEdge h, int first, int second) noexcept {
  const bool is_narrow = mesh.face(face_of(h)).fold(corner_of(h)) == Fold::narrow;
  return (is_narrow ? first > 0 && second > 0 : first > 0 || second > 0) ? DirectionKind::front : DirectionKind::back;
}

// The position of a direction d at an edge relative to a triangle there: the signs of n·d, and of (e x d)·n, positive where d
// leads from the edge into the triangle.
struct Beside {
  int side = 0, inward = 0;
};

// The side to which d points from a point inside the edge h. second: of the triangle beyond the edge; at the rim there is none.
FORCESHADE_INLINE DirectionKind kind_beside(const Mesh& mesh, HalfEdge h, const Beside& first, const Beside& second) noexcept {
  if (first.side == 0 && first.inward >= 0) return DirectionKind::on;
  if (mesh.twin(h) == kRim) return DirectionKind::open;
  if (second.side == 0 && second.inward >= 0) return DirectionKind::on;
  return kind_between(mesh, h, first.side, second.side);
}

// 2^24(p - g) or its opposite.
struct Direction {
  Vector3<double> d;
  double size;  // as Offset::size
  const Point* from;
  const float* to;
  bool is_opposite;
  const ExactOffset* known = nullptr;  // the same in integers, instead of the two points

  ExactOffset exact() const noexcept {
    if (known != nullptr) return *known;
    const ExactOffset U = exact_offset_from(*from, to);
    return is_opposite ? ExactOffset{-U.x, -U.y, -U.z} : U;
  }
};

// The ways that one direction at a point leads, on the triangles and edges there.
template <class Stages>
class Headings {
 public:
  Headings(const Mesh& mesh, const Direction& direction, const Stages& stages) noexcept
      : mesh_(mesh), direction_(direction), stages_(stages) {}

  // n·d.
  int side(std::uint32_t f) const noexcept {
    const FaceNumbers face(mesh_.face(f));
    return sign_of({dot(face.n, direction_.d), kAcross.error * face.area * direction_.size}, stages_,
                   [&] { return dot(ExactFace(mesh_.face(f)).n, direction_.exact()).sign(); });
  }

  // (e x d)·n: whether d leads from the edge into the triangle, for the edge's own part of it.
  int inward(HalfEdge h) const noexcept {
    const FaceNumbers face(mesh_.face(face_of(h)));
    const Vector3<double> e = difference(end_point(h), mesh_.start_point(h));
    return sign_of({dot(cross(e, direction_.d), face.n), kInside.error * face.area * size_of(e) * direction_.size}, stages_,
                   [&] {
                     const auto exact_e = exact_difference(end_point(h), mesh_.start_point(h));
                     return dot(cross(exact_e, direction_.exact()), ExactFace(mesh_.face(face_of(h))).n).sign();
                   });
  }

  // The same for two edges of one triangle: h, and the one that ends where h begins.
  struct InwardFrom {
    int edge, other;
  };
  InwardFrom inward_from(HalfEdge h) const noexcept {
    const Face& f = mesh_.face(face_of(h));
    const std::uint32_t a = corner_of(h), b = after(a), c = before(a);
    const FaceNumbers face(f);
    const auto from = [&](std::uint32_t start, std::uint32_t end) {
      const Vector3<double> e = difference(f.corner[end].data(), f.corner[start].data());
      return sign_of({dot(cross(e, direction_.d), face.n), kInside.error * face.area * size_of(e) * direction_.size}, stages_,
                     [&] {
                       const auto exact_e = exact_difference(f.corner[end].data(), f.corner[start].data());
                       return dot(cross(exact_e, direction_.exact()), ExactFace(f).n).sign();
                     });
    };
    return {from(a, b), from(c, a)};
  }

  // At a point inside an edge.
  DirectionKind kind_at_edge(HalfEdge h) const noexcept {
    const HalfEdge other = mesh_.twin(h);
    return kind_beside(mesh_, h, {side(face_of(h)), inward(h)},
                       other == kRim ? Beside{} : Beside{side(face_of(other)), inward(other)});
  }

  // At a point inside an edge: the steepest way; nothing where none leads nearer.
  Slide on_edge(HalfEdge h) const noexcept {
    const HalfEdge other = mesh_.twin(h);
    const Slide first{Slide::Along::triangle, h, false}, second{Slide::Along::triangle, other, false};
    const bool into_first = inward(h) > 0, into_second = other != kRim && inward(other) > 0;
    if (into_first && into_second) return is_better(second, first) ? second : first;
    if (into_first || into_second) return into_first ? first : second;
    const int sign = along({Slide::Along::edge, h, false});
    return sign == 0 ? Slide{} : Slide{Slide::Along::edge, h, sign < 0};
  }

  // At a vertex: with Along::nothing, the surface does not lead nearer. d is not 0.
  Heading at_vertex(std::uint32_t vertex) const noexcept {
    Slide best;
    const auto offer = [&](const Slide& way) {
      if (best.along == Slide::Along::nothing || is_better(way, best)) best = way;
    };
    // An edge is the steepest way only if neither of its triangles leads inward from it.
    const HalfEdge start = mesh_.first_around(vertex);
    const bool is_at_rim = mesh_.twin(start) == kRim;
    int into_first_from_start = 0, into_last = -1;  // the latter: from the edge at hand into the triangle before it
    HalfEdge h = start;
    int triangles = 0;
    do {
      ++triangles;
      const auto [from_edge, from_other] = inward_from(h);
      if (h == start && !is_at_rim)
        into_first_from_start = from_edge;
      else if (into_last <= 0 && from_edge <= 0)
        offer({Slide::Along::edge, h, false});
      if (from_edge > 0 && from_other > 0) offer({Slide::Along::triangle, h, false});
      into_last = from_other;
      const HalfEdge following = mesh_.around(h);
      if (following == kRim && into_last <= 0) offer({Slide::Along::edge, previous(h), true});
      h = following;
    } while (h != kRim && h != start);
    if (!is_at_rim && into_last <= 0 && into_first_from_start <= 0) offer({Slide::Along::edge, start, false});
    const DirectionKind kind = kind_at_vertex(best, is_at_rim);
    if (best.along == Slide::Along::edge && along(best) <= 0) best = {};
    return {kind, best, triangles};
  }

  // True if `a` is steeper than `b`, or comes before it where both are alike.
  bool is_better(const Slide& a, const Slide& b) const noexcept {
    int sign = 0;
    if (a.along == Slide::Along::triangle && b.along == Slide::Along::triangle) {
      // The nearer the plane, the longer the projection.
      const auto angle = [&](const Slide& way) {
        const FaceNumbers face(mesh_.face(face_of(way.half)));
        const DoubleWithError across{dot(face.n, direction_.d), kAcross.error * face.area * direction_.size};
        return across * across / DoubleWithError{dot(face.n, face.n), kArea.error * face.area * face.area};
      };
      sign = sign_of(angle(b) - angle(a), stages_, [&] { return exact_compare(a, b); });
    } else {
      sign = sign_of(part_along(a) - part_along(b), stages_, [&] { return exact_compare(a, b); });
    }
    if (sign != 0) return sign > 0;
    if (a.along != b.along) return a.along == Slide::Along::edge;
    if (a.along == Slide::Along::triangle) return mesh_.face(face_of(a.half)).index() < mesh_.face(face_of(b.half)).index();
    return ends(a) < ends(b);
  }

 private:
  const float* end_point(HalfEdge h) const noexcept { return mesh_.start_point(next(h)); }
  static DirectionKind kind_of(bool is_front) noexcept { return is_front ? DirectionKind::front : DirectionKind::back; }

  DirectionKind kind_at_vertex(const Slide& best, bool is_at_rim) const noexcept {
    if (best.along == Slide::Along::triangle) {
      const int sign = side(face_of(best.half));
      return sign == 0 ? DirectionKind::on : is_at_rim ? DirectionKind::open : kind_of(sign > 0);
    }
    const int first = side(face_of(best.half));
    if (first == 0 && inward(best.half) == 0 && along(best) > 0) return DirectionKind::on;
    if (is_at_rim) return DirectionKind::open;
    return kind_between(mesh_, best.half, first, side(face_of(mesh_.twin(best.half))));
  }

  // e·d, e leading away from the vertex.
  Vector3<double> edge(const Slide& way) const noexcept {
    const float *a = mesh_.start_point(way.half), *b = end_point(way.half);
    return way.is_reversed ? difference(a, b) : difference(b, a);
  }
  ExactDifference exact_edge(const Slide& way) const noexcept {
    const float *a = mesh_.start_point(way.half), *b = end_point(way.half);
    return way.is_reversed ? exact_difference(a, b) : exact_difference(b, a);
  }
  DoubleWithError along_edge(const Slide& way) const noexcept {
    const Vector3<double> e = edge(way);
    return {dot(direction_.d, e), kAlong.error * direction_.size * size_of(e)};
  }
  int along(const Slide& way) const noexcept {
    return sign_of(along_edge(way), stages_, [&] { return dot(direction_.exact(), exact_edge(way)).sign(); });
  }

  // The square of the part of d along the way, with the part's sign.
  DoubleWithError part_along(const Slide& way) const noexcept {
    if (way.along == Slide::Along::edge) {
      const Vector3<double> e = edge(way);
      const double size = size_of(e);
      const DoubleWithError part = along_edge(way);
      return (part.value < 0 ? -(part * part) : part * part) / DoubleWithError{dot(e, e), kLength.error * size * size};
    }
    const FaceNumbers face(mesh_.face(face_of(way.half)));
    const double unit = kAcross.error * face.area * direction_.size;
    const DoubleWithError across{dot(face.n, direction_.d), unit};
    const DoubleWithError length{square(direction_.d), kOffsetLength.error * direction_.size * direction_.size};
    return length - across * across / DoubleWithError{dot(face.n, face.n), kArea.error * face.area * face.area};
  }

  std::array<std::uint32_t, 2> ends(const Slide& way) const noexcept {
    const std::uint32_t a = mesh_.start(way.half), b = mesh_.start(next(way.half));
    return a < b ? std::array{a, b} : std::array{b, a};
  }

  [[gnu::noinline]] int exact_compare(const Slide& a, const Slide& b) const noexcept {
    if (a.along == Slide::Along::edge && b.along == Slide::Along::triangle) return -exact_compare(b, a);
    const ExactOffset d = direction_.exact();
    if (b.along == Slide::Along::triangle) {
      const auto n1 = ExactFace(mesh_.face(face_of(a.half))).n, n2 = ExactFace(mesh_.face(face_of(b.half))).n;
      const auto first = dot(n1, d), second = dot(n2, d);
      return (second * second * square(n1)).compare(first * first * square(n2));
    }
    const ExactDifference e = exact_edge(b);
    const auto part = dot(d, e);
    if (a.along == Slide::Along::triangle) {
      if (part.sign() <= 0) return 1;  // a triangle is offered only with a projection, which is longer than 0
      const auto n = ExactFace(mesh_.face(face_of(a.half))).n;
      return (square(cross(d, n)) * square(e)).compare(part * part * square(n));
    }
    const ExactDifference other = exact_edge(a);
    const auto first = dot(d, other);
    const auto signed_square = [](const auto& number) { return number.sign() < 0 ? -(number * number) : number * number; };
    return (signed_square(first) * square(e)).compare(signed_square(part) * square(other));
  }

  const Mesh& mesh_;
  const Direction& direction_;
  const Stages& stages_;
};

}  // namespace forceshade::fast
