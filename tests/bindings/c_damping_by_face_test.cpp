// SPDX-License-Identifier: BSD-3-Clause
// Damping by face through the C interface: the session's and the scene's step that damps.

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstring>
#include <string>

#include "forceshade.h"
#include "tests/bindings/misuse.h"
#include "tests/support/temporary_directory.h"

namespace forceshade {
namespace {

constexpr forceshade_damping_state kBegin{sizeof kBegin, 0, 0, {}, {}};

// A square of two faces at z = 0, of which the first one lets half of B act and no drag.
class CDampingByFace : public testing::Test {
 protected:
  static constexpr forceshade_damping kDamping{sizeof(forceshade_damping), 1024, 1, 0x1p-12F, 2, 0x1p-12F, 0.25F};
  static constexpr std::array<float, 3> kAbove{1, 1, 0.125F};

  CDampingByFace() {
    const tests::TemporaryDirectory folder;
    folder.write("its.obj", "v -4 -4 0\nv 4 -4 0\nv 4 4 0\nv -4 4 0\nf 1 2 3\nf 1 3 4\n");
    folder.write("half.toml", "[[material]]\nname = \"half\"\ndamping = 0.0001220703125\ndrag = 0\nfaces = [\"0\"]\n");
    const std::string file = folder.write("subject.toml",
                                          "mesh = \"its.obj\"\nunit = \"mm\"\nmaterials = \"half.toml\"\nstiffness = "
                                          "\"0.5N/mm\"\n[damping]\ndamping = 0.000244140625\ndrag = 0.000244140625\n");
    EXPECT_EQ(forceshade_subject_read(file.c_str(), &subject), FORCESHADE_OK) << forceshade_message();
    EXPECT_EQ(forceshade_session_open(subject, &session), FORCESHADE_OK);
    EXPECT_EQ(forceshade_scene_open(&subject, 1, &scene), FORCESHADE_OK);
  }
  ~CDampingByFace() override {
    forceshade_session_close(session);
    forceshade_scene_close(scene);
    forceshade_subject_free(subject);
  }

  forceshade_subject subject{};
  forceshade_session session{};
  forceshade_scene scene{};
};

TEST_F(CDampingByFace, of_the_subjects_file_says_that_materials_limit_it) {
  forceshade_damping its{};
  its.size = sizeof its;
  EXPECT_EQ(forceshade_subject_damping(subject, 1024, &its), FORCESHADE_WRONG_KIND);
  EXPECT_STREQ(forceshade_message(),
               "the subject's materials limit damping, which only forceshade_session_damped_step() and "
               "forceshade_scene_damped_step() see; the damping was written");
  EXPECT_EQ(std::memcmp(&its, &kDamping, sizeof its), 0);
}

// A way from 0.125 mm above to 0.5 mm below in a period, at 640 mm/s; the spring's force is 0.25 N. In the scene the square is
// 2 mm farther on.
TEST_F(CDampingByFace, is_what_the_material_lets_act) {
  struct Case {
    float x, y;
    std::array<float, 3> damped;
  };
  const forceshade_pose on{{2, 0, 0}, {1, 0, 0, 0}};
  for (const Case& its : {Case{2, 1, {0, 0, 0.328125F}}, {1, 2, {-0.25F, 0, 0.40625F}}, {1, 1, {-0.25F, 0, 0.40625F}}}) {
    forceshade_damping_state of_session = kBegin, of_scene = kBegin;
    std::array<float, 3> force{}, in_scene{};
    forceshade_status status = FORCESHADE_INVALID, said = FORCESHADE_INVALID;
    forceshade_session_reset(session);
    for (const float z : {0.125F, -0.5F}) {
      const std::array<float, 3> at{its.x + (z < 0 ? 0 : -1), its.y, z}, beside{at[0] + 2, at[1], z};
      ASSERT_EQ(forceshade_session_damped_step(session, &kDamping, &of_session, 1, at.data(), force.data(), &status),
                FORCESHADE_OK);
      ASSERT_EQ(forceshade_scene_damped_step(scene, &kDamping, &of_scene, 1, beside.data(), &on, 1, in_scene.data(), &said),
                FORCESHADE_OK);
    }
    EXPECT_EQ(force, its.damped) << its.x << ", " << its.y;
    EXPECT_EQ(in_scene, its.damped) << its.x << ", " << its.y;
    EXPECT_EQ(status, FORCESHADE_CONTACT);
    EXPECT_EQ(said, FORCESHADE_CONTACT);
    EXPECT_EQ(of_session.velocity[2], -640);
    EXPECT_EQ(of_scene.position[0], its.x + 2);
  }
}

TEST_F(CDampingByFace, a_misuse_has_its_result_and_its_sentence) {
  forceshade_damping_state state = kBegin, small{};
  forceshade_damping none = kDamping;
  none.rate = 0;
  const forceshade_pose pose{{0, 0, 0}, {1, 0, 0, 0}};
  std::array<float, 3> force{};
  const float* const at = kAbove.data();
  float* const to = force.data();
  const auto of_session = [&](forceshade_session its, const forceshade_damping* damping, forceshade_damping_state* its_state,
                              const float* position, float* its_force) -> tests::Use {
    return [=] { return forceshade_session_damped_step(its, damping, its_state, 1, position, its_force, nullptr); };
  };
  const auto of_scene = [&](forceshade_scene its, const forceshade_damping* damping, const forceshade_pose* poses,
                            std::size_t count, const float* position, float* its_force) -> tests::Use {
    return [=, &state] {
      return forceshade_scene_damped_step(its, damping, &state, 1, position, poses, count, its_force, nullptr);
    };
  };
  const auto null = FORCESHADE_NULL_POINTER, value = FORCESHADE_BAD_VALUE, handle = FORCESHADE_BAD_HANDLE;
  tests::expect_each({{"damping", of_session(session, nullptr, &state, at, to), null, "damping or its state is NULL"},
                      {"state", of_session(session, &kDamping, nullptr, at, to), null, "damping or its state is NULL"},
                      {"size", of_session(session, &kDamping, &small, at, to), FORCESHADE_BAD_SIZE, "damping_state)"},
                      {"rate", of_session(session, &none, &state, at, to), value, "rate is 0 Hz"},
                      {"position", of_session(session, &kDamping, &state, nullptr, to), null, "position or force is NULL"},
                      {"force", of_session(session, &kDamping, &state, at, nullptr), null, "position or force is NULL"},
                      {"session", of_session({}, &kDamping, &state, at, to), handle, "session"},
                      {"of a scene: rate", of_scene(scene, &none, &pose, 1, at, to), value, "rate is 0 Hz"},
                      {"of a scene: poses", of_scene(scene, &kDamping, nullptr, 1, at, to), null, "poses or force is NULL"},
                      {"of a scene: count", of_scene(scene, &kDamping, &pose, 2, at, to), value, "one pose for each object"},
                      {"of a scene: force", of_scene(scene, &kDamping, &pose, 1, at, nullptr), null, "poses or force is NULL"},
                      {"scene", of_scene({}, &kDamping, &pose, 1, at, to), handle, "scene"}},
                     &forceshade_message, 12);
  // Nothing has moved, and nothing was written.
  EXPECT_EQ(force, (std::array<float, 3>{}));
  EXPECT_EQ(state.has_position, 0);
  forceshade_state its{};
  its.size = sizeof its;
  ASSERT_EQ(forceshade_session_state(session, &its), FORCESHADE_OK);
  EXPECT_EQ(its.place, FORCESHADE_NOWHERE);
}

}  // namespace
}  // namespace forceshade
