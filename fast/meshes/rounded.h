// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Quotients, roots and vectors of a rest's numbers, correctly rounded to binary32 where the numbers decide it.

#include <optional>

#include "fast/meshes/rest_numbers.h"

namespace forceshade::fast::meshes {

// The binary32 nearest to over/under, and to √over/under; 0 < under, 0 <= over under a root. Empty where these numbers do not
// decide.
inline std::optional<float> nearest_quotient(const DoubleWithError& over, const DoubleWithError& under) noexcept {
  const DoubleWithError value = over / under;
  // A coordinate as small as this is read as 0.
  if (__builtin_fabs(value.value) + value.error < 0x1p-31) return 0.0F;
  return round_to_binary32(value);
}
inline std::optional<float> nearest_quotient(const Shaded& over, const Shaded& under) noexcept {
  using Short = BigFloatBall<4>;
  return round_to_binary32(approximately(Short(over) / Short(under)),
                           [&](double tie) { return proved_sign(over - Shaded::exactly(tie) * under); });
}
inline std::optional<float> nearest_root(const DoubleWithError& over, const DoubleWithError& under) noexcept {
  // As in along(); 0 itself is exact.
  if (!(over.value > 0x1p-600) && sign(over) != Sign::zero) return std::nullopt;
  return round_to_binary32(square_root(over) / under);
}
inline std::optional<float> nearest_root(const Shaded& over, const Shaded& under) noexcept {
  using Short = BigFloatBall<4>;
  return round_to_binary32(approximately(square_root(Short(over)) / Short(under)), [&](double tie) {
    if (tie < 0) return Sign::positive;
    const Shaded bound = Shaded::exactly(tie) * under;
    return proved_sign(over - bound * bound);
  });
}

// The binary32 nearest to n's length.
template <class N>
inline std::optional<float> nearest_length(const Vector3<N>& n) noexcept {
  return nearest_root(square(n), N::exactly(1));
}

// rounded(): gets the same component of each vector.
template <class Rounded>
std::optional<Force3> each(const Rounded& rounded, const auto&... vectors) noexcept {
  const std::optional<float> x = rounded(vectors.x...), y = rounded(vectors.y...), z = rounded(vectors.z...);
  if (!x || !y || !z) return std::nullopt;
  return Force3{*x, *y, *z};
}

// K times the length of `way` along the direction, which is not 0: each component correctly rounded, or empty.
inline std::optional<Force3> along(const Way3<DoubleWithError>& way, const Vector3<DoubleWithError>& direction,
                                   double K) noexcept {
  // Far above where the error bounds of small results end: fast/numbers/double_with_error.h.
  const DoubleWithError square_of_way = square(way.vector), square_of_direction = square(direction);
  if (!(square_of_direction.value > 0x1p-600 && square_of_way.value > 0x1p-600)) return std::nullopt;
  const DoubleWithError factor = DoubleWithError::exactly(K) * square_root(square_of_way / square_of_direction) / way.length;
  return each([&](const DoubleWithError& one) { return round_to_binary32(factor * one); }, direction);
}
inline std::optional<Force3> along(const Way3<Shaded>& way, const Vector3<Shaded>& direction, double K) noexcept {
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

// The same plus K times `pull`, whose length is 2^24 that of `way`.
inline std::optional<Force3> along_and(const Way3<DoubleWithError>& way, const Vector3<DoubleWithError>& direction,
                                       const Way3<DoubleWithError>& pull, double K) noexcept {
  const DoubleWithError square_of_way = square(way.vector), square_of_direction = square(direction);
  if (!(square_of_direction.value > 0x1p-600 && square_of_way.value > 0x1p-600)) return std::nullopt;
  const DoubleWithError stiffness = DoubleWithError::exactly(K),
                        factor = stiffness * square_root(square_of_way / square_of_direction) / way.length,
                        of_pull = stiffness / pull.length;
  return each(
      [&](const DoubleWithError& to, const DoubleWithError& by) { return round_to_binary32(factor * to + of_pull * by); },
      direction, pull.vector);
}
inline std::optional<Force3> along_and(const Way3<Shaded>& way, const Vector3<Shaded>& direction, const Way3<Shaded>& pull,
                                       double K) noexcept {
  using Short = BigFloatBall<4>;
  const Shaded square_of_way = square(way.vector), square_of_direction = square(direction), stiffness = Shaded::exactly(K);
  const Short short_stiffness = Short::exactly(K), of_pull = short_stiffness / Short(pull.length),
              factor = short_stiffness * square_root(Short(square_of_way) / Short(square_of_direction)) / Short(way.length);
  // F times pull.length is ±√(2^48 K² to² way²/direction²) + K by: where a tie stands for F, the root is compared with the
  // rest.
  const auto one = [&](const Shaded& to, const Shaded& by) -> std::optional<float> {
    const Shaded root = stiffness * to;
    const Sign side = proved_sign(root);
    if (side == Sign::unknown) return std::nullopt;
    const Shaded of_root = Shaded::exactly(0x1p48) * (root * root * square_of_way);
    const auto opposite = [](Sign sign) {
      return sign == Sign::positive ? Sign::negative : sign == Sign::negative ? Sign::positive : sign;
    };
    const auto beside = [&](double tie) {
      const Shaded rest = Shaded::exactly(tie) * pull.length - stiffness * by;
      const Sign of_rest = proved_sign(rest);
      if (of_rest == Sign::unknown) return Sign::unknown;
      if (of_rest == Sign::zero) return side;
      if (side != of_rest) return opposite(of_rest);
      const Sign farther = proved_sign(of_root - rest * rest * square_of_direction);
      return side == Sign::positive ? farther : opposite(farther);
    };
    return round_to_binary32(approximately(factor * Short(to) + of_pull * Short(by)), beside);
  };
  return each(one, direction, pull.vector);
}

}  // namespace forceshade::fast::meshes
