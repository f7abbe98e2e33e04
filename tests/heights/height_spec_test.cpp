// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <random>
#include <string>

#include "forceshade/fast.h"
#include "forceshade/heights.h"
#include "forceshade/reference.h"
#include "tests/support/rational.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace forceshade::heights {
namespace {

using tests::TemporaryDirectory;

std::string words_of(const std::string& text) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("map.toml", text);
  return tests::without(file + ": ", tests::thrown_by<Error>([&] { read_spec(file); }));
}

TEST(height_spec, reads_every_shape_with_its_defaults) {
  const TemporaryDirectory directory;
  const Spec spec = read_spec(directory.write("map.toml", R"(
render = "height-map-conservative"
[[part]]
shape = "plane"
slope_x = 1
[[part]]
shape = "cone"
height_mm = 2.5
radius_mm = 3
y_mm = -1
[[part]]
shape = "cylinder-cap"
radius_mm = 8
width_mm = 10
negated = true
[[part]]
shape = "sphere-cap"
radius_mm = 9
width_mm = 4
[[part]]
shape = "gaussian"
height_mm = -1
sigma_mm = 0.5
x_mm = 7
[[part]]
shape = "grating"
height_mm = 0.1
wave_y_rad_per_mm = 3
)"));
  EXPECT_EQ(spec.mode, height::Mode::conservative);
  const auto& parts = spec.map.parts;
  ASSERT_EQ(parts.size(), 6U);
  EXPECT_EQ(std::get<height::Plane>(parts[0].shape).slope_x, 1);
  EXPECT_EQ(std::get<height::Plane>(parts[0].shape).height, 0);
  EXPECT_EQ(std::get<height::Cone>(parts[1].shape).height, 2.5F);
  EXPECT_EQ(std::get<height::Cone>(parts[1].shape).y, -1);
  EXPECT_EQ(std::get<height::CylinderCap>(parts[2].shape).width, 10);
  EXPECT_EQ(std::get<height::SphereCap>(parts[3].shape).radius, 9);
  EXPECT_EQ(std::get<height::Gaussian>(parts[4].shape).x, 7);
  EXPECT_EQ(std::get<height::Grating>(parts[5].shape).wave_y, 3);
  for (std::size_t i = 0; i < parts.size(); ++i) EXPECT_EQ(parts[i].negated, i == 2);
}

// toml++ makes binary64 numbers of decimals; beside a tie between two numbers of binary32 the second rounding would go wrong.
TEST(height_spec, rounds_numbers_once) {
  const TemporaryDirectory directory;
  std::mt19937_64 random(9);
  int twice = 0;
  for (int file = 0; file < 4; ++file) {
    std::string text = "# \u00e9\nrender = \"height-map\"\n[[part]]\nshape = \"polygons\" # \u00e9\nknots_mm = [";
    std::vector<std::array<float, 2>> expected;
    for (int i = 0; i < 500; ++i) {
      std::array<float, 2> knot{};
      text += "[";
      for (float& number : knot) {
        const tests::NearTie one = tests::near_tie(random, 1);
        number = tests::nearest<float>(one.number);
        if (static_cast<float>(std::stod(one.text)) != number) ++twice;
        std::string typed = (i % 3 == 0 ? " +" : " ") + one.text;
        if (i % 2 == 0 && typed.find('.') < typed.size() - 3) typed.insert(typed.size() - 2, "_");
        text += typed + ',';
      }
      text.back() = ']';
      text += i % 7 == 0 ? ",\n # \u00e9\n" : ", ";
      expected.push_back(knot);
    }
    const std::filesystem::path map = directory.write("map.toml", text + "]\n");
    const Spec spec = read_spec(map);
    const auto& knots = std::get<height::Polygons>(spec.map.parts[0].shape).knots;
    ASSERT_EQ(knots.size(), expected.size());
    for (std::size_t i = 0; i < knots.size(); ++i) {
      ASSERT_EQ(knots[i].x, expected[i][0]) << i;
      ASSERT_EQ(knots[i].height, expected[i][1]) << i;
    }
  }
  std::printf("  %d of 4000 would be wrong by way of binary64\n", twice);
  EXPECT_GT(twice, 100);
}

// examples/smooth_leather.toml with other numbers.
TEST(height_spec, band_limits_a_grid) {
  const std::string start = "render = \"height-map\"\n[[part]]\nshape = \"grid\"\nfile = \"" FORCESHADE_SOURCE_DIR
                            "/examples/leather.png\"\npitch_mm = 0.15\nscale_mm = 0.4\ninterpolant = ";
  const auto words = [&](const std::string& rest) {
    const TemporaryDirectory directory;
    const std::string all = tests::thrown_by<Error>([&] { read_spec(directory.write("map.toml", start + rest)); });
    return all.empty() ? "" : all.substr(all.find(": ") + 2);  // whatever file it is about
  };
  EXPECT_EQ(words("\"band-limited\"\nshortest_wavelength_mm = 0.6\n"), "");
  EXPECT_EQ(words("\"band-limited\"\n"), "line 2: key shortest_wavelength_mm is missing");
  EXPECT_EQ(words("\"cubic-spline\"\nshortest_wavelength_mm = 0.6\n"), "line 8: unknown key shortest_wavelength_mm");
  EXPECT_EQ(words("\"band-limited\"\nshortest_wavelength_mm = 0.59\n"),
            "is to lose waves shorter than 0.59 mm; expected 4 pitches, 0.6 mm, to 10000 mm");
  EXPECT_EQ(words("\"band-limited\"\nshortest_wavelength_mm = nan\n").substr(0, 33), "is to lose waves shorter than nan");
}

TEST(height_spec, reads_a_surface_beside_the_parts) {
  const TemporaryDirectory directory;
  const Spec spec = read_spec(directory.write("map.toml", R"(
render = "height-map-shaded"
[[surface]]
shape = "polygons"
knots_mm = [[-4, 0], [0, 1.5], [4, 0]]
[[part]]
shape = "cylinder-cap"
radius_mm = 8
width_mm = 8
)"));
  ASSERT_EQ(spec.map.parts.size(), 1U);
  ASSERT_EQ(spec.map.surface.size(), 1U);
  const auto& knots = std::get<height::Polygons>(spec.map.surface[0].shape).knots;
  ASSERT_EQ(knots.size(), 3U);
  EXPECT_EQ(knots[1].height, 1.5F);
  EXPECT_EQ(knots[2].x, 4);
}

TEST(height_spec, says_what_is_wrong_and_where) {
  const std::string good = "render = \"height-map\"\n[[part]]\nshape = \"gaussian\"\nheight_mm = 1\nsigma_mm = 2\n";
  EXPECT_EQ(words_of(good), "");
  const auto with = [&](const std::string& a, const std::string& b) {
    std::string text = good;
    return words_of(text.replace(text.find(a), a.size(), b));
  };
  EXPECT_EQ(words_of(""), "line 1: key render is missing");
  EXPECT_EQ(words_of("render = \"height-map\"\n"), "expected at least one [[part]], got none");
  EXPECT_EQ(with("\"height-map\"", "\"flat\""),
            "line 1: render: expected one of height-map, height-map-shaded, height-map-conservative, got 'flat'");
  EXPECT_EQ(
      with("\"gaussian\"", "\"teapot\""),
      "line 3: shape: expected one of plane, cone, cylinder-cap, sphere-cap, gaussian, grating, polygons, grid, got 'teapot'");
  EXPECT_EQ(with("height_mm = 1", "height_mm = \"1\""), "line 4: height_mm: expected a number, got '1'");
  EXPECT_EQ(with("height_mm = 1", "height_mm = [1]"), "line 4: height_mm: expected a number, got a list or table");
  EXPECT_EQ(with("sigma_mm = 2", "sigma = 2"), "line 2: key sigma_mm is missing; the nearest is sigma");
  EXPECT_EQ(with("sigma_mm = 2", "sigma_mm = 2\nradius_mm = 3"), "line 6: unknown key radius_mm");
  EXPECT_EQ(with("sigma_mm = 2", "sigma_mm = 2\nnegated = 1"), "line 6: negated: expected true or false, got 1");
  EXPECT_EQ(with("[[part]]", "[part]"), "line 2: expected render, [[part]] and [[surface]], got part");
  EXPECT_EQ(with("[[part]]", "[[parts]]"), "line 2: expected render, [[part]] and [[surface]], got parts; the nearest is part");
  EXPECT_NE(with("sigma_mm = 2", "sigma_mm = ").find("line 5: "), std::string::npos);
  EXPECT_NE(with("\"gaussian\"", "\"grid\"\npitch_mm = 1\nscale_mm = 1"), "");
  EXPECT_EQ(with("[[part]]", "[[surface]]\nshape = \"plane\"\n[[part]]"),
            "line 2: only render = \"height-map-shaded\" has a [[surface]]");
  const auto knots = [&](const std::string& list) {
    return with("\"gaussian\"\nheight_mm = 1\nsigma_mm = 2", "\"polygons\"\nknots_mm = " + list);
  };
  EXPECT_EQ(knots("[[0, 1], [2.5, -1]]"), "");
  EXPECT_EQ(knots("[[0, 1], [2]]"), "line 4: knots_mm: expected pairs of numbers [x, height], got a list or table");
  EXPECT_EQ(knots("[[0, 1], 2]"), "line 4: knots_mm: expected pairs of numbers [x, height], got 2");
  EXPECT_EQ(knots("1"), "line 4: knots_mm: expected a list of pairs [x, height], got 1");
  EXPECT_THROW(read_spec("nowhere/map.toml"), Error);
}

// Each shipped example is read, built on both sides, and felt alike.
TEST(height_spec, examples_are_rendered_to_the_nearest_binary32) {
  std::size_t examples = 0;
  for (const auto& entry : std::filesystem::directory_iterator(FORCESHADE_SOURCE_DIR "/examples")) {
    if (entry.path().extension() != ".toml") continue;
    ++examples;
    const auto [map, rendering] = read_spec(entry.path());
    const auto fast = fast::HeightMapField::build(map, rendering, 0.5F);
    const auto truth = reference::HeightMapField::build(map, rendering, 0.5F);
    ASSERT_TRUE(std::holds_alternative<fast::HeightMapField>(fast)) << entry.path();
    std::mt19937 random(1);
    std::uniform_real_distribution<float> side(-12, 12), depth(-3, 2);
    std::size_t contacts = 0;
    for (int i = 0; i < 200; ++i) {
      const Eigen::Vector3f position(side(random), side(random), depth(random));
      const fast::Evaluation got = std::get<fast::HeightMapField>(fast).evaluate(position);
      const reference::Rounded exact = std::get<reference::HeightMapField>(truth).round_to_binary32(position);
      EXPECT_EQ(got.status, exact.status) << entry.path() << " " << position.transpose();
      EXPECT_EQ(got.force, exact.force) << entry.path() << " " << position.transpose();
      contacts += got.status == Status::contact;
    }
    EXPECT_GT(contacts, 20U) << entry.path();
  }
  EXPECT_GE(examples, 4U);
}

}  // namespace
}  // namespace forceshade::heights
