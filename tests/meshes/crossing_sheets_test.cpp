// SPDX-License-Identifier: BSD-3-Clause
// The god-object on meshes that intersect themselves: the two sides against each other and against a judge that shares nothing
// with them, and what docs/god-object.md, "Meshes that intersect themselves", promises.

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "forceshade/meshes.h"
#include "tests/meshes/allowed_crossings.h"
#include "tests/meshes/both_sides.h"

namespace forceshade {
namespace {

using mesh::Sides;
using mesh::TriangleMesh;
using tests::BothSides;
using tests::Exact;
using tests::exact;
using tests::Integer;
using tests::kStiffness;
using tests::Occasions;

constexpr std::array<const char*, 5> kKinds{"crossing sheets", "crossing tubes", "twisted strip", "pair of meshes",
                                            "three sheets"};

class Random : public properties::Draws {
 public:
  explicit Random(std::uint64_t seed) : Draws(seed) {}
  using Draws::bits;
  double number(double low, double high) { return low + (high - low) * static_cast<double>(bits() % 1000000) / 1e6; }
  // Sometimes of few bits, so that sheets meet in points of the grid.
  float rounded(double value, bool is_coarse) { return static_cast<float>(is_coarse ? std::round(value * 4) / 4 : value); }
};

// rows x columns vertices; `at` gives their places.
template <class At>
void add_grid(TriangleMesh& mesh, std::uint32_t rows, std::uint32_t columns, bool is_cyclic, const At& at) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  for (std::uint32_t i = 0; i < rows; ++i)
    for (std::uint32_t j = 0; j < columns; ++j) mesh.vertices.push_back(at(i, j));
  for (std::uint32_t i = 0; i + 1 < rows; ++i)
    for (std::uint32_t j = 0; j + (is_cyclic ? 0U : 1U) < columns; ++j) {
      const std::uint32_t k = (j + 1) % columns, a = first + i * columns, b = a + columns;
      mesh.triangles.push_back({a + j, b + j, b + k});
      mesh.triangles.push_back({a + j, b + k, a + k});
    }
}

void add_sheet(TriangleMesh& mesh, Random& random, std::size_t axis) {
  const bool is_coarse = random.bits() % 2 == 0;
  const double tilt = random.number(-0.7, 0.7), turn = random.number(-0.7, 0.7), rough = random.number(0, 0.4);
  const auto n = static_cast<std::uint32_t>(2 + random.bits() % 4);
  add_grid(mesh, n, n, false, [&](std::uint32_t i, std::uint32_t j) {
    const double step = 8.0 / (n - 1), x = -4 + step * i + random.number(-0.1, 0.1), y = -4 + step * j;
    std::array<float, 3> place{};
    place[axis] = random.rounded(tilt * x + turn * y + random.number(-rough, rough), is_coarse);
    place[(axis + 1) % 3] = random.rounded(x, is_coarse);
    place[(axis + 2) % 3] = random.rounded(y, is_coarse);
    return place;
  });
}

void add_tube(TriangleMesh& mesh, Random& random, std::size_t axis) {
  const double radius = random.number(0.7, 2), off = random.number(-0.6, 0.6);
  const auto n = static_cast<std::uint32_t>(3 + random.bits() % 6);
  add_grid(mesh, 4, n, true, [&](std::uint32_t i, std::uint32_t j) {
    std::array<float, 3> place{};
    const double angle = 2 * 3.14159265 * j / n;
    place[axis] = static_cast<float>(-4.5 + 3 * i + 0.1 * j);
    place[(axis + 1) % 3] = static_cast<float>(radius * std::cos(angle) + off);
    place[(axis + 2) % 3] = static_cast<float>(radius * std::sin(angle));
    return place;
  });
}

// Along a curve in the form of an eight, drawn along z and turned on the way.
void add_twisted_strip(TriangleMesh& mesh, Random& random) {
  const double twist = random.number(-0.5, 0.5);
  const auto n = static_cast<std::uint32_t>(7 + random.bits() % 20);
  add_grid(mesh, n, 3, false, [&](std::uint32_t i, std::uint32_t j) {
    const double t = -3 + 6.0 * i / (n - 1), z = 2.0 * j - 2;
    const double x = 4 * std::sin(t), y = 2 * std::sin(2 * t) + 0.3 * t;
    return std::array<float, 3>{static_cast<float>(x + twist * z * std::cos(t)), static_cast<float>(y), static_cast<float>(z)};
  });
}

// The second moved into the first, of about its size. Returns the number of triangles of the first.
template <class Next>
std::size_t add_pair(TriangleMesh& mesh, const Next& next) {
  std::size_t second = 0;
  for (int part = 0; part < 2; ++part) {
    const TriangleMesh one = next();
    second = mesh.triangles.size();
    std::array<double, 3> low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};
    for (const auto& v : one.vertices)
      for (std::size_t i = 0; i < 3; ++i) {
        low[i] = std::min(low[i], static_cast<double>(v[i]));
        high[i] = std::max(high[i], static_cast<double>(v[i]));
      }
    const double size = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const auto& v : one.vertices) {
      std::array<float, 3> place{};
      for (std::size_t i = 0; i < 3; ++i)
        place[i] = static_cast<float>((static_cast<double>(v[i]) - (low[i] + high[i]) / 2) * (8 / size) + 0.5 * part);
      mesh.vertices.push_back(place);
    }
    for (const auto& t : one.triangles) mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
  return second;
}

