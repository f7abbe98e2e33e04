// SPDX-License-Identifier: BSD-3-Clause
#include "fast/soups/star.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace forceshade::fast::soups {
namespace {

template <class A, class B, class C>
int sign_of_determinant(const A& a, const B& b, const C& c) noexcept {
  return sign_of([&]<class N>() { return determinant(a.template get<N>(), b.template get<N>(), c.template get<N>()); });
}
// The sign of how the distance from side i grows along d.
int grows(const Face& f, std::size_t i, const Direction& d) noexcept {
  return sign_of([&]<class N>() { return dot(cross(side_of_face<N>(f, i), d.get<N>()), normal<N>(f)); });
}

std::uint32_t root(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

}  // namespace

void Star::reserve(std::size_t looks) {
  const std::size_t rays = 2 * looks, sides = 2 * looks, nodes = rays + 3 * looks;
  triangles_.reserve(looks);
  planes_.reserve(looks);
  by_plane_.reserve(looks);
  normals_.reserve(looks);
  rays_.reserve(rays);
  directions_.reserve(rays);
  in_planes_.reserve(rays);
  plane_of_ray_.reserve(rays);
  pieces_.reserve(looks);
  piece_triangles_.reserve(looks);
  entries_.reserve(rays);
  part_.reserve(looks);
  for (auto* const each : {&order_, &parent_}) each->reserve(nodes);
  for (auto* const each : {&place_in_order_, &count_, &rays_by_part_}) each->reserve(rays);
  for (auto* const each : {&pieces_by_part_, &key_}) each->reserve(looks);
  for (auto* const each : {&region_of_side_, &cell_of_side_, &sides_by_cell_, &first_of_cell_, &keys_, &waiting_})
    each->reserve(sides + 2);
  is_wall_.reserve(sides);
  reached_.reserve(sides);
}

void Star::make(const Soup& soup, std::span<const Held> held) {
  soup_ = &soup;
  triangles_.assign(held.begin(), held.end());
  looks_ = held.size();
  if (is_too_large()) return;
  looks_ = 0;
  find_planes();
  find_rays();
  if (!is_too_large()) make_pieces();
  if (is_too_large()) return;
  order_around_rays();
  join();
  find_parts();
  make_cells();
}

// d: in the triangle's plane.
bool Star::covers(const Held& held, const Direction& d) const {
  for (std::size_t i = 0; i < 3; ++i)
    if (held.has_side(i) && !(d.kind == Direction::Kind::line && d.line.is_side(*held.face, i)) && grows(*held.face, i, d) < 0)
      return false;
  return true;
}
bool Star::covers(std::uint32_t plane, const Direction& d) const {
  return std::ranges::any_of(triangles_in(plane), [&](std::uint32_t i) { return covers(triangles_[i], d); });
}

bool Star::are_opposite(std::uint32_t i, std::uint32_t j) const noexcept {
  return rays_[i].along.line.is_known_as(rays_[j].along.line.reversed());
}

bool Star::is_in(std::uint32_t ray, std::uint32_t plane) const noexcept {
  for (std::uint32_t i = planes_[plane].last_ray; i != kNone; i = in_planes_[i].before)
    if (in_planes_[i].ray == ray) return true;
  return false;
}

// The ray along the line, which is added where the star lacks it.
std::uint32_t Star::add_ray(const Line& line) {
  const Direction along = Direction::along(line);
  const auto next = static_cast<std::uint32_t>(rays_.size());
  const std::uint32_t ray = directions_.find(along.about, next, [&](std::uint32_t i) {
    const Direction& other = rays_[i].along;
    if (other.line.is_known_as(line)) return true;
    if (other.line.is_known_as(line.reversed())) return false;
    return sign_of_dot(other, along) > 0 && are_parallel(other, along);
  });
  if (ray != next) return ray;
  directions_.add(along.about, next);
  rays_.push_back({along});
  plane_of_ray_.push_back(kNone);
  return next;
}

std::uint32_t Star::add_border(const Held& held, std::size_t i, int sign) {
  const Line line = Line::of_side(*held.face, i, sign);
  const std::uint32_t number = add_ray(line);
  if (std::exchange(plane_of_ray_[number], held.plane) != held.plane) put(number, held.plane);
  Ray& ray = rays_[number];
  const std::array<std::uint32_t, 2> names{std::min(line.names[0], line.names[1]), std::max(line.names[0], line.names[1])};
  if (!ray.is_edge() || names < ray.edge) ray.edge = names;
  return number;
}

// A side leads counter-clockwise around its triangle. In a corner one ends and the next begins.
void Star::add_borders(Held& held) {
  if (held.sides == 0) return;
  const std::size_t ends = held.sides == 1 || held.sides == 3 ? 0 : held.sides == 2 || held.sides == 6 ? 1 : 2;
  const bool is_corner = held.sides == 3 || held.sides == 5 || held.sides == 6;
  held.from = add_border(held, is_corner && ends == 2 ? 0 : ends + (is_corner ? 1 : 0), 1);
  held.to = add_border(held, ends, -1);
  if (held.is_flipped) std::swap(held.from, held.to);
}

void Star::find_rays() {
  rays_.clear();
  directions_.clear();
  in_planes_.clear();
  plane_of_ray_.clear();
  const auto planes = static_cast<std::uint32_t>(planes_.size());
  for (std::uint32_t plane = 0; plane < planes; ++plane)
    for (const std::uint32_t i : triangles_in(plane)) add_borders(triangles_[i]);
  for (std::uint32_t i = 0; i < planes; ++i) {
    for_rays_in(i, [&](std::uint32_t ray) { plane_of_ray_[ray] = i; });
    ray_of_first_ = kNone;
    for (std::uint32_t j = i + 1; j < planes; ++j)
      if (planes_[i].may_meet(planes_[j])) find_rays_of(i, j);
    // A piece has two ends at most.
    if (in_planes_.size() > 2 * kMostLooks) {
      looks_ = kMostLooks + 1;
      return;
    }
  }
  kind_ = rays_.empty()                                                                               ? Kind::plane
          : rays_.size() == 2 && (are_opposite(0, 1) || are_parallel(rays_[0].along, rays_[1].along)) ? Kind::line
                                                                                                      : Kind::point;
}

// Puts the rays of two planes in both. Those of plane i have it as their last one.
void Star::find_rays_of(std::uint32_t i, std::uint32_t j) {
  std::uint32_t shared = kNone;
  bool is_other_known = false;
  for_rays_in(j, [&](std::uint32_t ray) {
    if (plane_of_ray_[ray] == i) is_other_known = std::exchange(shared, ray) != kNone;
  });
  const auto offer = [&](const Line& line) {
    const Direction along = Direction::along(line);
    if (!covers(i, along) || !covers(j, along)) return;
    const std::uint32_t ray = add_ray(line);
    if (std::exchange(plane_of_ray_[ray], i) != i) put(ray, i);
    if (!is_in(ray, j)) put(ray, j);
  };
  if (shared == kNone) {
    offer(Line::of_planes(*planes_[i].normal.face, *planes_[j].normal.face, 1));
    offer(Line::of_planes(*planes_[i].normal.face, *planes_[j].normal.face, -1));
    return;
  }
  if (is_other_known) return;
  const Line other = rays_[shared].along.line.reversed();
  if (std::exchange(ray_of_first_, shared) != shared) is_opposite_in_first_ = covers(i, Direction::along(other));
  if (is_opposite_in_first_) offer(other);
}

int Star::across(std::uint32_t plane, const Direction& d) const {
  const NormalOf& n = planes_[plane].normal;
  const Face& f = *n.face;
  if (d.in_plane != nullptr)
    if (const Held* its = held(*d.in_plane); its != nullptr && its->plane == plane) return 0;
  if (d.kind == Direction::Kind::line && d.line.is_known_in_plane(f)) return 0;
  if (d.kind == Direction::Kind::normal && d.f == &f) return d.sign;
  return sign_of_dot(n, d);
}

// The sign of the turn around the plane's normal from ray i to ray j.
int Star::turn(std::uint32_t plane, std::uint32_t i, std::uint32_t j) const {
  if (i == j || are_opposite(i, j)) return 0;
  return sign_of_determinant(rays_[i].along, rays_[j].along, planes_[plane].normal);
}
int Star::half_turn(std::uint32_t plane, std::uint32_t i, std::uint32_t j) const {
  if (i == j) return 0;
  const int its = turn(plane, i, j);
  return its > 0 ? 1 : its < 0 ? 3 : 2;  // rays differ
}

// Its triangles follow.
void Star::add_piece(std::uint32_t plane, std::uint32_t from, std::uint32_t to) {
  Piece piece{.plane = plane, .from = from, .to = to, .half = 0, .middle = {}};
  if (from == kNone) {
    piece.middle = Direction::along(Line::of_side(*planes_[plane].normal.face, 0, 1));
  } else {
    const Line &a = rays_[from].along.line, &b = rays_[to].along.line;
    piece.half = half_turn(plane, from, to);
    piece.middle = piece.half == 0   ? -rays_[from].along
                   : piece.half == 2 ? Direction::across(*planes_[plane].normal.face, a)
                                     : Direction::sum_of(a, b, piece.half == 1 ? 1 : -1);
  }
  piece.middle.in_plane = planes_[plane].normal.face;
  pieces_.push_back(piece);
}

// The rays of the plane are order_, counter-clockwise. A triangle is in the pieces from one ray of its cone to the other.
void Star::add_pieces(std::uint32_t plane) {
  const auto gaps = static_cast<std::uint32_t>(std::max(order_.size(), std::size_t{1}));
  const auto place_of = [&](std::uint32_t ray) { return ray == kNone ? 0 : place_in_order_[ray]; };
  const auto for_gaps = [&](const Held& held, const auto& visit) {
    std::uint32_t gap = place_of(held.from);
    do {
      visit(gap);
      gap = gap + 1 == gaps ? 0 : gap + 1;
    } while (gap != place_of(held.to));
  };
  for (std::uint32_t i = 0; i < order_.size(); ++i) place_in_order_[order_[i]] = i;
  count_.assign(gaps, 0);
  for (const std::uint32_t i : triangles_in(plane)) {
    if (is_too_large()) return;
    for_gaps(triangles_[i], [&](std::uint32_t gap) {
      ++count_[gap];
      ++looks_;
    });
  }
  auto first = static_cast<std::uint32_t>(piece_triangles_.size());
  piece_triangles_.resize(looks_);
  for (std::uint32_t gap = 0; gap < gaps; ++gap) {
    if (count_[gap] == 0) continue;
    if (order_.empty())
      add_piece(plane, kNone, kNone);
    else
      add_piece(plane, order_[gap], order_[gap + 1 == gaps ? 0 : gap + 1]);
    pieces_.back().first = first;
    pieces_.back().count = count_[gap];
    first += std::exchange(count_[gap], first);
  }
  for (const std::uint32_t i : triangles_in(plane))
    for_gaps(triangles_[i], [&](std::uint32_t gap) { piece_triangles_[count_[gap]++] = i; });
}

void Star::make_pieces() {
  pieces_.clear();
  piece_triangles_.clear();
  place_in_order_.resize(rays_.size());
  for (std::uint32_t plane = 0; plane < planes_.size() && !is_too_large(); ++plane) {
    planes_[plane].first_piece = static_cast<std::uint32_t>(pieces_.size());
    order_.clear();
    for_rays_in(plane, [&](std::uint32_t ray) { order_.push_back(ray); });
    if (!order_.empty()) {
      std::ranges::sort(order_);
      const std::uint32_t base = order_.front();
      std::sort(order_.begin(), order_.end(), [&](std::uint32_t i, std::uint32_t j) {
        const int of_i = half_turn(plane, base, i), of_j = half_turn(plane, base, j);
        return of_i != of_j ? of_i < of_j : turn(plane, i, j) > 0;
      });
    }
    add_pieces(plane);
    planes_[plane].pieces = static_cast<std::uint32_t>(pieces_.size()) - planes_[plane].first_piece;
  }
}

void Star::order_around_rays() {
  for (Ray& ray : rays_) ray.first = ray.count = 0;
  for (const Piece& piece : pieces_)
    if (!piece.is_whole()) ++rays_[piece.from].count, ++rays_[piece.to].count;
  std::uint32_t total = 0;
  for (Ray& ray : rays_) {
    ray.first = total;
    total += std::exchange(ray.count, 0);
  }
  entries_.resize(total);
  for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
    const Piece& piece = pieces_[i];
    if (piece.is_whole()) continue;
    Ray &from = rays_[piece.from], &to = rays_[piece.to];
    entries_[from.first + from.count++] = {i, piece.plane, true, 0};
    entries_[to.first + to.count++] = {i, piece.plane, false, 0};
  }
  for (const Ray& ray : rays_) {
    const auto around = std::span(entries_).subspan(ray.first, ray.count);
    if (around.empty()) continue;
    // The sign of the turn around the ray from one entry to another: (a x r) x (b x r) is along r as a x b is.
    const auto turn_from = [&](const Entry& a, const Entry& b) {
      if (a.plane == b.plane) return 0;
      return a.sign() * b.sign() * sign_of_determinant(planes_[a.plane].normal, planes_[b.plane].normal, ray.along);
    };
    const Entry base = around.front();
    for (Entry& entry : around) {
      const int its = turn_from(base, entry);
      entry.half = its > 0 ? 1 : its < 0 ? 3 : entry.is_from == base.is_from ? 0 : 2;
    }
    std::sort(around.begin(), around.end(),
              [&](const Entry& a, const Entry& b) { return a.half != b.half ? a.half < b.half : turn_from(a, b) > 0; });
  }
}

