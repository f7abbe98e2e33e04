// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Finds where a god-object goes, on a mesh whose sheets may cross each other, when its own way is blocked (docs/god-object.md,
// "Meshes that intersect themselves").

#include <array>
#include <cstdint>
#include <optional>

#include "fast/meshes/ways.h"

namespace forceshade::fast {

// The tries that a detour or a landing has left: points of the grid that it may consider, lines and sheets that it may look at.
class Tries {
 public:
  static constexpr int kMost = 256;  // of one detour or landing

  bool take() noexcept {
    if (left_ == 0) return false;
    --left_;
    return true;
  }
  bool are_left() const noexcept { return left_ > 0; }
  int taken() const noexcept { return kMost - left_; }

 private:
  int left_ = kMost;
};

// In one tick, towards p.
template <class Stages>
class Sheets : Ways<Stages> {
 public:
  using Block = typename Ways<Stages>::Block;
  using Ways<Stages>::block;

  Sheets(const Mesh& mesh, const float* p, const Stages& stages) noexcept : Ways<Stages>(mesh, stages), p_(p) {}

  // True if a flight from g that met the surface in `hit`, `left`/`all` of it being left there, may be rounded to c.
  bool is_apart(const Point& g, const Hit& hit, const FixedInteger<304>& left, const FixedInteger<304>& all,
                const GridPoint& c) const noexcept {
    const Place end = place_at(c);
    const Face& inside = mesh_.face(hit.face);  // the line from x to c lies in it
    if (other_at(end, key_of(mesh_, c), &inside)) return false;
    const GridPlace p = place_of(Point::at(p_));
    const ExactOffset U = exact_offset_from(g, p_);
    using Long = FixedInteger<400>;
    const auto over = [&](const FixedInteger<92>& at_p, const FixedInteger<95>& u) {
      return Long((at_p * all - u * left).words());
    };
    const Segment<400, 329> way({over(p.x, U.x), over(p.y, U.y), over(p.z, U.z)},
                                {end.exact.x * all, end.exact.y * all, end.exact.z * all}, all.template shifted<24>());
    // x is within a cell of the grid from c, or is p.
    const double reach = hit.part == Hit::Part::corner ? 0 : kCell * static_cast<double>(mesh_.largest_coordinate());
    const FeatureKey own = key_at(mesh_, hit.face, hit.part, hit.corner);
    bool is_alone = true;
    const Vector3<double> low{end.about.x - reach, end.about.y - reach, end.about.z - reach},
        high{end.about.x + reach, end.about.y + reach, end.about.z + reach};
    mesh_.tree().along(low, high, [&](std::uint32_t f) {
      const Face& face = mesh_.face(f);
      if (have_common_vertex(face, inside)) return;  // no more in common than with the feature that x or c lies in
      const FaceNumbers numbers(face);
      const DoubleWithError side = side_about(face, numbers, end.about);
      if (!is_alone || stages_.sure(__builtin_fabs(side.value) > side.error + 8 * reach * numbers.area)) return;
      stages_.note(Stage::wide);
      std::uint32_t corner = 0;
      const Hit::Part part = way.start_in(face, corner);
      if (part != Hit::Part::none && key_at(mesh_, f, part, corner) != own) is_alone = false;
      way.meet(face, [&](Hit::Part, std::uint32_t, const auto&) { is_alone = false; });
    });
    return is_alone;
  }

  // A grid point of the closed triangle `face`, by the weights of its second and third corner.
  struct Base {
    std::uint32_t face = 0, k = 0, l = 0;
  };
  struct Bases {
    std::array<Base, 8> all;
    std::size_t count = 0;
  };
  // Those at a hit whose parameters are `cells`, of the corners of hit.face. Where it lies in an edge, the parameter of its end
  // with the higher number is rounded down.
  Bases bases(const Hit& hit, const std::array<Cell, 3>& cells) const noexcept {
    Bases result;
    if (hit.part == Hit::Part::triangle) {
      result.all[result.count++] = {hit.face, cells[1].floor, cells[2].floor};
      return result;
    }
    const HalfEdge h = 3 * hit.face + hit.corner;
    GridPoint at{hit.part == Hit::Part::edge ? mesh::Place::edge : mesh::Place::vertex, mesh::Side::front, h, {}, {}};
    if (hit.part == Hit::Part::edge) {
      const Cell& cell = cells[after(hit.corner)];
      const bool is_upwards = mesh_.start(h) < mesh_.start(next(h));
      at.weight[0] = is_upwards || cell.is_whole ? cell.floor : cell.floor + 1;
    }
    const Triangles triangles = triangles_at(at.place, h);
    for (std::size_t i = 0; i < triangles.count; ++i) {
      const auto weights = weights_in(mesh_, at, triangles.all[i]);
      result.all[result.count++] = {triangles.all[i], weights[1], weights[2]};
    }
    return result;
  }

