// SPDX-License-Identifier: BSD-3-Clause
// The sizes of numbers that the proofs for height maps assume, computed from the domain (fast/heights/limits.h) and compared
// with those in the headers and scripts. Each size is found twice: as a bound, from formulas, and as what the headers' own jets
// meet at the corners of the domain, which must be within the bound and not far from it.

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "fast/heights/all.h"
#include "fast/heights/force.h"
#include "fast/heights/limits.h"
#include "tests/fast/gappa_script.h"

namespace forceshade::tests {
namespace {

using namespace fast::height_limits;
using fast::DoubleWithError;
using fast::Jet;
using fast::kLargestCoordinate;
using fast::kPositionQuantum;
using fast::Place;

constexpr float kLeastFloat = 0x1p-149F;
// mm: coordinates and centres are 0 or at least the quantum, so multiples of the last bit of that.
constexpr double kLeastDifference = 0x1p-23 * static_cast<double>(kPositionQuantum);

double log2_of(float a) {
  return std::log2(static_cast<double>(a));
}

// A DoubleWithError that notes the least size that a result of it had.
struct Noted : DoubleWithError {
  static inline double least = HUGE_VAL;

  Noted() = default;
  Noted(const DoubleWithError& a) : DoubleWithError(a) {
    if (value != 0) least = std::min(least, std::fabs(value));
  }
  static Noted exactly(double value) { return Noted(DoubleWithError::exactly(value)); }
  Noted operator-() const { return Noted(-static_cast<const DoubleWithError&>(*this)); }
  friend Noted operator+(const Noted& a, const Noted& b) { return Noted(base(a) + base(b)); }
  friend Noted operator-(const Noted& a, const Noted& b) { return Noted(base(a) - base(b)); }
  friend Noted operator*(const Noted& a, const Noted& b) { return Noted(base(a) * base(b)); }
  friend Noted operator/(const Noted& a, const Noted& b) { return Noted(base(a) / base(b)); }
  friend Noted square_root(const Noted& a) { return Noted(square_root(base(a))); }
  friend Noted widened(const Noted& a, int k) { return Noted(widened(base(a), k)); }

