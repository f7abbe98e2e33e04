// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/case_file.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <set>
#include <sstream>
#include <vector>

#include "files/csv.h"
#include "files/npy.h"
#include "forceshade/error.h"
#include "properties/conformance/strokes.h"
#include "tests/support/words.h"

namespace forceshade::conformance {
namespace {

const Description kSubject{"bump-2p", DescribedLaw{LawId::bump_2p, {15.24F, 25.4F, 0.5F}}};

std::vector<Case> cases_of(const std::string& text, const std::string& file) {
  std::istringstream in(text);
  std::vector<Case> cases;
  read_cases(in, file, [&](const Case& each) { cases.push_back(each); });
  return cases;
}

std::string fault_of(const std::string& text, const std::string& file) {
  return tests::thrown_by([&] { cases_of(text, file); });
}

std::string bytes_of(std::initializer_list<float> numbers) {
  std::string bytes;
  for (const float number : numbers) {
    const auto four = std::bit_cast<std::array<char, 4>>(number);
    bytes.append(four.data(), four.size());
  }
  return bytes;
}

TEST(case_file, is_a_csv_whose_resets_and_aims_may_be_missing) {
  const auto all =
      cases_of("aim,x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,reset,periods\ntie,1,2,-0x1p-3,0,-0,0.5,1,0\n,4,5,6,7,8,nan,0,4294967295\n",
               "mine.csv");
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].position, Eigen::Vector3f(1, 2, -0.125F));
  EXPECT_EQ(all[0].force, Eigen::Vector3f(0, 0, 0.5F));
  EXPECT_TRUE(std::signbit(all[0].force.y()));
  EXPECT_TRUE(all[0].is_reset && !all[1].is_reset);
  EXPECT_EQ(all[0].aim, "tie");
  EXPECT_EQ(all[0].periods, 0U);
  EXPECT_EQ(all[1].periods, 4294967295U);
  EXPECT_EQ(all[1].place, "mine.csv:3");
  EXPECT_TRUE(std::isnan(all[1].force.z()));
  const auto few = cases_of("x_mm,y_mm,z_mm,fx_N,fy_N,fz_N\n1,2,3,4,5,6\n", "mine.csv");
  EXPECT_FALSE(few.at(0).is_reset);
  EXPECT_EQ(few.at(0).aim, "");
  EXPECT_EQ(few.at(0).periods, 1U);
}

TEST(case_file, is_an_array_of_records_or_of_six_numbers) {
  const std::string six = files::npy_header("'<f4'", 2);
  const std::string plain = six.substr(0, six.find("(2,)")) + "(2,6)" + six.substr(six.find("(2,)") + 4);
  const std::string rows = bytes_of({1, 2, 3, 4, 5, 6}) + bytes_of({7, 8, 9, 10, 11, -0.0F});
  std::string shorter = plain;  // the header keeps its length: one blank less before the line's end
  shorter.erase(shorter.rfind(' '), 1);
  const auto all = cases_of(shorter + rows, "mine.npy");
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[1].position, Eigen::Vector3f(7, 8, 9));
  EXPECT_TRUE(std::signbit(all[1].force.z()));
  EXPECT_EQ(all[1].place, "mine.npy, row 1");

  const std::string layout =
      "[('reset', '|b1'), ('fz_N', '<f4'), ('fy_N', '<f4'), ('fx_N', '<f4'), ('aim', '<U3'), "
      "('x_mm', '<f4'), ('y_mm', '<f4'), ('z_mm', '<f4'), ('mine', '<i8'), ('periods', '<u4')]";
  std::string record = "\x01" + bytes_of({3, 2, 1}) + std::string("t\0\0\0i\0\0\0e\0\0\0", 12) + bytes_of({4, 5, 6}) +
                       std::string(8, 'x') + std::string("\3\1\0\0", 4);
  const auto one = cases_of(files::npy_header(layout, 1) + record, "mine.NPY");
  ASSERT_EQ(one.size(), 1U);
  EXPECT_TRUE(one[0].is_reset);
  EXPECT_EQ(one[0].force, Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(one[0].position, Eigen::Vector3f(4, 5, 6));
  EXPECT_EQ(one[0].aim, "tie");
  EXPECT_EQ(one[0].periods, 259U);
  EXPECT_EQ(all[0].periods, 1U);
  const std::string as_byte = std::string(layout).replace(layout.find("|b1"), 3, "|u1");
  EXPECT_TRUE(cases_of(files::npy_header(as_byte, 1) + record, "mine.npy").at(0).is_reset);
}

