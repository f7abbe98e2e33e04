// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A test whose body runs in a simulated world, as the world's first thread.

#include <gtest/gtest.h>

#include "tests/world/world.h"

#define TEST_IN_THE_WORLD(suite, name)                                                            \
  void in_the_world_##suite##_##name();                                                           \
  TEST(suite, name) {                                                                             \
    forceshade::world::World world;                                                               \
    const auto end = world.run(in_the_world_##suite##_##name, 600 * forceshade::system::kSecond); \
    EXPECT_EQ(end, forceshade::world::World::End::over);                                          \
  }                                                                                               \
  void in_the_world_##suite##_##name()
