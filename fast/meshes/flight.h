// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The straight way from the god-object's point to p: where it first meets the surface from a side on which it may not go on.

#include "fast/meshes/grid_point.h"
#include "fast/meshes/heading.h"

namespace forceshade::fast {

// A place where a flight meets the surface: inside a triangle, on its edge `corner`, or at its corner.
struct Hit {
  enum class Part { none, triangle, edge, corner } part = Part::none;
  std::uint32_t face = 0, corner = 0;
  bool is_flat = false;  // the flight lies in the triangle's plane
  mesh::Side side = mesh::Side::front;
  DoubleWithError remaining{};  // what is left of the flight there: 1 at g, 0 at p
};

template <class Stages>
class Flight {
 public:
  // `from` is the god-object's point g, U = 2^24(p - g) not 0.
  Flight(const Mesh& mesh, const GridPoint& from, const Point& g, const Offset& U, const float* p,
         const Stages& stages) noexcept
      : mesh_(mesh), from_(from), g_(g), U_(U), p_(p), stages_(stages) {}

  // Looks at every triangle that the flight may meet before it lands.
  void run() noexcept {
    const Vector3<double> start = about_start(), end = about_end();
    const Range x(start.x, end.x), y(start.y, end.y), z(start.z, end.z);
    double share = HUGE_VAL;  // of the flight, within which nothing is known to be in the way
    mesh_.tree().along(start, end, share, [&](std::uint32_t f) {
      // A leaf's box holds much that no box of its triangles does, where these are slivers of several directions.
      const auto& corner = mesh_.face(f).corner;
      if (x.is_beside(corner, 0) || y.is_beside(corner, 1) || z.is_beside(corner, 2)) return;
      ++looks_;
      if (touches(mesh_, from_, f)) return;
      meet(f);
      if (landing_.part != Hit::Part::none) share = 1 - landing_.remaining.value + landing_.remaining.error + 0x1p-24;
    });
  }

  // The ends, within 2^-36 mm.
  Vector3<double> about_start() const noexcept {
    const auto back = [&](float to, double by) { return static_cast<double>(to) - by * 0x1p-24; };
    return {back(p_[0], U_.U.x), back(p_[1], U_.U.y), back(p_[2], U_.U.z)};
  }
  Vector3<double> about_end() const noexcept {
    return {static_cast<double>(p_[0]), static_cast<double>(p_[1]), static_cast<double>(p_[2])};
  }

  // The number of triangles that it has looked at: no fewer than those that Looks counts.
  int looks() const noexcept { return looks_; }

  // The place where it lands before p; Part::none if nothing is in the way.
  const Hit& landing() const noexcept { return landing_; }
  // The ways that p leads from the landing, if that is a vertex.
  const Heading& onward() const noexcept { return onward_; }
  // p itself, where it lies on the surface.
  const Hit& end() const noexcept { return end_; }

  // The parameters of the landing's corners. On an edge, of its ends.
  std::array<Cell, 3> cells() const noexcept {
    std::array<Cell, 3> cells{};
    if (landing_.part == Hit::Part::edge) cells[after(landing_.corner)] = cell_on_edge();
    if (landing_.part != Hit::Part::triangle) return cells;
    stages_.note(Stage::wide);  // once a landing: it is not tried in binary64
    const ExactPassing passing(*this, landing_.face);
    for (std::size_t i = 0; i < 3; ++i) cells[i] = passing.cell(i);
    return cells;
  }
  // The part of the flight that is left at a hit, as num/den with den > 0.
  struct Fraction {
    FixedInteger<304> num, den;
  };
  Fraction left_at_landing() const noexcept { return remaining(landing_); }

  // The cell in which it lands on an edge: that of the edge's half in landing().face, as the weight of the half's end.
  Cell cell_on_edge() const noexcept {
    stages_.note(Stage::wide);
    const std::uint32_t i = landing_.corner, j = after(i);
    const Face& f = mesh_.face(landing_.face);
    if (!landing_.is_flat) return ExactPassing(*this, landing_.face).cell_between(i, j);
    const ExactOffset U = exact_offset_from(g_, p_);
    const auto n = ExactFace(f).n;
    const auto beside = [&](std::uint32_t corner) { return dot(cross(exact_difference(p_, f.corner[corner].data()), U), n); };
    const auto first = beside(i), second = beside(j);
    const auto all = first - second;
    return all.is_negative() ? exact_cell(-first, -all) : exact_cell(first, all);
  }

