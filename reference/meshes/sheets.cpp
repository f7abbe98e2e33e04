// SPDX-License-Identifier: BSD-3-Clause
#include "reference/meshes/sheets.h"

#include <algorithm>
#include <array>
#include <utility>

namespace forceshade::reference::meshes {
namespace {

using mesh::Place;
using mesh::Side;
using mesh::Sides;

constexpr std::size_t kMostTriangles = 8;  // of a feature that are tried
constexpr std::uint32_t kRings = 8;

std::uint32_t whole_part(const Fraction& value) {
  return floor(value).convert_to<std::uint32_t>();
}

}  // namespace

// The point nearest to p of those that are offered; of equally near ones the first.
class Sheets::Nearest {
 public:
  explicit Nearest(Integer limit) : limit_(std::move(limit)) {}

  bool would_take(const Integer& distance) const { return distance < limit_; }
  void offer(const Reached& place, Integer distance) {
    if (!would_take(distance)) return;
    limit_ = std::move(distance);
    best_ = place;
  }
  const std::optional<Reached>& best() const { return best_; }

 private:
  Integer limit_;
  std::optional<Reached> best_;
};

Integer Sheets::distance(const GridPoint& c) const {
  const Vector off = surface_.position(c) - p_;
  return dot(off, off);
}

std::vector<std::size_t> Sheets::triangles_at(const Feature& feature) const {
  std::vector<std::size_t> all = surface_.triangles_at(feature);
  if (all.size() > kMostTriangles) all.resize(kMostTriangles);
  return all;
}

Sheets::Weights Sheets::weights(const GridPoint& at, std::size_t triangle) const {
  const auto& vertices = surface_.triangles()[triangle].vertices;
  const auto [k, l] = at.parameter;
  if (at.feature.place == Place::triangle) return {kGrid - k - l, k, l};
  Weights result{};
  for (std::size_t i = 0; i < 3; ++i) {
    if (at.feature.place == Place::vertex) {
      result[i] = vertices[i] == at.feature.index ? kGrid : 0;
    } else {
      const auto& ends = surface_.edges()[at.feature.index].vertices;
      result[i] = vertices[i] == ends[0] ? kGrid - k : vertices[i] == ends[1] ? k : 0;
    }
  }
  return result;
}

bool Sheets::is_blocked(const Feature& feature, const Vector& u) const {
  const DirectionKind A = directions(surface_, feature, -u).way, B = directions(surface_, feature, u).way;
  const bool leaves = sides_ == Sides::front && A == DirectionKind::back && B == DirectionKind::front;
  return B != DirectionKind::open && B != A && !leaves;
}

std::optional<Block> Sheets::block(const Vector& g, const GridPoint& c) const {
  const Vector end = surface_.position(c);
  if (end == g) return std::nullopt;
  for (const Crossing& crossing : crossings_.between(g, end))
    if (is_blocked(crossing.point.feature, end - g)) return Block{crossing.s, crossing.point.feature};
  for (const Feature& feature : crossings_.features_at(end))
    if (feature != c.feature) return Block{{1, 1}, feature};
  return std::nullopt;
}

bool Sheets::is_apart(const Vector& g, const Vector& over, const Integer& scale, const GridPoint& c) const {
  const Vector end = surface_.position(c);
  return crossings_.features_at(end).size() == 1 && crossings_.is_alone(over, scale, end, {g, p_});
}

// The side on which a direct way from g arrives at c; none where it is not clear.
std::optional<Side> Sheets::arrival(const Vector& g, const std::optional<Reached>& from, const GridPoint& c) const {
  const Vector u = surface_.position(c) - g;
  if (is_zero(u)) return std::nullopt;
  if (from) {
    const DirectionKind way = directions(surface_, from->at.feature, u).way;
    const DirectionKind blocked = from->side == Side::front ? DirectionKind::back : DirectionKind::front;
    if (way == blocked) return std::nullopt;
  }
  const DirectionKind A = directions(surface_, c.feature, -u).way;
  if (A == DirectionKind::on || (sides_ == Sides::front && A == DirectionKind::back) || block(g, c)) return std::nullopt;
  return A == DirectionKind::back ? Side::back : Side::front;
}

// The grid points beside a point of the closed triangle: up to four.
std::vector<GridPoint> Sheets::around(std::size_t triangle, const Fraction& k, const Fraction& l, Tries& tries) const {
  std::vector<GridPoint> found;
  const std::uint32_t K = whole_part(k), L = whole_part(l);
  for (std::uint32_t across = 0; across < 2; ++across)
    for (std::uint32_t up = 0; up < 2; ++up) {
      if ((up == 1 && is_whole(k)) || (across == 1 && is_whole(l)) || K + up + L + across > kGrid) continue;
      if (!tries.take()) return found;
      found.push_back(surface_.in_triangle(triangle, K + up, L + across));
    }
  return found;
}

std::optional<Reached> Sheets::landing(const Vector& g, const std::optional<Reached>& from, const SurfacePoint& x,
                                       Tries& tries) const {
  std::vector<std::pair<std::size_t, std::array<std::uint32_t, 2>>> bases;
  for (const std::size_t triangle : triangles_at(x.feature)) {
    std::array<std::uint32_t, 2> down{};
    for (std::size_t i = 0; i < 2; ++i) down[i] = whole_part({x.parameter[i].over * kGrid, x.parameter[i].under});
    const Weights corners =
        x.feature.place == Place::triangle ? Weights{0, down[0], down[1]} : weights({x.feature, down}, triangle);
    bases.push_back({triangle, {corners[1], corners[2]}});
  }
  if (!from) return landing(g, from, nullptr, bases, tries);
  const Integer limit = distance(from->at);
  return landing(g, from, &limit, bases, tries);
}

std::optional<Reached> Sheets::landing(const Vector& g, const std::optional<Reached>& from, const Integer* limit,
                                       const std::vector<std::pair<std::size_t, std::array<std::uint32_t, 2>>>& bases,
                                       Tries& tries) const {
  using Step = std::array<std::int64_t, 2>;
  static const std::vector<Step> kCell{{0, 0}, {1, 0}, {0, 1}, {1, 1}},
      kRing{{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}};
  for (std::uint32_t ring = 0; ring <= kRings; ++ring) {
    std::optional<std::pair<Reached, Integer>> best;
    for (const auto& [triangle, base] : bases)
      for (const Step& step : ring == 0 ? kCell : kRing) {
        const std::int64_t reach = ring == 0 ? 1 : std::int64_t{1} << (ring - 1);
        const std::int64_t k = base[0] + reach * step[0], l = base[1] + reach * step[1];
        if (k < 0 || l < 0 || k + l > kGrid) continue;
        if (!tries.take()) return best ? std::optional(best->first) : std::nullopt;
        const GridPoint c = surface_.in_triangle(triangle, static_cast<std::uint32_t>(k), static_cast<std::uint32_t>(l));
        Integer off = distance(c);
        if ((limit != nullptr && off >= *limit) || (best && off >= best->second)) continue;
        if (const auto side = arrival(g, from, c)) best.emplace(Reached{c, *side}, std::move(off));
      }
    if (best) return best->first;
  }
  return std::nullopt;
}

std::optional<Reached> Sheets::detour(const Reached& from, const GridPoint& e, std::size_t carrier, const Block& block,
                                      Tries& tries) const {
  Nearest best(distance(from.at));
  shorten(best, from, e, carrier, block.s, tries);
  for (const std::size_t along : triangles_at(from.at.feature))
    for (const std::size_t beside : triangles_at(block.feature))
      if (tries.take()) go_beside(best, from, along, beside, tries);
  for (const std::size_t to : triangles_at(block.feature))
    if (tries.take()) change_sheet(best, from, e, carrier, to, tries);
  return best.best();
}

// True if a way of the given square is as long as eight of the longest steps of the triangle's grid. Shorter ones are not gone.
bool Sheets::is_long_enough(const Fraction& square, std::size_t triangle) const {
  Integer longest = 0;
  for (const Vector& side : surface_.triangles()[triangle].sides) longest = std::max(longest, Integer(dot(side, side)));
  return square >= Fraction{64 * longest, Integer(kGrid) * kGrid};
}

// Along the way to e, as far as it is clear about.
void Sheets::shorten(Nearest& best, const Reached& from, const GridPoint& e, std::size_t carrier, const Fraction& s,
                     Tries& tries) const {
  const Vector g = surface_.position(from.at);
  const Weights G = weights(from.at, carrier), E = weights(e, carrier);
  const std::uint32_t most = whole_part({s.over * kGrid, s.under});
  const auto at = [&](std::uint32_t m, std::size_t i) {
    return Fraction{Integer(G[i]) * kGrid + Integer(m) * (Integer(E[i]) - Integer(G[i])), kGrid};
  };
  const Vector way = surface_.position(e) - g;
  const auto is_far = [&](std::uint32_t m) {
    return is_long_enough({Integer(m) * m * dot(way, way), Integer(kGrid) * kGrid}, carrier);
  };
  using Cell = std::array<std::pair<std::uint32_t, bool>, 2>;
  std::optional<Cell> last;
  for (std::uint32_t back = 0; back < most && is_far(most - back) && tries.are_left(); back = back == 0 ? 1 : 2 * back) {
    const Fraction k = at(most - back, 1), l = at(most - back, 2);
    const Cell cell{std::pair(whole_part(k), is_whole(k)), std::pair(whole_part(l), is_whole(l))};
    if (last == cell) continue;  // the same points
    last = cell;
    Nearest of_these(distance(from.at));
    for (const GridPoint& c : around(carrier, k, l, tries)) {
      Integer off = distance(c);
      if (of_these.would_take(off) && !this->block(g, c)) of_these.offer({c, from.side}, std::move(off));
    }
    if (!of_these.best()) continue;
    best.offer(*of_these.best(), distance(of_these.best()->at));
    return;
  }
}

// In the triangle `along`, parallel to the plane of the triangle `beside`.
void Sheets::go_beside(Nearest& best, const Reached& from, std::size_t along, std::size_t beside, Tries& tries) const {
  const Triangle& T = surface_.triangles()[along];
  const Vector &n = surface_.triangles()[beside].normal, g = surface_.position(from.at);
  std::array<Integer, 3> d{0, -dot(n, T.sides[2]), -dot(n, T.sides[0])};
  d[0] = -d[1] - d[2];
  const Vector D = d[1] * T.sides[0] - d[2] * T.sides[2];
  Integer onward = dot(p_ - g, D);
  if (onward.is_zero()) return;
  if (onward < 0) {
    onward = -onward;
    for (Integer& one : d) one = -one;
  }
  const Weights G = weights(from.at, along);
  Fraction t{onward, dot(D, D)};
  for (std::size_t i = 0; i < 3; ++i) {
    if (d[i] >= 0) continue;
    Fraction to_side{G[i], Integer(-d[i]) * kGrid};
    if (to_side < t) t = std::move(to_side);
  }
  if (t.over.is_zero()) return;
  const auto end = [&](std::size_t i) { return Fraction{Integer(G[i]) * t.under + t.over * d[i] * kGrid, t.under}; };
  std::vector<GridPoint> ends = around(along, end(1), end(2), tries);
  std::erase_if(ends, [&](const GridPoint& c) {
    const Vector way = surface_.position(c) - g;
    return !is_long_enough({dot(way, way), 1}, along);
  });
  std::ranges::stable_sort(ends, {}, [&](const GridPoint& c) { return distance(c); });
  const Integer limit = distance(from.at);
  std::optional<std::pair<GridPoint, Fraction>> blocked;
  for (const GridPoint& c : ends) {
    Integer off = distance(c);
    if (off >= limit) break;
    const auto found = block(g, c);
    if (!found) return best.offer({c, from.side}, std::move(off));
    if (!blocked) blocked.emplace(c, found->s);
  }
  if (blocked) shorten(best, from, blocked->first, along, blocked->second, tries);
}

// Onto the triangle `to`, where the way to e goes through its plane: if p is beyond that plane, and its foot there is not
// beyond the plane of the triangle that the god-object slides in.
void Sheets::change_sheet(Nearest& best, const Reached& from, const GridPoint& e, std::size_t carrier, std::size_t to,
                          Tries& tries) const {
  const Triangle &T = surface_.triangles()[carrier], &other = surface_.triangles()[to];
  const Vector g = surface_.position(from.at), u = surface_.position(e) - g;
  const auto corner = [&](const Triangle& of, std::size_t i) -> const Vector& { return surface_.vertices()[of.vertices[i]]; };
  const Integer through = dot(other.normal, u), beyond = dot(other.normal, p_ - corner(other, 0));
  if (through.is_zero() || through.sign() != beyond.sign()) return;
  const Integer foot = dot(T.normal, p_ - corner(T, 0)) * other.normal_squared - beyond * dot(T.normal, other.normal);
  if (from.side == Side::front ? foot < 0 : foot > 0) return;
  const Vector A = corner(other, 0) - g, B = corner(other, 1) - g, C = corner(other, 2) - g;
  const auto down = [&](const Integer& weight) { return whole_part(fraction(weight * kGrid, through)); };
  const Integer limit = distance(from.at);
  if (const auto found = landing(g, from, &limit, {{to, {down(dot(u, cross(C, A))), down(dot(u, cross(A, B)))}}}, tries))
    best.offer(*found, distance(found->at));
}

}  // namespace forceshade::reference::meshes