  // A point of the grid around these to which there is a clear way from g. from: g's grid point where it is on the surface;
  // then the point is nearer to p.
  std::optional<GridPoint> landing(const Point& g, const GridPoint* from, const Bases& bases, Tries& tries) const noexcept {
    struct Step {
      std::int64_t k, l;
    };
    constexpr std::array<Step, 4> kAround{{{0, 0}, {1, 0}, {0, 1}, {1, 1}}};
    constexpr std::array<Step, 6> kRing{{{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}}};
    constexpr int kRings = 8;
    const Place start{g, place_of(g), about(g)};
    for (int ring = 0; ring <= kRings; ++ring) {
      Nearest best;
      if (from != nullptr) best.limit = distance(g);
      best.has_limit = from != nullptr;
      const std::int64_t reach = ring == 0 ? 1 : std::int64_t{1} << (ring - 1);
      for (std::size_t b = 0; b < bases.count; ++b)
        for (std::size_t i = 0; i < (ring == 0 ? kAround.size() : kRing.size()); ++i) {
          const Step& step = ring == 0 ? kAround[i] : kRing[i];
          const std::int64_t k = bases.all[b].k + reach * step.k, l = bases.all[b].l + reach * step.l;
          if (k < 0 || l < 0 || k + l > kGrid || !tries.take()) continue;
          GridPoint c = grid_point_in_triangle(mesh_, bases.all[b].face, static_cast<std::uint32_t>(k),
                                               static_cast<std::uint32_t>(l), mesh::Side::front);
          const Distance off = distance(point_of(mesh_, c));
          if (!best.would_take(off) || !arrives(start, from, c)) continue;
          best.offer(c, off);
        }
      if (best.is_found) return best.grid_point;
    }
    return std::nullopt;
  }

  // The god-object's goal in place of e, in the closed triangle `carrier` as it is itself: a point nearer to p, or none.
  std::optional<GridPoint> detour(const GridPoint& from, const GridPoint& e, std::uint32_t carrier, const Block& block,
                                  Tries& tries) const noexcept {
    Nearest best;
    best.limit = distance(point_of(mesh_, from));
    best.has_limit = true;
    const Distance limit = best.limit;
    shorten(best, limit, from, e, carrier, block, tries);
    const Triangles here = triangles_at(from.place, from.half), there = triangles_at(block.key.place, block.half);
    for (std::size_t i = 0; i < here.count; ++i)
      for (std::size_t j = 0; j < there.count && tries.take(); ++j)
        go_beside(best, limit, from, here.all[i], there.all[j], tries);
    for (std::size_t j = 0; j < there.count && tries.take(); ++j) change_sheet(best, from, e, carrier, there.all[j], tries);
    if (!best.is_found) return std::nullopt;
    return best.grid_point;
  }

 private:
  using Place = typename Ways<Stages>::Place;
  using Ways<Stages>::mesh_, Ways<Stages>::stages_, Ways<Stages>::place_at, Ways<Stages>::about, Ways<Stages>::offset;
  using Ways<Stages>::opposite, Ways<Stages>::side_about, Ways<Stages>::have_common_vertex, Ways<Stages>::kind_at;
  using Ways<Stages>::is_clear, Ways<Stages>::other_at;

  static constexpr int kLeastSteps = 8;
  // A share of the largest coordinate that is longer than a cell of the grid, which is at most 2·√3·2^-24 of it.
  static constexpr double kCell = 0x1p-22;

  using Distance = FixedInteger<192>;  // squared, in units of 2^-154 mm²
  // The nearest of those that are offered; of equally near ones the first.
  struct Nearest {
    GridPoint grid_point{};
    Distance limit{};
    bool has_limit = false, is_found = false;
    bool would_take(const Distance& off) const noexcept { return !has_limit || off.compare(limit) < 0; }
    void offer(const GridPoint& c, const Distance& off) noexcept {
      if (!would_take(off)) return;
      grid_point = c;
      limit = off;
      has_limit = is_found = true;
    }
  };
  struct Triangles {
    std::array<std::uint32_t, 8> all;
    std::size_t count = 0;
  };

  Distance distance(const Point& point) const noexcept { return square(exact_offset_from(point, p_)); }

