// SPDX-License-Identifier: BSD-3-Clause
#include "reference/meshes/force.h"

#include <mutex>

#include "reference/numbers/decimal.h"

namespace forceshade::reference::meshes {
namespace {

// The direction as the hand sees it; none where the force is not turned to it.
Direction turned(const Direction& seen_from_front, const Rest& rest) {
  if (!seen_from_front) return std::nullopt;
  const Vector N = rest.side == mesh::Side::back ? -*seen_from_front : *seen_from_front;
  return dot(N, rest.D_over) <= 0 ? std::nullopt : Direction(N);
}

Enclosure enclosed(const Integer& value) {
  Enclosure enclosure;
  mpfi_set_z(enclosure.backend().data(), value.backend().data());
  return enclosure;
}

Integer integer_of(const CORE::BigInt& value) {
  return Integer(value.get_mp());
}

}  // namespace

std::array<RootSum, 3> exact_force(const Direction& seen_from_front, const Rest& rest, float stiffness) {
  const Direction N = turned(seen_from_front, rest);
  const Integer K = meshes::integer_of(stiffness, kFloatScale);
  constexpr int kExponent = -kFloatScale - kLengthScale;
  std::array<RootSum, 3> force;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Integer& along = rest.tangential_over[axis];
    if (!N) {
      force[axis] = {.whole = K * (rest.D_over[axis] + along), .under = rest.D_under, .exponent = kExponent};
      continue;
    }
    // |D_n| N_i/|N| = ±√(D_n² N_i² N²) / N²
    const Integer N_squared = dot(*N, *N), part = K * (*N)[axis];
    force[axis] = {K * N_squared * along, part < 0, part * part * N_squared * dot(rest.D_over, rest.D_over),
                   N_squared * rest.D_under, kExponent};
  }
  return force;
}

std::string decimal(const RootSum& value, unsigned digits) {
  const std::lock_guard lock(exact_arithmetic);
  const auto enclose = [&] {
    const Enclosure size = sqrt(enclosed(value.square)), whole = enclosed(value.whole);
    const Enclosure sum = value.root_is_negative ? Enclosure(whole - size) : Enclosure(whole + size);
    return Enclosure(sum / enclosed(value.under) * ldexp(Enclosure(1), value.exponent));
  };
  return correctly_rounded(digits, enclose, [&](const CORE::BigRat& with) {
    return compared(value, integer_of(numerator(with)), integer_of(denominator(with)));
  });
}

}  // namespace forceshade::reference::meshes