 private:
  static const DoubleWithError& base(const Noted& a) { return a; }
};

struct Met {
  double largest_height = 0, largest_slope = 0, least = HUGE_VAL;
};

// A part at one position, on DoubleWithError and, for the least results on the way, on the number that notes them.
template <class Shape>
void meet_at(Met& met, const Shape& shape, float x, float y) {
  const Place at(x, y);
  const Jet<DoubleWithError> one = jet<DoubleWithError>(shape, at);
  Noted::least = HUGE_VAL;
  if constexpr (!std::is_same_v<Shape, fast::HeightGrid>) jet<Noted>(shape, at);
  met.least = std::min(met.least, Noted::least);
  for (const DoubleWithError& number : {one.U, one.Ux, one.Uy})
    if (number.value != 0) met.least = std::min(met.least, std::fabs(number.value));
  met.largest_height = std::max(met.largest_height, std::fabs(one.U.value));
  met.largest_slope = std::max({met.largest_slope, std::fabs(one.Ux.value), std::fabs(one.Uy.value)});
}

template <class Shape>
void meet(Met& met, const Shape& shape, std::initializer_list<float> coordinates) {
  for (const float x : coordinates)
    for (const float y : coordinates) meet_at(met, shape, x, y);
}

// The least exp(-q) that the first stage's series gives: it ends where the header says, whatever q is.
double least_exponential() {
  double least = 1;
  for (double q = 1; q < 1e15; q *= 1.003) least = std::min(least, exp_of_minus(DoubleWithError::exactly(q), q).value);
  return least;
}

// The bounds of one part, mm and mm/mm.
struct Largest {
  double height, slope;
};
Largest largest_of_a_part() {
  const double height = static_cast<double>(kLargestHeight), slope = static_cast<double>(kLargestSlope),
               coordinate = static_cast<double>(kLargestCoordinate), reach = static_cast<double>(kSmallestReach),
               pitch = static_cast<double>(kSmallestPitch), radius = static_cast<double>(kLargestRadius);
  // A cap is as steep as c/√(R² - c²) at most, c its half chord, which is a unit of the last place below R or more.
  const double half_chord = 1 - 0x1p-24, cap_slope = half_chord / std::sqrt((1 - half_chord) * (1 + half_chord));
  return {std::max(height + 2 * slope * coordinate, radius),
          std::max({slope, height / reach, height * slope, 2 * height / reach, 2 * height / pitch, cap_slope})};
}

// Both ends of the domain of a number, and 0 where it is in it; `radius`: of a cap.
std::vector<float> ends_of(height::Meaning meaning, float radius) {
  switch (meaning) {
    case height::Meaning::centre: return {0, kLargestCoordinate};
    case height::Meaning::height: return {-kLargestHeight, 0, kLargestHeight};
    case height::Meaning::slope:
    case height::Meaning::wave: return {-kLargestSlope, 0, kLargestSlope};
    case height::Meaning::reach: return {kSmallestReach, kLargestReach};
    case height::Meaning::radius: return {kSmallestRadius, kLargestRadius};
    case height::Meaning::chord: break;
  }
  return {kSmallestWidth, std::nextafter(2 * radius, 0.0F)};
}

// All combinations of these ends, from the kind's number `from` on.
template <class Kind>
void meet_all_ends(Met& met, Kind shape, std::size_t from = 0) {
  if (from == Kind::numbers().size())
    return meet(met, shape, {0, 5e-4F, 9e-4F, 1, 0.99999F * kSmallestRadius, 7e3F, std::nextafter(kLargestCoordinate, 0.0F)});
  float radius = 0;
  if constexpr (requires { shape.radius; }) radius = shape.radius;
  for (const float end : ends_of(Kind::numbers()[from].meaning, radius)) {
    shape.*Kind::numbers()[from].member = end;
    meet_all_ends(met, shape, from + 1);
  }
}

TEST(height_bounds, every_kind_is_within_the_largest_height_and_slope_at_the_ends_of_its_domain) {
  const Largest largest = largest_of_a_part();
  for (std::size_t kind = 0; kind < height::kKinds; ++kind)
    height::make_shape(kind, [&]<class Kind>(std::type_identity<Kind>) {
      if constexpr (height::HasNumbers<Kind>) {
        Met met;
        meet_all_ends(met, Kind());
        std::printf("  %s: height 2^%.2f, slope 2^%.2f\n", Kind::kName.data(), std::log2(met.largest_height),
                    std::log2(met.largest_slope));
        EXPECT_GT(met.largest_height, 0) << Kind::kName;
        EXPECT_LE(met.largest_height, largest.height) << Kind::kName;
        EXPECT_LE(met.largest_slope, largest.slope) << Kind::kName;
      }
      return height::Plane{};
    });
}

TEST(height_bounds, the_largest_gap_and_slope_are_within_those_of_the_script) {
  const auto [largest_height, largest_slope] = largest_of_a_part();

  Met met;
  const float far = kLargestCoordinate, steep = kLargestSlope, high = kLargestHeight;
  meet(met, height::Plane{steep, -steep, high}, {far, -far});
  meet(met, height::Cone{0, 0, high, kSmallestReach}, {0, 5e-4F, 9e-4F});
  meet(met, height::Gaussian{0, 0, high, kSmallestReach}, {0, 1e-3F, 5e-4F});
  meet(met, height::Grating{high, steep, steep, 0}, {0, 1, 1e-3F, 1.5e-3F, 0.4F});
  meet(met, height::SphereCap{0, 0, kLargestRadius, std::nextafter(2 * kLargestRadius, 0.0F)},
       {0, 7e3F, std::nextafter(far, 0.0F)});
  meet(met, height::Polygons{{{0, -high}, {std::nextafter(kSmallestReach, 1.0F), high}}}, {0, 5e-4F});
  for (const auto interpolant : {height::Interpolant::bilinear, height::Interpolant::cubic_spline}) {
    height::Grid grid{2, 2, kSmallestPitch, height::Edge::tile, interpolant, {-high, high, -high, high}};
    meet(met, fast::HeightGrid(std::make_shared<const height::Grid>(grid)), {-2e-4F, 0, 1e-4F, 3e-4F, 4e-4F});
  }
  std::printf("  a part: height 2^%.2f of 2^%.2f, slope 2^%.2f of 2^%.2f\n", std::log2(met.largest_height),
              std::log2(largest_height), std::log2(met.largest_slope), std::log2(largest_slope));
  EXPECT_LE(met.largest_height, largest_height);
  EXPECT_GE(met.largest_height, largest_height / 2);
  EXPECT_LE(met.largest_slope, largest_slope);
  EXPECT_GE(met.largest_slope, largest_slope / 2);

  const GappaScript script(std::string(FORCESHADE_SOURCE_DIR "/fast/heights/force.g"));
  constexpr double kParts = kMostParts;
  const double largest_gap = kParts * largest_height + static_cast<double>(kLargestCoordinate);
  std::printf("  a sum: gap 2^%.2f, slope 2^%.2f\n", std::log2(largest_gap), std::log2(kParts * largest_slope));
  for (const GappaScript::Piece& piece : script.pieces()) {
    const auto [least_gap, most_gap] = script.interval(piece.name, "GAP");
    const auto [least_x, most_x] = script.interval(piece.name, "x");
    const auto [least_K, most_K] = script.interval(piece.name, "K");
    EXPECT_LE(largest_gap, most_gap);
    EXPECT_GE(largest_gap, most_gap / 4) << "idle";
    EXPECT_LE(kParts * largest_slope, most_x);
    EXPECT_GE(kParts * largest_slope, most_x / 4) << "idle";
    EXPECT_LE(least_K, static_cast<double>(kSmallestStiffness));
    EXPECT_GE(most_K, static_cast<double>(kLargestStiffness));
    // Below the script's lower ends every component is below 2^-160, a tenth of a thousandth of what rounds to a number.
    EXPECT_LE(least_gap * most_K * most_x, 0x1p-160);
    EXPECT_LE(least_x * most_K * most_gap, 0x1p-160);
    // Squares of such slopes are lost beside 1, by far.
    EXPECT_LE(least_x, 0x1p-500);
    if (piece.name == "force") {
      const auto [least_y, most_y] = script.interval(piece.name, "y");
      EXPECT_LE(least_y, least_x);
      EXPECT_GE(most_y, most_x);
    }
  }
}

TEST(height_bounds, the_least_result_of_a_jet_is_within_that_of_tracked_numbers) {
  const double number = log2_of(kLeastFloat), unit = std::log2(kLeastDifference), reach = log2_of(kLargestReach),
               coordinate = log2_of(kLargestCoordinate), quantum = log2_of(kPositionQuantum);
  const double farthest = coordinate + 1.5;  // √8 times the largest coordinate
  const double exponential = std::log2(least_exponential());
  // The least result of kind after kind, as a logarithm. A difference of two numbers is 0 or a multiple of their last bits.
  const double plane = number + quantum;
  const double cone = number - reach + std::min(unit - coordinate, 2 * unit - reach - 1);
  const double cap = 2 * unit - reach - 1;
  // exp(-q)/σ² falls with σ while q > 1, so σ is the largest at which the series ends.
  const double variance = 2 * farthest - std::log2(2 * -exponential * std::log(2));
  const double gaussian = number + exponential - variance + unit;
  // The angle is halved until it is below 2^-kBits, and its square is taken; sines are multiplied by height and wave.
  const double size = log2_of(kLargestSlope) + coordinate + 2;
  const double part = number + unit - std::floor(size) - 2 - fast::SeriesSize<DoubleWithError>::kBits;
  const double grating = std::min(2 * part, 2 * number + part);
  const double polygons = 2 * unit - farthest;
  const double grid = 2 * unit - 2 * log2_of(kLargestPitch);
  const double least_of_part = std::min({plane, cone, cap, gaussian, grating, polygons, grid});
  // A sum of parts cancels down to the last bit of the least of them.
  const double least = least_of_part - 52;

  Met met;
  const float tiny = kPositionQuantum, next = std::nextafter(kPositionQuantum, 1.0F), far = kLargestCoordinate;
  Met of_gaussian, of_grating;
  // At none of these does DoubleWithError's series end yet, which it does for its own number alone.
  for (const float sigma : {817.0F, 820.0F, 900.0F, 1154.0F})
    meet_at(of_gaussian, height::Gaussian{tiny, -far, kLeastFloat, sigma}, next, far);
  meet(of_grating, height::Grating{kLeastFloat, kLeastFloat, -kLeastFloat, 0}, {tiny, next});
  meet(of_grating, height::Grating{kLeastFloat, kLargestSlope, kLeastFloat, 0}, {0, next, far});
  meet(met, height::Plane{kLeastFloat, kLeastFloat, kLeastFloat}, {tiny, next});
  meet(met, height::Cone{tiny, tiny, kLeastFloat, kLargestReach}, {next, tiny, 7e3F});
  meet(met, height::SphereCap{tiny, tiny, kLargestRadius, 2e3F}, {next, tiny, 7e2F});
  meet(met, height::Polygons{{{-far, tiny}, {far, next}}}, {-far, next, tiny});
  const double met_gaussian = std::log2(of_gaussian.least), met_grating = std::log2(of_grating.least),
               met_others = std::log2(met.least);
  std::printf("  Gaussian 2^%.1f of 2^%.1f, grating 2^%.1f of 2^%.1f, others 2^%.1f of 2^%.1f; sum 2^%.1f\n", met_gaussian,
              gaussian, met_grating, grating, met_others, std::min({plane, cone, cap, polygons, grid}), least);
  EXPECT_GE(met_gaussian, gaussian);
  EXPECT_GE(met_grating, grating);
  EXPECT_GE(met_others, std::min({plane, cone, cap, polygons, grid}));
  EXPECT_LE(std::min(met_gaussian, met_grating), least_of_part + 24) << "idle";
  EXPECT_GE(least, std::log2(DoubleWithError::kLeastResult));
  EXPECT_LE(least, std::log2(DoubleWithError::kLeastResult) + 24) << "idle";
}

// A Ball without error.
struct Rational {
  mpq_class value;

