// SPDX-License-Identifier: BSD-3-Clause
// The real-time height maps against the reference, bit for bit, on positions aimed at what could go wrong.

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <limits>
#include <random>

#include "fast/heights/grid.h"
#include "fast/heights/jet.h"
#include "forceshade/fast.h"
#include "forceshade/reference.h"
#include "properties/binary32.h"
#include "tests/height_maps/grids_of.h"
#include "tests/height_maps/height_kinds.h"
#include "tests/laws/force_suite.h"
#include "tests/support/allocations.h"
#include "tests/support/drawn.h"

namespace forceshade {
namespace {

using Eigen::Vector3f;
using height::Edge;
using height::Interpolant;
using properties::neighbour;
using properties::show;
using tests::fast_law;
using tests::grid;
using tests::uniform;

using Random = std::mt19937_64;

struct Case {
  const char* name;
  HeightMap map;
  std::vector<float> lines;  // mm: coordinates at which something changes, in x and y
  float reach;               // mm: beyond it nothing new happens
};

std::vector<Case> cases() {
  Random random(5);
  const auto rough = [&](std::uint32_t, std::uint32_t) { return uniform(random, -0.5F, 0.5F); };
  const auto ridges = [](std::uint32_t i, std::uint32_t) { return 0.25F * static_cast<float>(i % 5); };
  const auto steps = [](std::uint32_t, std::uint32_t j) { return j % 4 == 0 ? 1e4F : 0x1p-30F; };
  const auto plate = [](std::uint32_t i, std::uint32_t j) { return i == 9 && j == 4 ? 1.0F : 5.0F; };
  std::vector<Case> all{
      {"plane", {{{height::Plane{0.75F, -1.0F / 3, 2}}}}, {0, 1}, 20},
      {"steep plane", {{{height::Plane{1e3F, -1e3F, 1e4F}}}}, {0, 10}, 30},
      {"cone", {{{height::Cone{0.5F, -0.25F, 2.5F, 4}}}}, {0.5F, -0.25F, 4.5F, -3.5F, 3.75F, -4.25F}, 8},
      {"dent", {{{height::Cone{0, 0, 8, 6}, true}}}, {0, 6, -6, 3.6F, 4.8F}, 8},
      {"cylinder cap", {{{height::CylinderCap{1, 15.24F, 25.4F}}}}, {1, 13.7F, -11.7F}, 20},
      {"sphere cap", {{{height::SphereCap{1, -1, 5, 8}}}}, {1, -1, 5, -3, 3, -5, 3.4F, 2.2F}, 8},
      {"bowl", {{{height::SphereCap{0, 0, 1e4F, 1e-3F}, true}}}, {0, 5e-4F, -5e-4F}, 1e-3F},
  };
  for (const Interpolant interpolant : {Interpolant::bilinear, Interpolant::cubic_spline})
    for (const Edge edge : {Edge::clamp, Edge::tile}) {
      all.push_back({"rough", {{{grid(37, 29, 0.3F, edge, interpolant, rough)}}}, {0, 0.15F, -0.3F, 5.4F, -5.4F}, 7});
      all.push_back({"ridges", {{{grid(16, 2, 0.25F, edge, interpolant, ridges)}}}, {0, 0.125F, -0.25F, 1.875F}, 3});
      all.push_back({"plate", {{{grid(20, 9, 100, edge, interpolant, plate)}}}, {0, 50, -100, 950, -400}, 1200});
      all.push_back({"steps", {{{grid(3, 40, 1e-3F, edge, interpolant, steps), true}}}, {0, 5e-4F, -1e-3F}, 0.03F});
    }
  // Splines whose first stage errs by what is small or missing: no step along one axis, steps of one unit in the last place
  // high above the plane, one step in a map that is level otherwise.
  std::array<float, 40> profile;
  for (float& value : profile) value = uniform(random, -0.5F, 0.5F);
  const auto rows_only = [&](std::uint32_t, std::uint32_t j) { return profile[j]; };
  const auto columns_only = [&](std::uint32_t i, std::uint32_t) { return profile[i]; };
  const auto high = [&](std::uint32_t, std::uint32_t) { return 8192 + 0x1p-10F * static_cast<float>(random() % 4); };
  const auto one_step = [](std::uint32_t i, std::uint32_t j) { return i == 12 && j == 12 ? 900.0F : 0.7F; };
  for (const Edge edge : {Edge::clamp, Edge::tile}) {
    const auto spline = [&](const auto& value) { return grid(24, 24, 0.3F, edge, Interpolant::cubic_spline, value); };
    all.push_back({"rows only", {{{spline(rows_only)}}}, {0, 0.15F, -0.45F, 3.45F}, 4});
    all.push_back({"columns only", {{{spline(columns_only)}}}, {0, 0.15F, -0.45F, 3.45F}, 4});
    all.push_back({"high and nearly flat", {{{spline(high)}}}, {0, 0.15F, -0.45F, 3.45F}, 4});
    all.push_back({"one big step", {{{spline(one_step)}}}, {0, 0.15F, -0.45F, 0.6F, -0.3F}, 4});
  }
  all.push_back({"Gaussian", {{{height::Gaussian{1, -1, 3, 1.5F}}}}, {0, 1, -1, 26, 31, 38, -30}, 10});
  all.push_back({"narrow hole", {{{height::Gaussian{0, 0, -1e4F, 1e-3F}}}}, {0, 1e-3F, 0.03F, 1e4F}, 0.01F});
  all.push_back({"grating", {{{height::Grating{0.5F, 6.5F, 0, 0.25F}}}}, {0, 1, 0.24166097F, -0.038461538F}, 20});
  all.push_back({"grating through 0", {{{height::Grating{2, 3, -4, 0.5F}}}}, {0, 0.5F, 0.125F, 1e4F}, 4});
  all.push_back({"fine grating", {{{height::Grating{1e-3F, 1e3F, -1e3F, 1e3F}}}}, {0, 1, 1e4F}, 100});
  all.push_back(
      {"hills and waves",
       {{{height::Gaussian{2, 0, 1, 0.5F}}, {height::Gaussian{-2, 0, 1, 0.5F}}, {height::Grating{0.1F, 9, 2, 0}, true}}},
       {0, 2, -2},
       4});
  all.push_back({"two bumps and a texture",
                 {{{height::SphereCap{2, 0, 5, 8}}, {height::Cone{-3, 1, 2, 3}, true}, all[7].map.parts[0]}},
                 {2, 6, -2, -3, 0, 1, 0.3F},
                 8});
  const height::Polygons roof{{{-4, 0.5F}, {-1.5F, 3}, {0x1p-40F, 3}, {2, -1.0F / 3}, {7, 0.25F}}};
  const height::Polygons cliff{{{-1, 1e4F}, {-0.9985F, -1e4F}, {0, 0x1p-30F}, {0.015625F, 0}}};
  all.push_back({"polygons", {{{roof}}}, {-4, -1.5F, 0, 2, 7}, 9});
  all.push_back({"cliff", {{{cliff, true}, {height::Plane{0, 0.5F, 0}}}}, {-1, -0.9985F, 0, 0.015625F}, 2});
  all.push_back(
      {"texture on two polygons", {all[7].map.parts, {{height::Polygons{{{-6, 0}, {0, 2}, {6, 0}}}}}}, {0, 6, -6, 0.3F}, 7});
  all.push_back({"cap on cap less cone",
                 {{{height::SphereCap{0, 0, 9, 12}}}, {{height::SphereCap{0, 0, 9, 10}}, {height::Cone{0, 0, 1, 4}, true}}},
                 {0, 6, 5, -4},
                 8});
  all.push_back(
      {"waves on a hill", {{{height::Grating{0.5F, 3, -4, 0.5F}}}, {{height::Gaussian{1, -1, 3, 1.5F}}}}, {0, 1, -1}, 4});
  for (const tests::HeightScene& scene : tests::scenes_of_every_kind()) {
    float reach = 2;
    for (const float edge : scene.edges) reach = std::max(reach, 2 * std::fabs(edge));
    all.push_back({scene.name, scene.map, scene.edges, std::min(reach, 10.0F)});
  }
  return all;
}

std::span<const height::ModeName> renderings_of(const HeightMap& map) {
  const std::span<const height::ModeName> all = height::kModes;
  return map.surface.empty() ? all : all.subspan(1, 1);  // the force-shaded
}

class Positions {
 public:
  Positions(const Case& of, const fast::HeightMapField& law, std::uint64_t seed) : case_(of), law_(law), random_(seed) {}