// Finds which rays and pieces hang together, and the regions of a part's sides.
void Star::join() {
  const auto rays = static_cast<std::uint32_t>(rays_.size()), pieces = static_cast<std::uint32_t>(pieces_.size());
  parent_.resize(rays + 3 * pieces);  // rays and pieces; then sides
  std::iota(parent_.begin(), parent_.end(), 0U);
  const auto connect = [&](std::size_t i, std::size_t j) {
    parent_[root(parent_, static_cast<std::uint32_t>(i))] = root(parent_, static_cast<std::uint32_t>(j));
  };
  const std::size_t first_side = rays + pieces;
  for (std::uint32_t i = 0; i < rays; ++i) {
    const auto around = std::span(entries_).subspan(rays_[i].first, rays_[i].count);
    for (std::size_t j = 0; j < around.size(); ++j) {
      const Entry &one = around[j], &next = around[j + 1 == around.size() ? 0 : j + 1];
      connect(i, rays + one.piece);
      // Counter-clockwise of a piece that begins here is above it; clockwise of one that ends here, too.
      connect(first_side + index({one.piece, one.is_from}), first_side + index({next.piece, !next.is_from}));
    }
  }
  region_of_side_.resize(2 * pieces_.size());
  for (std::uint32_t i = 0; i < 2 * pieces; ++i)
    region_of_side_[i] = root(parent_, static_cast<std::uint32_t>(first_side) + i) - static_cast<std::uint32_t>(first_side);
}

