// SPDX-License-Identifier: BSD-3-Clause
// Positions of a CSV that cannot be answered stand beside those that can.

#include "apps/force_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <random>
#include <sstream>
#include <stdexcept>

#include "files/csv.h"

namespace forceshade::apps {
namespace {

struct Answered {
  RowCount count;
  std::string rows, complaints;
  std::string begun = {};  // a letter for each answer and for each beginning
};

// Answers x for a position of positive x, and nothing for another.
Answered answered(const std::string& text, RowFormat format = RowFormat::csv) {
  std::istringstream in(text);
  std::ostringstream out, complaints;
  std::string begun;
  const auto answer = [&begun](const Eigen::Vector3f& position) {
    begun += 'a';
    if (position.x() <= 0) throw std::domain_error("nobody knows \x1b[2J");
    return AnsweredRow{{position.x(), 0, 0}, position.x() > 3 ? RowStatus::unfinished : RowStatus::contact, std::nullopt};
  };
  const RowCount count = answer_rows(in, "in.csv", format, out, complaints, {answer, [&begun] { begun += 'b'; }});
  return {count, out.str(), complaints.str(), begun};
}

TEST(force_rows, that_cannot_be_answered_are_reported_and_the_others_answered) {
  const auto [count, rows, complaints, begun] = answered("z_mm,x_mm,y_mm\n3,1,2\n3,-1,2\n\n3,4,2\n3,0,2\n");
  EXPECT_EQ(count.rows, 4U);
  EXPECT_EQ(count.unanswered, 2U);
  EXPECT_EQ(rows,
            "x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,status\n1,2,3,1,0,0,contact\n-1,2,3,nan,nan,nan,undecided\n4,2,3,4,0,0,unfinished\n"
            "0,2,3,nan,nan,nan,undecided\n");
  EXPECT_EQ(complaints,
            "forceshade: in.csv:3: cannot be answered: nobody knows \\x1b[2J\n"
            "forceshade: in.csv:6: cannot be answered: nobody knows \\x1b[2J\n");
}

// The bytes as the description of the format has them: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html
TEST(force_rows, of_an_npy_file_are_records_of_the_same_numbers) {
  const auto [count, file, complaints, begun] = answered("x_mm,y_mm,z_mm\n1,2,3\n-1,2,3\n4,0.1,3\n", RowFormat::npy);
  EXPECT_EQ(count.rows, 3U);
  EXPECT_EQ(count.unanswered, 1U);
  ASSERT_EQ(file.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const std::size_t header = static_cast<unsigned char>(file[8]) + 256U * static_cast<unsigned char>(file[9]);
  EXPECT_EQ((10 + header) % 64, 0U);
  EXPECT_TRUE(file.substr(10).starts_with(
      "{'descr': [('x_mm', '<f4'), ('y_mm', '<f4'), ('z_mm', '<f4'), ('fx_N', '<f4'), ('fy_N', '<f4'), ('fz_N', '<f4'), "
      "('status', '|u1')], 'fortran_order': False, 'shape': (3,), }"));
  const std::string rows = file.substr(10 + header);
  ASSERT_EQ(rows.size(), 3U * 25);
  const auto number = [&](std::size_t row, std::size_t column) {
    float value = 0;
    std::memcpy(&value, rows.data() + 25 * row + 4 * column, sizeof value);
    return value;
  };
  const auto status = [&](std::size_t row) { return static_cast<int>(rows[25 * row + 24]); };
  EXPECT_EQ(number(0, 0), 1);
  EXPECT_EQ(number(0, 2), 3);
  EXPECT_EQ(number(0, 3), 1);
  EXPECT_EQ(status(0), 1) << "contact";
  EXPECT_TRUE(std::isnan(number(1, 3)) && std::isnan(number(1, 4)) && std::isnan(number(1, 5)));
  EXPECT_EQ(status(1), 5) << "undecided";
  EXPECT_EQ(number(2, 1), 0.1F);
  EXPECT_EQ(number(2, 3), 4);
  EXPECT_EQ(status(2), 4) << "unfinished";
}

TEST(force_rows, are_as_many_as_were_read_whichever_are_answered) {
  std::mt19937 random(2);
  for (int i = 0; i < 50; ++i) {
    std::string text = "x_mm,y_mm,z_mm\n";
    std::size_t expected = 0;
    const std::size_t rows = random() % 40;
    for (std::size_t k = 0; k < rows; ++k) {
      const bool answers = random() % 3 != 0;
      expected += !answers;
      text += answers ? "1,2,3\n" : "-1,2,3\n";
    }
    const auto [count, out, complaints, begun] = answered(text);
    EXPECT_EQ(count.rows, rows);
    EXPECT_EQ(count.unanswered, expected);
    EXPECT_EQ(static_cast<std::size_t>(std::count(out.begin(), out.end(), '\n')), rows + 1);
    EXPECT_EQ(static_cast<std::size_t>(std::count(complaints.begin(), complaints.end(), '\n')), expected);
  }
}

TEST(force_rows, that_cannot_be_read_end_it) {
  EXPECT_THROW(answered("x_mm,y_mm,z_mm\n1,2,3\n1,here,3\n"), Error);
  EXPECT_THROW(answered("x_mm,y_mm,z_mm,reset\n1,2,3,yes\n"), Error);
}

// As `conform positions` writes them: without it a hand would go from the end of a path to the beginning of the next one.
TEST(force_rows, begin_another_path_where_the_column_reset_says_so) {
  EXPECT_EQ(answered("x_mm,y_mm,z_mm,reset,aim\n1,2,3,1,surface\n1,2,3,0,surface\n1,2,3,1,any\n").begun, "baaba");
  EXPECT_EQ(answered("x_mm,y_mm,z_mm\n1,2,3\n1,2,3\n").begun, "aa");
  for (const std::string name : {"Reset", "RESET", "\" reset \""})
    EXPECT_EQ(answered("x_mm,y_mm,z_mm," + name + "\n1,2,3,0\n1,2,3,1\n").begun, "aba") << name;
}

}  // namespace
}  // namespace forceshade::apps
