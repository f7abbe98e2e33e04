// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The triangles around a point of the surface: their directions, and the cells between them (docs/soups.md).

#include <array>
#include <compare>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "fast/soups/direction.h"
#include "fast/soups/parallels.h"
#include "fast/soups/soup.h"

namespace forceshade::fast::soups {

// Numbers of rays, pieces and planes; the vectors keep their memory when a star is made again.
class Star {
 public:
  enum class Kind { point, line, plane };

  // A triangle that holds the point.
  struct Held {
    const Face* face;
    unsigned sides;  // a bit for each that holds the point
    std::uint32_t plane;
    bool is_flipped;                         // its normal is opposite to that of its plane
    std::uint32_t from = kNone, to = kNone;  // the rays of its cone, counter-clockwise; a whole plane has none

    bool has_side(std::size_t i) const noexcept { return (sides >> i & 1U) != 0; }
  };
  // A piece that begins or ends at a ray. Its direction across the ray is n x ray where it begins, else its opposite.
  struct Entry {
    std::uint32_t piece, plane;
    bool is_from;
    int half;  // its angle from the first one: 0; below, at and beyond half a turn: 1, 2, 3

    int sign() const noexcept { return is_from ? 1 : -1; }
  };
  // A direction in which the cone of a triangle ends, or in which two of different planes meet.
  struct Ray {
    Direction along;
    std::uint32_t first = 0, count = 0, part = 0;     // entries, counter-clockwise, seen against the ray
    std::array<std::uint32_t, 2> edge{kNone, kNone};  // the least pair of vertices of an edge along it, the lower first

    bool is_edge() const noexcept { return edge[0] != kNone; }  // the line is that of an edge from here
  };
  // Directions of one plane, counter-clockwise around its normal from one ray to another.
  struct Piece {
    std::uint32_t plane;
    std::uint32_t from = kNone, to = kNone;        // a whole plane has none
    int half = 0;                                  // from the one to the other, as in an entry; 0: all around
    Direction middle;                              // inside it
    std::uint32_t first = 0, count = 0, part = 0;  // of piece_triangles_, in order

    bool is_whole() const noexcept { return from == kNone; }
  };
  struct Side {
    std::uint32_t piece;
    bool is_above;  // seen from where the plane's normal points

    auto operator<=>(const Side&) const = default;
    int sign() const noexcept { return is_above ? 1 : -1; }
  };
  using Cell = std::uint32_t;
  // The name of a side or a cell: a triangle, whether it is seen from behind, and the number of its piece.
  struct Name {
    std::uint32_t triangle = 0;
    bool is_behind = false;
    std::uint32_t piece = 0;
    auto operator<=>(const Name&) const = default;
  };

  // More of them are not looked at in one move (docs/soups.md, "A tick").
  static constexpr std::size_t kMostLooks = std::size_t{1} << 14;

  // Takes memory for a point of so many looks, where not too many parts of its triangles are apart from each other.
  void reserve(std::size_t looks);
  // held: of find_held().
  void make(const Soup& soup, std::span<const Held> held);
  bool is_of(std::span<const Held> held) const noexcept;

  // The triangles of all pieces. If they are more than kMostLooks, the star is not made.
  std::size_t looks() const noexcept { return looks_; }
  bool is_empty() const noexcept { return triangles_.empty(); }
  Kind kind() const noexcept { return kind_; }
  std::span<const Ray> rays() const noexcept { return rays_; }
  std::span<const Piece> pieces() const noexcept { return pieces_; }
  std::span<const Held> triangles() const noexcept { return triangles_; }  // in order
  const Held* held(const Face& f) const noexcept;
  const NormalOf& plane(std::uint32_t plane) const noexcept { return planes_[plane].normal; }
  bool is_rough() const noexcept { return is_rough_; }

  // The cell of d + εw for every small ε > 0; nothing where that lies on the surface.
  std::optional<Cell> cell(const Direction& d, const Direction* w = nullptr) const;
  Cell cell(const Side& side) const noexcept { return cell_of_side_[index(side)]; }
  std::optional<Cell> cell(const Name& name) const;
  bool is_wall(const Side& side) const noexcept { return is_wall_[index(side)]; }
  bool is_reached(Cell from, Cell to) const {
    if (reached_from_ != from) find_reached(from);
    return reached_[to] != 0;
  }
  // Calls visit(side) for the walls beside cells that are reached.
  template <class Visit>
  void for_walls(Cell from, const Visit& visit) const {
    for (std::uint32_t i = 0; i < cell_of_side_.size(); ++i)
      if (is_wall_[i] && is_reached(from, cell_of_side_[i])) visit(side_at(i));
  }
  template <class Visit>
  void for_sides(Cell cell, const Visit& visit) const {
    for (std::uint32_t i = first_of_cell_[cell]; i < first_of_cell_[cell + 1]; ++i) visit(side_at(sides_by_cell_[i]));
  }
  bool is_one_part() const noexcept { return parts_ == 1; }
  bool covers(const Held& held, const Direction& d) const;  // d: in its plane
  bool is_in(std::uint32_t ray, std::uint32_t plane) const noexcept;

  Name name(const Side& side) const;
  Name name(Cell cell) const;
  Cell least_cell() const;

