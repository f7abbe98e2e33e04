// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/fast/meshes/force.h"

#include <optional>
#include <type_traits>

#include "forceshade/fast/height_map_field.h"
#include "forceshade/fast/meshes/bit_span.h"
#include "forceshade/fast/meshes/bounded_vector3.h"
#include "forceshade/fast/numbers/arithmetic.h"
#include "forceshade/fast/numbers/big_float_ball.h"

namespace forceshade::fast {
namespace {

// Exact, because no expression takes more bits than these have.
constexpr std::size_t kShadedLimbs = 64;
using Shaded = BigFloatBall<kShadedLimbs>;
static_assert(most_bits_of_shaded_force() <= static_cast<int>(64 * kShadedLimbs));

// r - p = vector/length, length > 0.
template <class N>
struct Way3 {
  Vector3<N> vector;
  N length;
};

template <class N>
FORCESHADE_INLINE Vector3<N> point(const float* a) noexcept {
  return {N::exactly(static_cast<double>(a[0])), N::exactly(static_cast<double>(a[1])), N::exactly(static_cast<double>(a[2]))};
}
template <class N>
FORCESHADE_INLINE Vector3<N> scaled(const N& factor, const Vector3<N>& a) noexcept {
  return {factor * a.x, factor * a.y, factor * a.z};
}
template <class N>
FORCESHADE_INLINE Vector3<N> sum(const Vector3<N>& a, const Vector3<N>& b) noexcept {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class N>
FORCESHADE_INLINE Vector3<N> opposite(const Vector3<N>& a) noexcept {
  return {-a.x, -a.y, -a.z};
}
template <class N>
N whole(std::uint32_t value) noexcept {
  return N::exactly(static_cast<double>(value));
}

using Force3 = std::array<float, 3>;

// K times the length of `way` along the direction, which is not 0: each component correctly rounded, or empty.
std::optional<Force3> along(const Way3<DoubleWithError>& way, const Vector3<DoubleWithError>& direction, double K) noexcept;
std::optional<Force3> along(const Way3<Shaded>& way, const Vector3<Shaded>& direction, double K) noexcept;

// An exact number of units of `unit`, a power of two, in binary64.
template <int kBits>
DoubleWithError near(const FixedInteger<kBits>& number, double unit) noexcept {
  const double value = unit * number.approximately();
  return {value, 0x1p-51 * __builtin_fabs(value)};
}
template <class T>
Vector3<DoubleWithError> near(const Vector3<T>& a, double unit) noexcept {
  return {near(a.x, unit), near(a.y, unit), near(a.z, unit)};
}
constexpr double kUnit = 0x1p-53;  // mm, of coordinates; of products of two, three and four of them:
constexpr double kUnit2 = kUnit * kUnit, kUnit3 = kUnit2 * kUnit, kUnit4 = kUnit2 * kUnit2;

// The binary32 nearest to over/under, and to √over/under; 0 < under, 0 <= over under a root. Empty where these numbers do not
// decide.
std::optional<float> nearest_quotient(const DoubleWithError& over, const DoubleWithError& under) noexcept {
  const DoubleWithError value = over / under;
  // A coordinate as small as this is read as 0.
  if (__builtin_fabs(value.value) + value.error < 0x1p-31) return 0.0F;
  return round_to_binary32(value);
}
std::optional<float> nearest_quotient(const Shaded& over, const Shaded& under) noexcept {
  using Short = BigFloatBall<4>;
  return round_to_binary32(approximately(Short(over) / Short(under)),
                           [&](double tie) { return proved_sign(over - Shaded::exactly(tie) * under); });
}
std::optional<float> nearest_root(const DoubleWithError& over, const DoubleWithError& under) noexcept {
  // As in along(); 0 itself is exact.
  if (!(over.value > 0x1p-600) && sign(over) != Sign::zero) return std::nullopt;
  return round_to_binary32(square_root(over) / under);
}
std::optional<float> nearest_root(const Shaded& over, const Shaded& under) noexcept {
  using Short = BigFloatBall<4>;
  return round_to_binary32(approximately(square_root(Short(over)) / Short(under)), [&](double tie) {
    if (tie < 0) return Sign::positive;
    const Shaded bound = Shaded::exactly(tie) * under;
    return proved_sign(over - bound * bound);
  });
}

// What a rest's force is made of, in the numbers N. kIsFromIntegers: what cancels is computed in integers first, so that each
// number is good to a few units of its last place, and 0 where it is 0.
template <class N, bool kIsFromIntegers = false>
class Parts {
 public:
  // slopes: raised to the stage of each slope of a texture.
  Parts(const Mesh& mesh, const Arrival& arrival, const float* p, mesh::Shading scheme, Stage& slopes) noexcept
      : mesh_(mesh),
        scheme_(scheme),
        spot_(arrival.spot),
        rest_(arrival.rest),
        position_(p),
        p_(point<N>(p)),
        stage_of_slopes_(slopes) {}

  Way3<N> way() const noexcept {
    switch (rest_) {
      case Rest::in_triangle: {
        const Face& f = mesh_.face(face_of(spot_.half));
        const Vector3<N> n = normal(f);
        if constexpr (kIsFromIntegers) {
          const auto exact = ExactFace(f).n;
          return {scaled(-near(dot(exact, exact_difference(position_, f.corner[0].data())), kUnit3), n),
                  near(square(exact), kUnit4)};
        } else {
          return {scaled(-dot(n, p_ - point<N>(f.corner[0].data())), n), square(n)};
        }
      }
      case Rest::on_edge: {
        if constexpr (kIsFromIntegers) {
          const ExactDifference e = exact_edge(), w = exact_difference(position_, mesh_.start_point(spot_.half));
          return {near(cross(e, cross(e, w)), kUnit3), near(square(e), kUnit2)};
        } else {
          const Vector3<N> e = edge(), w = p_ - start();
          return {cross(e, cross(e, w)), square(e)};
        }
      }
      default: {
        const Point g = point_of(mesh_, spot_);
        if constexpr (kIsFromIntegers) return {opposite(near(exact_offset_from(g, position_), kUnit)), N::exactly(0x1p24)};
        Vector3<N> to = scaled(whole<N>(g.weight[0]), point<N>(g.corner[0]) - p_);
        for (std::size_t c = 1; c < static_cast<std::size_t>(g.count); ++c)
          to = sum(to, scaled(whole<N>(g.weight[c]), point<N>(g.corner[c]) - p_));
        return {to, N::exactly(0x1p24)};
      }
    }
  }

  // The shading direction times a positive number. `none`: the unshaded one; `unknown`: these numbers cannot decide it.
  enum class Outcome { direction, none, unknown };
  struct Shading {
    Outcome outcome;
    Vector3<N> direction;
  };
  Shading shading(const Way3<N>& way) const noexcept {
    const Shading found = outward(way);
    if (found.outcome != Outcome::direction) return found;
    const Sign along = proved_sign(dot(found.direction, way.vector));
    if (along == Sign::unknown) return {Outcome::unknown, {}};
    return along == Sign::positive ? found : Shading{Outcome::none, {}};
  }

 private:
  Vector3<N> normal(const Face& f) const noexcept {
    if constexpr (kIsFromIntegers) return near(ExactFace(f).n, kUnit2);
    const Vector3<N> a = point<N>(f.corner[0].data());
    return cross(point<N>(f.corner[1].data()) - a, point<N>(f.corner[2].data()) - a);
  }
  ExactDifference exact_edge() const noexcept {
    return exact_difference(mesh_.start_point(next(spot_.half)), mesh_.start_point(spot_.half));
  }
  Vector3<N> start() const noexcept { return point<N>(mesh_.start_point(spot_.half)); }
  Vector3<N> edge() const noexcept { return point<N>(mesh_.start_point(next(spot_.half))) - start(); }
  const mesh::Normal& normal_at(HalfEdge h) const noexcept { return (*mesh_.normals(face_of(h)))[corner_of(h)]; }

  Shading from_its_side(const Vector3<N>& direction) const noexcept {
    return {Outcome::direction, spot_.side == mesh::Side::front ? direction : opposite(direction)};
  }

  // The edge scheme as the thesis prints it, inside triangles: corner i is opposite to side i.
  Shading by_edges() const noexcept {
    const std::uint32_t f = face_of(spot_.half);
    const auto unit_normal = [&](std::uint32_t of) -> std::optional<Vector3<N>> {
      const Vector3<N> x_axis{N::exactly(1), N::exactly(0), N::exactly(0)};
      const auto rounded = along(Way3<N>{x_axis, N::exactly(1)}, normal(mesh_.face(of)), 1);
      if (!rounded) return std::nullopt;
      return point<N>(rounded->data());
    };
    const auto own = unit_normal(f);
    if (!own) return {Outcome::unknown, {}};
    const std::array<N, 3> weight = weights_in_triangle();
    std::array<Vector3<N>, 3> with_neighbour;
    std::array<N, 3> side;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const HalfEdge h = 3 * f + after(i), other = mesh_.twin(h);
      const auto neighbour = other == kRim ? own : unit_normal(face_of(other));
      const auto size = length(point<N>(mesh_.start_point(next(h))) - point<N>(mesh_.start_point(h)));
      if (!neighbour || !size) return {Outcome::unknown, {}};
      with_neighbour[i] = sum(*own, *neighbour);
      side[i] = N::exactly(static_cast<double>(*size));
    }
    // x_i = weight/side, times all three sides.
    Vector3<N> direction = scaled(weight[0] * (side[1] * side[2]), sum(with_neighbour[1], with_neighbour[2]));
    direction = sum(direction, scaled(weight[1] * (side[0] * side[2]), sum(with_neighbour[0], with_neighbour[2])));
    direction = sum(direction, scaled(weight[2] * (side[0] * side[1]), sum(with_neighbour[0], with_neighbour[1])));
    bool is_zero = true;
    for (const N& component : {direction.x, direction.y, direction.z}) {
      const Sign sign = proved_sign(component);
      is_zero = is_zero && sign == Sign::zero;
      if (sign == Sign::positive || sign == Sign::negative) return from_its_side(direction);
    }
    return is_zero ? from_its_side(*own) : Shading{Outcome::unknown, {}};
  }

  Shading outward(const Way3<N>& way) const noexcept {
    if (scheme_ == mesh::Shading::edge_scheme)
      return spot_.place == mesh::Place::triangle ? by_edges() : Shading{Outcome::none, {}};
    if (spot_.place == mesh::Place::vertex) {
      const HalfEdge first = mesh_.first_around(mesh_.start(spot_.half));
      for (HalfEdge h = mesh_.around(first); h != kRim && h != first; h = mesh_.around(h))
        if (!are_same_corners(h, first)) return {Outcome::none, {}};
      return shaded_by(interpolated<1>({first}, {N::exactly(1)}));
    }
    if (spot_.place == mesh::Place::triangle) {
      const HalfEdge h = spot_.half;
      return shaded_by(interpolated<3>({h, h + 1, h + 2}, weights_in_triangle()));
    }
    const HalfEdge other = mesh_.twin(spot_.half);
    const std::array<N, 2> weight = weights_on_edge();
    const std::array<HalfEdge, 2> ends{spot_.half, next(spot_.half)}, beyond{next(other), other};
    if (other == kRim || (are_same_corners(ends[0], beyond[0]) && are_same_corners(ends[1], beyond[1])))
      return shaded_by(interpolated<2>(ends, weight));
    // D = α n1 + β n2, α and β of the side's sign; they carry it to the direction.
    const Face &first = mesh_.face(face_of(spot_.half)), &second = mesh_.face(face_of(other));
    if (first.edge_angle(corner_of(spot_.half)) == EdgeAngle::flat) return {Outcome::none, {}};
    if (rest_ == Rest::at_spot) {
      const Sign along = proved_sign(dot(way.vector, edge()));
      if (along == Sign::unknown) return {Outcome::unknown, {}};
      if (along != Sign::zero) return {Outcome::none, {}};
    }
    const Vector3<N> n1 = normal(first), n2 = normal(second), axis = cross(n1, n2);
    const N alpha = dot(cross(way.vector, n2), axis), beta = dot(cross(n1, way.vector), axis);
    const Sign against = spot_.side == mesh::Side::front ? Sign::negative : Sign::positive;
    for (const Sign sign : {proved_sign(alpha), proved_sign(beta)}) {
      if (sign == Sign::unknown) return {Outcome::unknown, {}};
      if (sign == against) return {Outcome::none, {}};
    }
    const std::optional<float> q1 = length(n1), q2 = length(n2);
    const auto first_side = interpolated<2>(ends, weight), second_side = interpolated<2>(beyond, weight);
    if (!q1 || !q2 || !first_side || !second_side) return {Outcome::unknown, {}};
    return {Outcome::direction, sum(scaled(alpha * N::exactly(static_cast<double>(*q1)), *first_side),
                                    scaled(beta * N::exactly(static_cast<double>(*q2)), *second_side))};
  }

  Shading shaded_by(const std::optional<Vector3<N>>& direction) const noexcept {
    return direction ? from_its_side(*direction) : Shading{Outcome::unknown, {}};
  }

  bool is_textured() const noexcept { return scheme_ == mesh::Shading::texture_scheme; }
  const mesh::CornerTexture& texture_at(HalfEdge h) const noexcept { return (*mesh_.texture(face_of(h)))[corner_of(h)]; }
  bool are_same_corners(HalfEdge a, HalfEdge b) const noexcept {
    return normal_at(a) == normal_at(b) && (!is_textured() || texture_at(a) == texture_at(b));
  }

  // The scheme's N between these corners of a triangle, times the sum of their weights. Empty where these numbers do not
  // decide to what a part of it is rounded.
  template <std::size_t kCount>
  std::optional<Vector3<N>> interpolated(const std::array<HalfEdge, kCount>& corners,
                                         const std::array<N, kCount>& weight) const noexcept {
    const auto mean = [&](const auto& vector_of) {
      if constexpr (kCount == 3) {
        const Vector3<N> first = point<N>(vector_of(corners[0]).data()), second = point<N>(vector_of(corners[1]).data()),
                         third = point<N>(vector_of(corners[2]).data()), weights{weight[0], weight[1], weight[2]};
        return Vector3<N>{dot(weights, Vector3<N>{first.x, second.x, third.x}),
                          dot(weights, Vector3<N>{first.y, second.y, third.y}),
                          dot(weights, Vector3<N>{first.z, second.z, third.z})};
      } else {
        Vector3<N> all = scaled(weight[0], point<N>(vector_of(corners[0]).data()));
        for (std::size_t i = 1; i < kCount; ++i) all = sum(all, scaled(weight[i], point<N>(vector_of(corners[i]).data())));
        return all;
      }
    };
    const Vector3<N> smooth = mean([&](HalfEdge h) -> const mesh::Normal& { return normal_at(h); });
    if (!is_textured()) return smooth;
    N all = weight[0];
    for (std::size_t i = 1; i < kCount; ++i) all = all + weight[i];
    const auto coordinate = [&](std::size_t axis) {
      const auto of = [&](std::size_t i) { return N::exactly(static_cast<double>(texture_at(corners[i]).point[axis])); };
      N over = weight[0] * of(0);
      for (std::size_t i = 1; i < kCount; ++i) over = over + weight[i] * of(i);
      return nearest_quotient(over, all);
    };
    const std::optional<float> x = coordinate(0), y = coordinate(1), size = nearest_root(square(smooth), all);
    if (!x || !y || !size) return std::nullopt;
    const auto slopes = mesh_.texture_map()->slopes(*x, *y);
    if (!slopes) return std::nullopt;
    raise(stage_of_slopes_, slopes->stage);
    const auto tilt = [&](float slope, const Vector3<N>& gradient) {
      return scaled(N::exactly(static_cast<double>(*size) * static_cast<double>(slope)), gradient);  // a product of 48 bits
    };
    const Vector3<N> along_x = mean([&](HalfEdge h) -> const mesh::Normal& { return texture_at(h).gradient_x; }),
                     along_y = mean([&](HalfEdge h) -> const mesh::Normal& { return texture_at(h).gradient_y; });
    return smooth - sum(tilt(slopes->values[0], along_x), tilt(slopes->values[1], along_y));
  }

  // Up to a common factor.
  std::array<N, 3> weights_in_triangle() const noexcept {
    if (rest_ == Rest::at_spot)
      return {whole<N>(kGrid - spot_.weight[0] - spot_.weight[1]), whole<N>(spot_.weight[0]), whole<N>(spot_.weight[1])};
    const Face& f = mesh_.face(face_of(spot_.half));
    if constexpr (kIsFromIntegers) {
      const ExactWeights exact(f, position_);
      return {near(exact.corner[0], kUnit4), near(exact.corner[1], kUnit4), near(exact.corner[2], kUnit4)};
    }
    const Vector3<N> a = point<N>(f.corner[0].data()), n = normal(f), w = p_ - a;
    const N second = dot(cross(w, point<N>(f.corner[2].data()) - a), n),
            third = dot(cross(point<N>(f.corner[1].data()) - a, w), n);
    return {square(n) - (second + third), second, third};
  }
  std::array<N, 2> weights_on_edge() const noexcept {
    if (rest_ == Rest::at_spot) return {whole<N>(kGrid - spot_.weight[0]), whole<N>(spot_.weight[0])};
    if constexpr (kIsFromIntegers) {
      const ExactFoot exact(mesh_.start_point(spot_.half), mesh_.start_point(next(spot_.half)), position_);
      return {near(exact.length - exact.along, kUnit2), near(exact.along, kUnit2)};
    }
    const Vector3<N> e = edge();
    const N along = dot(p_ - start(), e);
    return {square(e) - along, along};
  }

  // The binary32 nearest to n's length.
  std::optional<float> length(const Vector3<N>& n) const noexcept { return nearest_root(square(n), N::exactly(1)); }

  const Mesh& mesh_;
  mesh::Shading scheme_;
  const Spot& spot_;
  Rest rest_;
  const float* position_;
  Vector3<N> p_;
  Stage& stage_of_slopes_;
};

template <class Rounded>
std::optional<Force3> each(const Rounded& rounded, const auto& vector) noexcept {
  const std::optional<float> x = rounded(vector.x), y = rounded(vector.y), z = rounded(vector.z);
  if (!x || !y || !z) return std::nullopt;
  return Force3{*x, *y, *z};
}

// K·num/den·2^-53, den > 0: correctly rounded.
template <int kNum, int kDen>
float rounded_quotient(const FixedInteger<kNum>& num, const FixedInteger<kDen>& den, double K, bool is_filtered) noexcept {
  if (num.is_zero()) return 0;
  // Five operations, each good to 2^-52.
  const double value = K * num.approximately() / den.approximately() * kUnit;
  const double reach = 0x1p-49 * __builtin_fabs(value);
  const auto low = static_cast<float>(value - reach), high = static_cast<float>(value + reach);
  if (is_filtered && low == high) return low + 0.0F;
  int exponent_of_K = 0;
  const auto significand_of_K = static_cast<std::int64_t>(std::ldexp(std::frexp(K, &exponent_of_K), 24));
  const auto size = num * FixedInteger<25>(significand_of_K);
  const auto rounded = round_to_binary32(value, [&](double tie) {
    // A tie has 25 bits.
    const Sign sign = num.is_negative() ? Sign::negative : Sign::positive;
    if (tie == 0 || (tie < 0) != num.is_negative()) return sign;
    int exponent = 0;
    const auto significand = static_cast<std::int64_t>(std::ldexp(std::frexp(std::fabs(tie), &exponent), 25));
    const int beyond = compare_sizes(size, exponent_of_K - 24 - 53 - (exponent - 25), den * FixedInteger<26>(significand));
    if (beyond == 0) return Sign::zero;
    return (beyond > 0) == (sign == Sign::positive) ? Sign::positive : Sign::negative;
  });
  return *rounded;  // the value is within a unit of binary32, so one of its neighbours is the answer
}

// last: as ForceDecision::last.
[[gnu::noinline]] Force3 exact_unshaded(const Mesh& mesh, const Arrival& arrival, const float* p, double K, bool is_filtered,
                                        Stage& last) noexcept {
  raise(last, Stage::wide);
  const auto rounded = [&](const auto& vector, const auto& length) -> Force3 {
    return {rounded_quotient(vector.x, length, K, is_filtered), rounded_quotient(vector.y, length, K, is_filtered),
            rounded_quotient(vector.z, length, K, is_filtered)};
  };
  const Spot& spot = arrival.spot;
  if (arrival.rest == Rest::in_triangle) {
    const Face& f = mesh.face(face_of(spot.half));
    const auto n = ExactFace(f).n;
    const auto across = -dot(n, exact_difference(p, f.corner[0].data()));
    return rounded(Vector3<decltype(across * n.x)>{across * n.x, across * n.y, across * n.z}, square(n));
  }
  if (arrival.rest == Rest::on_edge) {
    const float* const start = mesh.start_point(spot.half);
    const ExactDifference e = exact_difference(mesh.start_point(next(spot.half)), start);
    return rounded(cross(e, cross(e, exact_difference(p, start))), square(e));
  }
  const ExactOffset U = exact_offset_from(point_of(mesh, spot), p);
  return rounded(ExactOffset{-U.x, -U.y, -U.z}, FixedInteger<26>(std::int64_t{kGrid}));
}

std::optional<Force3> along(const Way3<DoubleWithError>& way, const Vector3<DoubleWithError>& direction, double K) noexcept {
  // Far above where the error bounds of small results end: fast/numbers/double_with_error.h.
  const DoubleWithError square_of_way = square(way.vector), square_of_direction = square(direction);
  if (!(square_of_direction.value > 0x1p-600 && square_of_way.value > 0x1p-600)) return std::nullopt;
  const DoubleWithError factor = DoubleWithError::exactly(K) * square_root(square_of_way / square_of_direction) / way.length;
  return each([&](const DoubleWithError& one) { return round_to_binary32(factor * one); }, direction);
}
std::optional<Force3> along(const Way3<Shaded>& way, const Vector3<Shaded>& direction, double K) noexcept {
  using Short = BigFloatBall<4>;
  const Shaded square_of_way = square(way.vector), square_of_direction = square(direction), stiffness = Shaded::exactly(K);
  const Short factor = Short::exactly(K) * square_root(Short(square_of_way) / Short(square_of_direction)) / Short(way.length);
  return each(
      [&](const Shaded& one) -> std::optional<float> {
        // The signs of F and the tie, then those of their squares times the denominator's.
        const Shaded size = stiffness * one, square_of_size = size * size * square_of_way;
        const Sign sign = proved_sign(size);
        if (sign == Sign::unknown) return std::nullopt;
        if (sign == Sign::zero) return 0.0F;
        return round_to_binary32(approximately(factor * Short(one)), [&](double tie) {
          const bool is_positive = sign == Sign::positive;
          if (tie == 0 || (tie > 0) != is_positive) return sign;
          const Shaded bound = Shaded::exactly(tie) * way.length;
          const Sign beyond = proved_sign(square_of_size - bound * bound * square_of_direction);
          if (beyond == Sign::unknown || beyond == Sign::zero) return beyond;
          return (beyond == Sign::positive) == is_positive ? Sign::positive : Sign::negative;
        });
      },
      direction);
}

bool is_zero(const DoubleWithError& a) noexcept {
  return sign(a) == Sign::zero;
}

// The shaded force with the numbers N; empty where they cannot decide it.
template <class N, bool kIsFromIntegers = false>
std::optional<Force3> shaded_force(const Mesh& mesh, const Arrival& arrival, const Force3& p, double K, mesh::Shading scheme,
                                   Stage& last) noexcept {
  using Numbers = Parts<N, kIsFromIntegers>;
  const Numbers parts(mesh, arrival, p.data(), scheme, last);
  const Way3<N> way = parts.way();
  const auto shading = parts.shading(way);
  if (shading.outcome == Numbers::Outcome::unknown) return std::nullopt;
  if (shading.outcome == Numbers::Outcome::none) return exact_unshaded(mesh, arrival, p.data(), K, true, last);
  if (const auto force = along(way, shading.direction, K)) return force;
  // On flat parts the shading direction often is the way's own, and ties are as common as without shading.
  if constexpr (kIsFromIntegers) {
    const auto aside = cross(way.vector, shading.direction);
    if (is_zero(aside.x) && is_zero(aside.y) && is_zero(aside.z)) return exact_unshaded(mesh, arrival, p.data(), K, true, last);
  }
  return std::nullopt;
}

// Both kept out of line: they are reached for few positions.
[[gnu::noinline]] std::optional<Force3> shaded_force_from_integers(const Mesh& mesh, const Arrival& arrival, const Force3& p,
                                                                   double K, mesh::Shading scheme, Stage& last) noexcept {
  return shaded_force<DoubleWithError, true>(mesh, arrival, p, K, scheme, last);
}
[[gnu::noinline]] std::optional<Force3> shaded_force_in_wide_numbers(const Mesh& mesh, const Arrival& arrival, const Force3& p,
                                                                     double K, mesh::Shading scheme, Stage& last) noexcept {
  return shaded_force<Shaded>(mesh, arrival, p, K, scheme, last);
}

// The unshaded force in binary64; empty where that cannot decide it. A component that is 0 because the edge is parallel to an
// axis is 0 here too.
[[gnu::noinline]] std::optional<Force3> unshaded_force(const Mesh& mesh, const Arrival& arrival, const Force3& p,
                                                       double K) noexcept {
  Stage slopes{};  // there are none
  const auto way = Parts<DoubleWithError>(mesh, arrival, p.data(), mesh::Shading::none, slopes).way();
  const DoubleWithError factor = DoubleWithError::exactly(K) / way.length;
  return each([&](const DoubleWithError& one) { return round_to_binary32(factor * one); }, way.vector);
}

// Whether a component of the triangle's normal is surely 0, as it is wherever the triangle, seen along that axis, is on a line
// which is parallel to an axis or has the slope 1. axis_1, axis_2: the other two.
bool is_normal_zero(const Face& f, std::size_t axis_1, std::size_t axis_2) noexcept {
  const auto &a = f.corner[0], &b = f.corner[1], &c = f.corner[2];
  const bool same_1 = a[axis_1] == b[axis_1], same_2 = a[axis_2] == b[axis_2];
  if (same_1 ? same_2 || a[axis_1] == c[axis_1] : same_2 && a[axis_2] == c[axis_2]) return true;
  const auto is_one_place = [&](const auto& of) { return of[axis_1] == c[axis_1] && of[axis_2] == c[axis_2]; };
  if (is_one_place(a) || is_one_place(b)) return true;
  const auto is_diagonal = [&](const auto& of) {
    const TwoTerms along_1 = two_sum(static_cast<double>(of[axis_1]), -static_cast<double>(a[axis_1])),
                   along_2 = two_sum(static_cast<double>(of[axis_2]), -static_cast<double>(a[axis_2]));
    return along_1.hi == along_2.hi && along_1.lo == along_2.lo;
  };
  return is_diagonal(b) && is_diagonal(c);
}

// The unshaded force of a rest in a triangle, the case of nearly every tick: as unshaded_force() with fewer operations.
FORCESHADE_INLINE std::optional<Force3> quick_force(const Face& f, const Plane& plane, double K) noexcept {
  const double all_error = kArea.error * plane.area * plane.area;
  if (!(plane.all > 0x1p20 * all_error)) return std::nullopt;
  const double inverse = 1 / plane.all, factor = K * plane.across * inverse, size = __builtin_fabs(factor);
  // Of the factor: its error, from those of n·w and n·n, and three roundings. Then that of a component.
  const double factor_error =
      (1 + 0x1p-18) * (K * kAcross.error * plane.area * plane.size_w * inverse + size * (all_error * inverse + 0x1p-51));
  const double fixed = (1 + 0x1p-18) * (size + factor_error) * (kNormal.x.error * plane.area),
               relative = (1 + 0x1p-18) * (factor_error + 0x1p-51 * size);
  bool is_sure = true;
  const auto component = [&](double n, std::size_t axis_1, std::size_t axis_2) -> float {
    if (n == 0 && is_normal_zero(f, axis_1, axis_2)) return 0;
    const double value = -factor * n, reach = fixed + __builtin_fabs(n) * relative;
    const auto low = static_cast<float>(value - reach), high = static_cast<float>(value + reach);
    is_sure = is_sure && low == high;
    return low + 0.0F;
  };
  const Force3 force{component(plane.n.x, 1, 2), component(plane.n.y, 2, 0), component(plane.n.z, 0, 1)};
  if (!is_sure) return std::nullopt;
  return force;
}

}  // namespace

std::optional<std::array<float, 3>> mesh_force(const Mesh& mesh, const Arrival& arrival, const std::array<float, 3>& p,
                                               float stiffness, mesh::Shading shading, bool is_filtered,
                                               ForceDecision* decided) noexcept {
  ForceDecision ignored;
  ForceDecision& by = decided != nullptr ? *decided : ignored;
  by = {};
  if (arrival.rest == Rest::none || arrival.rest == Rest::at_position) return Force3{};
  const auto K = static_cast<double>(stiffness);
  if (shading == mesh::Shading::none) {
    if (is_filtered)
      if (const auto force = arrival.rest == Rest::in_triangle
                                 ? quick_force(mesh.face(face_of(arrival.spot.half)), arrival.plane, K)
                                 : unshaded_force(mesh, arrival, p, K)) [[likely]]
        return *force;
    return exact_unshaded(mesh, arrival, p.data(), K, is_filtered, by.last);
  }
  if (is_filtered) {
    by.numbers = ForceStage::binary64;
    if (const auto force = shaded_force<DoubleWithError>(mesh, arrival, p, K, shading, by.last)) [[likely]]
      return *force;
    raise(by.last, Stage::wide);
    by.numbers = ForceStage::from_integers;
    if (const auto force = shaded_force_from_integers(mesh, arrival, p, K, shading, by.last)) return *force;
  }
  raise(by.last, Stage::wide);
  by.numbers = ForceStage::wide;
  return shaded_force_in_wide_numbers(mesh, arrival, p, K, shading, by.last);
}

const char* force_arithmetic_fault() noexcept {
  return arithmetic_fault_here();
}

}  // namespace forceshade::fast
