// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/creases.h"

#include <array>

#include "rendering/meshes/interval.h"
#include "rendering/meshes/whole_vectors.h"

namespace forceshade::mesh {
namespace {

WholeVector normal_of(const TrianglePoints& t) {
  return cross(side(t[0], t[1]), side(t[0], t[2]));
}

struct Squared {
  double degrees;
  int sign, fourths;  // of the cosine; of its square
};
// The angles in degrees, rational as every binary64 number is, with a rational square of the cosine: (1 + cos 2x)/2 is rational
// for no others (I. Niven, Irrational Numbers, 1956, corollary 3.12).
constexpr std::array<Squared, 9> kRational{
    {{0, 1, 4}, {30, 1, 3}, {45, 1, 2}, {60, 1, 1}, {90, 0, 0}, {120, -1, 1}, {135, -1, 2}, {150, -1, 3}, {180, -1, 4}}};

}  // namespace

// More than the angle: a lower cosine. That of the triangles is n1 . n2 / sqrt(n1^2 n2^2).
bool turns_by_more(const TrianglePoints& s, const TrianglePoints& t, double crease_degrees) {
  const WholeVector n1 = normal_of(s), n2 = normal_of(t);
  const Whole product = dot(n1, n2), squares = dot(n1, n1) * dot(n2, n2);
  for (const Squared& angle : kRational)
    if (angle.degrees == crease_degrees) return 4 * product * abs(product) < angle.sign * angle.fourths * squares;
  // They are never equal, so some precision separates them.
  for (int bits = 256;; bits *= 2) {
    const Interval limit = cos(Interval::pi(bits) * Interval(bits, crease_degrees) / Interval(bits, 180.0));
    const Interval cosine = Interval(bits, product) / sqrt(Interval(bits, squares));
    if (is_below(cosine, limit)) return true;
    if (is_below(limit, cosine)) return false;
  }
}

}  // namespace forceshade::mesh
