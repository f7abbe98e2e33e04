// SPDX-License-Identifier: BSD-3-Clause
#include "reference/soups/star.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace forceshade::reference::soups {
namespace {

// The directions of a triangle at a point: where each of these sides of it is not negative.
struct Cone {
  const Triangle* triangle;
  std::vector<std::size_t> sides;  // that hold the point: none, one or two

  bool covers(const Vector& d) const {
    return std::ranges::all_of(sides, [&](std::size_t i) { return grows(i, d) >= 0; });
  }
  Rational grows(std::size_t side, const Vector& d) const { return dot(cross(triangle->side(side), d), triangle->normal); }
  std::vector<Vector> borders() const {
    if (sides.empty()) return {};
    const Vector first = triangle->side(sides[0]);
    if (sides.size() == 1) return {first, -first};
    // Sides i and j meet in a corner: one begins there, the other ends.
    const std::size_t i = sides[0], j = sides[1];
    return j == i + 1 ? std::vector{-first, triangle->side(j)} : std::vector{first, -triangle->side(j)};
  }
};

Cone cone_of(const Triangle& triangle, const Vector& x) {
  Cone cone{&triangle, {}};
  for (std::size_t i = 0; i < 3; ++i)
    if (triangle.inside(i, x).is_zero()) cone.sides.push_back(i);
  return cone;
}

// The place of a direction on the way around a normal from `base`: 0 for base itself, 1 and 3 for the two halves, 2 between.
int half(const Vector& normal, const Vector& base, const Vector& d) {
  const Rational turn = dot(cross(base, d), normal);
  return turn > 0 ? 1 : turn < 0 ? 3 : dot(base, d) > 0 ? 0 : 2;
}

// True if a comes before b on the way counterclockwise around the normal from base; all lie in its plane.
bool is_before(const Vector& normal, const Vector& base, const Vector& a, const Vector& b) {
  const int of_a = half(normal, base, a), of_b = half(normal, base, b);
  return of_a != of_b ? of_a < of_b : dot(cross(a, b), normal) > 0;
}

struct Joined {
  explicit Joined(std::size_t count) : parent(count) { std::iota(parent.begin(), parent.end(), std::size_t{0}); }
  std::size_t root(std::size_t i) const { return parent[i] == i ? i : root(parent[i]); }
  void join(std::size_t i, std::size_t j) { parent[root(i)] = root(j); }
  std::vector<std::size_t> parent;
};

}  // namespace

struct Star::Plane {
  Vector normal;
  std::vector<Cone> cones;

  bool covers(const Vector& d) const {
    return std::ranges::any_of(cones, [&](const Cone& cone) { return cone.covers(d); });
  }
};

Star::Star(const Soup& soup, const Vector& x) {
  std::vector<Plane> planes;
  triangles_ = soup.holding(x);
  for (const Triangle* triangle : triangles_) {
    auto plane = std::ranges::find_if(planes, [&](const Plane& each) { return are_parallel(each.normal, triangle->normal); });
    if (plane == planes.end()) plane = planes.insert(plane, Plane{triangle->normal, {}});
    plane->cones.push_back(cone_of(*triangle, x));
  }
  const auto add_ray = [&](const Vector& direction) {
    const Vector along =
        1 / std::max({Rational(abs(direction.x)), Rational(abs(direction.y)), Rational(abs(direction.z))}) * direction;
    if (std::ranges::none_of(rays_, [&](const Ray& ray) { return same_direction(ray.along, along); })) rays_.push_back({along});
  };
  for (const Plane& plane : planes)
    for (const Cone& cone : plane.cones)
      for (const Vector& border : cone.borders()) add_ray(border);
  for (std::size_t i = 0; i < planes.size(); ++i)
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      const Vector line = cross(planes[i].normal, planes[j].normal);
      for (const Vector& along : {line, -line})
        if (planes[i].covers(along) && planes[j].covers(along)) add_ray(along);
    }
  const bool is_line = rays_.size() == 2 && are_parallel(rays_[0].along, rays_[1].along);
  kind_ = rays_.empty() ? Kind::plane : is_line ? Kind::line : Kind::point;
  make_pieces(planes);
  make_cells();
}

