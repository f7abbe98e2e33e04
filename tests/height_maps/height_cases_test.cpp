// SPDX-License-Identifier: BSD-3-Clause
// The hard cases of height maps: both sides give the recorded force and status, by every instruction set, and each case is as
// close to a tie or to the surface as its file says.

#include "tests/height_maps/height_cases.h"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <sstream>

#include "fast/heights/spline_force.h"
#include "files/csv.h"
#include "forceshade/fast.h"
#include "forceshade/reference.h"
#include "properties/binary32.h"
#include "tests/support/words.h"

namespace forceshade::tests {
namespace {

using properties::same_bits;
using properties::show;

class HeightCases : public ::testing::TestWithParam<std::size_t> {};

TEST_P(HeightCases, are_answered) {
  const HeightScene scene = height_scenes()[GetParam()];
  const Balls balls(scene);
  std::array<int, 3> stages{};
  std::set<std::pair<height::Mode, std::string>> kinds;
  double closest = 0;
  for (const HeightCase& one : height_cases(scene)) {
    SCOPED_TRACE(one.place + ": " + one.why);
    const auto law = std::get<fast::HeightMapField>(fast::HeightMapField::build(scene.map, one.mode, one.stiffness));
    const auto reference =
        std::get<reference::HeightMapField>(reference::HeightMapField::build(scene.map, one.mode, one.stiffness));
    const auto expect_recorded = [&](std::string_view who, const Eigen::Vector3f& force) {
      for (int axis = 0; axis < 3; ++axis) EXPECT_TRUE(same_bits(force[axis], one.force[axis])) << who << ": " << show(force);
    };
    const reference::Rounded exact = reference.round_to_binary32(one.position);
    const fast::Evaluation answer = law.evaluate(one.position);
    expect_recorded("reference", exact.force);
    expect_recorded("fast", answer.force);
    EXPECT_EQ(exact.status, one.status);
    EXPECT_EQ(answer.status, one.status);
    EXPECT_EQ(closeness(balls, one, is_about_gap(one)), one.closest);
    for (const fast::InstructionSet set : fast::kInstructionSets) {
      if (!fast::is_available(set)) continue;
      const std::vector<Eigen::Vector3f> at(fast::kSplineBatch + 1, one.position);  // a whole batch and one more
      std::vector<Eigen::Vector3f> forces(at.size());
      law.force(at, forces, set);
      expect_recorded(fast::name_of(set), forces.front());
      expect_recorded(fast::name_of(set), forces.back());
    }
    ++stages[static_cast<std::size_t>(answer.stage)];
    kinds.emplace(one.mode, one.why);
    if (const std::size_t power = one.closest.find("^-"); !is_about_gap(one) && power != std::string::npos)
      closest = std::max(closest, std::stod(one.closest.substr(power + 2)));
  }
  std::printf("  %s: answered by binary64 %d, double-double %d, wide %d; nearest to a tie, not on it: 2^-%.0f of its size\n",
              scene.name, stages[0], stages[1], stages[2], closest);
  for (const auto& [mode, name] : height::kModes) {
    if (!is_rendered(scene, mode)) continue;
    EXPECT_TRUE(kinds.contains({mode, "Fz: nearest to a tie"})) << name;
    EXPECT_TRUE(kinds.contains({mode, "Fz: binary64 lands across the tie"}) || scene.name == std::string("plane") ||
                scene.name == std::string("what-cancels") || mode == height::Mode::conservative)
        << name;
  }
  EXPECT_GT(stages[1] + stages[2], 0) << "no case is hard";
}

INSTANTIATE_TEST_SUITE_P(of, HeightCases, ::testing::Range(std::size_t{0}, height_scenes().size()), [](const auto& info) {
  std::string name = height_scenes()[info.param].name;
  std::ranges::replace(name, '-', '_');
  return name;
});

std::string refusal_of(const std::string& row) {
  std::istringstream in("rendering,K,x,y,z,Fx,Fy,Fz,status,closest,why\n" + row);
  return tests::thrown_by<Error>([&] { read_height_cases(in, "tests/some.cases"); });
}

TEST(height_case_files, are_refused_by_file_and_line) {
  EXPECT_EQ(refusal_of("height-map,1,0,0,-1,0,0,1,contact,z 0,a tie\n"), "");
  EXPECT_EQ(refusal_of(""), "tests/some.cases:1: expected cases below the header");
  EXPECT_EQ(refusal_of("map,1,0,0,-1,0,0,1,contact,z 0,a tie\n"),
            "tests/some.cases:2: column 1 (rendering): expected a rendering, got \"map\"");
  EXPECT_EQ(refusal_of("height-map,1,0,0,-1,0,0,1,invalid,z 0,a tie\n"),
            "tests/some.cases:2: column 9 (status): expected free or contact, got \"invalid\"");
  EXPECT_EQ(refusal_of("height-map,1,0,0,-1,0,0,1,contact,z 0,\n"),
            "tests/some.cases:2: column 11 (why): expected words, got \"\"");
}

}  // namespace
}  // namespace forceshade::tests
