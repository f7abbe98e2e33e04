// SPDX-License-Identifier: BSD-3-Clause
// Heights without short waves, and what the spline through them adds.

#include "rendering/heights/band_limit.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <random>

#include "fast/heights/spline.h"
#include "forceshade/heights.h"
#include "rendering/heights/coefficients.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace forceshade::heights {
namespace {

using height::Edge;
constexpr double kTurn = 2 * std::numbers::pi;

struct Picture {
  std::uint32_t columns, rows;
  std::vector<float> heights;

  Picture(std::uint32_t c, std::uint32_t r, const std::function<double(double, double)>& height) : columns(c), rows(r) {
    for (std::uint32_t j = 0; j < rows; ++j)
      for (std::uint32_t i = 0; i < columns; ++i) heights.push_back(static_cast<float>(height(i, j)));
  }
  Picture limited(Edge edge, double shortest) const {
    Picture copy = *this;
    limit_band(copy.heights, columns, rows, edge, shortest);
    return copy;
  }
  double largest_difference(const Picture& other) const {
    double most = 0;
    for (std::size_t i = 0; i < heights.size(); ++i)
      most = std::max(most, static_cast<double>(std::fabs(heights[i] - other.heights[i])));
    return most;
  }
  double largest() const {
    return largest_difference(Picture(columns, rows, [](double, double) { return 0.0; }));
  }
};

// Whole numbers of waves per grid, so that they tile; cosines from the edge of the mirror on, so that they mirror.
const auto tiled = [](double across, double up) {
  return [=](double i, double j) { return std::cos(kTurn * (across * i / 48 + up * j / 30) + 0.5); };
};
const auto mirrored = [](double across, double up) {
  return [=](double i, double j) {
    return std::cos(kTurn / 2 * across * (i + 0.5) / 48) * std::cos(kTurn / 2 * up * (j + 0.5) / 30);
  };
};

TEST(band_limit, long_waves_pass_and_short_ones_are_gone) {
  // L = 6 samples: waves of 12 and more pass, of 6 and less do not, whatever way they run.
  for (const auto& [across, up] : {std::pair{0, 0}, {4, 0}, {0, 2}, {3, 1}, {2, -2}}) {
    const Picture wave(48, 30, tiled(across, up));
    EXPECT_LT(wave.limited(Edge::tile, 6).largest_difference(wave), 1e-6) << across << ' ' << up;
    const Picture half(48, 30, mirrored(2 * across, 2 * up));
    EXPECT_LT(half.limited(Edge::clamp, 6).largest_difference(half), 1e-6) << across << ' ' << up;
  }
  for (const auto& [across, up] : {std::pair{8, 0}, {0, 5}, {7, 3}, {6, -4}, {24, 0}, {24, 15}, {1, 15}}) {
    EXPECT_LT(Picture(48, 30, tiled(across, up)).limited(Edge::tile, 6).largest(), 1e-6) << across << ' ' << up;
    EXPECT_LT(Picture(48, 30, mirrored(2 * across, 2 * up)).limited(Edge::clamp, 6).largest(), 1e-6) << across << ' ' << up;
  }
}

TEST(band_limit, rolls_off_as_a_raised_cosine_between) {
  for (const int waves : {5, 6, 7}) {
    const double share = 6 * waves / 48.0, passed = (1 - std::cos(kTurn * share)) / 2;
    const auto faded = [&](double i, double j) { return passed * tiled(waves, 0)(i, j); };
    EXPECT_LT(Picture(48, 30, tiled(waves, 0)).limited(Edge::tile, 6).largest_difference(Picture(48, 30, faded)), 1e-6);
  }
  // Slanted: 1/6 per sample squared is (4/48)² + (u/30)², so no multiple of either axis.
  const double share = 6 * std::hypot(4 / 48.0, 3 / 30.0), passed = (1 - std::cos(kTurn * share)) / 2;
  const auto faded = [&](double i, double j) { return passed * tiled(4, 3)(i, j); };
  EXPECT_LT(Picture(48, 30, tiled(4, 3)).limited(Edge::tile, 6).largest_difference(Picture(48, 30, faded)), 1e-6);
}

TEST(band_limit, works_for_odd_and_tiny_grids) {
  for (const auto& [columns, rows] : {std::pair{2U, 2U}, {3U, 2U}, {5U, 7U}, {6U, 9U}, {31U, 2U}})
    for (const Edge edge : {Edge::clamp, Edge::tile}) {
      const Picture flat(columns, rows, [](double, double) { return 2.5; });
      EXPECT_LT(flat.limited(edge, 4).largest_difference(flat), 1e-6);
      // Only the mean is left of waves that all are too short.
      const Picture limited = Picture(columns, rows, [](double i, double) { return i; }).limited(edge, 1000);
      for (const float height : limited.heights) EXPECT_NEAR(height, 0.5 * (columns - 1), 1e-5);
    }
}

TEST(band_limit, grids_with_large_prime_factors_are_refused) {
  const tests::TemporaryDirectory directory;
  const auto words = [&](std::uint32_t columns, std::uint32_t rows) -> std::string {
    std::string file = "Pf " + std::to_string(columns) + " " + std::to_string(rows) + " -1\n";
    file.resize(file.size() + std::size_t{4} * columns * rows);  // zeros
    return tests::thrown_by<Error>(
        [&] { load({.file = directory.write("flat.pfm", file), .pitch = 0.5F, .scale = 1, .shortest_wavelength = 2.0F}); });
  };
  EXPECT_EQ(words(128, 97), "");
  EXPECT_EQ(words(97 * 97, 4), "");
  EXPECT_NE(words(202, 4).find("202 columns or rows cannot be band-limited"), std::string::npos);
  EXPECT_NE(words(4, 101).find("101 columns or rows cannot be band-limited"), std::string::npos);
}

TEST(band_limit, clamped_edges_do_not_ring_across_and_tiled_ones_do) {
  const Picture slope(128, 4, [](double i, double) { return i / 127; });
  const Picture clamped = slope.limited(Edge::clamp, 6), repeated = slope.limited(Edge::tile, 6);
  EXPECT_LT(clamped.largest_difference(slope), 0.01);
  EXPECT_GT(repeated.heights[0], 0.3) << "pulled up by the other end";
}

TEST(band_limit, a_sharp_step_overshoots_by_8_percent_and_is_quiet_after_three_wavelengths) {
  const Picture step(512, 2, [](double i, double) { return i < 256 ? 0.0 : 1.0; });
  const Picture limited = step.limited(Edge::clamp, 16);
  float most = 0, far = 0;
  for (std::size_t i = 256; i < 512; ++i) {
    most = std::max(most, limited.heights[i] - 1);
    if (i >= 256 + 3 * 16) far = std::max(far, std::fabs(limited.heights[i] - 1));
  }
  EXPECT_NEAR(most, 0.079F, 0.001F);
  EXPECT_LT(far, 0.0015F);
}

TEST(band_limit, noise_becomes_smooth) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 1);
  const Picture rough(64, 64, [&](double, double) { return noise(random); });
  const auto roughness = [](const Picture& p) {  // of second differences: 4π²/l² of a wave of length l samples, at most
    double most = 0;
    for (std::size_t i = 1; i + 1 < p.heights.size(); ++i)
      if (i % 64 != 0 && i % 64 != 63)
        most = std::max(most, static_cast<double>(std::fabs(p.heights[i - 1] - 2 * p.heights[i] + p.heights[i + 1])));
    return most;
  };
  const Picture smooth = rough.limited(Edge::tile, 16);
  EXPECT_LT(roughness(smooth), smooth.largest() * kTurn * kTurn / (16 * 16));
  EXPECT_GT(roughness(rough), rough.largest());
}

