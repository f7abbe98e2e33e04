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

// True if the triangle holds x; then `sides` has a bit for each that does.
bool holds(const Face& f, const Point& x, unsigned& sides) noexcept {
  sides = 0;
  if (x.vertex != kNone)
    for (std::size_t i = 0; i < 3; ++i)
      if (f.vertex[i] == x.vertex) {
        sides = 1U << i | 1U << (i == 0 ? 2 : i - 1);
        return true;
      }
  const Vector3<Ball>& at = x.get<Ball>().x;
  const auto is_beyond = [](const Ball& c, float one, float two, float three) {
    const double low = static_cast<double>(std::min({one, two, three})),
                 high = static_cast<double>(std::max({one, two, three}));
    return c.value + c.error < low || c.value - c.error > high;
  };
  if (is_beyond(at.x, f.corner[0][0], f.corner[1][0], f.corner[2][0]) ||
      is_beyond(at.y, f.corner[0][1], f.corner[1][1], f.corner[2][1]) ||
      is_beyond(at.z, f.corner[0][2], f.corner[1][2], f.corner[2][2]))
    return false;
  bool is_known = std::ranges::find(x.faces, &f) != x.faces.end();
  std::size_t known_side = 3;
  if (x.edge[0] != kNone)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = f.vertex[i], b = f.vertex[i == 2 ? 0 : i + 1];
      if ((a == x.edge[0] && b == x.edge[1]) || (a == x.edge[1] && b == x.edge[0])) known_side = i;
    }
  is_known = is_known || known_side < 3;
  const Corners<Ball> c = corners<Ball>(f);
  const Vector3<Ball> n = c.normal();
  if (!is_known && dot(n, at - c[0]).is_sure()) return false;
  std::array<Ball, 3> about;
  for (std::size_t i = 0; i < 3; ++i) {
    if (i == known_side) continue;
    about[i] = dot(cross(c.side(i), at - c[i]), n);
    if (about[i].is_sure() && about[i].value < 0) return false;
  }
  if (!is_known && side_of_plane(f, x) != 0) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const int sign = i == known_side ? 0 : about[i].is_sure() ? 1 : sign_inside(f, i, x);
    if (sign < 0) return false;
    if (sign == 0) sides |= 1U << i;
  }
  return true;
}

std::uint32_t root(const std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i];
  return i;
}

}  // namespace

void Star::reserve(std::size_t planes) {
  const std::size_t rays = planes * planes;
  triangles_.reserve(4 * planes);
  planes_.reserve(planes);
  rays_.reserve(rays);
  in_plane_.reserve(rays * planes);
  pieces_.reserve(2 * rays);
  piece_triangles_.reserve(4 * rays);
  entries_.reserve(4 * rays);
  for (auto* const each : {&region_of_side_, &cell_of_side_, &order_, &parent_, &key_}) each->reserve(8 * rays);
  keys_.reserve(8 * rays);
  is_wall_.reserve(4 * rays);
  reached_.reserve(16 * rays);
}

void Star::make(const Soup& soup, const Point& x, std::span<const Face* const> near) {
  soup_ = &soup;
  find_triangles(x, near);
  find_rays();
  make_pieces();
  order_around_rays();
  join();
  make_cells();
  find_reached();
}

void Star::find_triangles(const Point& x, std::span<const Face* const> near) {
  triangles_.clear();
  planes_.clear();
  is_rough_ = false;
  for (const Face* const face : near)
    if (unsigned sides = 0; holds(*face, x, sides)) triangles_.push_back({face, sides, 0, false});
  std::ranges::sort(triangles_, {}, [](const Held& held) { return held.face->index(); });
  const auto is_same = [](const Held& a, const Held& b) { return a.face == b.face; };
  triangles_.erase(std::unique(triangles_.begin(), triangles_.end(), is_same), triangles_.end());
  for (Held& held : triangles_) {
    is_rough_ = is_rough_ || soup_->static_friction(*held.face) > 0;
    held.plane = 0;
    const NormalOf n(*held.face);
    while (held.plane < planes_.size() && !are_parallel(planes_[held.plane], n)) ++held.plane;
    if (held.plane == planes_.size()) planes_.push_back(n);
    held.is_flipped = held.face != planes_[held.plane].face && sign_of_dot(planes_[held.plane], n) < 0;
  }
}

