// SPDX-License-Identifier: BSD-3-Clause
// The witness goes round upright columns side by side, each of which takes in the part of its width that generates energy. Its
// lower side runs along the slice, its upper side back. Where nothing is to be taken in both run above the surface.

#include <algorithm>
#include <cmath>

#include "reference/energy/height_circulation.h"
#include "reference/energy/strips.h"

namespace forceshade::reference {
namespace {

constexpr double kSagitta = 0x1p-11;    // of the depth: how far a chord may leave the surface's shape
constexpr double kPassage = 0x1p-8;     // of the depth: stays open below what is left out at the top
constexpr long double kLeast = 1e-12L;  // of K·depth²: what is lost by binary32 corners
constexpr int kChords = 6;              // along where the circulation changes its sign

struct Corner {
  float s, z;
};

// From its left to its right end.
struct Column {
  Corner lower[2], upper[2];
  Enclosed enclosed;
};

float down(long double value) {
  const auto near = static_cast<float>(value);
  return static_cast<long double>(near) <= value ? near : std::nextafter(near, -HUGE_VALF);
}

float up(long double value) {
  return -down(-value) + 0.0F;  // never -0
}

Enclosed other_way_round(Enclosed enclosed) {
  switch (enclosed) {
    case Enclosed::nothing: return Enclosed::all;
    case Enclosed::all: return Enclosed::nothing;
    case Enclosed::top: return Enclosed::bottom;
    default: return Enclosed::top;
  }
}

class Columns {
 public:
  Columns(const HeightMapField& law, const Slice& slice, const Circulation& circulation, const std::vector<Stretch>& stretches,
          bool is_clockwise, const Monitor& monitor)
      : slice_(slice), to_(std::nextafter(slice.to, slice.from)), circulation_(circulation), is_clockwise_(is_clockwise) {
    const double D = depth(), top = tallest(law, slice);
    middle_ = up(static_cast<long double>(top + D / 8));
    top_ = up(static_cast<long double>(top + D / 4));
    const auto& pieces = circulation.line().pieces();
    const HeightLine::Piece* last = pieces.data();
    for (const Stretch& stretch : stretches) {
      monitor.at(static_cast<double>(&stretch - stretches.data()) / static_cast<double>(stretches.size()));
      const HeightLine::Piece* piece = stretch.piece;
      if (piece != last) add_line(static_cast<std::size_t>(piece - pieces.data()));
      last = piece;
      // Strictly between the lines, where the piece's formulas hold.
      const float low = piece == &pieces.front() ? slice.from : right_of(piece->from),
                  high = piece == &pieces.back() ? to_ : left_of(piece->to);
      if (low < high) add(stretch, std::clamp(at(stretch.from), low, high), std::clamp(at(stretch.to), low, high));
    }
  }

  std::vector<Corner> polygon() {
    open_passages();
    const auto is_nothing = [](const Column& c) { return c.enclosed == Enclosed::nothing; };
    const auto first = std::find_if_not(columns_.begin(), columns_.end(), is_nothing);
    const auto last = std::find_if_not(columns_.rbegin(), columns_.rend(), is_nothing).base();
    std::vector<Corner> corners;
    for (auto c = first; c < last; ++c) corners.insert(corners.end(), {c->lower[0], c->lower[1]});
    for (auto c = last; c > first; --c) corners.insert(corners.end(), {(c - 1)->upper[1], (c - 1)->upper[0]});
    return without_flat_corners(corners);
  }

 private:
  double depth() const { return static_cast<double>(circulation_.depth().mid()); }

  // Places along the slice.
  Ball64 place(const Ball64& t) const {
    const Ball64 from(static_cast<double>(slice_.from)), to(static_cast<double>(slice_.to));
    return from + t * (to - from);
  }
  Ball64 t_of(float s) const {
    const Ball64 from(static_cast<double>(slice_.from)), to(static_cast<double>(slice_.to));
    return (Ball64(static_cast<double>(s)) - from) / (to - from);
  }
  float at(const Ball64& t) const { return std::clamp(static_cast<float>(place(t).mid()), slice_.from, to_) + 0.0F; }
  float left_of(const Ball64& t) const { return down(place(t).low()) + 0.0F; }
  float right_of(const Ball64& t) const { return up(place(t).high()); }

  float surface(const HeightLine::Piece& piece, float s) const {
    return up(circulation_.line().ground(piece, t_of(s)).surface.high());
  }