// As NumPy writes records whose fields are aligned; and a reset is never left out.
TEST(case_file, is_an_array_whose_fields_have_gaps) {
  const std::string layout =
      "[('Reset', '|u1'), ('', '|V3'), ('x_mm', '<f4'), ('s', '|u1'), ('', '|V3'), ('y_mm', '<f4'), ('z_mm', '<f4'), "
      "('fx_N', '<f4'), ('fy_N', '<f4'), ('fz_N', '<f4')]";
  const auto row = [](char reset) {
    return std::string{reset, 9, 9, 9} + bytes_of({1}) + std::string(4, 9) + bytes_of({2, 3, 4, 5, 6});
  };
  const auto all = cases_of(files::npy_header(layout, 2) + row(0) + row(1), "mine.npy");
  ASSERT_EQ(all.size(), 2U);
  EXPECT_TRUE(!all[0].is_reset && all[1].is_reset);
  EXPECT_EQ(all[1].position, Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(all[1].force, Eigen::Vector3f(4, 5, 6));
  EXPECT_EQ(fault_of(files::npy_header(layout, 1) + row(2), "mine.npy"), "mine.npy, row 0: reset: expected 0 or 1, got 2");
  EXPECT_TRUE(cases_of("x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,RESET\n1,2,3,4,5,6,1\n", "mine.csv").at(0).is_reset);
}

TEST(case_file, is_refused_with_what_was_expected) {
  EXPECT_EQ(fault_of("x_mm,y_mm,z_mm,fx_N,fy_N,fz_N\n", "mine.csv"), "mine.csv: expected positions with forces, got none");
  EXPECT_NE(fault_of("x_mm,y_mm,z_mm,fx_N,fy_N\n", "mine.csv").find("no column fz_N"), std::string::npos);
  EXPECT_NE(fault_of("x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,reset\n1,2,3,4,5,6,2\n", "mine.csv")
                .find("mine.csv:2: column 7 (reset): expected 0 or 1, got \"2\""),
            std::string::npos);
  for (const char* periods : {"-1", "1.5", "4294967296", "", "1e3"})
    EXPECT_NE(fault_of(std::string("x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,periods\n1,2,3,4,5,6,") + periods + '\n', "mine.csv")
                  .find("mine.csv:2: column 7 (periods): expected a whole number from 0 to 4294967295, got \""),
              std::string::npos)
        << periods;
  const auto npy = [](const std::string& layout, const std::string& rows) { return files::npy_header(layout, 1) + rows; };
  const std::string usual =
      "[('x_mm', '<f4'), ('y_mm', '<f4'), ('z_mm', '<f4'), ('fx_N', '<f4'), ('fy_N', '<f4'), ('fz_N', '<f4')";
  for (const auto& [layout, rows, words] : {
           std::tuple{std::string("'<f4'"), 4U, "expected records with the fields"},
           {usual + "]", 23U, "is truncated: expected 1 rows, got 0"},
           {usual + "]", 25U, "goes on after its last row"},
           {usual.substr(0, usual.rfind(',', usual.size() - 2)) + ")]", 24U, "expected"},
           {std::string("[('x_mm', '<f8')]"), 8U, "field x_mm is of type <f8"},
           {"[('z_mm', '<f8'), " + usual.substr(1, usual.find("('z_mm'") - 1) + usual.substr(usual.find("('fx_N'")) + "]", 28U,
            "field z_mm is of type <f8; expected <f4 (float32)"},
           {usual + ", ('reset', '<i4')]", 28U, "field reset is of type <i4"},
           {usual + ", ('periods', '<i4')]", 28U, "field periods is of type <i4; expected <u4 (uint32)"},
           {usual + ", ('x_mm', '<f4')]", 28U, "expected one dimension, and fields"},
           {usual + ", ('inner', [('a', '<f4')])]", 28U, ""},
       }) {
    const std::string fault = fault_of(npy(layout, std::string(rows, '\0')), "mine.npy");
    EXPECT_NE(fault, "") << layout;
    EXPECT_NE(fault.find(words), std::string::npos) << layout << ": " << fault;
    EXPECT_EQ(fault.rfind("mine.npy", 0), 0U) << fault;
  }
  EXPECT_NE(fault_of("PK\x03\x04", "mine.npy"), "");
}

TEST(case_file, has_the_positions_that_a_subject_is_certified_at) {
  const auto subject = properties::subject_of(kSubject);
  std::ostringstream csv, npy;
  write_positions(csv, false, *subject, kPathLength + 2, 7);
  write_positions(npy, true, *subject, kPathLength + 2, 7);
  EXPECT_EQ(npy.str().find("periods"), std::string::npos);
  std::istringstream in(csv.str());
  files::Reader rows(in, "positions.csv", {"x_mm", "y_mm", "z_mm", "reset", "aim"});
  const auto positions = subject->positions(7);
  const std::string bytes = npy.str().substr(npy.str().size() - (kPathLength + 2) * 25);
  for (std::uint64_t i = 0; i < kPathLength + 2; ++i) {
    ASSERT_TRUE(rows.next());
    const properties::Aimed aimed = positions->next();
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float expected = aimed.position[static_cast<Eigen::Index>(axis)];
      EXPECT_TRUE(rows.binary32(axis) == expected || std::isnan(expected)) << i;
    }
    EXPECT_EQ(rows.text(3), i % kPathLength == 0 ? "1" : "0");
    EXPECT_EQ(rows.text(4), name_of(aimed.aim));
    EXPECT_EQ(bytes[i * 25 + 12], i % kPathLength == 0 ? 1 : 0);
    EXPECT_EQ(std::string(&bytes[i * 25 + 13]).substr(0, 12), std::string(name_of(aimed.aim)).substr(0, 12));
  }
  EXPECT_FALSE(rows.next());
}