void Star::find_parts() {
  const auto rays = static_cast<std::uint32_t>(rays_.size()), pieces = static_cast<std::uint32_t>(pieces_.size());
  order_.assign(rays + pieces, kNone);  // the parts of roots
  part_.clear();
  const auto part = [&](std::uint32_t node) {
    std::uint32_t& its = order_[root(parent_, node)];
    if (its == kNone) {
      its = static_cast<std::uint32_t>(part_.size());
      part_.push_back({});
    }
    return its;
  };
  for (std::uint32_t i = 0; i < rays; ++i) ++part_[rays_[i].part = part(i)].rays;
  for (std::uint32_t i = 0; i < pieces; ++i) ++part_[pieces_[i].part = part(rays + i)].pieces;
  parts_ = static_cast<std::uint32_t>(part_.size());
  std::uint32_t first_ray = 0, first_piece = 0;
  for (Part& each : part_) {
    each.first_ray = first_ray;
    each.first_piece = first_piece;
    first_ray += std::exchange(each.rays, 0);
    first_piece += std::exchange(each.pieces, 0);
  }
  rays_by_part_.resize(rays);
  pieces_by_part_.resize(pieces);
  for (std::uint32_t i = 0; i < rays; ++i) {
    Part& its = part_[rays_[i].part];
    rays_by_part_[its.first_ray + its.rays++] = i;
  }
  for (std::uint32_t i = 0; i < pieces; ++i) {
    Part& its = part_[pieces_[i].part];
    pieces_by_part_[its.first_piece + its.pieces++] = i;
  }
}

}  // namespace forceshade::fast::soups