  // Around the line on which a piece begins, or past it.
  void add_line(std::size_t index) {
    const auto& pieces = circulation_.line().pieces();
    const Ball64 rise = circulation_.rise(index);
    const bool is_smooth = std::fabs(rise.mid()) <= rise.rad();
    const HeightLine::Piece &left = pieces[index - 1], &right = pieces[index];
    const float from = left_of(right.from), to = right_of(right.from);
    const bool generates = !is_smooth && (rise.mid() > 0) != is_clockwise_;
    // The surface bends on the line, and is as good as straight beside it.
    const auto before = circulation_.line().ground(left, right.from), after = circulation_.line().ground(right, right.from);
    const auto steepness = [&](const SectionSample<Ball64>& g) {
      const Ball64 slope = g.climb + g.excess;
      return std::max(std::fabs(slope.low()), std::fabs(slope.high())) / (slice_.to - slice_.from);
    };
    const long double highest = after.surface.high() + 2 * std::max(steepness(before), steepness(after)) * (to - from);
    const float bottom = up(highest - static_cast<long double>(depth() * (1 - kSagitta)));
    if (generates || (is_smooth && !columns_.empty() && columns_.back().enclosed != Enclosed::nothing))
      push({{{from, bottom}, {to, bottom}}, {{from, top_}, {to, top_}}, Enclosed::all});
    else
      push_nothing(from, to);
  }

  void add(const Stretch& stretch, float from, float to) {
    const Enclosed enclosed = is_clockwise_ ? other_way_round(stretch.enclosed) : stretch.enclosed;
    if (to <= from) return;
    if (enclosed == Enclosed::nothing) return push_nothing(from, to);
    // On a chord of length l the surface leaves it by |second derivative|·l²/8 at most.
    const long double middle = (stretch.from.mid() + stretch.to.mid()) / 2, D = circulation_.depth().mid();
    const long double half = std::max(stretch.to.high() - middle, middle - stretch.from.low());
    const Ball64 bend =
        circulation_.line().ground(*stretch.piece, SectionSeries::variable(Ball64(middle, half), 1.0)).surface[2];
    const long double most = std::max(std::fabs(bend.low()), std::fabs(bend.high())) * stretch.width() * stretch.width() / 4;
    const long double leaves = enclosed == Enclosed::all ? 0 : bend_of_change(*stretch.piece, from, to);
    const auto chords_for = [&](long double height) { return static_cast<int>(std::ceil(std::sqrt(height / (D * kSagitta)))); };
    const int chords = std::max({1, chords_for(most), std::min(kChords, chords_for(leaves))});
    const long double sagitta = most / (static_cast<long double>(chords) * chords) * (1 + 0x1p-20L);
    float left = from;
    for (int i = 1; i <= chords; ++i) {
      const auto share = static_cast<double>(i) / chords;
      const float right =
          i == chords
              ? to
              : static_cast<float>(static_cast<double>(from) + share * (static_cast<double>(to) - static_cast<double>(from)));
      if (right <= left) continue;
      const auto [low_left, high_left] = sides(*stretch.piece, left, enclosed, sagitta);
      const auto [low_right, high_right] = sides(*stretch.piece, right, enclosed, sagitta);
      push({{low_left, low_right}, {high_left, high_right}, enclosed});
      left = right;
    }
  }

  // The depth at which the circulation changes its sign, from 0 to D.
  long double change_of_sign(const HeightLine::Piece& piece, float s) const {
    const auto [shallow, deep] = circulation_.density(piece, t_of(s));
    const long double D = circulation_.depth().mid(), change = D * shallow.mid() / (shallow.mid() - deep.mid());
    return change > 0 ? std::min(change, D) : 0;
  }

  // By how much its chord leaves it, about.
  long double bend_of_change(const HeightLine::Piece& piece, float from, float to) const {
    const float middle = from + (to - from) / 2;
    const long double chord = (change_of_sign(piece, from) + change_of_sign(piece, to)) / 2;
    return std::fabs(change_of_sign(piece, middle) - chord);
  }

  // The lower and the upper end of what is taken in at a place.
  std::array<Corner, 2> sides(const HeightLine::Piece& piece, float s, Enclosed enclosed, long double sagitta) const {
    const long double D = circulation_.depth().mid(), height = static_cast<long double>(surface(piece, s));
    const long double change = change_of_sign(piece, s), bottom = enclosed == Enclosed::top ? change : D;
    const long double roof = std::min(change, D * (1 - static_cast<long double>(kPassage)));
    return {Corner{s, up(height - bottom + sagitta)}, Corner{s, enclosed == Enclosed::bottom ? up(height - roof) : top_}};
  }