// A mesh that may intersect itself, and that check() has found to be one.
struct Made {
  TriangleMesh mesh;
  std::size_t kind = 0;
  bool is_embedded = false;
};

// Two closed parts, of which the second one's triangles come last.
struct Closed {
  TriangleMesh mesh;
  std::size_t second = 0;

  bool is_of_second(const mesh::GodObject& state) const {
    const std::uint32_t vertex = state.index[0];
    if (state.place == mesh::Place::triangle) return state.index[0] >= second;
    for (std::size_t i = 0; i < second; ++i)
      if (std::ranges::find(mesh.triangles[i], vertex) != mesh.triangles[i].end()) return false;
    return true;
  }
};

class Source {
 public:
  explicit Source(std::uint64_t seed) : random_(seed), parts_(seed) {}

  Made next() {
    for (;;) {
      Made made;
      made.kind = count_++ % kKinds.size();
      TriangleMesh mesh;
      switch (made.kind) {
        case 0:
        case 4:
          for (std::size_t axis = 0; axis < (made.kind == 0 ? 2U : 3U); ++axis) add_sheet(mesh, random_, axis);
          break;
        case 1:
          for (std::size_t axis = 0; axis < 2; ++axis) add_tube(mesh, random_, axis);
          break;
        case 2: add_twisted_strip(mesh, random_); break;
        default: add_pair(mesh, [&] { return parts_.next().mesh; });
      }
      made.is_embedded = std::holds_alternative<mesh::CheckedMesh>(mesh::check(mesh));
      auto checked = mesh::check(std::move(mesh), mesh::SelfIntersections::allowed);
      if (!std::holds_alternative<mesh::CheckedMesh>(checked)) continue;
      made.mesh = std::get<mesh::CheckedMesh>(checked).mesh();
      return made;
    }
  }

  Closed next_closed() {
    constexpr std::array<std::size_t, 4> kClosed{4, 5, 7, 8};  // of kMeshFamilies
    for (;;) {
      Closed made;
      made.second = add_pair(made.mesh, [&] { return parts_.of_family(kClosed[random_.bits() % kClosed.size()]).mesh; });
      const bool is_wrong = std::holds_alternative<mesh::Findings>(mesh::check(made.mesh, mesh::SelfIntersections::allowed)),
                 is_embedded = std::holds_alternative<mesh::CheckedMesh>(mesh::check(made.mesh));
      if (!is_wrong && !is_embedded) return made;
    }
  }

