// SPDX-License-Identifier: BSD-3-Clause
#include "fast/meshes/force.h"

#include <optional>

#include "fast/meshes/schemes/all.h"
#include "fast/numbers/arithmetic.h"

namespace forceshade::fast {
namespace {

using namespace meshes;  // all that a shaded force is made of

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
[[gnu::noinline]] Force3 exact_unshaded(const Mesh& mesh, const Arrival& arrival, const HandAndGoal& ends, double K,
                                        bool is_filtered, Stage& last) noexcept {
  raise(last, Stage::wide);
  const auto rounded = [&](const auto& vector, const auto& length) -> Force3 {
    return {rounded_quotient(vector.x, length, K, is_filtered), rounded_quotient(vector.y, length, K, is_filtered),
            rounded_quotient(vector.z, length, K, is_filtered)};
  };
  // vector/length is r less the goal.
  const auto rounded_past_goal = [&](const auto& vector, const auto& length) -> Force3 {
    if (ends.are_one()) [[likely]]
      return rounded(vector, length);
    const ExactDifference past = exact_difference(ends.goal(), ends.hand());
    using Sum = decltype(vector.x + length * past.x);
    return rounded(Vector3<Sum>{vector.x + length * past.x, vector.y + length * past.y, vector.z + length * past.z}, length);
  };
  const GridPoint& grid_point = arrival.grid_point;
  if (arrival.rest == RestKind::in_triangle) {
    const Face& f = mesh.face(face_of(grid_point.half));
    const auto n = ExactFace(f).n;
    const auto across = -dot(n, exact_difference(ends.goal(), f.corner[0].data()));
    return rounded_past_goal(Vector3<decltype(across * n.x)>{across * n.x, across * n.y, across * n.z}, square(n));
  }
  if (arrival.rest == RestKind::on_edge) {
    const float* const start = mesh.start_point(grid_point.half);
    const ExactDifference e = exact_difference(mesh.start_point(next(grid_point.half)), start);
    return rounded_past_goal(cross(e, cross(e, exact_difference(ends.goal(), start))), square(e));
  }
  if (arrival.rest == RestKind::at_goal)
    return rounded(exact_difference(ends.goal(), ends.hand()), FixedInteger<26>(std::int64_t{1}));
  const ExactOffset U = exact_offset_from(point_of(mesh, grid_point), ends.hand());
  return rounded(ExactOffset{-U.x, -U.y, -U.z}, FixedInteger<26>(std::int64_t{kGrid}));
}

bool is_zero(const DoubleWithError& a) noexcept {
  return sign(a) == Sign::zero;
}

// The shaded force with the numbers N; empty where they cannot decide it.
template <class N, bool kIsFromIntegers = false>
std::optional<Force3> shaded_force(const Mesh& mesh, const Arrival& arrival, const HandAndGoal& ends, double K,
                                   mesh::Shading scheme, Stage& last) noexcept {
  const RestNumbers<N, kIsFromIntegers> numbers(mesh, arrival, ends);
  const bool is_pulled = numbers.is_pulled();
  const Way3<N> way = is_pulled ? numbers.way_of_pressure() : numbers.way();
  const ShadingDirection<N> shading = shading_direction(scheme, numbers, way, last);
  if (shading.outcome == ShadingOutcome::unknown) return std::nullopt;
  if (shading.outcome == ShadingOutcome::none) return exact_unshaded(mesh, arrival, ends, K, true, last);
  if (is_pulled) {
    if (const auto force = along_and(way, shading.direction, numbers.way_of_pull(), K)) return force;
  } else if (const auto force = along(way, shading.direction, K)) {
    return force;
  }
  // On flat parts the shading direction often is the way's own, and ties are as common as without shading.
  if constexpr (kIsFromIntegers) {
    const auto aside = cross(way.vector, shading.direction);
    if (is_zero(aside.x) && is_zero(aside.y) && is_zero(aside.z)) return exact_unshaded(mesh, arrival, ends, K, true, last);
  }
  return std::nullopt;
}

// Both kept out of line: they are reached for few positions.
[[gnu::noinline]] std::optional<Force3> shaded_force_from_integers(const Mesh& mesh, const Arrival& arrival,
                                                                   const HandAndGoal& ends, double K, mesh::Shading scheme,
                                                                   Stage& last) noexcept {
  return shaded_force<DoubleWithError, true>(mesh, arrival, ends, K, scheme, last);
}
[[gnu::noinline]] std::optional<Force3> shaded_force_in_wide_numbers(const Mesh& mesh, const Arrival& arrival,
                                                                     const HandAndGoal& ends, double K, mesh::Shading scheme,
                                                                     Stage& last) noexcept {
  return shaded_force<Shaded>(mesh, arrival, ends, K, scheme, last);
}

// The unshaded force in binary64; empty where that cannot decide it. A component that is 0 because the edge is parallel to an
// axis is 0 here too.
[[gnu::noinline]] std::optional<Force3> unshaded_force(const Mesh& mesh, const Arrival& arrival, const HandAndGoal& ends,
                                                       double K) noexcept {
  const auto way = RestNumbers<DoubleWithError>(mesh, arrival, ends).way();
  const DoubleWithError factor = DoubleWithError::exactly(K) / way.length;
  return each([&](const DoubleWithError& one) { return round_to_binary32(factor * one); }, way.vector);
}

// True if a component of the triangle's normal is surely 0, as it is wherever the triangle, seen along that axis, is on a line
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
  // The factor's error, from those of n·w and n·n, and three roundings. Then that of a component.
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

// From 2^24(p - r) at a rest that friction holds, each component to `error`; where that is 0, as offset_from() computes it: to
// 2^-53 of its size and 2^-63; as it is a multiple of 2^-53, a component that is computed as 0 is 0 then.
FORCESHADE_INLINE bool is_sure_at_grid_point(const Vector3<double>& U, double error, double K, Force3& force) noexcept {
  bool is_sure = true;
  const double fixed = 0x1p-24 * K * (error + 0x1p-62);
  const auto component = [&](double along) FORCESHADE_INLINE_BODY -> float {
    if (along == 0 && error == 0) return 0;
    const double value = -0x1p-24 * K * along, reach = fixed + 0x1p-50 * __builtin_fabs(value);
    const auto low = static_cast<float>(value - reach), high = static_cast<float>(value + reach);
    is_sure = is_sure && low == high;
    return low + 0.0F;
  };
  force = {component(U.x), component(U.y), component(U.z)};
  return is_sure;
}
[[gnu::noinline]] std::optional<Force3> force_from_offset(const Mesh& mesh, const Arrival& arrival, const HandAndGoal& ends,
                                                          double K) noexcept {
  Force3 force;
  if (!is_sure_at_grid_point(offset_from(point_of(mesh, arrival.grid_point), ends.hand(), 0).U, 0, K, force))
    return std::nullopt;
  return force;
}
FORCESHADE_INLINE std::optional<Force3> quick_force_at_grid_point(const Mesh& mesh, const Arrival& arrival,
                                                                  const HandAndGoal& ends, double K) noexcept {
  Force3 force;
  if (is_sure_at_grid_point(arrival.to_hand.U, arrival.error_to_hand, K, force)) [[likely]]
    return force;
  if (arrival.error_to_hand == 0) return std::nullopt;
  return force_from_offset(mesh, arrival, ends, K);
}

// The unshaded force in binary64, by the shortest way for each kind of rest.
FORCESHADE_INLINE std::optional<Force3> force_in_binary64(const Mesh& mesh, const Arrival& arrival, const HandAndGoal& ends,
                                                          double K) noexcept {
  if (ends.are_one()) {
    if (arrival.rest == RestKind::in_triangle)
      return quick_force(mesh.face(face_of(arrival.grid_point.half)), arrival.plane, K);
    if (arrival.rest == RestKind::at_grid_point && arrival.to_hand.size > 0)
      return quick_force_at_grid_point(mesh, arrival, ends, K);
  }
  return unshaded_force(mesh, arrival, ends, K);
}

}  // namespace

std::optional<std::array<float, 3>> mesh_force(const Mesh& mesh, const Arrival& arrival, const HandAndGoal& ends,
                                               float stiffness, mesh::Shading shading, bool is_filtered,
                                               ForceDecision* decided) noexcept {
  ForceDecision ignored;
  ForceDecision& by = decided != nullptr ? *decided : ignored;
  by = {};
  if (arrival.rest == RestKind::none || (arrival.rest == RestKind::at_goal && ends.are_one())) return Force3{};
  const auto K = static_cast<double>(stiffness);
  if (shading == mesh::Shading::none) {
    if (is_filtered)
      if (const auto force = force_in_binary64(mesh, arrival, ends, K)) [[likely]]
        return *force;
    return exact_unshaded(mesh, arrival, ends, K, is_filtered, by.last);
  }
  if (is_filtered) {
    by.numbers = ForceStage::binary64;
    if (const auto force = shaded_force<DoubleWithError>(mesh, arrival, ends, K, shading, by.last)) [[likely]]
      return *force;
    raise(by.last, Stage::wide);
    by.numbers = ForceStage::from_integers;
    if (const auto force = shaded_force_from_integers(mesh, arrival, ends, K, shading, by.last)) return *force;
  }
  raise(by.last, Stage::wide);
  by.numbers = ForceStage::wide;
  return shaded_force_in_wide_numbers(mesh, arrival, ends, K, shading, by.last);
}

const char* force_arithmetic_fault() noexcept {
  return arithmetic_fault_here();
}

}  // namespace forceshade::fast