const Star::Held* Star::held(const Face& f) const noexcept {
  const auto found = std::ranges::find(triangles_, &f, &Held::face);
  return found == triangles_.end() ? nullptr : &*found;
}

// d: in the triangle's plane.
bool Star::covers(const Held& held, const Direction& d) const {
  for (std::size_t i = 0; i < 3; ++i)
    if (held.has_side(i) && !(d.kind == Direction::Kind::line && d.line.is_side(*held.face, i)) && grows(*held.face, i, d) < 0)
      return false;
  return true;
}
bool Star::covers(std::uint32_t plane, const Direction& d) const {
  return std::ranges::any_of(triangles_, [&](const Held& held) { return held.plane == plane && covers(held, d); });
}

bool Star::are_opposite(std::uint32_t i, std::uint32_t j) const noexcept {
  return rays_[i].along.line.is_known_as(rays_[j].along.line.reversed());
}

// A ray along the line, if there is none, in this plane and its cones.
std::uint32_t Star::add_ray(const Line& line, std::uint32_t plane) {
  std::uint32_t i = 0;
  for (; i < rays_.size(); ++i)
    if (rays_[i].along.line.is_known_as(line)) break;
  if (i == rays_.size()) {
    const Direction along = Direction::along(line);
    for (i = 0; i < rays_.size(); ++i) {
      const Direction& other = rays_[i].along;
      if (other.line.is_known_as(line.reversed())) continue;
      if (sign_of_dot(other, along) > 0 && are_parallel(other, along)) break;
    }
    if (i == rays_.size()) {
      rays_.push_back({along});
      in_plane_.resize(in_plane_.size() + planes_.size(), 0);
    }
  }
  in_plane_[i * planes_.size() + plane] = 1;
  return i;
}

void Star::add_border(const Face& f, std::size_t i, int sign, std::uint32_t plane) {
  const Line line = Line::of_side(f, i, sign);
  Ray& ray = rays_[add_ray(line, plane)];
  const std::array<std::uint32_t, 2> names{std::min(line.names[0], line.names[1]), std::max(line.names[0], line.names[1])};
  if (!ray.is_edge() || names < ray.edge) ray.edge = names;
}

void Star::add_borders(const Held& held) {
  const Face& f = *held.face;
  switch (held.sides) {
    case 0: return;
    case 1:
    case 2:
    case 4: {
      const std::size_t i = held.sides == 1 ? 0 : held.sides == 2 ? 1 : 2;
      add_border(f, i, 1, held.plane);
      add_border(f, i, -1, held.plane);
      return;
    }
    // In a corner one side begins and the other ends.
    case 3:
      add_border(f, 0, -1, held.plane);
      add_border(f, 1, 1, held.plane);
      return;
    case 6:
      add_border(f, 1, -1, held.plane);
      add_border(f, 2, 1, held.plane);
      return;
    default: add_border(f, 0, 1, held.plane); add_border(f, 2, -1, held.plane);
  }
}

void Star::find_rays() {
  rays_.clear();
  in_plane_.clear();
  for (std::uint32_t plane = 0; plane < planes_.size(); ++plane)
    for (const Held& held : triangles_)
      if (held.plane == plane) add_borders(held);
  for (std::uint32_t i = 0; i < planes_.size(); ++i)
    for (std::uint32_t j = i + 1; j < planes_.size(); ++j) {
      std::uint32_t shared = 0;
      while (shared < rays_.size() && !(is_in(shared, i) && is_in(shared, j))) ++shared;
      const auto offer = [&](const Line& line) {
        const Direction along = Direction::along(line);
        if (!covers(i, along) || !covers(j, along)) return;
        const std::uint32_t ray = add_ray(line, i);
        in_plane_[ray * planes_.size() + j] = 1;
      };
      if (shared == rays_.size()) {
        offer(Line::of_planes(*planes_[i].face, *planes_[j].face, 1));
        offer(Line::of_planes(*planes_[i].face, *planes_[j].face, -1));
        continue;
      }
      bool is_other_known = false;
      for (std::uint32_t other = shared + 1; other < rays_.size(); ++other)
        is_other_known = is_other_known || (is_in(other, i) && is_in(other, j));
      if (!is_other_known) offer(rays_[shared].along.line.reversed());
    }
  for (std::uint32_t i = 0; i < rays_.size(); ++i)
    for (std::uint32_t plane = 0; plane < planes_.size(); ++plane)
      if (!is_in(i, plane) && across(plane, rays_[i].along) == 0 && covers(plane, rays_[i].along))
        in_plane_[i * planes_.size() + plane] = 1;
  kind_ = rays_.empty()                                                                               ? Kind::plane
          : rays_.size() == 2 && (are_opposite(0, 1) || are_parallel(rays_[0].along, rays_[1].along)) ? Kind::line
                                                                                                      : Kind::point;
}

