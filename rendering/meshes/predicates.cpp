// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/predicates.h"

#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "rendering/meshes/whole_coordinate.h"

namespace forceshade::mesh {
namespace {

thread_local Stages counted;

// A matrix of differences minuend - subtrahend of coordinates.
struct Differences {
  std::array<std::array<float, 3>, 3> minuend, subtrahend;
};

template <class T>
using Matrix = std::array<std::array<T, 3>, 3>;

template <class T>
T determinant(const Matrix<T>& m) {
  return m[0][2] * (m[1][0] * m[2][1] - m[2][0] * m[1][1]) + m[1][2] * (m[2][0] * m[0][1] - m[0][0] * m[2][1]) +
         m[2][2] * (m[0][0] * m[1][1] - m[1][0] * m[0][1]);
}

template <class T>
int sign_of(const T& number) {
  return static_cast<int>(number > 0) - static_cast<int>(number < 0);
}

// A coordinate takes 67 bits (rendering/meshes/whole_coordinate.h), a difference 68, a product of three 204, and a sum of six
// of them 207.
int sign_in_256_bits(const Differences& of) {
  ++counted.bits_256;
  using Wide = boost::multiprecision::int256_t;
  Matrix<Wide> m;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      m[i][k] = whole_coordinate<Wide>(of.minuend[i][k]) - whole_coordinate<Wide>(of.subtrahend[i][k]);
  return determinant(m).sign();
}

// For differences that are exact in binary64 and, after division by their largest common power of two, below 2^40: a product
// of two is below 2^80, a minor below 2^81, the determinant below 3 * 2^121.
int sign_in_128_bits(const Differences& of, const Matrix<double>& m) {
  std::array<std::array<std::int64_t, 3>, 3> whole{};
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto x = static_cast<double>(of.minuend[i][k]), y = static_cast<double>(of.subtrahend[i][k]);
      const double back = x - m[i][k];
      const bool is_exact = (x - (m[i][k] + back)) + (back - y) == 0;  // Knuth's error of a difference
      if (!is_exact || std::fabs(m[i][k]) >= 0x1p9) return sign_in_256_bits(of);
      whole[i][k] = static_cast<std::int64_t>(std::ldexp(m[i][k], kCoordinateBits));
      bits |= static_cast<std::uint64_t>(std::abs(whole[i][k]));
    }
  const int zeros = bits == 0 ? 0 : std::countr_zero(bits);
  if (bits >> zeros >= std::uint64_t{1} << 40) return sign_in_256_bits(of);
  ++counted.bits_128;
  __extension__ using Wide = __int128;
  Matrix<Wide> scaled;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) scaled[i][k] = whole[i][k] / (std::int64_t{1} << zeros);
  return sign_of(determinant(scaled));
}

// The sign of the determinant. The bound is that of J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast
// Robust Geometric Predicates, 1997, section 4.3 (errboundA of orient3d), for the same operations in the same order; nothing
// underflows, because no difference but 0 is below 2^-53.
int sign_of_determinant(const Differences& of) {
  constexpr double kEpsilon = 0x1p-53, kBound = (7 + 56 * kEpsilon) * kEpsilon;
  Matrix<double> m, size;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      m[i][k] = static_cast<double>(of.minuend[i][k]) - static_cast<double>(of.subtrahend[i][k]);
      size[i][k] = std::fabs(m[i][k]);
    }
  const double permanent = (size[1][0] * size[2][1] + size[2][0] * size[1][1]) * size[0][2] +
                           (size[2][0] * size[0][1] + size[0][0] * size[2][1]) * size[1][2] +
                           (size[0][0] * size[1][1] + size[1][0] * size[0][1]) * size[2][2];
  const double value = determinant(m);
  // A permanent of 0 says that every product has a factor that is exactly 0.
  if (std::fabs(value) > kBound * permanent || permanent == 0) {
    ++counted.binary64;
    return sign_of(value);
  }
  return sign_in_128_bits(of, m);
}

int sign_of_sides(int p, int q, int r) {
  return p > 0 && q > 0 && r > 0 ? 1 : p < 0 && q < 0 && r < 0 ? -1 : 0;
}

// True if a segment (p, q) and a triangle in one plane meet, seen along `axis`, on which the triangle keeps an area. They are
// apart where a side of the triangle has both ends strictly outside, or the segment's line has the triangle strictly on one
// side: the difference of the two sets is a polygon with edges in just these directions.
bool meet_in_plane(std::size_t axis, const Vertex& p, const Vertex& q, const TrianglePoints& t) {
  const int front = turn(axis, t[0], t[1], t[2]);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vertex &a = t[i], &b = t[(i + 1) % 3];
    if (turn(axis, a, b, p) == -front && turn(axis, a, b, q) == -front) return false;
  }
  return sign_of_sides(turn(axis, p, q, t[0]), turn(axis, p, q, t[1]), turn(axis, p, q, t[2])) == 0;
}