  // Those of a feature, by their index in the file, the first eight.
  Triangles triangles_at(mesh::Place place, HalfEdge h) const noexcept {
    Triangles found;
    const auto add = [&](std::uint32_t f) {
      std::size_t i = found.count < found.all.size() ? found.count++ : found.all.size();
      const auto index = [&](std::uint32_t of) { return mesh_.face(of).index(); };
      if (i == found.all.size() && index(found.all[--i]) < index(f)) return;
      for (; i > 0 && index(found.all[i - 1]) > index(f); --i) found.all[i] = found.all[i - 1];
      found.all[i] = f;
    };
    if (place == mesh::Place::triangle) {
      add(face_of(h));
    } else if (place == mesh::Place::edge) {
      add(face_of(h));
      if (mesh_.twin(h) != kRim) add(face_of(mesh_.twin(h)));
    } else {
      const HalfEdge first = mesh_.first_around(mesh_.start(h));
      HalfEdge around = first;
      do {
        add(face_of(around));
        around = mesh_.around(around);
      } while (around != kRim && around != first);
    }
    return found;
  }

  // True if a direct way from g to c is clear; sets c's side.
  bool arrives(const Place& g, const GridPoint* from, GridPoint& c) const noexcept {
    const Place end = place_at(c);
    const ExactOffset u = offset(g.exact, end.exact);
    if (is_zero(u)) return false;
    if (from != nullptr) {
      const DirectionKind blocked = from->side == mesh::Side::front ? DirectionKind::back : DirectionKind::front;
      if (kind_at(key_of(mesh_, *from), from->half, u) == blocked) return false;
    }
    const FeatureKey own = key_of(mesh_, c);
    const DirectionKind A = kind_at(own, c.half, opposite(u));
    const bool is_one_sided = mesh_.sides() == mesh::Sides::front;
    if (A == DirectionKind::on || (is_one_sided && A == DirectionKind::back) || !is_clear(g, end, c, nullptr)) return false;
    c.side = A == DirectionKind::back ? mesh::Side::back : mesh::Side::front;
    return true;
  }

  // The grid points beside a point of the closed triangle, up to four.
  template <class Visit>
  void around(std::uint32_t face, const Cell& k, const Cell& l, mesh::Side side, Tries& tries,
              const Visit& visit) const noexcept {
    for (std::uint32_t across = 0; across < 2; ++across)
      for (std::uint32_t up = 0; up < 2; ++up) {
        if ((up == 1 && k.is_whole) || (across == 1 && l.is_whole) || k.floor + up + l.floor + across > kGrid) continue;
        if (!tries.take()) return;
        visit(grid_point_in_triangle(mesh_, face, k.floor + up, l.floor + across, side));
      }
  }

  // The square of the least length of a way along or beside a sheet, in the units of Distance: kLeastSteps of the grid's
  // longest steps. Around a nearer place there often is a point that is a little nearer to p, and the god-object would creep
  // along the sheet from point to point.
  static FixedInteger<146> least_square(const Face& face) noexcept {
    FixedInteger<139> longest;  // of a side, in units of 2^-106 mm²: the grid's step is 2^-24 of it
    for (std::uint32_t i = 0; i < 3; ++i) {
      const FixedInteger<139> side = square(exact_difference(face.corner[after(i)].data(), face.corner[i].data()));
      if (longest.compare(side) < 0) longest = side;
    }
    return longest * FixedInteger<7>(std::int64_t{kLeastSteps} * kLeastSteps);
  }

  // Along the way to e, as far as it is clear about.
  void shorten(Nearest& best, const Distance& limit, const GridPoint& from, const GridPoint& e, std::uint32_t carrier,
               const Block& blocked, Tries& tries) const noexcept {
    const auto G = weights_in(mesh_, from, carrier), E = weights_in(mesh_, e, carrier);
    const std::uint32_t most =
        blocked.s.num.compare(blocked.s.den) == 0 ? kGrid : exact_cell(blocked.s.num, blocked.s.den).floor;
    const auto at = [&](std::uint32_t m, std::size_t i) {
      const std::int64_t sum = std::int64_t{G[i]} * kGrid + std::int64_t{m} * (std::int64_t{E[i]} - std::int64_t{G[i]});
      return Cell{static_cast<std::uint32_t>(sum / kGrid), sum % kGrid == 0};
    };
    const Face& face = mesh_.face(carrier);
    const auto least = least_square(face).template shifted<48>();
    const Place start = place_at(from);
    const Distance length = square(offset(start.exact, place_at(e).exact));
    std::array<Cell, 2> last{};
    for (std::uint32_t back = 0; back < most && tries.are_left(); back = back == 0 ? 1 : 2 * back) {
      const FixedInteger<25> m(static_cast<std::int64_t>(most - back));
      if ((m * m * length).compare(least) < 0) return;  // the length of the way to there, times 2^48
      const std::array<Cell, 2> cell{at(most - back, 1), at(most - back, 2)};
      if (back > 0 && cell == last) continue;  // the same points
      last = cell;
      Nearest of_these;
      of_these.limit = limit;
      of_these.has_limit = true;
      around(carrier, cell[0], cell[1], from.side, tries, [&](const GridPoint& c) {
        const Distance off = distance(point_of(mesh_, c));
        if (of_these.would_take(off) && is_clear(start, place_at(c), c, &face)) of_these.offer(c, off);
      });
      if (!of_these.is_found) continue;
      return best.offer(of_these.grid_point, of_these.limit);
    }
  }

