// SPDX-License-Identifier: BSD-3-Clause
// Every misuse of the C interface of the exact side is an error with a sentence, and never a crash.

#include <gtest/gtest.h>

#include <array>
#include <cfenv>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "forceshade_reference.h"
#include "tests/bindings/batches.h"
#include "tests/bindings/misuse.h"
#include "tests/bindings/references.h"
#include "tests/support/temporary_directory.h"

namespace forceshade {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

using tests::Misuse;
using tests::Use;

std::int32_t go_on(void*, const char*, std::int32_t, std::uint64_t, const char*) {
  return 0;
}

std::int32_t stop_it(void*, double) {
  return 1;
}

class ReferenceMisuse : public testing::Test {
 protected:
  ReferenceMisuse() : bump(tests::parsed(tests::kBump)), freed(tests::parsed(tests::kBump)) {
    EXPECT_EQ(forceshade_reference_read(tests::write_tetrahedron(folder).c_str(), &tetrahedron), FORCESHADE_OK)
        << forceshade_reference_message();
    forceshade_reference_free(freed);
  }
  ~ReferenceMisuse() override {
    forceshade_reference_free(bump);
    forceshade_reference_free(tetrahedron);
  }

  Use forces(const std::function<void(forceshade_batch&)>& change) const {
    forceshade_batch its = batch;
    change(its);
    return [this, its] { return forceshade_reference_forces(tetrahedron, &its, nullptr); };
  }
  Use differences(const std::function<void(forceshade_batch&)>& change) const {
    forceshade_batch its = batch;
    change(its);
    return [this, its] {
      std::size_t count = 0;
      return forceshade_reference_differences(bump, &its, nullptr, &count);
    };
  }
  // Nothing may be written by it.
  Use certify(const std::function<void(forceshade_reference_plan&)>& change) const {
    forceshade_reference_plan its = plan;
    change(its);
    return [this, its] {
      std::int32_t standing = 42;
      const std::string file = folder.file("certificate.json");
      const forceshade_result result = forceshade_reference_certify(bump, &its, file.c_str(), nullptr, nullptr, &standing);
      EXPECT_EQ(standing, 42);
      return result;
    };
  }
  Use compare(std::uint32_t axis, const std::string& rational) const {
    return [this, axis, rational] {
      std::int32_t sign = 42;
      const forceshade_result result = forceshade_reference_compare(bump, at.data(), axis, rational.c_str(), &sign);
      EXPECT_EQ(sign, 42) << "nothing is written where nothing is compared";
      return result;
    };
  }
  Use decimals(forceshade_reference of, std::uint32_t digits) const {
    return [this, of, digits] {
      std::array<char, 9> text{"as it is"};
      std::size_t length = 42;
      const forceshade_result result =
          forceshade_reference_decimals(of, at.data(), digits, text.data(), text.size(), &length, nullptr);
      EXPECT_STREQ(text.data(), "as it is");
      EXPECT_EQ(length, 42U);
      return result;
    };
  }
  static Use geometry(float radius, float width, std::uint32_t digits) {
    return [=] { return forceshade_reference_geometry(radius, width, digits, nullptr, 0, nullptr); };
  }
  std::vector<Use> every_use_of(forceshade_reference of) const {
    return {decimals(of, 10),
            [=, this] { return forceshade_reference_compare(of, at.data(), 0, "1", nullptr); },
            [=, this] { return forceshade_reference_forces(of, &batch, nullptr); },
            [=, this] { return forceshade_reference_differences(of, &batch, nullptr, nullptr); },
            [=] { return forceshade_reference_properties(of, 10, 1, &go_on, nullptr); },
            [=, this] { return forceshade_reference_certify(of, &plan, "absent.json", nullptr, nullptr, nullptr); },
            [=] { return forceshade_reference_free(of); }};
  }

