// SPDX-License-Identifier: BSD-3-Clause
#include "fast/soups/force.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "fast/damping/limits.h"
#include "fast/numbers/ball.h"

namespace forceshade::fast::soups {
namespace {

using Side = Star::Side;

// A binary32 number; integers count 2^-149.
template <class N>
N single(float value) {
  if constexpr (std::is_same_v<N, Ball>) {
    return Ball::exactly(static_cast<double>(value));
  } else {
    int exponent = 0;
    const auto significand = static_cast<std::int64_t>(std::ldexp(std::frexp(static_cast<double>(value), &exponent), 24));
    const int shift = exponent - 24 + 149;
    return shift >= 0 ? Whole::scaled(significand, shift) : Whole(significand / (std::int64_t{1} << -shift));  // zeros
  }
}
template <class N>
Vector3<N> corner_normal(const mesh::Normal& n) {
  return {single<N>(n[0]), single<N>(n[1]), single<N>(n[2])};
}

Sign named(int sign) {
  return sign < 0 ? Sign::negative : sign == 0 ? Sign::zero : Sign::positive;
}

// A binary64 number: significand·2^exponent.
struct Binary {
  std::int64_t significand;
  int exponent;
};
Binary binary(double value) {
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  return {static_cast<std::int64_t>(std::ldexp(fraction, 53)), exponent - 53};
}

std::optional<float> rounded(const Ball& value) {
  const auto low = static_cast<float>(value.value - value.error), high = static_cast<float>(value.value + value.error);
  if (!(low == high)) return {};
  return low + 0.0F;
}

// The binary32 nearest to a length in mm².
float nearest_length(const Face& f) {
  const Ball square = squared(normal<Ball>(f));
  const double about = std::sqrt(square.value);
  if (const auto sure = rounded(Ball::rounded(about, square.error / about))) return *sure;
  const Whole exact = squared(normal<Whole>(f));  // in units of 2^-212 mm^4
  return *round_to_binary32(about, [&](double tie) {
    if (tie < 0) return Sign::positive;
    const Binary its = binary(tie);
    const Whole bound = Whole(its.significand) * Whole(its.significand);
    const int shift = 2 * its.exponent + 4 * kUnitBits;
    return named(shift >= 0 ? (exact - bound.shifted(shift)).sign() : (exact.shifted(-shift) - bound).sign());
  });
}

// N, times a positive number.
struct Shade {
  enum class Kind { none, corner, triangle, crease };

  Kind kind = Kind::none;
  int sign = 1, sign_h = 1;
  const Face *f = nullptr, *h = nullptr;
  const std::array<mesh::Normal, 3>*of_f = nullptr, *of_h = nullptr;
  std::size_t corner = 0;
  float length_f = 0, length_h = 0;
};

// r - q and q - p, or r - p: over w.
template <class N>
struct Lengths {
  Vector3<N> pressing;
  N pressing_w;
  Vector3<N> held;
  N held_w;
};

class Forces {
 public:
  Forces(const Soup& soup, const At& r, const Point& p, const Point* q) : soup_(soup), r_(r), p_(p), q_(q) {}

  template <class N>
  Lengths<N> lengths() const {
    const Scaled<N>&r = r_.x.get<N>(), &p = p_.get<N>();
    if (q_ == nullptr) return {r.x - r.w * p.x, r.w, {}, N::of(1)};
    const Scaled<N>& q = q_->get<N>();
    return {q.x - q.w * p.x, q.w, q.w * r.x - r.w * q.x, q.w * r.w};
  }
  // D and its w.
  template <class N>
  Lengths<N> whole() const {
    const Scaled<N>&r = r_.x.get<N>(), &p = p_.get<N>();
    return {r.x - r.w * p.x, r.w, {}, N::of(1)};
  }

  Shade shade() const {
    Shade its = r_.star->kind() == Star::Kind::point  ? at_vertex()
                : r_.star->kind() == Star::Kind::line ? on_line()
                                                      : in_plane();
    if (its.kind != Shade::Kind::none && sign_of([&]<class N>() { return dot(direction<N>(its), lengths<N>().pressing); }) <= 0)
      its.kind = Shade::Kind::none;
    return its;
  }

  template <class N>
  Vector3<N> direction(const Shade& its) const {
    switch (its.kind) {
      case Shade::Kind::none: return {};
      case Shade::Kind::corner: return signed_by(its.sign, corner_normal<N>((*its.of_f)[its.corner]));
      case Shade::Kind::triangle: return signed_by(its.sign, interpolated<N>(*its.f, *its.of_f));
      case Shade::Kind::crease: break;
    }
    const Vector3<N> n_1 = signed_by(its.sign, normal<N>(*its.f)), n_2 = signed_by(its.sign_h, normal<N>(*its.h)),
                     turn = cross(n_1, n_2), d = lengths<N>().pressing;
    const N alpha = dot(cross(d, n_2), turn), beta = dot(cross(n_1, d), turn);
    return alpha * single<N>(its.length_f) * squared(n_2) * signed_by(its.sign, interpolated<N>(*its.f, *its.of_f)) +
           beta * single<N>(its.length_h) * squared(n_1) * signed_by(its.sign_h, interpolated<N>(*its.h, *its.of_h));
  }