int Star::across(std::uint32_t plane, const Direction& d) const {
  const NormalOf& n = planes_[plane];
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
  return sign_of_determinant(rays_[i].along, rays_[j].along, planes_[plane]);
}
int Star::half_turn(std::uint32_t plane, std::uint32_t i, std::uint32_t j) const {
  if (i == j) return 0;
  const int its = turn(plane, i, j);
  return its > 0 ? 1 : its < 0 ? 3 : 2;  // rays differ
}

void Star::add_piece(std::uint32_t plane, std::uint32_t from, std::uint32_t to) {
  Piece piece{.plane = plane, .from = from, .to = to, .half = 0, .middle = {}};
  if (from == kNone) {
    piece.middle = Direction::along(Line::of_side(*planes_[plane].face, 0, 1));
  } else {
    const Line &a = rays_[from].along.line, &b = rays_[to].along.line;
    piece.half = half_turn(plane, from, to);
    piece.middle = piece.half == 0   ? -rays_[from].along
                   : piece.half == 2 ? Direction::across(*planes_[plane].face, a)
                                     : Direction::sum_of(a, b, piece.half == 1 ? 1 : -1);
  }
  piece.middle.in_plane = planes_[plane].face;
  piece.first = static_cast<std::uint32_t>(piece_triangles_.size());
  for (std::uint32_t i = 0; i < triangles_.size(); ++i)
    if (triangles_[i].plane == plane && covers(triangles_[i], piece.middle)) piece_triangles_.push_back(i);
  piece.count = static_cast<std::uint32_t>(piece_triangles_.size()) - piece.first;
  if (piece.count > 0) pieces_.push_back(piece);
}

void Star::make_pieces() {
  pieces_.clear();
  piece_triangles_.clear();
  for (std::uint32_t plane = 0; plane < planes_.size(); ++plane) {
    order_.clear();
    for (std::uint32_t i = 0; i < rays_.size(); ++i)
      if (is_in(i, plane)) order_.push_back(i);
    if (order_.empty()) {
      add_piece(plane, kNone, kNone);
      continue;
    }
    const std::uint32_t base = order_.front();
    std::sort(order_.begin(), order_.end(), [&](std::uint32_t i, std::uint32_t j) {
      const int of_i = half_turn(plane, base, i), of_j = half_turn(plane, base, j);
      return of_i != of_j ? of_i < of_j : turn(plane, i, j) > 0;
    });
    for (std::size_t i = 0; i < order_.size(); ++i) add_piece(plane, order_[i], order_[i + 1 == order_.size() ? 0 : i + 1]);
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
      return a.sign() * b.sign() * sign_of_determinant(planes_[a.plane], planes_[b.plane], ray.along);
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

// Finds the parts, and the regions of a part's sides.
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
  order_.clear();
  const auto part = [&](std::uint32_t node) {
    const std::uint32_t its = root(parent_, node);
    const auto found = std::ranges::find(order_, its);
    if (found != order_.end()) return static_cast<std::uint32_t>(found - order_.begin());
    order_.push_back(its);
    return static_cast<std::uint32_t>(order_.size() - 1);
  };
  for (std::uint32_t i = 0; i < rays; ++i) rays_[i].part = part(i);
  for (std::uint32_t i = 0; i < pieces; ++i) pieces_[i].part = part(rays + i);
  parts_ = static_cast<std::uint32_t>(order_.size());
  region_of_side_.resize(2 * pieces_.size());
  for (std::uint32_t i = 0; i < 2 * pieces; ++i) region_of_side_[i] = root(parent_, static_cast<std::uint32_t>(first_side) + i);
}

}  // namespace forceshade::fast::soups
