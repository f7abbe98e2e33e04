// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The triangles around a point of the surface: their directions, and the cells between them (docs/soups.md).

#include <cstddef>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "reference/soups/soup.h"

namespace forceshade::reference::soups {

class Star {
 public:
  enum class Kind { point, line, plane };

  // A direction in which the cone of a triangle ends, or in which two of different planes meet.
  struct Ray {
    Vector along;   // whose largest coordinate in size is 1 or -1
    struct Entry {  // a piece that begins or ends at this ray, and the direction of its plane across it
      std::size_t piece;
      bool is_from;
      Vector across;
    };
    std::vector<Entry> around = {};  // counterclockwise, seen against the ray
  };
  // Directions of one plane, counterclockwise around its normal from one ray to another; a whole plane has no rays.
  struct Piece {
    Vector normal;
    std::optional<std::size_t> from, to;
    Vector middle;                                // a direction inside it
    std::vector<const Triangle*> triangles = {};  // in order
  };
  // A piece seen from where its normal points (above), or from the other side.
  struct Side {
    std::size_t piece;
    bool is_above;
    auto operator<=>(const Side&) const = default;
  };
  using Cell = std::size_t;
  // The name of a side or a cell: a triangle, whether it is seen from behind, and the number of its piece.
  using Name = std::tuple<std::size_t, bool, std::size_t>;

  // x is a point of the surface.
  Star(const Soup& soup, const Vector& x);

  Kind kind() const { return kind_; }
  const std::vector<Ray>& rays() const { return rays_; }
  const std::vector<Piece>& pieces() const { return pieces_; }
  const std::vector<const Triangle*>& triangles() const { return triangles_; }  // that hold x, in order

  // The cell of d + εw for every small ε > 0; nothing where that lies on the surface.
  std::optional<Cell> cell(const Vector& d, const Vector& w = {}) const;
  Cell cell(const Side& side) const { return cell_of_side_[index(side)]; }
  std::optional<Cell> cell(const Name& name) const;
  bool is_wall(const Side& side) const;
  std::set<Cell> reached(Cell from) const;
  std::vector<Side> walls(Cell from) const;  // beside cells that are reached
  std::vector<Side> sides(Cell cell) const;  // beside it

  std::size_t looks() const;  // the triangles of all pieces

  bool is_one_part() const { return parts_ == 1; }  // its directions are connected

  Name name(const Side& side) const;
  Name name(Cell cell) const;
  Cell least_cell() const;

  // The lowest triangle of the piece that blocks on this side.
  const Triangle& blocking(const Side& side) const;
  // The direction at a right angle to the piece on this side.
  Vector up(const Side& side) const { return side.is_above ? pieces_[side.piece].normal : -pieces_[side.piece].normal; }
  // The wedge around a ray that lies at this side of a piece. A piece that begins and ends at the ray has two: it is the one
  // that follows the piece counterclockwise.
  struct Wedge {
    Vector inner;  // a direction in it, across the ray
    Side next;     // beyond it
  };
  Wedge wedge(std::size_t ray, const Side& side) const;
  // True for a direction of this piece but its ends.
  bool is_inside(const Piece& piece, const Vector& d) const;

 private:
  struct Plane;
  static std::size_t index(const Side& side) { return 2 * side.piece + (side.is_above ? 0 : 1); }
  static Side side_at(std::size_t index) { return {index / 2, index % 2 == 0}; }
  void make_pieces(const std::vector<Plane>& planes);
  void make_cells();
  std::optional<std::size_t> region(std::size_t part, const Vector& d, const Vector& w) const;
  std::optional<Side> beside(std::size_t ray, const Vector& across) const;
  std::optional<std::vector<std::size_t>> key(const Vector& d, const Vector& w) const;
  std::size_t number_in(const Triangle& triangle, std::size_t piece) const;

  Kind kind_;
  std::vector<const Triangle*> triangles_;
  std::vector<Ray> rays_;
  std::vector<Piece> pieces_;
  std::vector<std::size_t> part_of_ray_, part_of_piece_;
  std::size_t parts_ = 0;
  std::vector<std::size_t> region_of_side_;     // of the directions off its own part
  std::vector<std::vector<std::size_t>> keys_;  // of the cells: a region for each part
  std::vector<Cell> cell_of_side_;
};

}  // namespace forceshade::reference::soups
