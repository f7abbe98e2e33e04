// SPDX-License-Identifier: BSD-3-Clause
// The cells of a star by directions and by names.

#include <algorithm>
#include <numeric>
#include <utility>

#include "fast/soups/star.h"

namespace forceshade::fast::soups {
namespace {

template <class N>
N squared_sine(const Vector3<N>& d, const Vector3<N>& n) noexcept {
  return squared(cross(d, n));
}

int sign_of_turn(const Direction& a, const Direction& b, const NormalOf& n) noexcept {
  return sign_of([&]<class N>() { return determinant(a.get<N>(), b.get<N>(), n.get<N>()); });
}
int sign_along(const Direction& a, const Direction& b) noexcept {
  return sign_of([&]<class N>() { return dot(a.get<N>(), b.get<N>()); });
}

}  // namespace

void Star::make_cells() {
  const auto sides = static_cast<std::uint32_t>(2 * pieces_.size());
  keys_.clear();
  cell_of_side_.clear();
  is_wall_.clear();
  cells_ = 0;
  reached_from_ = kNone;
  order_.assign(sides, kNone);  // the cells of regions, if there is one part
  for (std::uint32_t i = 0; i < sides; ++i) {
    const Piece& piece = pieces_[i / 2];
    if (i % 2 == 0) {
      key_.clear();
      for (std::uint32_t part = 0; part < parts_; ++part)
        key_.push_back(part == piece.part ? kNone : region(part, piece.middle, nullptr));
    }
    key_[piece.part] = region_of_side_[i];
    Cell cell = 0;
    if (parts_ == 1) {
      cell = std::min(order_[region_of_side_[i]], cells_);
      order_[region_of_side_[i]] = cell;
    } else {
      while (cell < cells_ && !is_key(cell)) ++cell;
    }
    if (cell == cells_) {
      keys_.insert(keys_.end(), key_.begin(), key_.end());
      ++cells_;
    }
    cell_of_side_.push_back(cell);
    const Side side = side_at(i);
    is_wall_.push_back(std::ranges::any_of(triangles_of(piece), [&](std::uint32_t t) { return blocks(triangles_[t], side); }));
  }
  first_of_cell_.assign(cells_ + 1, 0);
  for (const Cell cell : cell_of_side_) ++first_of_cell_[cell + 1];
  std::partial_sum(first_of_cell_.begin(), first_of_cell_.end(), first_of_cell_.begin());
  sides_by_cell_.resize(sides);
  for (std::uint32_t i = sides; i-- > 0;) sides_by_cell_[--first_of_cell_[cell_of_side_[i] + 1]] = i;
  first_of_cell_.erase(first_of_cell_.begin());
  first_of_cell_.push_back(sides);
}

void Star::find_reached(Cell from) const {
  reached_from_ = from;
  reached_.assign(cells_, 0);
  reached_[from] = 1;
  waiting_.assign(1, from);
  while (!waiting_.empty()) {
    const Cell cell = waiting_.back();
    waiting_.pop_back();
    for_sides(cell, [&](const Side& side) {
      if (is_wall(side)) return;
      const Cell other = this->cell(Side{side.piece, !side.is_above});
      if (std::exchange(reached_[other], 1) == 0) waiting_.push_back(other);
    });
  }
}

bool Star::blocks(const Held& held, const Side& side) const noexcept {
  return soup_->blocks_along(*held.face) || held.is_flipped != side.is_above;
}

const Star::Held& Star::blocking(const Side& side) const noexcept {
  for (const std::uint32_t t : triangles_of(pieces_[side.piece]))
    if (blocks(triangles_[t], side)) return triangles_[t];
  return triangles_[piece_triangles_[pieces_[side.piece].first]];  // no wall has none
}

std::uint32_t Star::known_ray(const Direction& d) const noexcept {
  if (d.kind != Direction::Kind::line) return kNone;
  const Line line = d.as_line();
  for (std::uint32_t i = 0; i < rays_.size(); ++i)
    if (rays_[i].along.line.is_known_as(line)) return i;
  return kNone;
}

bool Star::is_inside(const Piece& piece, const Direction& d, std::uint32_t known) const {
  const NormalOf& n = planes_[piece.plane].normal;
  if (piece.is_whole()) return true;
  const Direction &a = rays_[piece.from].along, &b = rays_[piece.to].along;
  if (known == piece.from || known == piece.to) return false;
  const int turn = sign_of_turn(a, d, n);
  int half = turn > 0 ? 1 : 3;
  if (turn == 0) {
    const int along = sign_along(a, d);
    if (along >= 0) return false;
    half = 2;
  }
  if (piece.half == 0) return true;
  if (half != piece.half) return half < piece.half;
  return half != 2 && sign_of_turn(d, b, n) > 0;
}

// The region of the wedge around a ray that holds a direction across it; kNone on a piece, or where there is none.
std::uint32_t Star::region_at_ray(std::uint32_t ray, const Direction* across) const {
  if (across == nullptr) return kNone;
  const std::span<const Entry> around = std::span(entries_).subspan(rays_[ray].first, rays_[ray].count);
  const Direction& along = rays_[ray].along;
  const auto turn = [&](const Entry& entry) { return entry.sign() * this->across(entry.plane, *across); };
  // The same within the plane of an entry.
  const auto is_along = [&](const Entry& entry) {
    return entry.sign() * sign_of([&]<class N>() {
             return determinant(planes_[entry.plane].normal.get<N>(), along.get<N>(), across->get<N>());
           });
  };
  int half = 0;
  std::size_t before = 0;
  for (std::size_t i = 0; i < around.size(); ++i) {
    const int its = turn(around[i]);
    if (its == 0) {
      const int side = is_along(around[i]);
      if (side >= 0) return kNone;  // it lies in this piece, or along the ray
      if (i == 0) half = 2;
    } else if (i == 0) {
      half = its > 0 ? 1 : 3;
    }
    if (i == 0 || around[i].half < half || (around[i].half == half && half != 2 && its > 0)) before = i;
  }
  return region_of_side_[index({around[before].piece, around[before].is_from})];
}

// The region of a part in which d + εw lies; kNone on the surface.
std::uint32_t Star::region(std::uint32_t part, const Direction& d, const Direction* w) const {
  const auto beside_piece = [&](std::uint32_t piece) {
    int side = across(pieces_[piece].plane, d);
    if (side == 0) side = w == nullptr ? 0 : across(pieces_[piece].plane, *w);
    return side == 0 ? kNone : region_of_side_[index({piece, side > 0})];
  };
  if (rays_.empty()) return beside_piece(0);
  const std::uint32_t known = known_ray(d);
  if (known != kNone && rays_[known].part == part) return region_at_ray(known, w);
  if (d.in_plane != nullptr)
    if (const Held* const its = held(*d.in_plane); its != nullptr)
      for (std::uint32_t i = planes_[its->plane].first_piece, n = 0; n < planes_[its->plane].pieces; ++i, ++n)
        if (pieces_[i].part == part && is_inside(pieces_[i], d, known)) return beside_piece(i);
  // The largest cosine to d, by its signed square times d²: of a ray r, s|s|/r² with s = d·r; of a piece, |d x n|²/n².
  bool is_ray = false, has_any = false;
  std::uint32_t nearest = 0;
  const auto cosine = [&]<class N>(bool of_ray, std::uint32_t i) -> Quotient<N> {
    if (of_ray) {
      const Vector3<N> r = rays_[i].along.get<N>();
      const N s = dot(d.get<N>(), r);
      return {s * size_of(s), squared(r)};
    }
    const Vector3<N> n = planes_[pieces_[i].plane].normal.get<N>();
    return {squared_sine(d.get<N>(), n), squared(n)};
  };
  Ball most;
  const auto offer = [&](bool of_ray, std::uint32_t i) {
    const Quotient<Ball> its = cosine.template operator()<Ball>(of_ray, i);
    const Ball about = its.num / its.den;
    if (has_any) {
      const Ball more = about - most;
      int sign = more.value > 0 ? 1 : -1;
      if (!more.is_sure()) {
        note_exact_decision();
        const Quotient<Whole> one = cosine.template operator()<Whole>(of_ray, i),
                              best = cosine.template operator()<Whole>(is_ray, nearest);
        sign = (one.num * best.den - best.num * one.den).sign();
      }
      if (sign <= 0) return;
    }
    has_any = true;
    most = about;
    is_ray = of_ray;
    nearest = i;
  };
  const Part& its = part_[part];
  for (const std::uint32_t i : std::span(rays_by_part_).subspan(its.first_ray, its.rays)) offer(true, i);
  for (const std::uint32_t i : std::span(pieces_by_part_).subspan(its.first_piece, its.pieces))
    if (is_inside(pieces_[i], d, known)) offer(false, i);
  if (!is_ray) return beside_piece(nearest);
  // Only w is across a ray along d.
  const std::span<const Entry> around = std::span(entries_).subspan(rays_[nearest].first, rays_[nearest].count);
  const bool is_along =
      std::ranges::all_of(around, [&](const Entry& entry) { return across(entry.plane, d) == 0; }) &&
      sign_of([&]<class N>() {
        return determinant(planes_[around.front().plane].normal.get<N>(), rays_[nearest].along.get<N>(), d.get<N>());
      }) == 0;
  return region_at_ray(nearest, is_along ? w : &d);
}

bool Star::is_key(Cell cell) const {
  return std::equal(key_.begin(), key_.end(), keys_.begin() + static_cast<std::ptrdiff_t>(std::size_t{cell} * parts_));
}

std::optional<Star::Cell> Star::cell(const Direction& d, const Direction* w) const {
  key_.clear();
  for (std::uint32_t part = 0; part < parts_; ++part) {
    const std::uint32_t its = region(part, d, w);
    if (its == kNone) return {};
    key_.push_back(its);
  }
  for (Cell cell = 0; cell < cells_; ++cell)
    if (is_key(cell)) return cell;
  return {};
}

// True if the middle of piece a comes before that of b on the way around the triangle's normal from its first side.
bool Star::is_before_in(const Held& held, std::uint32_t a, std::uint32_t b) const {
  const NormalOf n(*held.face);
  const Direction base = Direction::along(Line::of_side(*held.face, 0, 1));
  const auto half = [&](const Direction& d) {
    const int turn = sign_of_turn(base, d, n);
    return turn > 0 ? 1 : turn < 0 ? 3 : sign_along(base, d) > 0 ? 0 : 2;
  };
  const Direction &one = pieces_[a].middle, &other = pieces_[b].middle;
  const int of_one = half(one), of_other = half(other);
  return of_one != of_other ? of_one < of_other : sign_of_turn(one, other, n) > 0;
}

std::uint32_t Star::number_in(std::uint32_t triangle, std::uint32_t piece) const {
  std::uint32_t number = 0;
  const Plane& plane = planes_[pieces_[piece].plane];
  for (std::uint32_t i = plane.first_piece; i < plane.first_piece + plane.pieces; ++i)
    if (i != piece && std::ranges::binary_search(triangles_of(pieces_[i]), triangle) &&
        is_before_in(triangles_[triangle], i, piece))
      ++number;
  return number;
}

Star::Name Star::name(const Side& side) const {
  // Triangles are in order, and one is seen from one side of itself here.
  const std::uint32_t first = triangles_of(pieces_[side.piece]).front();
  const Held& held = triangles_[first];
  return {held.face->index(), held.is_flipped == side.is_above, number_in(first, side.piece)};
}

Star::Name Star::name(Cell cell) const {
  std::optional<Name> least;
  for_sides(cell, [&](const Side& side) {
    const std::uint32_t first = triangles_of(pieces_[side.piece]).front();
    if (least && triangles_[first].face->index() > least->triangle) return;
    const Name its = name(side);
    if (!least || its < *least) least = its;
  });
  return *least;
}

std::optional<Star::Cell> Star::cell(const Name& name) const {
  for (std::uint32_t i = 0; i < cell_of_side_.size(); ++i) {
    const Side side = side_at(i);
    for (const std::uint32_t t : triangles_of(pieces_[side.piece]))
      if (triangles_[t].face->index() == name.triangle && (triangles_[t].is_flipped == side.is_above) == name.is_behind &&
          number_in(t, side.piece) == name.piece)
        return cell_of_side_[i];
  }
  return {};
}

Star::Cell Star::least_cell() const {
  Cell least = 0;
  for (Cell cell = 1; cell < cells_; ++cell)
    if (name(cell) < name(least)) least = cell;
  return least;
}

Star::Wedge Star::wedge(std::uint32_t ray, const Side& side) const {
  const Direction& along = rays_[ray].along;
  const std::span<const Entry> around = std::span(entries_).subspan(rays_[ray].first, rays_[ray].count);
  const bool is_full = pieces_[side.piece].from == pieces_[side.piece].to;
  const auto at = std::ranges::find_if(
      around, [&](const Entry& entry) { return entry.piece == side.piece && (!is_full || entry.is_from == side.is_above); });
  const auto i = static_cast<std::size_t>(at - around.begin());
  // Above a piece that begins here is counter-clockwise of it.
  const bool turns_left = at->is_from == side.is_above;
  const Entry& next = around[(i + (turns_left ? 1 : around.size() - 1)) % around.size()];
  const Side beyond{next.piece, next.is_from != turns_left};
  const NormalOf &f = planes_[at->plane].normal, &h = planes_[next.plane].normal;
  // The wedge is wide where the side's own direction comes first: up is at a right angle to the piece.
  bool is_wide = at->plane == next.plane;
  if (!is_wide) {
    const int turn = (turns_left ? 1 : -1) * at->sign() * next.sign() *
                     sign_of([&]<class N>() { return determinant(f.get<N>(), h.get<N>(), along.get<N>()); });
    is_wide = turn < 0 || -side.sign() * next.sign() * (turns_left ? 1 : -1) * sign_of([&]<class N>() {
                return dot(f.get<N>(), h.get<N>());
              }) > 0;
  }
  if (is_wide) return {up(side), beyond};
  return {Direction::wedge(*f.face, at->sign(), *h.face, next.sign(), along.as_line()), beyond};
}

}  // namespace forceshade::fast::soups
