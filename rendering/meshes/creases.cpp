// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/creases.h"

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "rendering/meshes/interval.h"

namespace forceshade::mesh {
namespace {

using Whole = boost::multiprecision::cpp_int;
using WholeVector = std::array<Whole, 3>;

// In units of 2^-106 mm^2: a coordinate is a whole multiple of 2^-53 mm (rendering/meshes/predicates.cpp).
WholeVector normal_of(const TrianglePoints& t) {
  const auto difference = [](const Vertex& a, const Vertex& b) {
    const auto whole = [](float x) { return Whole(std::ldexp(static_cast<double>(x), 53)); };
    return WholeVector{whole(a[0]) - whole(b[0]), whole(a[1]) - whole(b[1]), whole(a[2]) - whole(b[2])};
  };
  const WholeVector u = difference(t[1], t[0]), v = difference(t[2], t[0]);
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}

Whole dot(const WholeVector& a, const WholeVector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

struct Squared {
  double degrees;
  int sign, fourths;  // of the cosine; of its square
};
// The angles in degrees, rational as every binary64 number is, with a rational square of the cosine: (1 + cos 2x)/2 is rational
// for no others (I. Niven, Irrational Numbers, 1956, corollary 3.12).
constexpr std::array<Squared, 9> kRational{
    {{0, 1, 4}, {30, 1, 3}, {45, 1, 2}, {60, 1, 1}, {90, 0, 0}, {120, -1, 1}, {135, -1, 2}, {150, -1, 3}, {180, -1, 4}}};

Interval interval_of(const Whole& number, mpfr_prec_t bits) {
  // In parts that binary64 holds.
  Interval result(bits);
  Whole rest = abs(number);
  const Interval unit(bits, 0x1p52);
  std::vector<double> parts;
  for (; rest != 0; rest >>= 52) parts.push_back(static_cast<double>(static_cast<std::uint64_t>(rest & 0xFFFFFFFFFFFFFU)));
  for (std::size_t i = parts.size(); i > 0; --i) result = result * unit + Interval(bits, parts[i - 1]);
  return number < 0 ? Interval(bits) - result : result;
}

}  // namespace

// More than the angle: a lower cosine. That of the triangles is n1 . n2 / sqrt(n1^2 n2^2).
bool turns_by_more(const TrianglePoints& s, const TrianglePoints& t, double crease_degrees) {
  const WholeVector n1 = normal_of(s), n2 = normal_of(t);
  const Whole product = dot(n1, n2), squares = dot(n1, n1) * dot(n2, n2);
  for (const Squared& angle : kRational)
    if (angle.degrees == crease_degrees) return 4 * product * abs(product) < angle.sign * angle.fourths * squares;
  // They are never equal, so some precision separates them.
  for (mpfr_prec_t bits = 256;; bits *= 2) {
    const Interval limit = cos(Interval::pi(bits) * Interval(bits, crease_degrees) / Interval(bits, 180));
    const Interval cosine = interval_of(product, bits) / sqrt(interval_of(squares, bits));
    if (is_below(cosine, limit)) return true;
    if (is_below(limit, cosine)) return false;
  }
}

}  // namespace forceshade::mesh