  Vector3f next() {
    const float x = coordinate(), y = coordinate();
    return {x, y, height_at(x, y)};
  }

 private:
  std::uint64_t pick(std::uint64_t count) { return random_() % count; }
  int few() { return static_cast<int>(pick(7)) - 3; }

  float coordinate() {
    switch (pick(8)) {
      case 0: return std::bit_cast<float>(static_cast<std::uint32_t>(random_()));  // any bits at all
      case 1: return neighbour(case_.lines[pick(case_.lines.size())], few());
      case 2: return case_.lines[pick(case_.lines.size())];
      case 3: return std::round(uniform(random_, -16, 16) * case_.reach) / 16;  // few bits: ties
      case 4: return uniform(random_, -1, 1) * std::exp2(uniform(random_, -32, 0));
      default: return uniform(random_, -1, 1) * case_.reach;
    }
  }

  float height_at(float x, float y) {
    const float contact = highest_contact(x, y);
    switch (pick(8)) {
      case 0: return std::bit_cast<float>(static_cast<std::uint32_t>(random_()));
      case 1:
      case 2: return neighbour(contact, few());
      case 3: return neighbour(0, few());
      case 4: return contact - std::exp2(uniform(random_, -30, 4));
      case 5: return std::round(16 * (contact - uniform(random_, 0, 2))) / 16;
      default: return contact - uniform(random_, 0, 2);
    }
  }