void Star::make_pieces(const std::vector<Plane>& planes) {
  for (const Plane& plane : planes) {
    const Vector& n = plane.normal;
    std::vector<std::size_t> its;
    for (std::size_t i = 0; i < rays_.size(); ++i)
      if (dot(n, rays_[i].along).is_zero() && plane.covers(rays_[i].along)) its.push_back(i);
    const auto add = [&](Piece piece) {
      for (const Cone& cone : plane.cones)
        if (cone.covers(piece.middle)) piece.triangles.push_back(cone.triangle);
      if (!piece.triangles.empty()) pieces_.push_back(std::move(piece));
    };
    if (its.empty()) {
      add({n, {}, {}, plane.cones.front().triangle->side(0)});
      continue;
    }
    const Vector& base = rays_[its.front()].along;
    std::ranges::sort(its, [&](std::size_t i, std::size_t j) { return is_before(n, base, rays_[i].along, rays_[j].along); });
    for (std::size_t i = 0; i < its.size(); ++i) {
      const std::size_t from = its[i], to = its[(i + 1) % its.size()];
      const Vector &a = rays_[from].along, &b = rays_[to].along;
      const Rational turn = dot(cross(a, b), n);
      const Vector middle = from == to ? -a : turn > 0 ? a + b : turn < 0 ? -(a + b) : cross(n, a);
      add({n, from, to, middle});
    }
  }
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& piece = pieces_[i];
    if (!piece.from) continue;
    const Vector &a = rays_[*piece.from].along, &b = rays_[*piece.to].along;
    rays_[*piece.from].around.push_back({i, true, cross(piece.normal, a)});
    rays_[*piece.to].around.push_back({i, false, cross(b, piece.normal)});
  }
  for (Ray& ray : rays_) {
    const Vector base = ray.around.front().across;
    std::ranges::sort(ray.around,
                      [&](const Ray::Entry& a, const Ray::Entry& b) { return is_before(ray.along, base, a.across, b.across); });
  }
}

void Star::make_cells() {
  Joined parts(rays_.size() + pieces_.size()), regions(2 * pieces_.size());
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    const std::vector<Ray::Entry>& around = rays_[i].around;
    for (std::size_t j = 0; j < around.size(); ++j) {
      const Ray::Entry &one = around[j], &next = around[(j + 1) % around.size()];
      parts.join(i, rays_.size() + one.piece);
      // Counterclockwise of a piece that begins here is above it; clockwise of one that ends here, too.
      regions.join(index({one.piece, one.is_from}), index({next.piece, !next.is_from}));
    }
  }
  std::vector<std::size_t> roots;
  const auto part = [&](std::size_t node) {
    const std::size_t root = parts.root(node);
    const auto found = std::ranges::find(roots, root);
    if (found != roots.end()) return static_cast<std::size_t>(found - roots.begin());
    roots.push_back(root);
    return roots.size() - 1;
  };
  for (std::size_t i = 0; i < rays_.size(); ++i) part_of_ray_.push_back(part(i));
  for (std::size_t i = 0; i < pieces_.size(); ++i) part_of_piece_.push_back(part(rays_.size() + i));
  parts_ = roots.size();
  for (std::size_t i = 0; i < 2 * pieces_.size(); ++i) region_of_side_.push_back(regions.root(i));

  for (std::size_t i = 0; i < 2 * pieces_.size(); ++i) {
    std::vector<std::size_t> key;
    for (std::size_t j = 0; j < parts_; ++j)
      key.push_back(j == part_of_piece_[i / 2] ? region_of_side_[i] : *region(j, pieces_[i / 2].middle, {}));
    const auto found = std::ranges::find(keys_, key);
    cell_of_side_.push_back(static_cast<Cell>(found - keys_.begin()));
    if (found == keys_.end()) keys_.push_back(key);
  }
}