  tests::TemporaryDirectory folder;
  std::array<float, 6> at{1, 2, -3, 4, 5, -6};
  mutable std::array<float, 6> to{};
  mutable std::array<forceshade_status, 2> statuses{};
  forceshade_batch batch = tests::batch_of(at, to, statuses);
  forceshade_reference_plan plan{.size = sizeof(forceshade_reference_plan), .points = 10, .cases = 10, .seed = 1, .threads = 1};
  forceshade_reference bump{}, tetrahedron{}, freed{};
};

TEST_F(ReferenceMisuse, of_every_kind_has_its_result_and_its_sentence) {
  std::int32_t sign = 0;
  const float* const position = at.data();
  const std::string file = folder.file("certificate.json"), nowhere = folder.file("nowhere/certificate.json");
  const auto null = FORCESHADE_NULL_POINTER, size = FORCESHADE_BAD_SIZE, value = FORCESHADE_BAD_VALUE,
             kind = FORCESHADE_WRONG_KIND, failed = FORCESHADE_FAILED;
  std::vector<Misuse> misuses{
      {"decimals position null", [&] { return forceshade_reference_decimals(bump, nullptr, 5, nullptr, 0, nullptr, nullptr); },
       null, "position"},
      {"decimals text null", [&] { return forceshade_reference_decimals(bump, position, 5, nullptr, 9, nullptr, nullptr); },
       null, "text is NULL"},
      {"decimals no digits", decimals(bump, 0), value, "digits is 0; expected 1 to 10000"},
      {"decimals many digits", decimals(bump, 10001), value, "digits is 10001"},
      {"decimals UINT32_MAX digits", decimals(bump, UINT32_MAX), value, "digits is 4294967295"},
      {"decimals of a mesh", decimals(tetrahedron, 5), kind, "depends on the path"},

      {"compare position null", [&] { return forceshade_reference_compare(bump, nullptr, 0, "1", &sign); }, null, "NULL"},
      {"compare rational null", [&] { return forceshade_reference_compare(bump, position, 0, nullptr, &sign); }, null, "NULL"},
      {"compare sign null", [&] { return forceshade_reference_compare(bump, position, 0, "1", nullptr); }, null, "NULL"},
      {"compare axis", compare(3, "1"), value, "axis is 3; expected 0 to 2"},
      {"compare of a mesh", [&] { return forceshade_reference_compare(tetrahedron, position, 0, "1", &sign); }, kind, "path"},
      {"compare by zero", compare(0, "1/0"), value, "got \"1/0\""},
      {"compare empty", compare(1, ""), value, "got \"\""},
      {"compare a word", compare(2, "half"), value, "expected a number such as -3/4"},
      {"compare nan", compare(2, "nan"), value, "got \"nan\""},
      {"compare a hexadecimal number", compare(2, "0x1p-3"), value, "got \"0x1p-3\""},
      {"compare beyond", compare(2, "1e10001"), value, "got"},
      {"compare long", compare(2, std::string(20000, '1')), value, "got \"1111"},

      {"batch null", [&] { return forceshade_reference_forces(bump, nullptr, nullptr); }, null, "batch is NULL"},
      {"differences batch null", [&] { return forceshade_reference_differences(bump, nullptr, nullptr, nullptr); }, null,
       "batch"},
      {"differences count null", [&] { return forceshade_reference_differences(bump, &batch, nullptr, nullptr); }, null,
       "count"},

      {"geometry radius 0", geometry(0, 1, 5), value, "radius is 0 mm; expected 0.1 to 10000"},
      {"geometry radius NaN", geometry(kNan, 1, 5), value, "radius is nan"},
      {"geometry width wide", geometry(1, 3, 5), value, "width is 3 mm"},
      {"geometry no digits", geometry(15, 25, 0), value, "digits is 0"},
      {"geometry text null", [] { return forceshade_reference_geometry(15, 25, 5, nullptr, 1, nullptr); }, null, "text"},

      {"properties callback null", [&] { return forceshade_reference_properties(bump, 5, 1, nullptr, nullptr); }, null,
       "callback"},
      {"properties cases", [&] { return forceshade_reference_properties(bump, UINT64_MAX, 1, &go_on, nullptr); }, value,
       "cases is"},
      {"certify plan null", [&] { return forceshade_reference_certify(bump, nullptr, "x", nullptr, nullptr, nullptr); }, null,
       "plan"},
      {"certify file null", [&] { return forceshade_reference_certify(bump, &plan, nullptr, nullptr, nullptr, nullptr); }, null,
       "file"},
      {"certify size", certify([](auto& its) { its.size = 8; }), size, "plan->size is 8"},
      {"certify points", certify([](auto& its) { its.points = UINT64_MAX; }), value, "plan->points is"},
      {"certify cases", certify([](auto& its) { its.cases = 1000000001; }), value, "plan->cases is 1000000001"},
      {"certify threads", certify([](auto& its) { its.threads = 1025; }), value, "plan->threads is 1025"},
      {"certify output", [&] { return forceshade_reference_certify(bump, &plan, "-", nullptr, nullptr, nullptr); }, value,
       "expected the name of a file"},
      {"certify empty name", [&] { return forceshade_reference_certify(bump, &plan, "", nullptr, nullptr, nullptr); }, failed,
       ""},
      {"certify nowhere", [&] { return forceshade_reference_certify(bump, &plan, nowhere.c_str(), nullptr, nullptr, nullptr); },
       failed, "nowhere/certificate.json"},
      {"certify a folder",
       [&] { return forceshade_reference_certify(bump, &plan, folder.path().c_str(), nullptr, nullptr, nullptr); }, failed,
       folder.path()},
      {"certify stopped", [&] { return forceshade_reference_certify(bump, &plan, file.c_str(), &stop_it, nullptr, nullptr); },
       failed, "stopped before its end"},
  };
  add(misuses, tests::misuses_of_files(&forceshade_reference_read, &forceshade_reference_parse));
  add(misuses, tests::misuses_of_batches("batch ", [this](const auto& change) { return forces(change); }));
  add(misuses, tests::misuses_of_batches("differences batch ", [this](const auto& change) { return differences(change); }));
  add_handles<forceshade_reference>(misuses, "handle",
                                    {{0}, {7}, {UINT64_MAX}, {bump.handle ^ (std::uint64_t{1} << 40U)}, freed},
                                    [this](forceshade_reference of) { return every_use_of(of); });

  const std::ptrdiff_t files = folder.entries();
  expect_each(misuses, &forceshade_reference_message, 110);
  EXPECT_EQ(folder.entries(), files) << "nothing is left of a certificate that was not made";
  EXPECT_STREQ(forceshade_message(), "") << "the message of the other library is its own";
  // All that was made is as it was.
  EXPECT_EQ(forceshade_reference_forces(bump, &batch, nullptr), FORCESHADE_OK);
  EXPECT_EQ(forceshade_reference_forces(tetrahedron, &batch, nullptr), FORCESHADE_OK);
}

TEST_F(ReferenceMisuse, another_rounding_is_an_error) {
  std::fesetround(FE_UPWARD);
  forceshade_reference made{};
  std::size_t count = 0;
  const std::vector<forceshade_result> results{
      forceshade_reference_parse(tests::kBump.data(), tests::kBump.size(), "bump.toml", &made),
      decimals(bump, 5)(),
      compare(0, "1")(),
      forceshade_reference_forces(bump, &batch, nullptr),
      forceshade_reference_differences(bump, &batch, nullptr, &count),
      geometry(15, 25, 5)(),
      forceshade_reference_properties(bump, 5, 1, &go_on, nullptr),
      certify([](auto&) {})()};
  EXPECT_EQ(std::fegetround(), FE_UPWARD);
  std::fesetround(FE_TONEAREST);
  for (const forceshade_result result : results) EXPECT_EQ(result, FORCESHADE_BAD_ARITHMETIC);
  EXPECT_NE(std::string(forceshade_reference_message()).find("expected the arithmetic of IEEE 754"), std::string::npos)
      << forceshade_reference_message();
}

TEST_F(ReferenceMisuse, a_position_that_is_no_number_is_invalid_and_no_error) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<float, 3> position{1, 1, -1};
    position[axis] = kNan;
    std::array<char, 20> text{};
    forceshade_status status = 99;
    EXPECT_EQ(forceshade_reference_decimals(bump, position.data(), 5, text.data(), text.size(), nullptr, &status),
              FORCESHADE_OK);
    EXPECT_EQ(status, FORCESHADE_INVALID);
    EXPECT_STREQ(text.data(), "0 0 0");
    std::int32_t sign = 9;
    EXPECT_EQ(forceshade_reference_compare(bump, position.data(), 2, "0", &sign), FORCESHADE_OK);
    EXPECT_EQ(sign, 0);
  }
}

}  // namespace
}  // namespace forceshade
