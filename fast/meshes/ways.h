// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Ways across a mesh whose sheets may cross each other, and what blocks them (docs/god-object.md, "Meshes that intersect
// themselves"). The tree gives the triangles that a way may meet; binary64 drops those that it surely passes by, and finds
// those that it surely goes through; the rest is decided in integers.

#include <array>
#include <cstdint>
#include <optional>

#include "fast/meshes/segment.h"

namespace forceshade::fast {

template <class Stages>
class Ways {
 public:
  // The place where a way is blocked, from 0 to 1 along it; 1 where its end lies on another feature, too.
  struct Block {
    typename GridSegment::Fraction s;
    HalfEdge half = 0;  // as GridPoint::half
    FeatureKey key{};
  };

  struct Place {
    Point point;
    GridPlace exact;
    Vector3<double> about;
  };
  Ways(const Mesh& mesh, const Stages& stages) noexcept : mesh_(mesh), stages_(stages) {}

  // The first place at which the way in a triangle from one point of it to another is blocked.
  std::optional<Block> block(const GridPoint& from, const GridPoint& to, std::uint32_t triangle) const noexcept {
    return first_block(place_at(from), place_at(to), key_of(mesh_, to), &mesh_.face(triangle));
  }

  static Vector3<double> about(const Point& g) noexcept {
    const auto coordinate = [&](std::size_t axis) {
      double sum = 0;
      for (int c = 0; c < g.count; ++c) {
        const auto i = static_cast<std::size_t>(c);
        sum += static_cast<double>(g.weight[i]) * static_cast<double>(g.corner[i][axis]);
      }
      return 0x1p-24 * sum;
    };
    return {coordinate(0), coordinate(1), coordinate(2)};
  }
  Place place_at(const GridPoint& grid_point) const noexcept {
    const Point point = point_of(mesh_, grid_point);
    return {point, place_of(point), about(point)};
  }

  static Vector3<double> off(const Vector3<double>& at, const std::array<float, 3>& a) noexcept {
    return {at.x - static_cast<double>(a[0]), at.y - static_cast<double>(a[1]), at.z - static_cast<double>(a[2])};
  }
  // n·(at - a), `at` being good to kAbout.
  static DoubleWithError side_about(const Face& face, const FaceNumbers& numbers, const Vector3<double>& at) noexcept {
    const Vector3<double> w = off(at, face.corner[0]);
    return {dot(numbers.n, w), numbers.area * (kAcross.error * size_of(w) + 8 * kAbout)};
  }

  // True if a way between two such points surely passes the triangle by: both are beyond the plane through one of its edges
  // that is at a right angle to it.
  bool surely_passes_by(const Face& face, const FaceNumbers& numbers, const Vector3<double>& from,
                        const Vector3<double>& to) const noexcept {
    bool passes = false;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const auto &a = face.corner[i], &b = face.corner[after(i)];
      const Vector3<double> e = difference(b.data(), a.data());
      const double unit = numbers.area * size_of(e);
      const auto is_beyond = [&](const Vector3<double>& at) {
        const Vector3<double> w = off(at, a);
        return dot(cross(e, w), numbers.n) < -unit * (kInside.error * size_of(w) + 16 * kAbout);
      };
      passes = passes || (is_beyond(from) && is_beyond(to));
    }
    return stages_.sure(passes);
  }

  static bool have_common_vertex(const Face& a, const Face& b) noexcept {
    for (const std::uint32_t v : a.vertex)
      for (const std::uint32_t other : b.vertex)
        if (v == other) return true;
    return false;
  }