// Ctrl-C is heard at each row and each 64 columns, and heights that are not replaced yet stay.
TEST(spline_coefficients, are_made_whole_or_not_at_all) {
  constexpr int kReports = 7 + 2;
  const Picture before(70, 7, [&](double i, double j) { return std::sin(i * j); });
  for (int last = 1; last <= kReports; ++last) {
    Picture after = before;
    std::atomic<bool> stop = false;
    int reports = 0;
    const Monitor monitor([&](double) { stop = ++reports == last; }, stop);
    const auto make = [&] { make_coefficients(after.heights, after.columns, after.rows, Edge::clamp, monitor); };
    if (last < kReports)
      EXPECT_THROW(make(), Interrupted) << last;
    else
      make();
    EXPECT_EQ(reports, last);
    EXPECT_EQ(after.heights == before.heights, last < kReports);
  }
}

// A wave of f per sample through the spline: besides itself, of every whole k an image at k + f, (f/(k + f))⁴ as high beside it
// and (f/(k + f))³ as steep. Fourier coefficients of the map itself over one of its periods, 32 points to a sample.
TEST(band_limit, images_of_a_sampled_wave_are_as_high_as_the_formula_says) {
  constexpr int kFine = 32;
  for (const unsigned length : {4U, 8U, 16U}) {
    Picture wave(16, 4, [&](double i, double) { return std::cos(kTurn * i / length); });
    make_coefficients(wave.heights, wave.columns, wave.rows, Edge::tile);
    const fast::HeightGrid grid(std::make_shared<const height::Grid>(
        height::Grid{16, 4, 1, Edge::tile, height::Interpolant::cubic_spline, wave.heights}));
    const auto amplitude = [&](double frequency, bool of_slope) {
      std::complex<double> sum = 0;
      for (int i = 0; i < 16 * kFine; ++i) {
        const double x = static_cast<double>(i) / kFine;
        const auto jet = fast::tracked_spline_jet(grid, fast::Place(static_cast<float>(x), 0));
        sum += (of_slope ? jet.Ux : jet.U).value * std::polar(1.0, -kTurn * frequency * x);
      }
      return std::abs(sum);
    };
    const double f = 1.0 / length;
    for (const int k : {-2, -1, 1, 2}) {
      const double ratio = std::fabs(f / (k + f));
      EXPECT_NEAR(amplitude(k + f, false) / amplitude(f, false), std::pow(ratio, 4), 2e-6) << length << ' ' << k;
      EXPECT_NEAR(amplitude(k + f, true) / amplitude(f, true), std::pow(ratio, 3), 4e-5) << length << ' ' << k;
    }
  }
}

}  // namespace
}  // namespace forceshade::heights