bool Star::is_inside(const Piece& piece, const Vector& d) const {
  if (is_zero(d)) return false;
  if (!piece.from) return true;
  const Vector &a = rays_[*piece.from].along, &b = rays_[*piece.to].along;
  if (same_direction(a, d) || same_direction(b, d)) return false;
  return *piece.from == *piece.to || is_before(piece.normal, a, d, b);
}

// The side of a piece that bounds the wedge around a ray in which `across` lies; nothing on a piece.
std::optional<Star::Side> Star::beside(std::size_t ray, const Vector& across) const {
  const auto& [along, around] = rays_[ray];
  const Vector t = soups::across(across, along);
  if (is_zero(t)) return {};
  const Vector& base = around.front().across;
  std::size_t before = 0;
  for (std::size_t i = 0; i < around.size(); ++i) {
    if (same_direction(around[i].across, t)) return {};
    if (i == 0 || is_before(along, base, around[i].across, t)) before = i;
  }
  return Side{around[before].piece, around[before].is_from};
}

// The region of a part in which d + εw lies.
std::optional<std::size_t> Star::region(std::size_t part, const Vector& d, const Vector& w) const {
  bool is_ray = false;  // what has the largest cosine to d, and its number
  std::size_t nearest = 0;
  std::optional<Rational> most;
  const auto offer = [&](const Rational& size, bool of_ray, std::size_t i) {
    if (!most || size > *most) most = size, is_ray = of_ray, nearest = i;
  };
  for (std::size_t i = 0; i < rays_.size(); ++i)
    if (part_of_ray_[i] == part) offer(signed_square_along(d, rays_[i].along), true, i);
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    if (part_of_piece_[i] != part) continue;
    const Vector projection = across(d, pieces_[i].normal);
    const bool is_whole = !pieces_[i].from;
    if (is_whole || is_inside(pieces_[i], projection)) offer(squared(projection), false, i);
  }
  if (is_ray) {
    const std::optional<Side> side = beside(nearest, are_parallel(d, rays_[nearest].along) ? w : d);
    return side ? std::optional(region_of_side_[index(*side)]) : std::nullopt;
  }
  const Vector& n = pieces_[nearest].normal;
  const Rational height = dot(n, d), side = height.is_zero() ? dot(n, w) : height;
  return side.is_zero() ? std::nullopt : std::optional(region_of_side_[index({nearest, side > 0})]);
}

std::optional<std::vector<std::size_t>> Star::key(const Vector& d, const Vector& w) const {
  std::vector<std::size_t> key;
  for (std::size_t j = 0; j < parts_; ++j) {
    const std::optional<std::size_t> found = region(j, d, w);
    if (!found) return {};
    key.push_back(*found);
  }
  return key;
}

std::optional<Star::Cell> Star::cell(const Vector& d, const Vector& w) const {
  const auto its = key(d, w);
  if (!its) return {};
  return static_cast<Cell>(std::ranges::find(keys_, *its) - keys_.begin());
}

bool Star::is_wall(const Side& side) const {
  return std::ranges::any_of(pieces_[side.piece].triangles,
                             [&](const Triangle* triangle) { return triangle->blocks_from(up(side)); });
}

std::set<Star::Cell> Star::reached(Cell from) const {
  std::set<Cell> all{from};
  for (std::vector<Cell> waiting{from}; !waiting.empty();) {
    const Cell cell = waiting.back();
    waiting.pop_back();
    for (const Side& side : sides(cell)) {
      if (is_wall(side)) continue;
      const Cell other = this->cell(Side{side.piece, !side.is_above});
      if (all.insert(other).second) waiting.push_back(other);
    }
  }
  return all;
}