  void push_nothing(float from, float to) {
    push({{{from, middle_}, {to, middle_}}, {{from, top_}, {to, top_}}, Enclosed::nothing});
  }

  // Side by side: what overlaps the last column is cut off, a gap is left out.
  void push(Column column) {
    const float reached = columns_.empty() ? slice_.from : columns_.back().lower[1].s;
    if (column.lower[1].s <= reached) return;
    if (!columns_.empty() && column.lower[0].s > reached) {
      const float to = column.lower[0].s;
      columns_.push_back({{{reached, middle_}, {to, middle_}}, {{reached, top_}, {to, top_}}, Enclosed::nothing});
    }
    for (Corner* left : {&column.lower[0], &column.upper[0]}) left->s = std::max(left->s, reached);
    columns_.push_back(column);
  }

  // Opens a part one binary32 step wide of each column that is open at its bottom alone and cannot be entered from its
  // neighbour, up to the corridor.
  void open_passages() {
    std::vector<Column> open;
    for (Column next : columns_) {
      if (!open.empty()) {
        Column& last = open.back();
        const float floor = std::max(last.lower[1].z, next.lower[0].z), roof = std::min(last.upper[1].z, next.upper[0].z);
        if (floor >= roof) {
          const float s = next.lower[0].s;
          if (next.enclosed == Enclosed::bottom) {
            const float to = std::nextafter(s, HUGE_VALF);
            open.push_back({{{s, next.lower[0].z}, {to, next.lower[0].z}}, {{s, top_}, {to, top_}}, Enclosed::all});
            for (Corner* left : {&next.lower[0], &next.upper[0]}) left->s = to;
          } else {
            const float from = std::nextafter(s, -HUGE_VALF);
            for (Corner* right : {&last.lower[1], &last.upper[1]}) right->s = from;
            const float bottom = last.lower[1].z;
            if (last.lower[0].s >= from) open.pop_back();
            open.push_back({{{from, bottom}, {s, bottom}}, {{from, top_}, {s, top_}}, Enclosed::all});
          }
        }
      }
      if (next.lower[0].s < next.lower[1].s) open.push_back(next);
    }
    columns_.swap(open);
  }

  static std::vector<Corner> without_flat_corners(const std::vector<Corner>& corners) {
    std::vector<Corner> kept;
    for (const Corner& c : corners) {
      const auto is_flat = [&](const Corner& a, const Corner& b) {
        return (a.s == b.s && b.s == c.s) || (a.z == b.z && b.z == c.z);
      };
      if (!kept.empty() && kept.back().s == c.s && kept.back().z == c.z) continue;
      if (kept.size() > 1 && is_flat(kept[kept.size() - 2], kept.back())) kept.pop_back();
      kept.push_back(c);
    }
    return kept;
  }

  const Slice& slice_;
  float to_;  // mm: the last place in the slice
  const Circulation& circulation_;
  bool is_clockwise_;
  float middle_, top_;  // mm: two heights above the surface
  std::vector<Column> columns_;
};

}  // namespace

std::vector<Eigen::Vector3f> witness(const HeightMapField& law, const Slice& slice, float depth, const Monitor& monitor) {
  if (potential(law)) return {};
  const std::lock_guard lock(exact_arithmetic);
  set_precision(kEnergyBits);
  return decided([&] {
    const Circulation circulation(law, slice, depth);
    const std::vector<Stretch> stretches = circulation.stretches(1e-4L, monitor.part(0, 0.75));
    const Generated generated = circulation.generated(stretches);
    const long double D = circulation.depth().mid(),
                      most = std::max(generated.counter_clockwise.high(), generated.clockwise.high());
    if (most <= D * D * kLeast) return std::vector<Eigen::Vector3f>{};
    const bool is_clockwise = generated.counter_clockwise.high() < generated.clockwise.high();
    std::vector<Corner> corners = Columns(law, slice, circulation, stretches, is_clockwise, monitor.part(0.75, 1)).polygon();
    if (is_clockwise) std::reverse(corners.begin(), corners.end());
    if (!corners.empty()) corners.push_back(corners.front());
    std::vector<Eigen::Vector3f> loop;
    for (const auto& [s, z] : corners)
      loop.push_back(slice.along == Slice::Along::x ? Eigen::Vector3f(s, slice.at, z) : Eigen::Vector3f(slice.at, s, z));
    return loop;
  });
}

}  // namespace forceshade::reference