std::size_t axis_with_area(const TrianglePoints& t) {
  for (const std::size_t axis : {2U, 1U})
    if (turn(axis, t[0], t[1], t[2]) != 0) return axis;
  return 0;
}

// True if a segment (p, q) and a triangle meet, given on which sides of the triangle the ends are.
bool meets(const Vertex& p, const Vertex& q, int side_p, int side_q, const TrianglePoints& t) {
  if (side_p * side_q > 0) return false;
  if (side_p == 0 && side_q == 0) return meet_in_plane(axis_with_area(t), p, q, t);
  // The line has one point in the plane. It is in the triangle unless the line passes two of its edges on different sides.
  const int first = side_of(p, q, t[0], t[1]), second = side_of(p, q, t[1], t[2]);
  if (first * second < 0) return false;
  const int third = side_of(p, q, t[2], t[0]);
  return first * third >= 0 && second * third >= 0;
}

// On which sides of t the corners of s are.
std::array<int, 3> sides_of(const TrianglePoints& s, const TrianglePoints& t) {
  return {side_of(t[0], t[1], t[2], s[0]), side_of(t[0], t[1], t[2], s[1]), side_of(t[0], t[1], t[2], s[2])};
}

}  // namespace

Stages stages() {
  return counted;
}

int side_of(const Vertex& a, const Vertex& b, const Vertex& c, const Vertex& d) {
  return sign_of_determinant({{b, c, d}, {a, a, a}});
}

// The bound is ccwerrboundA of the same paper.
int turn(std::size_t axis, const Vertex& a, const Vertex& b, const Vertex& c) {
  constexpr double kEpsilon = 0x1p-53, kBound = (3 + 16 * kEpsilon) * kEpsilon;
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const auto difference = [](float x, float y) { return static_cast<double>(x) - static_cast<double>(y); };
  const double left = difference(b[u], a[u]) * difference(c[v], a[v]), right = difference(c[u], a[u]) * difference(b[v], a[v]);
  const double value = left - right, size = std::fabs(left) + std::fabs(right);
  if (std::fabs(value) > kBound * size || size == 0) {
    ++counted.binary64;
    return sign_of(value);
  }
  return sign_of_determinant(
      {{{{b[u], b[v], 0}, {c[u], c[v], 0}, {0, 0, 1}}}, {{{a[u], a[v], 0}, {a[u], a[v], 0}, {0, 0, 0}}}});
}

bool has_area(const TrianglePoints& t) {
  return turn(2, t[0], t[1], t[2]) != 0 || turn(1, t[0], t[1], t[2]) != 0 || turn(0, t[0], t[1], t[2]) != 0;
}

bool meet(const TrianglePoints& s, const TrianglePoints& t) {
  const std::array<int, 3> of_s = sides_of(s, t);
  if (sign_of_sides(of_s[0], of_s[1], of_s[2]) != 0) return false;
  const std::array<int, 3> of_t = sides_of(t, s);
  if (sign_of_sides(of_t[0], of_t[1], of_t[2]) != 0) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t k = (i + 1) % 3;
    if (meets(s[i], s[k], of_s[i], of_s[k], t) || meets(t[i], t[k], of_t[i], of_t[k], s)) return true;
  }
  return false;
}

// The common part is convex. A segment of it that begins in the corner goes on until it leaves one of the triangles,
// which is at the edge opposite to the corner.
bool meet_beside_corner(const TrianglePoints& s, const TrianglePoints& t) {
  const int s1 = side_of(t[0], t[1], t[2], s[1]), s2 = side_of(t[0], t[1], t[2], s[2]);
  if (s1 * s2 > 0) return false;
  const int t1 = side_of(s[0], s[1], s[2], t[1]), t2 = side_of(s[0], s[1], s[2], t[2]);
  if (t1 * t2 > 0) return false;
  return meets(s[1], s[2], s1, s2, t) || meets(t[1], t[2], t1, t2, s);
}

// In different planes they have the edge alone in common; in one plane, no more if the third corners are on different sides of
// it.
bool meet_beside_edge(const TrianglePoints& s, const TrianglePoints& t) {
  if (side_of(s[0], s[1], s[2], t[2]) != 0) return false;
  const std::size_t axis = axis_with_area(s);
  return turn(axis, s[0], s[1], s[2]) == turn(axis, s[0], s[1], t[2]);
}

}  // namespace forceshade::mesh