 private:
  // The flight along an axis, and 2^-34 mm more at each end: the ends are known within 2^-36 mm.
  struct Range {
    double low, high;
    Range(double start, double end) noexcept
        : low((start < end ? start : end) - 0x1p-34), high((start < end ? end : start) + 0x1p-34) {}
    bool is_beside(const std::array<std::array<float, 3>, 3>& corner, std::size_t axis) const noexcept {
      const auto a = static_cast<double>(corner[0][axis]), b = static_cast<double>(corner[1][axis]),
                 c = static_cast<double>(corner[2][axis]);
      return (a < low && b < low && c < low) || (a > high && b > high && c > high);
    }
  };
  // ((p - w)·x U)·e for each edge: n·U times the weight of the opposite corner where the line meets the plane.
  struct ExactPassing {
    std::array<FixedInteger<236>, 3> weight;  // of the corner, times the sign of n·U
    FixedInteger<238> all;

    ExactPassing(const Flight& flight, std::uint32_t f) noexcept {
      const Face& face = flight.mesh_.face(f);
      const ExactOffset U = exact_offset_from(flight.g_, flight.p_);
      for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t a = after(i), b = after(a);
        weight[i] = dot(cross(exact_difference(flight.p_, face.corner[a].data()), U),
                        exact_difference(face.corner[b].data(), face.corner[a].data()));
      }
      all = weight[0] + weight[1] + weight[2];
      if (!all.is_negative()) return;
      for (auto& one : weight) one = -one;
      all = -all;
    }
    Cell cell(std::size_t i) const noexcept { return exact_cell(weight[i], all); }
    Cell cell_between(std::size_t i, std::size_t j) const noexcept { return exact_cell(weight[j], weight[i] + weight[j]); }
  };