  std::span<const std::uint32_t> triangles_of(const Piece& piece) const noexcept {
    return {piece_triangles_.data() + piece.first, piece.count};
  }
  bool blocks(const Held& held, const Side& side) const noexcept;
  // The lowest triangle of the piece that blocks on this side.
  const Held& blocking(const Side& side) const noexcept;
  Direction up(const Side& side) const noexcept {
    return Direction::normal_of(*planes_[pieces_[side.piece].plane].normal.face, side.sign());
  }
  // The wedge around a ray that lies at this side of a piece. A piece that begins and ends at the ray has two: it is the one
  // that follows the piece counter-clockwise.
  struct Wedge {
    Direction inner;  // in it
    Side next;        // beyond it
  };
  Wedge wedge(std::uint32_t ray, const Side& side) const;
  // True for a direction whose projection onto the plane is in this piece and not at its ends. One without a projection is in
  // no piece with ends.
  bool is_inside(const Piece& piece, const Direction& d) const { return is_inside(piece, d, known_ray(d)); }
  // The sign of n·d.
  int across(std::uint32_t plane, const Direction& d) const;
  // The ray that d is known to be along, or kNone.
  std::uint32_t known_ray(const Direction& d) const noexcept;

 private:
  struct Plane {
    NormalOf normal;  // of its first triangle
    std::uint32_t first = 0, triangles = 0, first_piece = 0, pieces = 0;
    std::uint32_t last_ray = kNone;  // of in_planes_
    std::array<double, 3> low{2, 2, 2}, high{-2, -2, -2};

    void widen(const Held& held) noexcept;
    // False only if no direction is in cones of both.
    bool may_meet(const Plane& other) const noexcept {
      for (std::size_t i = 0; i < 3; ++i)
        if (low[i] > other.high[i] || other.low[i] > high[i]) return false;
      return true;
    }
  };
  struct InPlane {  // a ray in a plane and its cones
    std::uint32_t ray, before;
  };
  struct Part {
    std::uint32_t first_ray = 0, rays = 0, first_piece = 0, pieces = 0;
  };

  static std::size_t index(const Side& side) noexcept { return 2 * std::size_t{side.piece} + (side.is_above ? 0 : 1); }
  static Side side_at(std::uint32_t index) noexcept { return {index / 2, index % 2 == 0}; }
  bool are_opposite(std::uint32_t i, std::uint32_t j) const noexcept;
  bool covers(std::uint32_t plane, const Direction& d) const;
  bool is_too_large() const noexcept { return looks_ > kMostLooks; }
  std::uint32_t add_ray(const Line& line);
  void add_borders(Held& held);
  std::uint32_t add_border(const Held& held, std::size_t i, int sign);
  int turn(std::uint32_t plane, std::uint32_t i, std::uint32_t j) const;
  int half_turn(std::uint32_t plane, std::uint32_t i, std::uint32_t j) const;

  std::span<const std::uint32_t> triangles_in(std::uint32_t plane) const noexcept {
    return {by_plane_.data() + planes_[plane].first, planes_[plane].triangles};
  }
  template <class Visit>
  void for_rays_in(std::uint32_t plane, const Visit& visit) const {
    for (std::uint32_t i = planes_[plane].last_ray; i != kNone; i = in_planes_[i].before) visit(in_planes_[i].ray);
  }
  void put(std::uint32_t ray, std::uint32_t plane) {
    in_planes_.push_back({ray, planes_[plane].last_ray});
    planes_[plane].last_ray = static_cast<std::uint32_t>(in_planes_.size() - 1);
  }

  void find_planes();
  void find_rays();
  void find_rays_of(std::uint32_t i, std::uint32_t j);
  void make_pieces();
  void add_pieces(std::uint32_t plane);
  void add_piece(std::uint32_t plane, std::uint32_t from, std::uint32_t to);
  void order_around_rays();
  void join();
  void find_parts();
  void make_cells();
  void find_reached(Cell from) const;
  bool is_key(Cell cell) const;  // its is key_
  bool is_inside(const Piece& piece, const Direction& d, std::uint32_t known) const;
  std::uint32_t region(std::uint32_t part, const Direction& d, const Direction* w) const;
  std::uint32_t region_at_ray(std::uint32_t ray, const Direction* across) const;
  bool is_before_in(const Held& held, std::uint32_t a, std::uint32_t b) const;
  std::uint32_t number_in(std::uint32_t triangle, std::uint32_t piece) const;

  Kind kind_ = Kind::plane;
  bool is_rough_ = false;
  std::size_t looks_ = 0;
  const Soup* soup_ = nullptr;
  std::vector<Held> triangles_;
  std::vector<Plane> planes_;
  std::vector<std::uint32_t> by_plane_;  // triangles
  Parallels normals_{false};
  std::vector<Ray> rays_;
  Parallels directions_{true};
  std::vector<InPlane> in_planes_;
  std::vector<std::uint32_t> plane_of_ray_;  // the last one in which a ray was found to be
  std::uint32_t ray_of_first_ = kNone;       // a ray of the plane whose rays are looked for
  bool is_opposite_in_first_ = false;        // the opposite direction is in that plane's cones
  std::vector<Piece> pieces_;                // those of a plane follow each other
  std::vector<std::uint32_t> piece_triangles_;
  std::vector<Entry> entries_;
  std::uint32_t parts_ = 0;
  std::vector<Part> part_;
  std::vector<std::uint32_t> rays_by_part_, pieces_by_part_;
  std::vector<std::uint32_t> region_of_side_;  // of the directions off its own part
  std::vector<std::uint32_t> keys_;            // of the cells: a region for each part
  std::vector<Cell> cell_of_side_;
  std::vector<std::uint32_t> sides_by_cell_, first_of_cell_;
  std::vector<char> is_wall_;
  std::uint32_t cells_ = 0;
  std::vector<std::uint32_t> order_, parent_, place_in_order_, count_;
  mutable std::vector<std::uint32_t> key_, waiting_;
  mutable Cell reached_from_ = kNone;  // of which reached_ is
  mutable std::vector<char> reached_;  // for each cell
};

// The triangles that hold x, in order; `near` has all of them.
void find_held(const Point& x, std::span<const Face* const> near, std::vector<Star::Held>& held);

}  // namespace forceshade::fast::soups
