// SPDX-License-Identifier: BSD-3-Clause
// Both sides against values of an independent program: ours in tests/golden (exact rationals, in Python), and, where it is
// present, another one beside the project.

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <tuple>

#include "files/csv.h"
#include "forceshade/fast.h"
#include "forceshade/reference.h"
#include "properties/binary32.h"

namespace forceshade {
namespace {

using properties::same_bits;
using properties::show;

// The digits of a decimal number and the power of ten of the first, whatever its notation: "-0.00125" and "-1.25e-3" agree.
struct Decimal {
  bool negative = false;
  std::string digits;  // no zero at either end; empty for zero
  long exponent = 0;

  explicit Decimal(std::string text) {
    long power = 0;
    if (const std::size_t e = text.find_first_of("eE"); e != std::string::npos) {
      power = std::stol(text.substr(e + 1));
      text.erase(e);
    }
    negative = text.starts_with('-');
    long point = -1, place = 0;
    for (const char c : text) {
      if (c == '.') point = place;
      if (c < '0' || c > '9') continue;
      digits += c;
      ++place;
    }
    if (point < 0) point = place;
    const std::size_t first = std::min(digits.find_first_not_of('0'), digits.size());
    digits.erase(0, first);
    exponent = power + point - static_cast<long>(first) - 1;
    digits.erase(digits.find_last_not_of('0') + 1);
    if (digits.empty()) *this = Decimal();
  }
  friend bool operator==(const Decimal&, const Decimal&) = default;

 private:
  Decimal() = default;
};

using LawKey = std::tuple<LawId, float, float, float>;

class Golden : public ::testing::Test {
 protected:
  // Compares every row; how many decimal digits are compared, and whether a tie in the last of them may go either way.
  void forces(const std::string& path, unsigned digits, bool ties_to_even, int every) {
    std::ifstream in = files::open_input(path);
    files::Reader rows(
        in, path, {"law", "R_mm", "w_mm", "K_N_per_mm", "x_mm", "y_mm", "z_mm", "fx_N", "fz_N", "fx_binary32", "fz_binary32"});
    std::map<LawKey, std::pair<fast::Law, reference::Law>> laws;
    std::array<int, 3> stages{}, methods{};
    int count = 0, decimals = 0, last_digit = 0;
    while (rows.next()) {
      const LawId id = law_named(rows.text(0)).value();
      const Parameters p{rows.binary32(1), rows.binary32(2), rows.binary32(3)};
      const LawKey key{id, p.radius, p.width, p.stiffness};
      auto found = laws.find(key);
      if (found == laws.end())
        found = laws.emplace(key, std::pair{std::get<fast::Law>(fast::Law::build(id, p)),
                                            std::get<reference::Law>(reference::Law::build(id, p))})
                    .first;
      const auto& [fast, reference] = found->second;
      const Eigen::Vector3f position(rows.binary32(4), rows.binary32(5), rows.binary32(6));
      const float fx = rows.binary32(9), fz = rows.binary32(10);
      const fast::Evaluation answer = fast.evaluate(position);
      const reference::Rounded exact = reference.round_to_binary32(position);
      ASSERT_TRUE(same_bits(answer.force.x(), fx) && same_bits(answer.force.z(), fz))
          << path << ':' << rows.line() << ": fast gives " << show(answer.force);
      ASSERT_TRUE(same_bits(exact.force.x(), fx) && same_bits(exact.force.z(), fz))
          << path << ':' << rows.line() << ": reference gives " << show(exact.force);
      EXPECT_EQ(answer.status, exact.status);
      ++stages[static_cast<std::size_t>(answer.stage)];
      ++methods[static_cast<std::size_t>(exact.method)];
      if (count++ % every != 0) continue;
      const reference::DecimalForce decimal = reference.decimal(position, digits);
      for (const bool is_x : {true, false}) {
        const std::string& ours = is_x ? decimal.x : decimal.z;
        const std::string& theirs = rows.text(is_x ? 7 : 8);
        ++decimals;
        if (Decimal(ours) == Decimal(theirs)) continue;
        // Forgiven to a program that breaks ties otherwise: the value ends exactly one digit further on, in a 5.
        ++last_digit;
        const reference::DecimalForce more = reference.decimal(position, digits + 20);
        const std::string value = Decimal(is_x ? more.x : more.z).digits;
        EXPECT_TRUE(!ties_to_even && value.size() == digits + 1 && value.back() == '5')
            << path << ':' << rows.line() << ": " << ours << " and " << theirs;
      }
    }
    std::printf(
        "  %d rows; stages %d, %d, %d; reference %d by filter, %d by enclosure, %d by exact comparison; %d decimals, %d of "
        "them ties in the last digit\n",
        count, stages[0], stages[1], stages[2], methods[0], methods[1], methods[2], decimals, last_digit);
    EXPECT_GT(count, 3000);
    EXPECT_LE(last_digit, decimals / 100);
    for (const int reached : stages) EXPECT_GT(reached, 0);
    for (const int reached : methods) EXPECT_GT(reached, 0);
  }

  void geometry(const std::string& path) {
    std::ifstream in = files::open_input(path);
    files::Reader rows(in, path, {"R_mm", "w_mm", "d_mm", "h_mm", "w_prime_mm", "h_prime_mm", "theta_rad"});
    int count = 0;
    while (rows.next()) {
      const reference::DecimalGeometry g = reference::geometry({rows.binary32(0), rows.binary32(1), 1}, 50);
      const std::array<std::string, 5> ours{g.d, g.h, g.w_prime, g.h_prime, g.theta};
      for (std::size_t i = 0; i < ours.size(); ++i)
        EXPECT_EQ(Decimal(ours[i]), Decimal(rows.text(i + 2))) << path << ':' << rows.line() << ": " << ours[i];
      ++count;
    }
    std::printf("  %d bumps\n", count);
    EXPECT_GE(count, 10);
  }
};

const std::string kOwn = std::string(FORCESHADE_SOURCE_DIR "/tests/golden/");
const std::string kOther = std::string(FORCESHADE_SOURCE_DIR "/../shared/golden/");

TEST_F(Golden, own_forces_are_met_to_every_bit_and_digit) {
  forces(kOwn + "bump_forces.csv", 40, true, 1);
}

TEST_F(Golden, own_geometry_is_met_to_every_digit) {
  geometry(kOwn + "bump_geometry.csv");
}

TEST_F(Golden, other_forces_are_met_to_every_bit_and_digit) {
  if (!std::filesystem::exists(kOther)) GTEST_SKIP() << "not on this machine";
  forces(kOther + "bump_forces.csv", 40, false, 1);
}

TEST_F(Golden, other_geometry_is_met_to_every_digit) {
  if (!std::filesystem::exists(kOther)) GTEST_SKIP() << "not on this machine";
  geometry(kOther + "bump_geometry.csv");
}

}  // namespace
}  // namespace forceshade