// Both kinds of file have the ticks on which conform compares a renderer with damping.
TEST(case_file, has_the_strokes_and_periods_of_a_run_with_damping) {
  const auto subject = properties::subject_of(kSubject);
  constexpr std::uint64_t kTicks = 500;
  std::ostringstream csv, npy;
  write_positions(csv, false, *subject, kTicks, 7, true);
  write_positions(npy, true, *subject, kTicks, 7, true);
  EXPECT_NE(npy.str().find("('periods', '<u4')]"), std::string::npos);
  std::istringstream in(csv.str());
  files::Reader rows(in, "positions.csv", {"z_mm", "periods"});
  Strokes ticks(subject->positions(7), true, 7);
  const std::string bytes = npy.str().substr(npy.str().size() - kTicks * 29);
  std::set<std::uint32_t> seen;
  for (std::uint64_t i = 0; i < kTicks; ++i) {
    ASSERT_TRUE(rows.next());
    const auto [aimed, periods] = ticks.next();
    const float z = aimed.position.z();
    EXPECT_TRUE(rows.binary32(0) == z || std::isnan(z)) << i;
    EXPECT_EQ(rows.text(1), std::to_string(periods));
    std::uint32_t kept = 0;
    std::memcpy(&kept, &bytes[i * 29 + 25], sizeof kept);
    EXPECT_EQ(kept, periods);
    seen.insert(periods);
  }
  EXPECT_FALSE(rows.next());
  EXPECT_GT(seen.size(), 5U);
}

}  // namespace
}  // namespace forceshade::conformance