  DirectionKind kind_at(const FeatureKey& key, HalfEdge half, const ExactOffset& d) const noexcept {
    if (key.place == mesh::Place::triangle) {
      const int sign = dot(ExactFace(mesh_.face(face_of(half))).n, d).sign();
      return sign > 0 ? DirectionKind::front : sign < 0 ? DirectionKind::back : DirectionKind::on;
    }
    const auto near = [](const FixedInteger<95>& component) { return 0x1p-53 * component.approximately(); };
    const Vector3<double> rounded{near(d.x), near(d.y), near(d.z)};
    const Direction direction{rounded, size_of(rounded), nullptr, nullptr, false, &d};
    const Headings<Stages> headings(mesh_, direction, stages_);
    return key.place == mesh::Place::edge ? headings.kind_at_edge(half) : headings.at_vertex(mesh_.start(half)).kind;
  }
  static ExactOffset opposite(const ExactOffset& d) noexcept { return {-d.x, -d.y, -d.z}; }
  static ExactOffset offset(const GridPlace& from, const GridPlace& to) noexcept {
    return {to.x - from.x, to.y - from.y, to.z - from.z};
  }

  // True if a move in direction u may not go on at a point of the feature.
  bool is_blocked(const FeatureKey& key, HalfEdge half, const ExactOffset& u) const noexcept {
    const DirectionKind from = kind_at(key, half, opposite(u)), onward = kind_at(key, half, u);
    const bool leaves = mesh_.sides() == mesh::Sides::front && from == DirectionKind::back && onward == DirectionKind::front;
    return onward != DirectionKind::open && onward != from && !leaves;
  }