 private:
  Random random_;
  properties::MeshSource parts_;
  std::size_t count_ = 0;
};

TEST(crossing_sheets, fast_is_the_reference_in_every_bit) {
  Occasions reached;
  Source source(71);
  properties::MeshSource looks(71);
  constexpr std::size_t kTicks = 250;
  const std::size_t ticks = tests::drawn(5000);
  for (std::uint64_t seed = 0; seed * kTicks < ticks; ++seed) {
    const Made made = source.next();
    const Sides sides = seed % 3 == 0 ? Sides::both : Sides::front;
    const auto shading = static_cast<mesh::Shading>(seed % mesh::kShadingNames.size());
    const std::string shaded = "turned by the shading: " + std::string(name_of(shading));
    const auto look = tests::look_of(made.mesh, shading, looks);
    BothSides both(tests::rendering_of(made.mesh, sides, mesh::SelfIntersections::allowed, look));
    properties::MeshPath path(made.mesh, seed);
    for (std::size_t i = 0; i < kTicks; ++i) {
      const std::array<float, 3> p = path.next();
      const mesh::GodObject before = both.state();
      const mesh::Tick tick = both.step(p, "mesh " + std::to_string(seed) + ", " + kKinds[made.kind] + ", " +
                                               std::string(name_of(shading)) + ", tick " + std::to_string(i));
      if (testing::Test::HasFailure()) return;

      const mesh::Tick without = fast::walk_through_sheets(both.mesh(), before, p);
      const bool is_blocked = tick.moves != without.moves || tick.after != without.after,
                 is_turned = tick.force != fast::step(both.mesh(), before, p, kStiffness, mesh::Shading::none).force;
      reached["a way that is blocked"] += is_blocked;
      reached[shaded] += is_turned;
      reached[shaded + ", where a way is blocked"] += is_turned && is_blocked;
      reached["a rest where a way is blocked"] += tick.status == Status::contact && tick.after != without.after;
      reached["a move onto another part"] += tick.moves > 1 && tick.after.place == mesh::Place::triangle &&
                                             before.place == mesh::Place::triangle && is_blocked &&
                                             tick.after.index != before.index;
      ++reached[made.is_embedded ? "embedded" : kKinds[made.kind]];
      reached.note(tick);
    }
  }
  reached.expect_all({kKinds.begin(), kKinds.end()});
  reached.expect_all({"a way that is blocked", "a rest where a way is blocked", "a move onto another part"});
  for (const auto& [name, count] : reached.reached) {
    if (!name.starts_with("turned by the shading")) continue;
    EXPECT_EQ(count == 0, name.starts_with("turned by the shading: none")) << name;
  }
}

// Testing the ways changes nothing where no triangles cross.
TEST(crossing_sheets, an_embedded_mesh_is_rendered_as_ever_in_every_bit) {
  std::size_t touching = 0;
  properties::MeshSource source(72);
  const std::size_t ticks = tests::drawn(11000);
  for (std::uint64_t seed = 0; seed * 500 < ticks; ++seed) {
    const properties::RandomMesh made = source.next();
    const fast::Mesh plain = tests::fast_mesh(tests::unshaded(made.mesh, made.sides)),
                     tested = tests::fast_mesh(tests::crossing(made.mesh, made.sides));
    properties::MeshPath path(made.mesh, seed);
    mesh::GodObject state;
    for (std::size_t i = 0; i < 500; ++i) {
      const std::array<float, 3> p = path.next();
      const mesh::Tick expected = fast::step(plain, state, p, kStiffness, mesh::Shading::none),
                       found = fast::step(tested, state, p, kStiffness, mesh::Shading::none);
      ASSERT_TRUE(tests::is_same(found, expected))
          << properties::kMeshFamilies[made.family] << ", mesh " << seed << ", tick " << i << ": expected "
          << tests::show(expected) << ", found " << tests::show(found);
      state = found.after;
      touching += found.status == Status::contact;
    }
  }
  std::printf("  %zu ticks in contact\n", touching);
  EXPECT_GT(touching, 0U);
}

