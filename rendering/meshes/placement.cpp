// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/placement.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>

#include "rendering/meshes/numbers.h"

namespace forceshade::mesh {
namespace {

// Every number here is below 2^256, all in units of 2^-53 or of its square. A component of a rotation is up to 2, so an entry
// of A and the sum of squares are below 2^111. A coordinate or translation is below 2^14 mm. The exact coordinate, times the
// sum of squares, is a sum of four products, below 2^(111 + 67 + 2).
using Wide = boost::multiprecision::int256_t;
using Wides = std::array<Wide, 3>;
constexpr int kUnit = -53;  // exponent of 2

// number/2^-53, which is whole: the number is 0, or at least 2^-30 in size.
Wide whole(float number) {
  int exponent = 0;
  const auto digits = static_cast<std::int32_t>(std::ldexp(std::frexp(number, &exponent), 24));
  return digits == 0 ? Wide(0) : Wide(digits) << (exponent - 24 - kUnit);
}

// The binary32 number nearest to numerator/denominator units, ties to even. The denominator is above 0.
float nearest(Wide numerator, Wide denominator) {
  if (numerator == 0) return 0;
  const bool is_negative = numerator < 0;
  if (is_negative) numerator = -numerator;
  // A quotient of 40 bits or 41. A last bit of 1 where there is a remainder stands for all the bits that follow, so that one
  // rounding to 24 bits is that of the exact quotient.
  const int shift = 40 + static_cast<int>(msb(denominator)) - static_cast<int>(msb(numerator));
  if (shift >= 0)
    numerator <<= shift;
  else
    denominator <<= -shift;
  Wide quotient, remainder;
  divide_qr(numerator, denominator, quotient, remainder);
  const std::uint64_t bits = static_cast<std::uint64_t>(quotient) | static_cast<std::uint64_t>(remainder != 0);
  const float size = std::ldexp(static_cast<float>(bits), kUnit - shift);
  return is_negative ? -size : size;
}

// A length as every coordinate is kept.
float kept(float length) {
  return std::fabs(length) < kSmallest ? 0.0F : length;
}

struct Rotation {
  std::array<Wides, 3> rows;  // of A
  Wide squares;               // w^2 + x^2 + y^2 + z^2, in the same unit
};

Rotation rotation_of(const std::array<float, 4>& quaternion) {
  const Wide w = whole(quaternion[0]), x = whole(quaternion[1]), y = whole(quaternion[2]), z = whole(quaternion[3]);
  const Wide ww = w * w, xx = x * x, yy = y * y, zz = z * z;
  return {{Wides{ww + xx - yy - zz, 2 * (x * y - w * z), 2 * (x * z + w * y)},
           Wides{2 * (x * y + w * z), ww - xx + yy - zz, 2 * (y * z - w * x)},
           Wides{2 * (x * z - w * y), 2 * (y * z + w * x), ww - xx - yy + zz}},
          ww + xx + yy + zz};
}

}  // namespace

bool is_of_rotation(float component) {
  const float size = std::fabs(component);
  return size == 0 || (size >= kLeastOfRotation && size <= kMostOfRotation);
}

bool is_of_translation(float component) {
  return std::fabs(component) <= kLargest;
}

std::vector<Vertex> placed(std::vector<Vertex> vertices, const scene::Pose& placement) {
  const auto& [rows, squares] = rotation_of(placement.rotation);
  Wides shift;
  for (std::size_t i = 0; i < 3; ++i) shift[i] = whole(kept(placement.translation[i])) * squares;
  for (Vertex& vertex : vertices) {
    const Wides a{whole(vertex[0]), whole(vertex[1]), whole(vertex[2])};
    for (std::size_t i = 0; i < 3; ++i) {
      const float x = nearest(rows[i][0] * a[0] + rows[i][1] * a[1] + rows[i][2] * a[2] + shift[i], squares);
      vertex[i] = kept(x);
    }
  }
  return vertices;
}

}  // namespace forceshade::mesh