std::vector<Star::Side> Star::walls(Cell from) const {
  const std::set<Cell> cells = reached(from);
  std::vector<Side> all;
  for (std::size_t i = 0; i < cell_of_side_.size(); ++i)
    if (const Side side = side_at(i); cells.contains(cell_of_side_[i]) && is_wall(side)) all.push_back(side);
  return all;
}

std::vector<Star::Side> Star::sides(Cell cell) const {
  std::vector<Side> all;
  for (std::size_t i = 0; i < cell_of_side_.size(); ++i)
    if (cell_of_side_[i] == cell) all.push_back(side_at(i));
  return all;
}

// The number of a piece among those of a triangle, by the angle of its middle around the normal from the first side.
std::size_t Star::number_in(const Triangle& triangle, std::size_t piece) const {
  return static_cast<std::size_t>(std::ranges::count_if(pieces_, [&](const Piece& its) {
    return &its != &pieces_[piece] && std::ranges::count(its.triangles, &triangle) > 0 &&
           is_before(triangle.normal, triangle.side(0), its.middle, pieces_[piece].middle);
  }));
}

std::size_t Star::looks() const {
  std::size_t count = 0;
  for (const Piece& piece : pieces_) count += piece.triangles.size();
  return count;
}

Star::Name Star::name(const Side& side) const {
  std::optional<Name> least;
  for (const Triangle* triangle : pieces_[side.piece].triangles) {
    const bool is_behind = dot(triangle->normal, up(side)) < 0;
    const Name its{triangle->number, is_behind, number_in(*triangle, side.piece)};
    if (!least || its < *least) least = its;
  }
  return *least;
}

Star::Name Star::name(Cell cell) const {
  std::optional<Name> least;
  for (const Side& side : sides(cell)) {
    const Name its = name(side);
    if (!least || its < *least) least = its;
  }
  return *least;
}

std::optional<Star::Cell> Star::cell(const Name& name) const {
  const auto& [number, is_behind, piece] = name;
  for (std::size_t i = 0; i < cell_of_side_.size(); ++i) {
    const Side side = side_at(i);
    for (const Triangle* triangle : pieces_[side.piece].triangles)
      if (triangle->number == number && (dot(triangle->normal, up(side)) < 0) == is_behind &&
          number_in(*triangle, side.piece) == piece)
        return cell_of_side_[i];
  }
  return {};
}

Star::Cell Star::least_cell() const {
  Cell least = 0;
  for (Cell cell = 1; cell < keys_.size(); ++cell)
    if (name(cell) < name(least)) least = cell;
  return least;
}

const Triangle& Star::blocking(const Side& side) const {
  const auto& all = pieces_[side.piece].triangles;
  return **std::ranges::find_if(all, [&](const Triangle* triangle) { return triangle->blocks_from(up(side)); });
}

Star::Wedge Star::wedge(std::size_t ray, const Side& side) const {
  const auto& [along, around] = rays_[ray];
  // Above a piece that begins here is counterclockwise of it.
  const auto is_counterclockwise = [&](const Ray::Entry& entry) { return entry.is_from == side.is_above; };
  const bool is_whole = pieces_[side.piece].from == pieces_[side.piece].to;
  const auto at = std::ranges::find_if(
      around, [&](const Ray::Entry& entry) { return entry.piece == side.piece && (!is_whole || is_counterclockwise(entry)); });
  const std::size_t i = static_cast<std::size_t>(at - around.begin());
  const bool turns_left = is_counterclockwise(*at);
  const Ray::Entry& next = around[(i + (turns_left ? 1 : around.size() - 1)) % around.size()];
  const Vector w = up(side);
  const bool is_wide = around.size() == 1 || is_before(turns_left ? along : -along, at->across, w, next.across);
  return {is_wide ? w : at->across + next.across, {next.piece, next.is_from != turns_left}};
}

}  // namespace forceshade::reference::soups
