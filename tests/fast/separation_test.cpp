// SPDX-License-Identifier: BSD-3-Clause
// The numbers of docs/proofs.md, "The last stage", and of the smallest component, from the ends of the domain.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "fast/evaluate.h"
#include "fast/laws/all.h"
#include "forceshade/fast.h"

namespace forceshade {
namespace {

constexpr double kLargestK = 1e3, kLargestR = 1e4, kLargestZ = 1e4;  // N/mm, mm, mm: the ends of the domain
constexpr double kRho = 22361;                                       // mm, not less than √(R² + (|z| + R)²)

// A rounding boundary next to a force of this size.
constexpr double tie(double force) {
  return force * (1 + 0x1p-23);
}

// degree: at most that of (component - tie)·denominator; 2^scale makes it an algebraic integer, whose conjugates are at most
// `conjugate` times that.
struct Separation {
  std::string_view law;
  int bits, degree, scale;
  double conjugate, denominator;
};

// In the notation and with the formulas of the page: c <= R, d <= R, |z ± d| <= |z| + R, R ± d <= 2R, σ <= R, ψ <= 2R,
// ωη <= 2R² because ω² + η² = 4R², and |2R² - ω²| <= 2R². Of the two components it is the one with larger conjugates.
TEST(separation, of_each_law_follows_from_its_largest_conjugate) {
  const double K = kLargestK, R = kLargestR, z = kLargestZ, R2 = R * R, R4 = R2 * R2;
  const double deep = tie(K * (R + z));  // N, a boundary next to K times the largest gap
  const Separation all[] = {
      {"wall", fast::Wall::kSeparation, 1, 150, 1, 1},
      {"bump-1p", fast::Bump1p::kSeparation, 1, 150, 1, 1},
      {"bump-1p-shaded", fast::Bump1pShaded::kSeparation, 2, 177, K * z * R + tie(K * z) * R, R},
      {"cylinder", fast::Cylinder::kSeparation, 4, 203, K * (R + kRho) * (z + R) + tie(K * R) * kRho, R},
      {"bump-cylinder", fast::BumpCylinder::kSeparation, 4, 203, K * (R + kRho) * (z + R) + (K * z + deep) * kRho, R},
      {"bump-2p", fast::Bump2p::kSeparation, 4, 218, K * (R2 + 2 * R * z) * R + deep * 4 * R2, 4 * R2},
      {"bump-2p-shaded", fast::Bump2pShaded::kSeparation, 4, 211, K * (R2 + 2 * R * z) * R + deep * 2 * R2, 2 * R2},
      {"bump-3p", fast::Bump3p::kSeparation, 6, 272, 4 * K * (R + z) * R4 + 4 * deep * R4, 4 * R4},
      {"bump-3p-shaded", fast::Bump3pShaded::kSeparation, 12, 245, 2 * K * (R + z) * R2 * R + 2 * deep * R2 * R, 2 * R2 * R},
  };
  for (const LawName& law : kLaws)
    EXPECT_TRUE(std::any_of(std::begin(all), std::end(all), [&](const Separation& of) { return law.name == of.law; }))
        << law.name;
  EXPECT_GE(kRho, std::hypot(R, z + R));
  for (const Separation& of : all) {
    const double conjugate_bits = of.scale + std::log2(of.conjugate);
    const double bits = of.scale + (of.degree - 1) * conjugate_bits + std::log2(of.denominator);
    EXPECT_LE(bits, of.bits) << of.law;
    EXPECT_GE(bits + 10 + of.degree, of.bits) << of.law << ": more idle than logarithms that are rounded up";
    std::printf("  %-15s largest conjugate 2^%.1f, separation 2^-%.1f, assumed 2^-%d\n", of.law.data(), conjugate_bits, bits,
                of.bits);
  }
}

// The other root of ρ², √(x² + (z - d)²), can be larger than 2R where the law acts, not larger than its bound.
TEST(separation, the_conjugate_of_rho_reaches_three_radii) {
  const auto conjugate = [](double radius, double half, double x, double height) {
    const double d = std::sqrt(radius * radius - half * half);
    EXPECT_LT(std::hypot(x, height + d), radius) << "the law acts";
    return std::hypot(x, height - d);
  };
  EXPECT_GT(conjugate(5000, 1, 1, -9999), 2.99 * 5000);
  std::mt19937 random(26);
  std::uniform_real_distribution<double> share(0, 1);
  double most = 0;
  for (int i = 0; i < 100000; ++i) {
    const double radius = kLargestR * std::pow(10, -5 * share(random)), half = radius * share(random);
    const double d = std::sqrt(radius * radius - half * half), x = radius * share(random);
    const double height = std::max(-kLargestZ, -d - std::sqrt(radius * radius - x * x) * (1 - 1e-9));
    most = std::max(most, conjugate(radius, half, x, height) / radius);
    EXPECT_LE(conjugate(radius, half, x, height), std::min(std::sqrt(10) * radius, kRho));
  }
  EXPECT_GT(most, 2.9);
}

// F_x of a shaded law just deep enough not to be in doubt: K·gap·x/R with gap >= 2^-27 of the height. The rounding test
// requires a normal binary32.
TEST(separation, smallest_component_is_normal) {
  const auto least = [](const Parameters& p) {
    const fast::ThreePolygonGap three = fast::Built<fast::Bump3p>(p).definition.gap;
    const fast::LinearGap two = fast::Built<fast::Bump2p>(p).definition.gap;
    const double height = std::min({three.top.height, three.side.height, two.height});
    return std::ldexp(height, -27) * static_cast<double>(p.stiffness) / static_cast<double>(p.radius) * 0x1p-30;
  };
  const double corner = least({1e4F, 1e-3F, 1e-3F});
  EXPECT_NEAR(std::log2(corner), -116.6, 0.05) << "the page's figure, more than -118";
  EXPECT_LT(fast::Built<fast::Bump3p>({1e4F, 1e-3F, 1e-3F}).definition.gap.top.height, std::exp2(-36.3));
  std::mt19937 random(27);
  std::uniform_real_distribution<float> share(0, 1);
  for (int i = 0; i < 10000; ++i) {
    const float radius = 0.1F * std::pow(10.0F, 5 * share(random)), width = 1e-3F * std::pow(2e3F * radius, share(random));
    if (radius > 1e4F || width > 2 * radius || width < 1e-3F) continue;
    EXPECT_GE(least({radius, width, 1e-3F}), corner * (1 - 1e-6)) << radius << ' ' << width;
  }
}

}  // namespace
}  // namespace forceshade