  void meet(std::uint32_t f) noexcept {
    const Face& face = mesh_.face(f);
    const FaceNumbers numbers(face);
    const Vector3<double> w = difference(p_, face.corner[0].data());
    const DoubleWithError at_p{dot(numbers.n, w), kAcross.error * numbers.area * size_of(w)};
    const DoubleWithError along{dot(numbers.n, U_.U), kAcross.error * numbers.area * U_.size};
    // With sides = front a flight goes on wherever it comes from behind all triangles of a feature. If one of them lies
    // otherwise, it meets that one there, too.
    if (mesh_.sides() == mesh::Sides::front &&
        stages_.sure(along.value > along.error && __builtin_fabs(at_p.value) > at_p.error))
      return;
    // A flight through a vertex meets each triangle there in nothing else, but for those it lies in the plane
    // of.
    if (passed_ != kNoVertex && has_vertex(face, passed_) && stages_.sure(__builtin_fabs(along.value) > along.error)) return;
    const int forward = sign_of(along, stages_, [&] { return dot(ExactFace(face).n, exact_offset_from(g_, p_)).sign(); });
    if (forward == 0) return meet_flat(f);
    const int beyond = forward * sign_of(at_p, stages_, [&] { return exact_side_of(face, p_); });
    if (beyond < 0) return;
    if (beyond == 0) return end_in(f);
    // g has to be before the plane: what is left of the flight there is less than all of it.
    const DoubleWithError left = DoubleWithError::exactly(0x1p24) * at_p;
    const int before_plane = forward * sign_of(along - left, stages_, [&] {
                               const ExactFace exact(face);
                               const auto at_end = dot(exact.n, exact_difference(p_, face.corner[0].data()));
                               return dot(exact.n, exact_offset_from(g_, p_)).compare(at_end.template shifted<24>());
                             });
    if (before_plane <= 0) return;
    std::array<int, 3> inside;  // of the edge opposite to a corner
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t a = after(i), b = after(a);
      const Vector3<double> to = difference(p_, face.corner[a].data()),
                            e = difference(face.corner[b].data(), face.corner[a].data());
      const DoubleWithError passes{dot(cross(to, U_.U), e), kPasses.error * size_of(to) * size_of(e) * U_.size};
      inside[i] = forward * sign_of(passes, stages_, [&] {
                    return dot(cross(exact_difference(p_, face.corner[a].data()), exact_offset_from(g_, p_)),
                               exact_difference(face.corner[b].data(), face.corner[a].data()))
                        .sign();
                  });
      if (inside[i] < 0) return;
    }
    Hit hit{Hit::Part::triangle, f, 0, false, forward < 0 ? mesh::Side::front : mesh::Side::back, left / along};
    for (std::uint32_t i = 0; i < 3; ++i) {
      if (inside[i] != 0) continue;
      const bool is_corner = inside[after(i)] == 0;
      if (is_corner || inside[before(i)] != 0) {
        hit.part = is_corner ? Hit::Part::corner : Hit::Part::edge;
        hit.corner = is_corner ? before(i) : after(i);
        break;
      }
    }
    offer(hit);
  }

  // The flight lies in the triangle's plane, or beside it: then it meets no more than the border.
  [[gnu::noinline]] void meet_flat(std::uint32_t f) noexcept {
    const Face& face = mesh_.face(f);
    if (exact_side_of(face, p_) != 0) return;
    end_in(f);
    const ExactOffset U = exact_offset_from(g_, p_);
    const auto n = ExactFace(face).n;
    std::array<int, 3> beside;
    for (std::size_t i = 0; i < 3; ++i) beside[i] = dot(cross(exact_difference(p_, face.corner[i].data()), U), n).sign();
    for (std::uint32_t i = 0; i < 3; ++i) {
      Hit hit{Hit::Part::none, f, i, true, mesh::Side::front, {0, HUGE_VAL}};
      if (beside[i] == 0) {
        hit.part = Hit::Part::corner;
      } else if (beside[i] * beside[after(i)] < 0) {
        hit.part = Hit::Part::edge;
      } else {
        continue;
      }
      const Fraction left = remaining(hit);
      if (left.num.sign() > 0 && left.num.compare(left.den) < 0) offer(hit);
    }
  }

  [[gnu::noinline]] Fraction remaining(const Hit& hit) const noexcept {
    const Face& face = mesh_.face(hit.face);
    const ExactOffset U = exact_offset_from(g_, p_);
    const auto positive = [](const auto& num, const auto& den) -> Fraction {
      const FixedInteger<304> up = num.template shifted<24>(), down = den;
      return down.is_negative() ? Fraction{-up, -down} : Fraction{up, down};
    };
    const auto w = [&](std::size_t i) { return exact_difference(p_, face.corner[i].data()); };
    if (!hit.is_flat) {
      const ExactFace exact(face);
      return positive(dot(exact.n, w(0)), dot(exact.n, U));
    }
    if (hit.part == Hit::Part::corner) return positive(dot(w(hit.corner), U), square(U));
    const auto e = exact_difference(face.corner[after(hit.corner)].data(), face.corner[hit.corner].data());
    const auto n = ExactFace(face).n;
    return positive(dot(cross(e, w(hit.corner)), n), dot(cross(e, U), n));
  }

  static bool has_vertex(const Face& f, std::uint32_t v) noexcept {
    return f.vertex[0] == v || f.vertex[1] == v || f.vertex[2] == v;
  }
  void pass(const Hit& hit) noexcept {
    if (hit.part == Hit::Part::corner) passed_ = mesh_.start(3 * hit.face + hit.corner);
  }

  // Keeps the hit if it comes before the one that is kept, and the flight may not go on there.
  void offer(Hit hit) noexcept {
    pass(hit);
    if (landing_.part != Hit::Part::none) {
      const int nearer = sign_of(hit.remaining - landing_.remaining, stages_, [&] {
        const Fraction a = remaining(hit), b = remaining(landing_);
        return (a.num * b.den).compare(b.num * a.den);
      });
      if (nearer <= 0) return;
    }
    if (is_blocked(hit)) landing_ = hit;
  }

  // If so, it sets the hit's side and the heading from there, too.
  bool is_blocked(Hit& hit) noexcept {
    const bool is_one_sided = mesh_.sides() == mesh::Sides::front;
    if (hit.part == Hit::Part::triangle) return !is_one_sided || hit.side == mesh::Side::front;
    const DirectionKind from = kind(hit, true);
    const Heading onward = heading(hit, false);
    if (onward.kind == DirectionKind::open || onward.kind == from ||
        (is_one_sided && from == DirectionKind::back && onward.kind == DirectionKind::front))
      return false;
    onward_ = onward;
    hit.side = !is_one_sided && from == DirectionKind::back ? mesh::Side::back : mesh::Side::front;
    return true;
  }

  // The side that the flight's direction leads to, or the one it comes from, at an edge or a corner.
  DirectionKind kind(const Hit& hit, bool is_opposite) const noexcept { return heading(hit, is_opposite).kind; }
  Heading heading(const Hit& hit, bool is_opposite) const noexcept {
    const Vector3<double> d = is_opposite ? Vector3<double>{-U_.U.x, -U_.U.y, -U_.U.z} : U_.U;
    const Direction direction{d, U_.size, &g_, p_, is_opposite};
    const Headings<Stages> headings(mesh_, direction, stages_);
    const HalfEdge h = 3 * hit.face + hit.corner;
    if (hit.part == Hit::Part::edge) return {headings.kind_at_edge(h), {}};
    return headings.at_vertex(mesh_.start(h));
  }

  // p, which lies in the triangle's plane, may lie in the triangle.
  void end_in(std::uint32_t f) noexcept {
    Hit hit = part_at(mesh_, f, p_, stages_);
    if (hit.part == Hit::Part::none) return;
    pass(hit);
    if (end_.part != Hit::Part::none) return;
    if (hit.part == Hit::Part::triangle) {
      hit.side = sign_of({dot(FaceNumbers(mesh_.face(f)).n, U_.U), HUGE_VAL}, stages_,
                         [&] { return dot(ExactFace(mesh_.face(f)).n, exact_offset_from(g_, p_)).sign(); }) > 0
                     ? mesh::Side::back
                     : mesh::Side::front;
    } else {
      hit.side = kind(hit, true) == DirectionKind::back ? mesh::Side::back : mesh::Side::front;
    }
    if (mesh_.sides() == mesh::Sides::front) hit.side = mesh::Side::front;
    end_ = hit;
  }

 public:
  // The part that p is in of a triangle in whose plane it lies, or none.
  static Hit part_at(const Mesh& mesh, std::uint32_t f, const float* p, const Stages& stages) noexcept {
    const Face& face = mesh.face(f);
    for (std::uint32_t i = 0; i < 3; ++i)
      if (is_same_point(face.corner[i].data(), p)) return {Hit::Part::corner, f, i, false, mesh::Side::front, {}};
    const Weights weights(FaceNumbers(face), difference(p, face.corner[0].data()));
    std::array<int, 3> inside;
    int zeros = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      inside[i] = sign_of(weights.corner[i], stages, [&] { return ExactWeights(face, p).corner[i].sign(); });
      if (inside[i] < 0) return {};
      zeros += inside[i] == 0;
    }
    Hit hit{Hit::Part::triangle, f, 0, false, mesh::Side::front, {}};
    for (std::uint32_t i = 0; i < 3 && zeros > 0; ++i) {
      if (zeros == 1 && inside[i] == 0) hit = {Hit::Part::edge, f, after(i), false, mesh::Side::front, {}};
      if (zeros == 2 && inside[i] > 0) hit = {Hit::Part::corner, f, i, false, mesh::Side::front, {}};
    }
    return hit;
  }

 private:
  const Mesh& mesh_;
  const GridPoint& from_;
  const Point& g_;
  const Offset& U_;
  const float* p_;
  const Stages& stages_;
  Hit landing_, end_;
  Heading onward_{};
  int looks_ = 0;
  static constexpr std::uint32_t kNoVertex = 0xFFFFFFFF;
  std::uint32_t passed_ = kNoVertex;  // the last vertex that the flight was found to go through or to end in
};

}  // namespace forceshade::fast
