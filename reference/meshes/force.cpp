// SPDX-License-Identifier: BSD-3-Clause
#include "reference/meshes/force.h"

#include <mutex>

#include "reference/meshes/rounding.h"
#include "reference/numbers/decimal.h"

namespace forceshade::reference::meshes {
namespace {

// The direction as the hand sees it; none where the force is not turned to it.
Direction turned(const Direction& seen_from_front, const Rest& rest) {
  if (!seen_from_front) return std::nullopt;
  const Vector N = rest.side == mesh::Side::back ? -*seen_from_front : *seen_from_front;
  return dot(N, rest.D_over) <= 0 ? std::nullopt : Direction(N);
}

// The square of a component is K² |D|² N_i² / |N|², and K² D_i² where the force is not turned.
std::array<Root, 3> roots_of(const Direction& to, const Rest& rest, float stiffness) {
  const Vector& N = to ? *to : rest.D_over;
  const Integer K = integer_of(stiffness, kFloatScale);
  const Integer size_over = to ? Integer(K * K * dot(rest.D_over, rest.D_over)) : Integer(K * K);
  const Integer under = rest.D_under * rest.D_under * (to ? dot(N, N) : Integer(1));
  std::array<Root, 3> roots;
  for (std::size_t axis = 0; axis < 3; ++axis)
    roots[axis] = {N[axis] < 0, {size_over * N[axis] * N[axis], under}, -kFloatScale - kLengthScale};
  return roots;
}

Enclosure enclosed(const Integer& value) {
  Enclosure enclosure;
  mpfi_set_z(enclosure.backend().data(), value.backend().data());
  return enclosure;
}

Integer integer_of(const CORE::BigInt& value) {
  return Integer(value.get_mp());
}

// The sign of the root less a rational number.
int compared(const Root& root, const CORE::BigRat& with) {
  const int sign = root.square.over.is_zero() ? 0 : root.is_negative ? -1 : 1;
  if (sign != CGAL::sign(with) || sign == 0) return sign - CGAL::sign(with) > 0 ? 1 : sign - CGAL::sign(with) < 0 ? -1 : 0;
  const Integer over = integer_of(numerator(with)), under = integer_of(denominator(with));
  // square 4^exponent against over² / under², of which the exponent, which is negative, goes to the right.
  const Integer left = root.square.over * under * under;
  const Integer right = (over * over * root.square.under) << static_cast<unsigned>(-2 * root.exponent);
  return sign * left.compare(right);
}

}  // namespace

std::array<float, 3> unshaded_force(const Rest& rest, float stiffness) {
  const Integer K = integer_of(stiffness, kFloatScale);
  std::array<float, 3> force{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    force[axis] = nearest_binary32({K * rest.D_over[axis], rest.D_under}, -kFloatScale - kLengthScale);
  return force;
}

std::array<float, 3> shaded_force(const Direction& seen_from_front, const Rest& rest, float stiffness) {
  const Direction to = turned(seen_from_front, rest);
  if (!to) return unshaded_force(rest, stiffness);
  std::array<float, 3> force{};
  const std::array<Root, 3> roots = roots_of(to, rest, stiffness);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float size = nearest_binary32_root(roots[axis].square, roots[axis].exponent);
    force[axis] = roots[axis].is_negative && size != 0 ? -size : size;
  }
  return force;
}

std::array<Root, 3> exact_force(const Direction& seen_from_front, const Rest& rest, float stiffness) {
  return roots_of(turned(seen_from_front, rest), rest, stiffness);
}

std::string decimal(const Root& root, unsigned digits) {
  const std::lock_guard lock(exact_arithmetic);
  const auto enclose = [&] {
    const Enclosure size = sqrt(enclosed(root.square.over) / enclosed(root.square.under)) * ldexp(Enclosure(1), root.exponent);
    return root.is_negative ? Enclosure(-size) : size;
  };
  return correctly_rounded(digits, enclose, [&](const CORE::BigRat& with) { return compared(root, with); });
}

}  // namespace forceshade::reference::meshes