// A judge that shares nothing with either side: exact points, and how often a ray to far away goes into and out of a closed
// part.

Integer determinant(const Exact& a, const Exact& b, const Exact& c, const Exact& d) {
  const auto minus = [](const Exact& x, const Exact& y) { return Exact{x[0] - y[0], x[1] - y[1], x[2] - y[2]}; };
  const Exact e = minus(b, a), f = minus(c, a), g = minus(d, a);
  return e[0] * (f[1] * g[2] - f[2] * g[1]) + e[1] * (f[2] * g[0] - f[0] * g[2]) + e[2] * (f[0] * g[1] - f[1] * g[0]);
}

// The number of times that the part, triangles first to last, is around the point; a point in a triangle's plane may be counted
// either way, so the least of three rays is taken.
int times_around(const TriangleMesh& mesh, std::size_t first, std::size_t last, const Exact& point) {
  int least = 1000;
  for (const std::array<int, 3>& way : {std::array{1009, 2503, 4001}, {-3001, 1511, 2011}, {2017, -1013, -3511}}) {
    Exact far = point;
    for (std::size_t i = 0; i < 3; ++i) far[i] += Integer(way[i] * 64) << 77U;
    int count = 0;
    for (std::size_t t = first; t < last; ++t) {
      const auto& [a, b, c] = mesh.triangles[t];
      const Exact A = exact(mesh.vertices[a]), B = exact(mesh.vertices[b]), C = exact(mesh.vertices[c]);
      const int here = determinant(A, B, C, point).sign(), there = determinant(A, B, C, far).sign();
      if (here * there >= 0) continue;
      const int u = determinant(point, far, A, B).sign(), v = determinant(point, far, B, C).sign(),
                w = determinant(point, far, C, A).sign();
      if (u == v && v == w) count += there > 0 ? 1 : -1;  // out through the front
    }
    least = std::min(least, count);
  }
  return least;
}

TEST(crossing_sheets, a_god_object_that_begins_outside_is_never_inside_a_part) {
  Occasions reached;
  Source source(73);
  const std::size_t ticks = tests::drawn(1500);
  for (std::uint64_t seed = 0, done = 0; done < ticks; ++seed) {
    const Closed made = source.next_closed();
    const fast::Mesh mesh = tests::fast_mesh(tests::crossing(made.mesh));
    properties::MeshPath path(made.mesh, seed);
    mesh::GodObject state = fast::step(mesh, {}, {40, 41, 42}, kStiffness, mesh::Shading::none).after;
    for (std::size_t i = 0; i < 300; ++i, ++done) {
      const std::array<float, 3> p = path.next();
      const mesh::Tick tick = fast::step(mesh, state, p, kStiffness, mesh::Shading::none);
      state = tick.after;
      if (tick.status != Status::contact) continue;
      const Exact point = tests::point_of(made.mesh, state);
      const std::size_t triangles = made.mesh.triangles.size();
      const bool is_in_second = made.is_of_second(state);
      const int others = is_in_second ? times_around(made.mesh, 0, made.second, point)
                                      : times_around(made.mesh, made.second, triangles, point);
      ASSERT_LE(others, 0) << "mesh " << seed << ", tick " << i << ": " << tests::show(tick);
      ++reached[is_in_second ? "on the second part" : "on the first part"];
      const Exact device = exact(p);
      const bool is_in_both =
          times_around(made.mesh, 0, made.second, device) > 0 && times_around(made.mesh, made.second, triangles, device) > 0;
      reached["the device is in both"] += is_in_both;
    }
  }
  reached.expect_all({"on the first part", "on the second part", "the device is in both"});
}

}  // namespace
}  // namespace forceshade