 private:
  template <class N>
  Vector3<N> interpolated(const Face& f, const std::array<mesh::Normal, 3>& normals) const {
    return inside<N>(f, 1, r_.x) * corner_normal<N>(normals[0]) + inside<N>(f, 2, r_.x) * corner_normal<N>(normals[1]) +
           inside<N>(f, 0, r_.x) * corner_normal<N>(normals[2]);
  }
  // The first two of the cell; it returns how many there are.
  std::size_t walls(std::array<Side, 2>& first) const {
    std::size_t count = 0;
    r_.star->for_sides(r_.cell, [&](const Side& side) {
      if (!r_.star->is_wall(side)) return;
      if (count < 2) first[count] = side;
      ++count;
    });
    return count;
  }
  static int seen(const Star::Held& held, const Side& side) { return held.is_flipped == side.is_above ? -1 : 1; }

  Shade in_plane() const {
    std::array<Side, 2> sides{};
    if (walls(sides) == 0) return {};
    const Star::Held& held = r_.star->blocking(sides[0]);
    return {Shade::Kind::triangle, seen(held, sides[0]), 1, held.face, nullptr, soup_.normals(*held.face), nullptr};
  }

  // Two triangles alone, whose common edge runs in opposite directions.
  bool is_regular(const Face& f, const Face& h, bool& have_same_normals) const {
    if (r_.star->triangles().size() != 2) return false;
    std::size_t count = 0;
    std::array<std::size_t, 3> in_f{}, in_h{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        if (f.vertex[i] == h.vertex[j] && count < 3) in_f[count] = i, in_h[count++] = j;
    if (count != 2) return false;
    const auto follows = [](std::size_t i, std::size_t j) { return (i + 1) % 3 == j; };
    have_same_normals = true;
    for (std::size_t k = 0; k < 2; ++k)
      have_same_normals = have_same_normals && (*soup_.normals(f))[in_f[k]] == (*soup_.normals(h))[in_h[k]];
    return follows(in_f[0], in_f[1]) != follows(in_h[0], in_h[1]);
  }

  Shade on_line() const {
    std::array<Side, 2> sides{};
    if (walls(sides) != 2) return {};
    const Star::Held &one = r_.star->blocking(sides[0]), &other = r_.star->blocking(sides[1]);
    const Face &f = *one.face, &h = *other.face;
    Shade its{Shade::Kind::triangle, seen(one, sides[0]), seen(other, sides[1]), &f, &h, soup_.normals(f), soup_.normals(h)};
    bool have_same_normals = false;
    if (is_regular(f, h, have_same_normals) && have_same_normals) return its;
    its.kind = Shade::Kind::crease;
    if (one.plane == other.plane) return {};
    const auto normals = [&]<class N>() {
      return std::array{signed_by(its.sign, normal<N>(f)), signed_by(its.sign_h, normal<N>(h)), lengths<N>().pressing};
    };
    const auto sign = [&](const auto& value) {
      return sign_of([&]<class N>() {
        const auto [n_1, n_2, d] = normals.template operator()<N>();
        return value(n_1, n_2, d);
      });
    };
    if (sign([](const auto& a, const auto& b, const auto& d) { return dot(cross(a, b), d); }) != 0 ||
        sign([](const auto& a, const auto& b, const auto& d) { return dot(cross(d, b), cross(a, b)); }) < 0 ||
        sign([](const auto& a, const auto& b, const auto& d) { return dot(cross(a, d), cross(a, b)); }) < 0)
      return {};
    its.length_f = nearest_length(f);
    its.length_h = nearest_length(h);
    return its;
  }

  // Only if all triangles have one normal at this vertex, and nothing else passes.
  Shade at_vertex() const {
    Shade its;
    for (const Star::Held& held : r_.star->triangles()) {
      std::size_t corner = 0;
      while (corner < 3 && !(held.has_side(corner) && held.has_side(corner == 0 ? 2 : corner - 1))) ++corner;
      if (corner == 3) return {};
      const std::array<mesh::Normal, 3>* const normals = soup_.normals(*held.face);
      if (its.of_f != nullptr && (*its.of_f)[its.corner] != (*normals)[corner]) return {};
      its.of_f = normals;
      its.corner = corner;
    }
    std::array<Side, 2> sides{};
    if (!r_.star->is_one_part() || walls(sides) == 0) return {};
    its.kind = Shade::Kind::corner;
    its.sign = r_.star->name(r_.cell).is_behind ? -1 : 1;
    return its;
  }

  const Soup& soup_;
  const At& r_;
  const Point& p_;
  const Point* q_;
};

// K over/under, a length.
float rounded_quotient(const Whole& over, const Whole& under, double K) {
  if (over.is_zero()) return 0;
  const Ball value = ball_of(over, under) * Ball::exactly(K);
  if (const auto sure = rounded(value)) return *sure;
  const Binary stiffness = binary(K);
  const Whole size = Whole(stiffness.significand) * over;
  return *round_to_binary32(value.value, [&](double tie) {
    const Binary its = binary(tie);
    const Whole bound = Whole(its.significand) * under;
    const int shift = stiffness.exponent - kUnitBits - its.exponent;
    return named(shift >= 0 ? (size.shifted(shift) - bound).sign() : (size - bound.shifted(-shift)).sign());
  });
}

}  // namespace

std::array<float, 3> force_at(const Soup& soup, const At& r, const Point& p, const Point* q, float stiffness, bool is_shaded) {
  float largest = 0;
  for (const Star::Held& held : r.star->triangles()) largest = std::max(largest, soup.stiffness(*held.face, stiffness));
  const auto K = static_cast<double>(largest);
  const Forces forces(soup, r, p, q);
  const Shade shade = is_shaded ? forces.shade() : Shade{};
  if (shade.kind == Shade::Kind::none) {
    const Lengths<Whole> its = forces.whole<Whole>();
    const auto one = [&](const Whole& over) { return rounded_quotient(over, its.pressing_w, K); };
    return {one(its.pressing.x), one(its.pressing.y), one(its.pressing.z)};
  }
  const Vector3<Ball> N = forces.direction<Ball>(shade);
  const Lengths<Ball> about = forces.lengths<Ball>();
  const Ball square = squared(about.pressing) / squared(N);
  const double root = std::sqrt(std::max(square.value, 0.0));
  const Ball factor = root > 0 && std::isfinite(square.error) ? Ball::rounded(root, square.error / root) : Ball{0, HUGE_VAL};
  std::optional<Vector3<Whole>> exact_N;
  std::optional<Lengths<Whole>> exact;
  const auto component = [&](const auto& of) -> float {
    const Ball value = Ball::exactly(K) * (factor * of(N) + of(about.held));
    if (const auto sure = rounded(value)) return *sure;
    if (!exact) {
      exact_N = forces.direction<Whole>(shade);
      exact = forces.lengths<Whole>();
    }
    // K(h/w ± √(d² n²/(v² N²))), with lengths in units of 2^-53 mm.
    const Whole &n = of(*exact_N), &w = exact->held_w, &v = exact->pressing_w;
    const Whole held = of(exact->held);
    if (n.is_zero()) return rounded_quotient(held, w, K);
    const Binary stiffness_of = binary(K);
    const Whole k(stiffness_of.significand), square_N = v * v * squared(*exact_N),
                                             square_root = k * k * squared(exact->pressing) * (n * n) * (w * w);
    const bool is_negative = n.sign() < 0;
    const double guess = K * (static_cast<double>(n.sign()) *
                                  std::ldexp(std::sqrt(ratio(squared(exact->pressing) * (n * n), square_N)), -kUnitBits) +
                              std::ldexp(ratio(held, w), -kUnitBits));
    const auto found = round_to_binary32(guess, [&](double tie) {
      const Binary its = binary(tie);
      const int of_length = stiffness_of.exponent - kUnitBits, least = std::min(of_length, its.exponent);
      const Whole rest = (Whole(its.significand) * w).shifted(its.exponent - least) - (k * held).shifted(of_length - least);
      // The sign of the root less rest/w.
      if (rest.sign() == 0) return named(n.sign());
      if ((rest.sign() < 0) != is_negative) return named(-rest.sign());
      const int farther = (square_root.shifted(2 * (of_length - least)) - rest * rest * square_N).sign();
      return named(is_negative ? -farther : farther);
    });
    return found.value_or(0.0F);
  };
  return {component([](const auto& v) -> const auto& { return v.x; }),
          component([](const auto& v) -> const auto& { return v.y; }),
          component([](const auto& v) -> const auto& { return v.z; })};
}

damping::Limits damping_at(const Soup& soup, const At& r) {
  damping::Limits largest{0, 0};
  for (const Star::Held& held : r.star->triangles()) largest = larger_limits(largest, soup.damping(*held.face));
  return largest;
}

}  // namespace forceshade::fast::soups
