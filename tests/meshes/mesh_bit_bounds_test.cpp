// SPDX-License-Identifier: BSD-3-Clause
// The length of the integers of a god-object's decisions: the proof of the table in fast/meshes/bits.md.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <random>
#include <regex>
#include <sstream>

#include "reference/meshes/surface.h"

namespace forceshade::reference::meshes {
namespace {

constexpr int kSide = 20000;  // mm: of the cube that all points are in

// The corners of the cube. Each of the three quantities below is the size of a function that is linear in every point, so that
// it is convex in every point, and largest where all points are corners.
std::vector<Vector> corners() {
  std::vector<Vector> all;
  for (int i = 0; i < 8; ++i) all.push_back({(i & 1) * kSide, (i >> 1 & 1) * kSide, (i >> 2 & 1) * kSide});
  return all;
}

const Integer kSide2 = Integer(kSide) * kSide;
const Integer kDistance2 = 3 * kSide2;                  // the square of |b - a|, mm²
const Integer kArea2 = 3 * kSide2 * kSide2;             // of |(b - a) x (c - a)|, mm⁴
const Integer kVolume2 = 4 * kSide2 * kSide2 * kSide2;  // of det(b - a, c - a, d - a), mm⁶

TEST(mesh_bit_bounds, distances_areas_and_volumes_in_a_cube_are_largest_at_its_corners) {
  Integer distance2 = 0, area2 = 0, volume2 = 0;
  const Vector a = corners()[0];  // the others by symmetry
  for (const Vector& b : corners()) {
    distance2 = std::max(distance2, dot(b - a, b - a));
    for (const Vector& c : corners()) {
      const Vector n = cross(b - a, c - a);
      area2 = std::max(area2, dot(n, n));
      for (const Vector& d : corners()) volume2 = std::max(volume2, Integer(dot(n, d - a) * dot(n, d - a)));
    }
  }
  EXPECT_EQ(distance2, kDistance2);
  EXPECT_EQ(area2, kArea2);
  EXPECT_EQ(volume2, kVolume2);
}

// The least number of bits with size · 2^unit < 2^bits, the size given by its square.
int bits_of(const Integer& size2, int unit) {
  const Integer scaled = size2 << static_cast<unsigned>(2 * unit);
  int bits = 0;
  while (scaled >= Integer(1) << static_cast<unsigned>(2 * bits)) ++bits;
  return bits;
}

struct Row {
  const char* quantity;
  Integer size2;  // the square of a bound of its size, in mm, mm², ...
  int unit;       // it is a multiple of 2^-unit of these
};

// Units: 53 for a difference of two of p and vertices, 77 where a point of the grid takes part.
const std::vector<Row>& rows() {
  static const Integer l = kDistance2, n = kArea2, v = kVolume2;
  // The square of a component on a crease: |α| <= |e² D| |n₂| |n₁ x n₂|, q² <= 2n², e² N′, and two terms.
  static const Integer on_crease = 4 * (l * l * l * n * n * n) * (2 * n) * ((l * l) << 88U);
  static const std::vector<Row> all{
      {"n·(p − a), a corner of the triangle", v, 159},
      {"e·(p − a), a a vertex", l * l, 106},
      {"e·(p − g), g of the grid", l * l, 130},
      {"n·((b − a) × (p − a))", n * n, 212},
      {"n·((g − w) × (p − w)), g of the grid", n * n, 236},
      {"two edges at a vertex: (e₁·u)² e₂²", l * l * l * l * l * l, 318},
      {"an edge and a triangle: (e·u)² n²", l * l * l * l * n * n, 424},
      {"two triangles: (n₁·u)² n₂²", v * v * n * n, 530},
      {"u on an edge: (e·u)² and e² u²", l * l * l * l, 212},
      {"n·(a − g), and the weights of a triangle's corners", v, 183},
      {"n·(p − g), g anywhere on the grid", n * l, 183},
      {"(a − g)·((p − g) × e)", v, 183},
      {"two crossings of triangles: n₁·(a₁ − g) n₂·(p − g)", v * n * l, 366},
      {"t of an edge that is crossed, times 2²⁴", l * l * l * l, 284},
      {"β of a triangle that is crossed, times 2²⁴", v, 207},
      {"‖x − p‖², x of the grid", l * l, 154},
      {"t of a foot, times 2²⁵", l * l, 131},
      {"β of a foot, times 2²⁵", n * n, 237},
      {"where a way beside a sheet ends, times 2²⁴: (n₁ × n₂)²", n * n * n * n, 448},
      {"p's foot on another sheet: n₁·(p − a₁) n₂²", v * n * n, 371},
      {"two crossings in a plane, from grid to grid", l * l * l * l * l * l * l * l, 520},
      {"the square of a way's length, from grid to grid, times m²", (l * l) << 96U, 154},
      {"from a landing to the grid: d² det(…), d = (e × (p − g))·n", l * l * n * l * l * n * v, 679},
      {"the same in the plane of another triangle: d³ (u × e)², u the way from the landing",
       l * l * n * l * l * n * l * l * n * l * l * l * l, 992},
      {"a coordinate of a sub-goal, times 2²⁴ N² n²", 9 * kSide2 * (Integer(144) << 144U) * n * n, 563},
      {"a component of N′ with a texture, times n²", (n * n) << 88U, 467},
      {"a component of αq₁N₁′ + βq₂N₂′ with a texture", on_crease, 987},
      {"its square, times those of K and of e² D", (on_crease * on_crease * l * l * l * l * l * l) << 40U, 2358},
  };
  return all;
}

std::string text_of(const std::string& file) {
  std::ifstream in(FORCESHADE_SOURCE_DIR "/" + file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

TEST(mesh_bit_bounds, the_table_in_the_documentation_has_these_rows) {
  const std::string page = text_of("fast/meshes/bits.md");
  for (const Row& row : rows()) {
    const std::string expected = std::string("| ") + row.quantity + " | 2^-" + std::to_string(row.unit) + " | " +
                                 std::to_string(bits_of(row.size2, row.unit)) + " |";
    EXPECT_NE(page.find(expected), std::string::npos) << expected;
  }
}

// Each theorem of the table stands below the row that it proves, with the numbers of that row.
TEST(mesh_bit_bounds, theorems_in_coq_have_the_numbers_of_the_documentation) {
  const std::string pages = text_of("fast/meshes/bits.md"),
                    proofs = text_of("proofs/meshes/MeshBounds.v") + text_of("proofs/meshes/MeshBoundsMoves.v") +
                             text_of("proofs/meshes/MeshBoundsShaded.v") + text_of("proofs/meshes/MeshBoundsPulled.v");
  const std::regex theorem(R"(\(\* (\|.*\| 2\^-(\d+) \| (\d+) \|) \*\)\nTheorem [^.]*?fits? (\d+) (\d+))");
  int found = 0;
  for (std::sregex_iterator one(proofs.begin(), proofs.end(), theorem), end; one != end; ++one, ++found) {
    EXPECT_NE(pages.find((*one)[1]), std::string::npos) << (*one)[1];
    EXPECT_EQ((*one)[2], (*one)[4]) << (*one)[1];
    EXPECT_EQ((*one)[3], (*one)[5]) << (*one)[1];
  }
  EXPECT_EQ(found, 36);
}

// The determinants meet the bound here: it is not too large by a bit.
TEST(mesh_bit_bounds, the_bounds_of_the_most_common_decisions_are_met) {
  const auto units = [](int x, int y, int z) {
    return exact_point({static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
  };
  constexpr int kEnd = 10000;
  const Vector a = units(-kEnd, -kEnd, -kEnd), b = units(kEnd, kEnd, -kEnd), c = units(-kEnd, kEnd, kEnd),
               p = units(kEnd, -kEnd, kEnd);
  const auto bits = [](const Integer& number, int multiple) {
    return static_cast<int>(msb(Integer(abs(number) >> static_cast<unsigned>(multiple)))) + 1;
  };
  const Vector n = cross(b - a, c - a);
  EXPECT_EQ(bits(dot(n, p - a), 3 * 24), bits_of(kVolume2, 159));
  EXPECT_EQ(bits(dot(n, n), 4 * 24), bits_of(kArea2 * kArea2, 212));
  const Vector across = units(kEnd, kEnd, kEnd) - a;
  EXPECT_EQ(bits(dot(across, across), 2 * 24), bits_of(kDistance2 * kDistance2, 106));
}

}  // namespace
}  // namespace forceshade::reference::meshes
