// SPDX-License-Identifier: BSD-3-Clause
// Both sides of damping against the rows of the program in rationals, tests/golden/make_damping_golden.py; and, where it is
// named, against another folder of such rows.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "files/csv.h"
#include "tests/damping/both_sides.h"

namespace forceshade {
namespace {

Eigen::Vector3f vector_in(const files::Reader& rows, std::size_t first) {
  return {rows.binary32(first), rows.binary32(first + 1), rows.binary32(first + 2)};
}

// By the name of the path.
std::map<std::string, damping::Parameters> parameters_in(const std::string& folder) {
  std::map<std::string, damping::Parameters> found;
  const std::string path = folder + "/parameters.csv";
  std::ifstream in = files::open_input(path);
  files::Reader rows(in, path, {"path", "rate_Hz", "alpha", "damping_Ns_mm", "most", "drag_Ns_mm", "drag_from_N"});
  while (rows.next())
    found[rows.text(0)] = {rows.binary32(1), rows.binary32(2), rows.binary32(3),
                           rows.binary32(4), rows.binary32(5), rows.binary32(6)};
  return found;
}

// Returns the number of rows.
int expect_path(const std::string& path, const damping::Parameters& parameters, std::map<std::string, int>& reached) {
  tests::DampingOfBothSides both(parameters);
  std::ifstream in = files::open_input(path);
  files::Reader rows(in, path,
                     {"periods", "x_mm", "y_mm", "z_mm", "status", "fx_N", "fy_N", "fz_N", "vx_mm_s", "vy_mm_s", "vz_mm_s",
                      "Fx_N", "Fy_N", "Fz_N"},
                     {"damping_limit_Ns_mm", "drag_limit_Ns_mm"});
  int count = 0;
  while (rows.next()) {
    ++count;
    ++reached[rows.text(4)];
    const Eigen::Vector3f position = vector_in(rows, 1), force = vector_in(rows, 11);
    const auto periods = static_cast<std::uint32_t>(std::stoul(rows.text(0)));
    // The renderer of an invalid row does not see that it is: the stage does.
    const Status status = rows.text(4) == "free" ? Status::free : Status::contact;
    const damping::Limits limits = rows.has(14) ? damping::Limits{rows.binary32(14), rows.binary32(15)} : damping::Limits{};
    reached["limited"] += limits.damping < parameters.damping || limits.drag < parameters.drag;
    const fast::Evaluation found = both.tick(position, periods, vector_in(rows, 5), status, limits);
    const std::array<float, 3> velocity = both.fast.state().velocity;
    const bool is_nan = std::isnan(force.x());
    EXPECT_TRUE(is_nan ? std::isnan(found.force.x()) : found.force == force) << path << ':' << rows.line();
    EXPECT_EQ(Eigen::Vector3f(velocity.data()), vector_in(rows, 8)) << path << ':' << rows.line();
    EXPECT_EQ(found.status == Status::invalid, rows.text(4) == "invalid") << path << ':' << rows.line();
  }
  return count;
}

int expect_single_ticks(const std::string& path) {
  std::ifstream in = files::open_input(path);
  files::Reader rows(in, path,
                     {"damping_Ns_mm", "most", "drag_Ns_mm", "drag_from_N", "vx_mm_s", "vy_mm_s", "vz_mm_s", "fx_N", "fy_N",
                      "fz_N", "Fx_N", "Fy_N", "Fz_N"});
  int count = 0;
  while (rows.next()) {
    ++count;
    tests::DampingOfBothSides both({1000, 1, rows.binary32(0), rows.binary32(1), rows.binary32(2), rows.binary32(3)});
    both.resume({true, {0, 0, 0}, {rows.binary32(4), rows.binary32(5), rows.binary32(6)}, 0});
    const fast::Evaluation found = both.tick({0, 0, 0}, 0, vector_in(rows, 7));
    EXPECT_EQ(found.force, vector_in(rows, 10)) << path << ':' << rows.line();
  }
  return count;
}

void expect_folder(const std::string& folder, int least) {
  std::map<std::string, int> reached;
  int rows = expect_single_ticks(folder + "/ticks.csv");
  for (const auto& [name, parameters] : parameters_in(folder))
    rows += expect_path(folder + "/" + name + ".csv", parameters, reached);
  std::printf("%d rows: %d free, %d in contact, %d invalid, %d on faces that damp less\n", rows, reached["free"],
              reached["contact"], reached["invalid"], reached["limited"]);
  EXPECT_GE(rows, least);
  for (const char* status : {"free", "contact", "invalid"}) EXPECT_GT(reached[status], 0) << status;
}

TEST(damping_golden, both_sides_meet_every_row_of_the_program_in_rationals) {
  expect_folder(FORCESHADE_SOURCE_DIR "/tests/golden/damping", 2500);
}

TEST(damping_golden, both_sides_meet_every_row_in_a_given_folder) {
  const char* const folder = std::getenv("FORCESHADE_DAMPING_PATHS");
  if (folder == nullptr) GTEST_SKIP() << "FORCESHADE_DAMPING_PATHS names no folder of paths";
  expect_folder(folder, 1);
}

}  // namespace
}  // namespace forceshade