  // The meeting of a way between two points, which are good to kAbout, and a triangle, as far as binary64 decides it. Inwards
  // and outwards: through its inside, from its front or to it.
  enum class Meeting { none, inwards, outwards, unknown };
  // inside: a triangle that the way lies in, and so meets no triangle with which that has a vertex in common.
  Meeting meeting(const Face& face, const Vector3<double>& from, const Vector3<double>& to, const Face* inside) const noexcept {
    if (inside != nullptr && have_common_vertex(face, *inside)) return Meeting::none;
    const FaceNumbers numbers(face);
    const DoubleWithError at_start = side_about(face, numbers, from), at_end = side_about(face, numbers, to);
    const bool starts_before = at_start.value > at_start.error,
               starts_beyond = at_start.value<-at_start.error, ends_before = at_end.value> at_end.error,
               ends_beyond = at_end.value < -at_end.error;
    if (stages_.sure((starts_before && ends_before) || (starts_beyond && ends_beyond))) return Meeting::none;
    if (surely_passes_by(face, numbers, from, to)) return Meeting::none;
    const bool is_inwards = starts_before && ends_beyond;
    if (!stages_.sure(is_inwards || (starts_beyond && ends_before))) return Meeting::unknown;
    const Vector3<double> u = to - from;
    const double size_u = size_of(u);
    bool is_through = true, passes_by = false;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const auto &a = face.corner[i], &b = face.corner[after(i)];
      const Vector3<double> e = difference(b.data(), a.data()), w = off(from, a);
      const double size_w = size_of(w), passes = is_inwards ? -dot(cross(w, u), e) : dot(cross(w, u), e);
      const double error = size_of(e) * (kPasses.error * size_w * size_u + 8 * kAbout * (size_u + 2 * size_w + 2 * kAbout));
      is_through = is_through && passes > error;
      passes_by = passes_by || passes < -error;
    }
    if (stages_.sure(passes_by)) return Meeting::none;
    if (!stages_.sure(is_through)) return Meeting::unknown;
    return is_inwards ? Meeting::inwards : Meeting::outwards;
  }
  // True if a way may not go on where it meets a triangle in its inside.
  bool is_blocked(Meeting meeting) const noexcept { return meeting == Meeting::inwards || mesh_.sides() == mesh::Sides::both; }

  // True if nothing blocks the way to c, whose place is `to`.
  bool is_clear(const Place& from, const Place& to, const GridPoint& c, const Face* inside) const noexcept {
    const ExactOffset u = offset(from.exact, to.exact);
    if (is_zero(u)) return true;
    const GridSegment way(from.exact, to.exact, FixedInteger<25>(kGrid));
    bool clear = true;
    FeatureKey open{};  // the last one that the way meets and that does not block it: each triangle at a vertex meets that
    mesh_.tree().along(from.about, to.about, [&](std::uint32_t f) {
      if (!clear) return;
      const Face& face = mesh_.face(f);
      const Meeting met = meeting(face, from.about, to.about, inside);
      if (met == Meeting::none) return;
      if (met != Meeting::unknown) {
        clear = !is_blocked(met);
        return;
      }
      if (touches(mesh_, c, f)) {  // a way that begins off its plane meets it in c alone
        const DoubleWithError at_start = side_about(face, FaceNumbers(face), from.about);
        if (stages_.sure(__builtin_fabs(at_start.value) > at_start.error)) return;
      }
      stages_.note(Stage::wide);
      way.meet(face, [&](Hit::Part part, std::uint32_t corner, const auto&) {
        const FeatureKey key = key_at(mesh_, f, part, corner);
        if (!clear || key == open) return;
        clear = !is_blocked(key, 3 * f + corner, u);
        open = key;
      });
    });
    return clear && !other_at(to, key_of(mesh_, c), &mesh_.face(face_of(c.half)));
  }

  std::optional<Block> first_block(const Place& from, const Place& to, const FeatureKey& own,
                                   const Face* inside) const noexcept {
    const ExactOffset u = offset(from.exact, to.exact);
    if (is_zero(u)) return std::nullopt;
    std::optional<Block> first;
    FeatureKey open{};  // as in is_clear()
    const GridSegment way(from.exact, to.exact, FixedInteger<25>(kGrid));
    mesh_.tree().along(from.about, to.about, [&](std::uint32_t f) {
      const Face& face = mesh_.face(f);
      const Meeting met = meeting(face, from.about, to.about, inside);
      if (met == Meeting::none || (met != Meeting::unknown && !is_blocked(met))) return;
      const auto is_first = [&](const Block& found) {
        if (!first) return true;
        const int order = (found.s.num * first->s.den).compare(first->s.num * found.s.den);
        return order < 0 || (order == 0 && found.key < first->key);
      };
      stages_.note(Stage::wide);
      if (met != Meeting::unknown) {
        const Block found{way.through(face), 3 * f, key_of(mesh_, mesh::Place::triangle, 3 * f)};
        if (is_first(found)) first = found;
        return;
      }
      way.meet(face, [&](Hit::Part part, std::uint32_t corner, const auto& where) {
        const Block found{where(), 3 * f + corner, key_at(mesh_, f, part, corner)};
        if (found.key == open || !is_first(found)) return;
        if (is_blocked(found.key, found.half, u))
          first = found;
        else
          open = found.key;
      });
    });
    if (first) return first;
    return other_at(to, own, inside);
  }

  // The first feature at a point but its own.
  std::optional<Block> other_at(const Place& at, const FeatureKey& own, const Face* inside = nullptr) const noexcept {
    std::optional<Block> first;
    const GridSegment way(at.exact, at.exact, FixedInteger<25>(kGrid));
    mesh_.tree().along(at.about, at.about, [&](std::uint32_t f) {
      const Face& face = mesh_.face(f);
      if (meeting(face, at.about, at.about, inside) == Meeting::none) return;
      stages_.note(Stage::wide);
      std::uint32_t corner = 0;
      const Hit::Part part = way.start_in(face, corner);
      if (part == Hit::Part::none) return;
      using Number = decltype(GridSegment::Fraction::num);
      const Block found{{Number(1), Number(1)}, 3 * f + corner, key_at(mesh_, f, part, corner)};
      if (found.key != own && (!first || found.key < first->key)) first = found;
    });
    return first;
  }

  const Mesh& mesh_;
  const Stages& stages_;

 private:
  // mm: more than binary64 rounds a point's coordinates by.
  static constexpr double kAbout = 0x1p-35;
};

}  // namespace forceshade::fast
