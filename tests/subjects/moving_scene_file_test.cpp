// SPDX-License-Identifier: BSD-3-Clause
// Scenes whose objects move: what a file of poses means in each tick, what an object with a motion is, and what is refused in
// which words.

#include <gtest/gtest.h>

#include <cmath>

#include "forceshade/error.h"
#include "forceshade/identity.h"
#include "forceshade/renderer.h"
#include "subjects/motion.h"
#include "tests/subjects/scene_folder.h"

namespace forceshade::subjects {
namespace {

const std::string kTranslations = "time_s,x_mm,y_mm,z_mm\n", kPoses = "time_s,x_mm,y_mm,z_mm,qw,qx,qy,qz\n",
                  kRisingWall = "[[object]]\nname = \"wall\"\nmotion = \"up.csv\"\nlaw = \"wall\"\n",
                  kStillPlate = "[[object]]\nname = \"plate\"\nmesh = \"plate.off\"\nunit = \"mm\"\n";

class MovingScenes : public SceneFolder {
 protected:
  MovingScenes() { folder.write("up.csv", kTranslations + "0,0,0,0\n0.01,0,0,1\n"); }

  scene::Motion motion_of(const std::string& text, bool repeats = false, double rate = 1000) {
    return read_motion(folder.write("poses.csv", text), rate, repeats);
  }
};

TEST_F(MovingScenes, have_the_pose_of_a_row_in_its_tick_and_the_way_between_rows) {
  const scene::Motion motion = motion_of(kPoses + "0,0,0,2,2,0,0,0\n0.004,1,-8,2,2,0,0,1\n");
  ASSERT_EQ(motion.poses.size(), 5U);
  EXPECT_EQ(motion.poses[0], (scene::Pose{{0, 0, 2}, {2, 0, 0, 0}})) << "a row as it stands, whatever its length is";
  EXPECT_EQ(motion.poses[4], (scene::Pose{{1, -8, 2}, {2, 0, 0, 1}}));
  EXPECT_EQ(motion.poses[1].translation, (std::array<float, 3>{0.25F, -2, 2}));
  // Halfway between quaternions of length 1.
  const double w = 2 / std::sqrt(5.0), z = 1 / std::sqrt(5.0);
  EXPECT_EQ(motion.poses[2].rotation, (std::array<float, 4>{static_cast<float>((1 + w) / 2), 0, 0, static_cast<float>(z / 2)}));
  EXPECT_EQ(motion.at(100), motion.poses[4]) << "the last pose stays";
}

TEST_F(MovingScenes, repeat_from_the_tick_of_the_last_row) {
  const scene::Motion motion = motion_of(kTranslations + "0,0,0,0\n0.002,2,0,0\n0.004,0,0,0\n", true);
  ASSERT_EQ(motion.poses.size(), 4U);
  for (const std::uint64_t tick : {0U, 4U, 8U}) EXPECT_EQ(motion.at(tick), motion.poses[0]);
  EXPECT_EQ(motion.at(7).translation[0], 1);
  const scene::Motion one = motion_of(kTranslations + "0,7,0,0\n", true);
  EXPECT_EQ(one.at(3).translation[0], 7);
}

TEST_F(MovingScenes, turn_the_shorter_way) {
  // -q is the same rotation as q.
  const scene::Motion same = motion_of(kPoses + "0,0,0,0,1,0,0,0\n0.002,0,0,0,-1,0,0,0\n");
  EXPECT_EQ(same.poses[1].rotation, (std::array<float, 4>{1, 0, 0, 0}));
  const scene::Motion still = motion_of(kPoses + "0,0,0,0,2,0,0,1\n0.002,1,0,0,2,0,0,1\n");
  EXPECT_EQ(still.poses[1].rotation, (std::array<float, 4>{2, 0, 0, 1})) << "a rotation that stays is not rounded";
  const scene::Motion tiny = motion_of(kPoses + "0,0,0,0,1,0,0,0\n0.002,0,0,0,1,0,1e-9,0\n");
  EXPECT_EQ(tiny.poses[1].rotation, (std::array<float, 4>{1, 0, 0, 0})) << "below 2^-30 a component is 0";
}

TEST_F(MovingScenes, have_poses_for_the_rate) {
  EXPECT_EQ(motion_of(kTranslations + "0,0,0,0\n1,1,0,0\n", false, 500).poses.size(), 501U);
  EXPECT_EQ(motion_of(kTranslations + "0,0,0,0\n0.0014,1,0,0\n").poses.size(), 3U) << "a row between two ticks";
  EXPECT_EQ(motion_of(kTranslations + "0,0,0,0\n0.0014,1,0,0\n").poses[2].translation[0], 1);
}

TEST_F(MovingScenes, refuse_what_is_no_file_of_poses) {
  const auto expect = [&](const std::string& text, const std::string& words) {
    tests::expect_words(tests::thrown_by<Error>([&] { motion_of(text); }), {words});
  };
  expect(kTranslations, "expected a row for each pose, got none");
  expect(kTranslations + "1,0,0,0\n", ":2: column 1 (time_s): expected 0, the time of the first pose, got \"1\"");
  expect(kTranslations + "0,0,0,0\n0,1,0,0\n",
         ":3: column 1 (time_s): expected a time after that of the row before, got \"0\"");
  expect(kTranslations + "0,0,0,0\nnan,1,0,0\n", "expected a time after that of the row before");
  expect(kTranslations + "0,0,0,0\n4000,1,0,0\n", "expected at most 4000000 ticks");
  expect(kTranslations + "0,10001,0,0\n", "column 2 (x_mm): expected mm within 10000");
  expect(kPoses + "0,0,0,0,3,0,0,0\n", "column 5 (qw): expected 0, or 2^-30 to 2 in size, got \"3\"");
  expect(kPoses + "0,0,0,0,0,0,0,0\n", "expected a quaternion that is not 0");
  expect("time_s,x_mm,y_mm,z_mm,qw\n0,0,0,0,1\n", "expected all of the columns qw, qx, qy and qz or none of them");
  expect("time_s,x_mm,y_mm,z_mm,yaw\n0,0,0,0,1\n",
         ":1: column 5: expected one of time_s, x_mm, y_mm, z_mm, qw, qx, qy, qz, got \"yaw\"");
  expect("time_s,x_mm,y_mm\n0,0,0\n", "z_mm");
}

TEST_F(MovingScenes, have_the_ground_first_and_then_what_moves) {
  const Description table =
      read_scene_of("rate = 500\nsides = \"front\"\n" + kRisingWall + "stiffness = 2\nrepeats = true\n" + kStillPlate +
                        "[[object]]\nname = \"other\"\nmotion = \"up.csv\"\nmesh = \"plate.off\"\n"
                        "unit = \"mm\"\nfriction = [0.4, 0.3]\nshading = \"none\"\n",
                    {{"stiffness", "0.25"}});
  const auto& scene = std::get<DescribedScene>(table.what);
  EXPECT_EQ(table.name, "table.toml");
  EXPECT_EQ(scene.rate, 500);
  EXPECT_EQ(table.stiffness(), 0.25F);
  ASSERT_EQ(scene.objects.size(), 3U);
  EXPECT_EQ(scene.objects[0].name, "ground");
  EXPECT_EQ(std::get<MeshRendering>(scene.objects[0].what.what).sides, mesh::Sides::front);
  EXPECT_EQ(scene.objects[0].motion.poses, std::vector<scene::Pose>(1));
  EXPECT_EQ(scene.objects[1].name, "wall");
  EXPECT_EQ(scene.objects[1].what.stiffness(), 2);
  EXPECT_EQ(scene.objects[1].motion.poses.size(), 5U);
  EXPECT_TRUE(scene.objects[1].motion.repeats);
  const auto& other = std::get<MeshRendering>(scene.objects[2].what.what);
  EXPECT_EQ(other.stiffness, 0.25F) << "that of the scene, as it says none";
  EXPECT_EQ(other.materials.list, (std::vector<mesh::Material>{{{}, 0.4F, 0.3F}}));
  EXPECT_EQ(other.shading, mesh::Shading::none);
  EXPECT_EQ(scene.objects[2].motion.poses.size(), 6U);
}

TEST_F(MovingScenes, are_told_apart_by_whatever_changes_a_force) {
  const std::string text = kStillPlate + kRisingWall;
  const Identity its = identity_of(read_scene_of(text));
  EXPECT_EQ(its.kind, kSceneKind);
  EXPECT_EQ(parameters_in_words(its), "objects 2, rate 1000 Hz");
  EXPECT_TRUE(
      identity_of(read_scene_of(kStillPlate + "[[object]]\nname = \"w\"\nmotion = \"up.csv\"\nlaw = \"wall\"\n")).is_same(its))
      << "a name of an object is for people";
  for (const std::string& other :
       {kRisingWall,
        kRisingWall + kRisingWall.substr(0, 11) +
            "name = \"plate\"\nmotion = \"up.csv\"\nmesh = \"plate.off\"\nunit = \"mm\"\n",
        text + "repeats = true\n", text + "stiffness = 0.6\n", "rate = 500\n" + text, "sides = \"front\"\n" + text})
    EXPECT_FALSE(identity_of(read_scene_of(other)).is_same(its)) << other;
  Description repeated = read_scene_of(text);
  std::get<DescribedScene>(repeated.what).objects[1].motion.repeats = true;
  EXPECT_FALSE(identity_of(repeated).is_same(its)) << "the same poses";
  folder.write("up.csv", kTranslations + "0,0,0,0\n0.01,0,0,1.0000001\n");
  EXPECT_FALSE(identity_of(read_scene_of(text)).is_same(its)) << "one bit of one pose";
}

TEST_F(MovingScenes, are_rendered_at_their_rate) {
  const auto built = rendering_of(read_scene_of("rate = 500\n" + kRisingWall));
  const auto& rendering = std::get<Rendering>(built);
  EXPECT_EQ(rendering.rate_hz, 500);
  EXPECT_EQ(rendering.stiffness, 0.5F);
  const std::string stiff = kRisingWall + "stiffness = 3\n" + kStillPlate;
  EXPECT_EQ(std::get<Rendering>(rendering_of(read_scene_of(stiff))).stiffness, 3) << "the largest of its objects";
  // The wall rises by 0.2 mm in each tick under a hand that rests.
  const auto session = rendering.renderer.open();
  for (const float expected : {0.0F, 0.1F, 0.2F}) EXPECT_EQ(session->step({0, 0, 0}).force.z(), expected);
}

TEST_F(MovingScenes, refuse_what_cannot_move_in_words) {
  expect_refusal(kRisingWall + "repeats = 1\n", "table.toml: line 5: repeats: expected true or false, got 1");
  expect_refusal("[[object]]\nname = \"a\"\nmotion = \"up.csv\"\n",
                 "table.toml: line 1: a: expected one of the keys law, height-map and mesh beside motion");
  expect_refusal(kRisingWall + "scene = \"other.toml\"\n", "line 5: unknown key scene; expected keys of a subject");
  expect_refusal(kRisingWall + "translation = [1, 0, 0]\n", "unknown key translation");
  expect_refusal(kStillPlate + "repeats = true\n", "unknown key");
  expect_refusal(kRisingWall + kRisingWall, "name: expected another name for each object, got \"wall\" again");
  expect_refusal("sides = \"both\"\n" + kRisingWall, "sides: expected an object without a motion in the scene, got none");
  expect_refusal(kRisingWall, "--sides: expected an object without a motion in the scene, got none", {{"sides", "both"}});
  expect_refusal("rate = 1000\n" + kStillPlate, "rate: expected an object with a motion in the scene, got none");
  for (const std::string rate : {"99", "10001", "1000.5", "\"fast\""})
    expect_refusal("rate = " + rate + "\n" + kRisingWall, "expected a whole number of ticks per second from 100 to 10000");
  expect_refusal(kRisingWall + "stiffness = 0\n", "table.toml: line 5: stiffness");
  folder.write("up.csv", kTranslations);
  expect_refusal(kRisingWall, "up.csv: expected a row for each pose");
  std::string many;
  folder.write("up.csv", kTranslations + "0,0,0,0\n");
  for (int i = 0; i < 33; ++i)
    many += "[[object]]\nname = \"" + std::to_string(i) + "\"\nmotion = \"up.csv\"\nlaw = \"wall\"\n";
  expect_refusal(many, "expected at most 32 objects");
}

}  // namespace
}  // namespace forceshade::subjects
