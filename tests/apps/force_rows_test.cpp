// SPDX-License-Identifier: BSD-3-Clause
// Positions of a CSV that cannot be answered stand beside those that can.

#include "forceshade/apps/force_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <sstream>
#include <stdexcept>

#include "forceshade/apps/bad_input.h"
#include "forceshade/csv/csv.h"

namespace forceshade::apps {
namespace {

struct Answered {
  RowCount count;
  std::string rows, complaints;
};

// Answers x for a position of positive x, and nothing for another.
Answered answered(const std::string& text) {
  std::istringstream in(text);
  std::ostringstream out, complaints;
  const RowCount count = answer_rows(in, "in.csv", out, complaints, [](const Eigen::Vector3f& position, std::ostream& to) {
    if (position.x() <= 0) throw std::domain_error("nobody knows \x1b[2J");
    to << position.x() << ",0,0,ok";
  });
  return {count, out.str(), complaints.str()};
}

TEST(force_rows, that_cannot_be_answered_are_reported_and_the_others_answered) {
  const auto [count, rows, complaints] = answered("z_mm,x_mm,y_mm\n3,1,2\n3,-1,2\n\n3,4,2\n3,0,2\n");
  EXPECT_EQ(count.rows, 4U);
  EXPECT_EQ(count.unanswered, 2U);
  EXPECT_EQ(rows,
            "x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,status\n1,2,3,1,0,0,ok\n-1,2,3,nan,nan,nan,undecided\n4,2,3,4,0,0,ok\n"
            "0,2,3,nan,nan,nan,undecided\n");
  EXPECT_EQ(complaints,
            "forceshade: in.csv:3: cannot be answered: nobody knows \\x1b[2J\n"
            "forceshade: in.csv:6: cannot be answered: nobody knows \\x1b[2J\n");
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
    const auto [count, out, complaints] = answered(text);
    EXPECT_EQ(count.rows, rows);
    EXPECT_EQ(count.unanswered, expected);
    EXPECT_EQ(static_cast<std::size_t>(std::count(out.begin(), out.end(), '\n')), rows + 1);
    EXPECT_EQ(static_cast<std::size_t>(std::count(complaints.begin(), complaints.end(), '\n')), expected);
  }
}

TEST(force_rows, that_cannot_be_read_end_it) {
  EXPECT_THROW(answered("x_mm,y_mm,z_mm\n1,2,3\n1,here,3\n"), csv::Error);
}

}  // namespace
}  // namespace forceshade::apps
