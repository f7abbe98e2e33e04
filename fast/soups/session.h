// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One god-object on its path over any set of triangles (docs/soups.md): state, moves and force equal the exact definition in
// every bit.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "fast/soups/places.h"
#include "fast/soups/segment.h"
#include "fast/soups/way.h"
#include "forceshade/law.h"

namespace forceshade::fast::soups {

struct State {
  Place place;      // nowhere: no valid position has come yet
  Star::Name cell;  // where it is touching
  bool is_slipping = false;

  bool operator==(const State&) const = default;
};

struct Tick {
  Status status = Status::invalid;
  std::uint16_t moves = 0;
  std::array<float, 3> force{};  // N
  State after;
  damping::Limits damping = {};
};

// One thread at a time; the soup may be shared. A tick allocates only where it looks at more than kUsual triangles at a point,
// or on a way; and keeps the memory.
class Session {
 public:
  // stiffness: N/mm, of triangles without one of their own. is_shaded: by the soup's corner normals.
  Session(std::shared_ptr<const Soup> soup, float stiffness, bool is_shaded);

  Tick tick(const std::array<float, 3>& position);

  const State& state() const noexcept { return state_; }
  std::size_t looks() const noexcept { return looks_; }  // of the last tick
  std::size_t boxes() const noexcept { return boxes_; }  // of triangles that the last tick tested
  // A state that the soup does not have counts as none.
  void resume(const State& state);

 private:
  using Near = std::vector<const Face*>;
  static constexpr unsigned kMostMoves = 256;
  static constexpr std::size_t kMostLooks = Star::kMostLooks, kUsual = 1000;

  struct End {  // of a move
    At* at = nullptr;
    bool is_rest = false;
  };

  Tick run();
  Tick unfinished(unsigned moves, bool is_slipping);
  End flight(const Point& g);
  End along_piece(const Way& way);
  End along_ray(const Way& way);
  Tick free(unsigned moves);
  Tick resting(unsigned moves, bool is_slipping, Status status);
  void go_to_place();
  Tick resting_at_end(At& r, unsigned moves, bool is_slipping);
  Tick ended(const At& r, unsigned moves, bool is_slipping, bool is_at_goal, Status status);

  void find_near(const Point& a, const Point& b, Near& near);
  void look_along(const Point& a, const Point& b, Near& near);
  void look_at(const Star& star) noexcept {
    points_ += star.looks();
    looks_ += star.looks();
  }
  // Then the move is not made, and stars of its points may not be either.
  bool is_exhausted() const noexcept { return points_ > kMostLooks; }
  const Star& star_at(const Point& x, const Near& near);
  void make_end(At& at, const Point& x, const Near& near, const Direction& back, const Direction& w);
  bool make_on_surface(At& at, const Point& x);
  // At x, in the cell of this name; false where there is none, or where x has more triangles than a tick looks at.
  bool make_in_cell(At& at, Point x, const Star::Name& name);
  // The triangles among which are all that hold the way's point at the first of these times; it moves on to the next one.
  const Near& near_at(const Segment& segment, std::size_t& time);
  // Into *stop_.
  bool is_stopped(const Segment& segment, const Time& most, const Direction& w, const Near& near);

  At* rounded(At* at);
  At* rounded_on_line(At* at);
  At* rounded_in_plane(At* at);
  Point next_point(const At& at, const GridLine& line, const Floor& m, bool is_up, const Near& near);
  Place corner_of_cell(const Face& f, const Point& x, bool& is_same) const;
  Place grid_place(const At& at) const;
  Place rest_on_line(At*& r);
  Place rest_in_plane(At*& r);

  std::shared_ptr<const Soup> soup_;
  float stiffness_;
  bool is_shaded_;
  State state_;
  bool is_on_ = false;  // *on_ is where the state is
  std::array<float, 3> hand_{};
  Point p_;
  // Ticks that follow each other are mostly among the same triangles. There are more than can be of one tick.
  struct KeptStar {
    Star star;
    std::uint64_t last_use = 0;
  };
  std::array<KeptStar, 8> stars_;
  std::uint64_t uses_ = 0;
  std::vector<Star::Held> held_;
  std::array<At, 5> ats_;
  At *on_ = &ats_[0], *end_ = &ats_[1], *next_ = &ats_[2], *stop_ = &ats_[3], *spare_ = &ats_[4];
  std::optional<Place> kept_;               // of *on_, where it is known
  std::optional<Place> rounded_place_;      // of a triangle's grid that gave what was rounded, where it is strictly inside
  Near near_, near_end_, along_, near_at_;  // of a way; of its end; those in whose plane a way is; at a time
  std::vector<Time> times_;
  std::size_t looks_ = 0, boxes_ = 0, points_ = 0;  // of the tick; of the tick; at the points of a move or a rest
};

}  // namespace forceshade::fast::soups
