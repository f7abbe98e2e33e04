// SPDX-License-Identifier: BSD-3-Clause
// Scenes through the C interface: forces of objects that move, and what is refused.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "forceshade.h"
#include "tests/bindings/subjects.h"
#include "tests/support/allocations.h"

namespace forceshade {
namespace {

using Force = std::array<float, 3>;

constexpr forceshade_pose kUnmoved{{0, 0, 0}, {1, 0, 0, 0}};
// A quarter turn about y, which takes z to x.
constexpr forceshade_pose kOnItsSide{{0, 0, 0}, {1, 0, 1, 0}};

TEST(c_scenes, add_the_forces_of_their_objects_without_allocation) {
  const std::array objects{tests::law_of("wall"), tests::law_of("wall")};
  forceshade_scene scene{};
  ASSERT_EQ(forceshade_scene_open(objects.data(), 2, &scene), FORCESHADE_OK) << forceshade_message();
  for (const forceshade_subject object : objects) EXPECT_EQ(forceshade_subject_free(object), FORCESHADE_OK);
  // The wall z = 0, and the wall x = 0: the hand is 2 mm below the one and 1 mm behind the other.
  const std::array poses{kUnmoved, kOnItsSide};
  const Force position{-1, 0, -2};
  Force force{};
  forceshade_status status = FORCESHADE_FREE;
  const std::size_t allocated = tests::allocations();
  ASSERT_EQ(forceshade_scene_step(scene, position.data(), poses.data(), 2, force.data(), &status), FORCESHADE_OK);
  EXPECT_EQ(tests::allocations(), allocated);
  EXPECT_EQ(status, FORCESHADE_CONTACT);
  EXPECT_EQ(force, (Force{0.5F, 0, 1}));
  ASSERT_EQ(forceshade_scene_object(scene, 1, force.data(), nullptr), FORCESHADE_OK);
  EXPECT_EQ(force, (Force{0, 0, 0.5F})) << "in its own axes";
  std::array wrong = poses;
  wrong[0].rotation[0] = NAN;
  ASSERT_EQ(forceshade_scene_step(scene, position.data(), wrong.data(), 2, force.data(), &status), FORCESHADE_OK);
  EXPECT_EQ(status, FORCESHADE_INVALID);
  EXPECT_EQ(force, (Force{0, 0, 0}));
  EXPECT_EQ(forceshade_scene_close(scene), FORCESHADE_OK);
}

TEST(c_scenes, refuse_what_is_wrong_with_the_reason) {
  const forceshade_subject wall = tests::law_of("wall");
  std::array<forceshade_subject, 33> many{};
  many.fill(wall);
  forceshade_scene scene{};
  EXPECT_EQ(forceshade_scene_open(many.data(), 33, &scene), FORCESHADE_BAD_VALUE);
  EXPECT_EQ(std::string(forceshade_message()), "number of objects is 33; expected 1 to 32");
  EXPECT_EQ(forceshade_scene_open(many.data(), 0, &scene), FORCESHADE_BAD_VALUE);
  EXPECT_EQ(forceshade_scene_open(nullptr, 1, &scene), FORCESHADE_NULL_POINTER);
  const forceshade_subject none{};
  EXPECT_EQ(forceshade_scene_open(&none, 1, &scene), FORCESHADE_BAD_HANDLE);
  ASSERT_EQ(forceshade_scene_open(many.data(), 32, &scene), FORCESHADE_OK);

  const Force position{0, 0, -1};
  Force force{};
  std::array<forceshade_pose, 33> poses{};
  poses.fill(kUnmoved);
  for (const std::size_t count : {2, 31, 33}) {
    EXPECT_EQ(forceshade_scene_step(scene, position.data(), poses.data(), count, force.data(), nullptr), FORCESHADE_BAD_VALUE);
    EXPECT_EQ(std::string(forceshade_message()), "count: expected one pose for each object of the scene") << count;
  }
  EXPECT_EQ(forceshade_scene_step(scene, position.data(), nullptr, 32, force.data(), nullptr), FORCESHADE_NULL_POINTER);
  EXPECT_EQ(forceshade_scene_object(scene, 32, force.data(), nullptr), FORCESHADE_BAD_VALUE);
  EXPECT_EQ(forceshade_scene_object(scene, 0, nullptr, nullptr), FORCESHADE_NULL_POINTER);
  EXPECT_EQ(forceshade_scene_close(scene), FORCESHADE_OK);
  EXPECT_EQ(forceshade_scene_close(scene), FORCESHADE_BAD_HANDLE);
  EXPECT_EQ(forceshade_scene_object(scene, 0, force.data(), nullptr), FORCESHADE_BAD_HANDLE);
  EXPECT_EQ(std::string(forceshade_message()), "invalid scene handle: it was never opened, or has been closed");
  EXPECT_EQ(forceshade_subject_free(wall), FORCESHADE_OK);
}

}  // namespace
}  // namespace forceshade