  // By bisection over the ordered binary32 numbers; only where to aim, so the law under test may say it.
  float highest_contact(float x, float y) const {
    const auto number = [](std::int64_t place) {
      return place < 0 ? -std::bit_cast<float>(static_cast<std::uint32_t>(-place))
                       : std::bit_cast<float>(static_cast<std::uint32_t>(place));
    };
    std::int64_t low = -static_cast<std::int64_t>(std::bit_cast<std::uint32_t>(1e4F)), high = -low;
    while (high - low > 1) {
      const std::int64_t middle = (low + high) / 2;
      (law_.evaluate({x, y, number(middle)}).status == Status::contact ? low : high) = middle;
    }
    return number(low);
  }

  const Case& case_;
  const fast::HeightMapField& law_;
  Random random_;
};

// As the common suite takes it.
tests::Tested tested(const Case& one, const height::ModeName& how) {
  const fast::HeightMapField fast = fast_law(one.map, how.mode);
  return {std::string(one.name) + ", " + std::string(how.name),
          [fast](const Vector3f& position) { return fast.evaluate(position); },
          [reference = std::get<reference::HeightMapField>(reference::HeightMapField::build(one.map, how.mode, 0.5F))](
              const Vector3f& position) { return reference.round_to_binary32(position); },
          [fast](std::span<const Vector3f> positions, std::span<Vector3f> to, fast::InstructionSet set) {
            return fast.force(positions, to, set);
          }};
}

// Calls claim(tested, positions) for every map and rendering.
template <class Claim>
void for_every_map(int count, std::uint64_t seed, const Claim& claim) {
  for (const Case& one : cases())
    for (const height::ModeName& how : renderings_of(one.map)) {
      const fast::HeightMapField law = fast_law(one.map, how.mode);
      Positions positions(one, law, seed);
      std::vector<Vector3f> all;
      for (int i = 0; i < count; ++i) all.push_back(positions.next());
      claim(tested(one, how), all);
    }
}

TEST(height_map_field, equals_the_rounded_reference) {
  for_every_map(static_cast<int>(tests::drawn(600)), 11, [](const tests::Tested& one, const std::vector<Vector3f>& positions) {
    tests::Met met;
    expect_rounded_reference(one, positions, met);
    const auto& [stages, methods, statuses] = met;
    std::printf("  %-48s binary64 %d, double-double %d, wide %d; free %d, contact %d, invalid %d; exact reference %d\n",
                one.name.c_str(), stages[0], stages[1], stages[2], statuses[0], statuses[1], statuses[2], methods[2]);
    for (const int count : statuses) EXPECT_GT(count, 0) << one.name << ": a status was never reached";
    EXPECT_GT(stages[0], 0) << one.name;
  });
}

TEST(height_map_field, reports_invalid_positions) {
  for_every_map(0, 1, [](const tests::Tested& one, const auto&) { expect_invalid_positions_reported(one); });
}

TEST(height_map_field, reads_tiny_coordinates_as_zero) {
  for_every_map(4, 1, [](const tests::Tested& one, const auto& at) { expect_tiny_coordinates_read_as_zero(one, at); });
}

TEST(height_map_field, gives_no_negative_zero) {
  for_every_map(60, 4, [](const tests::Tested& one, const auto& at) { expect_no_negative_zero(one, at); });
}

TEST(height_map_field, equals_scalar_at_every_simd_width) {
  for_every_map(273, 21, [](const tests::Tested& one, const auto& at) { expect_scalar_at_every_simd_width(one, at); });
}

TEST(height_map_field, allocates_nothing) {
  for_every_map(60, 3, [](const tests::Tested& one, const auto& at) { expect_no_allocation(one, at); });
}

TEST(height_map_field, finds_the_cell_of_every_grid_line_and_its_neighbours) {
  for (const float pitch : {0.3F, 1e-3F, 100.0F, 1.0F / 3})
    for (const std::uint32_t count : {2U, 3U, 1024U, 32767U}) {
      // Two rows keep the grid small; columns are what is asked for.
      const fast::HeightGrid g(grid(count, 2, pitch, Edge::clamp, Interpolant::bilinear, [](auto, auto) { return 1.0F; }));
      for (int line = -40; line < 40; ++line) {
        const double exact = (line - 0.5 * ((count - 1) % 2)) * static_cast<double>(pitch);
        for (int step = -2; step <= 2; ++step) {
          const float x = neighbour(static_cast<float>(exact), step);
          if (x != 0 && std::fabs(x) < 0x1p-30F) continue;
          const auto cell = g.cell(fast::Place(x, 0));
          EXPECT_LE(cell.start[0], static_cast<double>(x)) << pitch << ' ' << count << ' ' << show(x);
          EXPECT_LT(static_cast<double>(x) - cell.start[0], static_cast<double>(pitch))
              << pitch << ' ' << count << ' ' << show(x);
        }
      }
    }
}

TEST(height_map_field, refuses_what_the_reference_refuses) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  std::vector<HeightMap> maps{
      {}, {std::vector<height::Part>(17, {height::Plane{}})}, {{{std::shared_ptr<const height::Grid>()}}}};
  const auto add = [&](height::Shape shape) { maps.push_back({{{std::move(shape)}}}); };
  for (const float odd :
       {nan, inf, -inf, 0.0F, -1.0F, 1e-4F, 1e-3F, 0.1F, 10.0F, 1e3F, neighbour(1e3F, 1), 1e4F, neighbour(1e4F, 1), -1e4F}) {
    for (std::size_t kind = 0; kind < height::kKinds; ++kind)
      height::make_shape(kind, [&]<class Kind>(std::type_identity<Kind>) {
        if constexpr (height::HasNumbers<Kind>)
          for (const height::Number<Kind>& number : Kind::numbers()) {
            Kind one = std::get<Kind>(tests::Samples<Kind>::scenes().front().map.parts.front().shape);
            one.*number.member = odd;
            if constexpr (requires { one.width; })
              if (number.meaning == height::Meaning::radius) one.width = 0.15F;
            add(one);
          }
        return height::Plane{};
      });
    add(height::Polygons{{{odd, 0}, {1e4F, 0}}});
    add(height::Polygons{{{0, 0}, {odd, 1}}});
    add(height::Polygons{{{0, 0}, {1, odd}}});
    for (const float pitch : {odd, 1.0F})
      add(grid(3, 3, pitch, Edge::tile, Interpolant::bilinear,
               [&](auto i, auto) { return i == 1 && pitch == 1 ? odd : 1.0F; }));
  }
  add(std::make_shared<const height::Grid>(height::Grid{3, 3, 1, Edge::tile, Interpolant::bilinear, {1, 2, 3}}));
  add(std::make_shared<const height::Grid>(height::Grid{1, 3, 1, Edge::tile, Interpolant::bilinear, {1, 2, 3}}));
  add(height::Polygons{{{0, 0}}});
  add(height::Polygons{std::vector<height::Knot>(1026)});
  maps.push_back({{{height::Plane{}}}, {{height::Plane{}}}});
  int refused = 0;
  for (const HeightMap& map : maps)
    for (const float stiffness : {1.0F, 0.0F}) {
      const auto fast = fast::HeightMapField::build(map, height::Mode::true_height, stiffness);
      const auto reference = reference::HeightMapField::build(map, height::Mode::true_height, stiffness);
      const auto message = [](const auto& built) {
        const auto* error = std::get_if<ParameterError>(&built);
        return error == nullptr ? std::string("built") : error->message();
      };
      EXPECT_EQ(message(fast), message(reference));
      refused += message(fast) != "built";
    }
  EXPECT_GT(refused, 100);
  EXPECT_LT(refused, static_cast<int>(2 * maps.size()) - 50);
}

TEST(height_map_field, quantises_centres_and_positions_alike) {
  const fast::HeightMapField cone = fast_law({{{height::Cone{0x1p-31F, 0, 8, 6}}}}, height::Mode::true_height);
  const Vector3f apex = cone.force({0, 0, 3});
  EXPECT_EQ(cone.force({-0x1.fffffep-31F, 0x1p-149F, 3}), apex);
  EXPECT_NE(cone.force({-0x1p-30F, 0, 3}), apex);
}

TEST(height_map_field, is_in_contact_with_the_farthest_tail_of_a_gaussian) {
  // exp(-8.1e13) mm above the plane: no force to speak of, but contact, and below it none.
  for (const bool negated : {false, true}) {
    const HeightMap map{{{height::Gaussian{0, 0, 2, 1e-3F}, negated}}};
    const Vector3f far(9000, 9000, 0);
    const fast::Evaluation answer = fast_law(map, height::Mode::true_height).evaluate(far);
    EXPECT_EQ(answer.status, negated ? Status::free : Status::contact);
    EXPECT_EQ(answer.force, Vector3f(0, 0, 0));
    const auto reference =
        std::get<reference::HeightMapField>(reference::HeightMapField::build(map, height::Mode::true_height, 0.5F));
    EXPECT_EQ(reference.round_to_binary32(far).status, answer.status);
  }
}

// A renderer is a grid and little more: at most 1.1 times its numbers, 64 by 64 of them being the fewest that one would sample.
TEST(height_map_field, shares_its_grid) {
  const auto values =
      grid(64, 64, 0.5F, Edge::tile, Interpolant::cubic_spline, [](auto i, auto j) { return 0.1F * float(i ^ j); });
  const std::size_t before = tests::allocated_bytes();
  const fast::HeightMapField law = fast_law({{{values}}}, height::Mode::true_height);
  EXPECT_LT(sizeof law + (tests::allocated_bytes() - before), values->values.size() * sizeof(float) / 10);
}

}  // namespace
}  // namespace forceshade