  static Rational exactly(double a) { return {mpq_class(a)}; }
  Rational operator-() const { return {-value}; }
  friend Rational operator+(const Rational& a, const Rational& b) { return {a.value + b.value}; }
  friend Rational operator-(const Rational& a, const Rational& b) { return {a.value - b.value}; }
  friend Rational operator*(const Rational& a, const Rational& b) { return {a.value * b.value}; }
  friend Rational operator/(const Rational& a, const Rational& b) { return {a.value / b.value}; }

  double denominator_bits() const {
    long exponent = 0;
    const double fraction = mpz_get_d_2exp(&exponent, value.get_den_mpz_t());
    return std::log2(fraction) + static_cast<double>(exponent);
  }
};

struct Denominators {
  double U = 0, slopes = 0;  // base-2 logarithms
};

template <class Shape>
Denominators denominators(const std::function<Shape()>& any_shape, const std::function<float()>& any_coordinate) {
  Denominators most;
  for (int i = 0; i < 500; ++i) {
    const Jet<Rational> one = jet<Rational>(any_shape(), Place(any_coordinate(), any_coordinate()));
    most.U = std::max(most.U, one.U.denominator_bits());
    most.slopes = std::max({most.slopes, one.Ux.denominator_bits(), one.Uy.denominator_bits()});
  }
  return most;
}

void expect(const char* kind, const Denominators& met, const Denominators& bound) {
  std::printf("  %-8s U 2^%.1f of 2^%.1f, slopes 2^%.1f of 2^%.1f\n", kind, met.U, bound.U, met.slopes, bound.slopes);
  EXPECT_LE(met.U, bound.U) << kind;
  EXPECT_GE(met.U, bound.U - 8) << kind << ": idle";
  EXPECT_LE(met.slopes, bound.slopes) << kind;
  EXPECT_GE(met.slopes, bound.slopes - 8) << kind << ": idle";
}

// The bounds of the maps that are rational functions of a position, each part by itself.
TEST(height_bounds, the_denominators_of_rational_maps_are_those_of_the_domain) {
  std::mt19937_64 random(1);
  const auto odd_float = [&](float near) {  // of about this size, with all 24 bits
    return near * (1 - 0x1p-5F) + near * 0x1p-24F * static_cast<float>(2 * (random() % (1U << 18)) + 1);
  };
  const auto coordinate = [&] { return odd_float(1.5F * kPositionQuantum); };
  const double unit = -std::log2(kLeastDifference), number = -log2_of(kLeastFloat);
  // t = (x - start)/pitch: of the pitch in units of the last place of x.
  const double pitch = log2_of(kLargestPitch), t = pitch + unit;
  const double stiffness = 23 - std::floor(log2_of(kSmallestStiffness));
  for (const auto interpolant : {height::Interpolant::bilinear, height::Interpolant::cubic_spline}) {
    const bool is_spline = interpolant == height::Interpolant::cubic_spline;
    const auto any = [&] {
      height::Grid grid{4, 4, odd_float(kLargestPitch), height::Edge::clamp, interpolant, {}};
      for (int i = 0; i < 16; ++i) grid.values.push_back(odd_float(1.5F * kPositionQuantum));
      return fast::HeightGrid(std::make_shared<const height::Grid>(grid));
    };
    // Cubes of both t over 36 for a spline, whose slopes take the place of one t by the pitch over 12.
    const Denominators bound = is_spline ? Denominators{6 * t + std::log2(36) + unit, 5 * t + std::log2(12) + unit + pitch}
                                         : Denominators{2 * t + unit, t + unit + pitch};
    expect(is_spline ? "spline" : "bilinear", denominators<fast::HeightGrid>(any, coordinate), bound);
    // The denominator of a component squared and times n²: docs/proofs.md, stage 3 of height maps.
    EXPECT_LE(2 * (stiffness + bound.U + bound.slopes), 1700);
  }
  const auto any_polygons = [&] {
    const float far = kLargestCoordinate;
    return height::Polygons{{{-odd_float(far), odd_float(1.5F * kPositionQuantum)}, {odd_float(0x1p-14F), -odd_float(1.0F)}}};
  };
  const auto beside = [&] { return -odd_float(1.5F * kPositionQuantum); };
  const double knots = log2_of(kLargestCoordinate) + 1 + unit;
  expect("polygons", denominators<height::Polygons>(any_polygons, beside), {knots + unit, knots});
  const auto any_plane = [&] { return height::Plane{0x1p-126F - kLeastFloat, 0x1p-127F + kLeastFloat, 1}; };
  expect("plane", denominators<height::Plane>(any_plane, coordinate), {number + unit, number});
}

}  // namespace
}  // namespace forceshade::tests