  // In the triangle `along`, parallel to the plane of the triangle `beside`.
  void go_beside(Nearest& best, const Distance& limit, const GridPoint& from, std::uint32_t along, std::uint32_t beside,
                 Tries& tries) const noexcept {
    const ExactFace T(mesh_.face(along));
    const auto n = ExactFace(mesh_.face(beside)).n;
    using Step = FixedInteger<212>;
    std::array<Step, 3> d{Step{}, dot(n, T.e2), -dot(n, T.e1)};
    d[0] = Step((-d[1] - d[2]).words());
    const auto scaled = [](const auto& by, const auto& v) { return Vector3<decltype(by * v.x)>{by * v.x, by * v.y, by * v.z}; };
    const auto D = scaled(d[1], T.e1) - scaled(-d[2], T.e2);
    auto onward = dot(exact_offset_from(point_of(mesh_, from), p_), D);
    if (onward.is_zero()) return;
    if (onward.is_negative()) {
      onward = -onward;
      for (Step& one : d) one = -one;
    }
    const auto G = weights_in(mesh_, from, along);
    const auto whole = [](std::uint32_t weight) { return FixedInteger<26>(static_cast<std::int64_t>(weight)); };
    // The way's length times 2^24, as num/den.
    using Number = FixedInteger<600>;
    Number num = onward, den = dot(D, D);
    for (std::size_t i = 0; i < 3; ++i) {
      if (!d[i].is_negative()) continue;
      if ((whole(G[i]) * den).compare(num * -d[i]) >= 0) continue;
      num = whole(G[i]);
      den = -d[i];
    }
    if (num.is_zero()) return;
    const auto end = [&](std::size_t i) { return exact_cell(whole(G[i]) * den + num * d[i], den.template shifted<24>()); };
    struct Candidate {
      GridPoint grid_point;
      Distance off;
    };
    std::array<Candidate, 4> ends;
    std::size_t count = 0;
    const Place start = place_at(from);
    const auto least = least_square(mesh_.face(along));
    around(along, end(1), end(2), from.side, tries, [&](const GridPoint& c) {
      if (square(offset(start.exact, place_at(c).exact)).compare(least) < 0) return;
      const Distance off = distance(point_of(mesh_, c));
      std::size_t i = count++;
      for (; i > 0 && off.compare(ends[i - 1].off) < 0; --i) ends[i] = ends[i - 1];
      ends[i] = {c, off};
    });
    for (std::size_t i = 0; i < count && ends[i].off.compare(limit) < 0; ++i)
      if (is_clear(start, place_at(ends[i].grid_point), ends[i].grid_point, &mesh_.face(along)))
        return best.offer(ends[i].grid_point, ends[i].off);
    if (count == 0 || ends[0].off.compare(limit) >= 0) return;
    if (const auto blocked = block(from, ends[0].grid_point, along))
      shorten(best, limit, from, ends[0].grid_point, along, *blocked, tries);
  }

  // Onto the triangle `to`, where the way to e goes through its plane: if p is beyond that plane, and its foot there is not
  // beyond the plane of the triangle that the god-object slides in.
  void change_sheet(Nearest& best, const GridPoint& from, const GridPoint& e, std::uint32_t carrier, std::uint32_t to,
                    Tries& tries) const noexcept {
    const Face &here = mesh_.face(carrier), &there = mesh_.face(to);
    const auto n = ExactFace(there).n, own = ExactFace(here).n;
    const Place start = place_at(from), end = place_at(e);
    const ExactOffset u = offset(start.exact, end.exact);
    const int through = dot(n, u).sign();
    const auto beyond = dot(n, exact_difference(p_, there.corner[0].data()));
    if (through == 0 || through != beyond.sign()) return;
    const int foot = (dot(own, exact_difference(p_, here.corner[0].data())) * square(n) - beyond * dot(own, n)).sign();
    if (from.side == mesh::Side::front ? foot < 0 : foot > 0) return;
    const GridSegment way(start.exact, end.exact, FixedInteger<25>(kGrid));
    const auto first = way.opposite(there, 0, u), second = way.opposite(there, 1, u), third = way.opposite(there, 2, u);
    const auto all = first + second + third;
    const auto down = [&](const auto& weight) {
      return (all.is_negative() ? exact_cell(-weight, -all) : exact_cell(weight, all)).floor;
    };
    Bases base;
    base.all[base.count++] = {to, down(second), down(third)};
    const std::optional<GridPoint> found = landing(start.point, &from, base, tries);
    if (found) best.offer(*found, distance(point_of(mesh_, *found)));
  }

  const float* p_;
};

}  // namespace forceshade::fast
