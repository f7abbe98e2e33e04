// SPDX-License-Identifier: BSD-3-Clause
// The C interface of the exact side gives what the C++ calls give, and every digit that independent programs computed.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "bindings/reference/rational.h"
#include "forceshade/properties.h"
#include "forceshade/reference.h"
#include "forceshade/subjects.h"
#include "forceshade_reference.h"
#include "tests/bindings/batches.h"
#include "tests/bindings/references.h"
#include "tests/bindings/subjects.h"
#include "tests/support/temporary_directory.h"

namespace forceshade {
namespace {

using tests::batch_of;
using tests::bits_of;
using tests::kBump;
using tests::law_file;
using tests::parsed;
using tests::positions;
using tests::write_tetrahedron;

std::string decimals(forceshade_reference reference, const std::array<float, 3>& at, std::uint32_t digits) {
  std::size_t length = 0;
  EXPECT_EQ(forceshade_reference_decimals(reference, at.data(), digits, nullptr, 0, &length, nullptr), FORCESHADE_OK)
      << forceshade_reference_message();
  std::string text(length + 1, '?');
  EXPECT_EQ(forceshade_reference_decimals(reference, at.data(), digits, text.data(), text.size(), nullptr, nullptr),
            FORCESHADE_OK);
  EXPECT_EQ(text.back(), '\0');
  text.pop_back();
  return text;
}

// The C++ calls have the golden digits (tests/laws/golden_test.cpp).
TEST(reference_interface, has_every_digit_and_every_bit_that_cpp_has_of_laws_and_their_geometry) {
  const std::vector<float> at = positions(100, 3);
  for (const LawName& name : kLaws)
    for (const Parameters& its : {Parameters{15.24F, 25.4F, 0.5F}, {1.25F, 1.5F, 3}}) {
      const forceshade_reference law = parsed(law_file(std::string(name.name), its));
      const auto right = std::get<reference::Law>(reference::Law::build(name.id, its));
      std::vector<float> forces(at.size(), 7);
      std::vector<forceshade_status> statuses(at.size() / 3, 99);
      const forceshade_batch batch = batch_of(at, forces, statuses);
      ASSERT_EQ(forceshade_reference_forces(law, &batch, nullptr), FORCESHADE_OK) << forceshade_reference_message();
      int contacts = 0;
      for (std::size_t i = 0; i < statuses.size(); ++i) {
        const std::array<float, 3> p{at[3 * i], at[3 * i + 1], at[3 * i + 2]};
        const reference::Rounded exact = right.round_to_binary32({p[0], p[1], p[2]});
        EXPECT_EQ(bits_of(&forces[3 * i]), bits_of(exact.force.data())) << name.name;
        EXPECT_EQ(statuses[i], static_cast<int>(exact.status)) << name.name;
        const reference::DecimalForce digits = right.decimal({p[0], p[1], p[2]}, 40);
        EXPECT_EQ(decimals(law, p, 40), digits.x + " 0 " + digits.z) << name.name;
        contacts += exact.status == Status::contact ? 1 : 0;
      }
      EXPECT_GT(contacts, 0) << name.name;
      EXPECT_EQ(forceshade_reference_free(law), FORCESHADE_OK);

      const reference::DecimalGeometry geometry = reference::geometry(its, 50);
      std::array<char, 1000> text{};
      std::size_t length = 0;
      ASSERT_EQ(forceshade_reference_geometry(its.radius, its.width, 50, text.data(), text.size(), &length), FORCESHADE_OK);
      EXPECT_EQ(std::string(text.data(), length),
                geometry.d + '\n' + geometry.h + '\n' + geometry.w_prime + '\n' + geometry.h_prime + '\n' + geometry.theta);
    }
}

TEST(reference_interface, writes_as_much_of_a_text_as_there_is_room_for) {
  const forceshade_reference bump = parsed(kBump);
  const std::array<float, 3> at{3, 0, -0.5F};
  const std::string all = decimals(bump, at, 20);
  EXPECT_EQ(all, "1.3490643153346555443 0 2.5137452088061372488");
  for (const std::size_t size : {std::size_t{1}, std::size_t{10}, all.size(), all.size() + 1}) {
    std::string text(size + 1, '?');
    std::size_t length = 0;
    forceshade_status status = 99;
    ASSERT_EQ(forceshade_reference_decimals(bump, at.data(), 20, text.data(), size, &length, &status), FORCESHADE_OK);
    EXPECT_EQ(text, all.substr(0, size - 1) + '\0' + '?');
    EXPECT_EQ(length, all.size());
    EXPECT_EQ(status, FORCESHADE_CONTACT);
  }
  EXPECT_EQ(decimals(bump, {3, 0, 20}, 5), "0 0 0");
  EXPECT_EQ(decimals(bump, {3, 0, 2e4F}, 5), "0 0 0");
  EXPECT_EQ(decimals(bump, at, 10000).size(), 20005U);
  forceshade_reference_free(bump);
}

TEST(reference_interface, rounds_a_height_map_and_a_path_on_a_mesh_as_the_calls_of_cpp_do_wherever_they_lie) {
  const tests::TemporaryDirectory folder;
  for (const std::string& file : {std::string(FORCESHADE_SOURCE_DIR "/examples/leather.toml"), write_tetrahedron(folder)}) {
    const std::string text = file.ends_with("leather.toml") ? "height-map = \"" + file + "\"\nstiffness = \"0.5N/mm\"\n" : "";
    const Description description = text.empty() ? subjects::read_file(file) : subjects::read_text(text, "map.toml");
    forceshade_reference reference{};
    if (text.empty())
      ASSERT_EQ(forceshade_reference_read(file.c_str(), &reference), FORCESHADE_OK) << forceshade_reference_message();
    else
      reference = parsed(text, "map.toml");
    constexpr std::size_t kCount = 1000;
    const std::vector<float> at = positions(kCount, 5);
    std::vector<float> forces(2 * at.size(), -1);
    std::vector<forceshade_status> statuses(kCount, 99);
    forceshade_batch batch = batch_of(at, forces, statuses);
    batch.force_stride = 24;
    std::size_t invalid = 99, expected_invalid = 0, contacts = 0;
    ASSERT_EQ(forceshade_reference_forces(reference, &batch, &invalid), FORCESHADE_OK) << forceshade_reference_message();
    const auto subject = properties::subject_of(description);
    const auto path = subject->open_reference();
    for (std::size_t i = 0; i < kCount; ++i) {
      const reference::Rounded exact = path->step({at[3 * i], at[3 * i + 1], at[3 * i + 2]});
      ASSERT_EQ(bits_of(&forces[6 * i]), bits_of(exact.force.data())) << file << " " << i;
      ASSERT_EQ(forces[6 * i + 3], -1) << "what lies between is not touched";
      ASSERT_EQ(statuses[i], static_cast<int>(exact.status));
      expected_invalid += exact.status == Status::invalid ? 1 : 0;
      contacts += finished(exact.status) == Status::contact ? 1 : 0;
    }
    EXPECT_EQ(invalid, expected_invalid);
    EXPECT_GT(invalid, 0U);
    EXPECT_GT(contacts, 10U) << file;
    if (const auto* map = std::get_if<DescribedHeightMap>(&description.what)) {
      const auto field =
          std::get<reference::HeightMapField>(reference::HeightMapField::build(map->map, map->mode, map->stiffness));
      for (std::size_t i = 0; i < 30; ++i) {
        const reference::DecimalMapForce digits = field.decimal({at[3 * i], at[3 * i + 1], at[3 * i + 2]}, 30);
        EXPECT_EQ(decimals(reference, {at[3 * i], at[3 * i + 1], at[3 * i + 2]}, 30),
                  digits.x + ' ' + digits.y + ' ' + digits.z);
      }
    }
    std::size_t first = 99, count = 99;
    ASSERT_EQ(forceshade_reference_differences(reference, &batch, &first, &count), FORCESHADE_OK);
    EXPECT_EQ(count, 0U) << "the path begins anew";
    EXPECT_EQ(first, kCount);
    forceshade_reference_free(reference);
  }
}

TEST(reference_interface, compares_a_component_with_rational_numbers_in_every_form) {
  const forceshade_reference wall = parsed(law_file("wall", {0, 0, 0.5F})), bump = parsed(kBump);
  const std::array<float, 3> in_wall{1, 2, -0.5F}, in_bump{3, 0, -0.5F}, outside{0, 0, 50};
  const auto sign = [](forceshade_reference of, const std::array<float, 3>& at, std::uint32_t axis,
                       const std::string& rational) {
    std::int32_t found = 99;
    EXPECT_EQ(forceshade_reference_compare(of, at.data(), axis, rational.c_str(), &found), FORCESHADE_OK)
        << rational << ": " << forceshade_reference_message();
    return found;
  };
  for (const char* equal : {"1/4", "0.25", "+0.25", "25e-2", "0.0025E+2", ".25", "2/8", "010/040", "0.250"})
    EXPECT_EQ(sign(wall, in_wall, 2, equal), 0) << equal;
  EXPECT_EQ(sign(wall, in_wall, 2, "1000001/4000000"), -1);
  EXPECT_EQ(sign(wall, in_wall, 2, "999999/4000000"), 1);
  EXPECT_EQ(sign(wall, in_wall, 2, "-5"), 1);
  EXPECT_EQ(sign(bump, in_bump, 0, "1.3490643153346555443"), sign(bump, in_bump, 0, "1.34906431533465554430"));
  EXPECT_EQ(sign(bump, in_bump, 0, "1.3490643153346555442"), 1);
  EXPECT_EQ(sign(bump, in_bump, 0, "1.3490643153346555444"), -1);
  EXPECT_EQ(sign(bump, in_bump, 2, "1e10000"), -1);
  EXPECT_EQ(sign(bump, in_bump, 2, "1e-10000"), 1);
  // The component along y is 0, and so is every one where there is no force.
  for (const auto& [at, axis] : {std::pair(in_bump, 1U), std::pair(outside, 0U), std::pair(outside, 2U)}) {
    EXPECT_EQ(sign(bump, at, axis, "0"), 0);
    EXPECT_EQ(sign(bump, at, axis, "-0/3"), 0);
    EXPECT_EQ(sign(bump, at, axis, "1e-9"), -1);
    EXPECT_EQ(sign(bump, at, axis, "-2/3"), 1);
  }
  forceshade_reference_free(wall);
  forceshade_reference_free(bump);
}

TEST(reference_interface, checks_rational_numbers_before_exact_ones_are_made_of_them) {
  const std::map<std::string, std::string> read{
      {"3/4", "3/4"}, {"-3/4", "-3/4"}, {"007", "7/1"},    {"0.50", "050/100"},  {"1e3", "1000/1"},      {"-.5", "-5/10"},
      {"5.", "5/1"},  {"0/7", "0/7"},   {"2.5e1", "25/1"}, {"2.5e-1", "25/100"}, {"+0010/0020", "10/20"}};
  for (const auto& [text, expected] : read) {
    const std::optional<std::string> found = exact::rational_of(text);
    ASSERT_TRUE(found) << text;
    EXPECT_EQ(*found, expected.starts_with("050") ? "50/100" : expected) << text;
  }
  for (const char* none : {"",      "-",     "+",    ".",    "1/0", "1/00",    "/2",
                           "1/",    "1/2/3", "1/-2", "0x10", "1e",  "e5",      "1e+",
                           "1.5/2", "nan",   "inf",  " 1",   "1 ",  "1e10001", "1e-99999999999999999999",
                           "--1",   "1,5",   "1.2.3"})
    EXPECT_FALSE(exact::rational_of(none)) << none;
  EXPECT_TRUE(exact::rational_of(std::string(10000, '1')));
  EXPECT_FALSE(exact::rational_of(std::string(10001, '1')));
}

TEST(reference_interface, finds_what_differs_from_the_exact_forces_bit_for_bit) {
  constexpr std::size_t kCount = 1000;
  const forceshade_reference exact = parsed(kBump);
  const forceshade_subject fast = tests::law_of("bump-2p");
  const std::vector<float> at = positions(kCount, 11);
  std::vector<float> forces(at.size());
  std::vector<forceshade_status> statuses(kCount);
  forceshade_batch batch = batch_of(at, forces, statuses);
  ASSERT_EQ(forceshade_forces(fast, &batch, nullptr), FORCESHADE_OK);
  std::size_t first = 0, count = 99;
  const auto look = [&] {
    EXPECT_EQ(forceshade_reference_differences(exact, &batch, &first, &count), FORCESHADE_OK) << forceshade_reference_message();
    return std::pair(count, first);
  };
  EXPECT_EQ(look(), std::pair(std::size_t{0}, kCount)) << "the real-time library gives the exact forces";
  statuses[700] ^= 1;
  EXPECT_EQ(look(), std::pair(std::size_t{1}, std::size_t{700}));
  forces[3 * 500 + 1] = -0.0F;
  EXPECT_EQ(look(), std::pair(std::size_t{2}, std::size_t{500})) << "a zero is +0";
  forces[3 * 42 + 2] = std::nextafter(forces[3 * 42 + 2], 1e9F);
  EXPECT_EQ(look(), std::pair(std::size_t{3}, std::size_t{42}));
  batch.statuses = nullptr;
  EXPECT_EQ(look(), std::pair(std::size_t{2}, std::size_t{42})) << "statuses that are not given are not compared";
  EXPECT_EQ(forceshade_reference_differences(exact, &batch, nullptr, &count), FORCESHADE_OK);
  batch.count = 0;
  EXPECT_EQ(look(), std::pair(std::size_t{0}, std::size_t{0}));
  forceshade_subject_free(fast);
  forceshade_reference_free(exact);
}

}  // namespace
}  // namespace forceshade
