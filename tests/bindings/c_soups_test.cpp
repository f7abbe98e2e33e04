// SPDX-License-Identifier: BSD-3-Clause
// Meshes that are not regular through the C interface: every bit of fast::GodObject on the stored sets of triangles, states out
// and in, and what is refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include "forceshade.h"
#include "forceshade/fast.h"
#include "forceshade/meshes.h"
#include "tests/bindings/batches.h"
#include "tests/bindings/subjects.h"
#include "tests/meshes/soup_paths.h"
#include "tests/support/drawn.h"

namespace forceshade {
namespace {

using tests::beginning;
using tests::bits_of;

constexpr float kStiffness = 0.3F;  // N/mm
const char *const kShaded = mesh::kShadingNames[1].data(), *const kShadingOfRegular = mesh::kShadingNames[2].data(),
                  *const kContactOfRegular = mesh::kContactNames[1].data();
constexpr std::size_t kFormerState = offsetof(forceshade_state, meeting);
const std::string kSoups = FORCESHADE_SOURCE_DIR "/tests/golden/soups/";

struct Variant {
  const char* shading;
  bool is_rough;
};

forceshade_mesh mesh_of(const mesh::TriangleMesh& its, const char* sides, const char* shading) {
  forceshade_mesh mesh{};
  mesh.size = sizeof mesh;
  mesh.vertices = its.vertices.front().data();
  mesh.vertex_count = its.vertices.size();
  mesh.triangles = its.triangles.front().data();
  mesh.triangle_count = its.triangles.size();
  mesh.sides = sides;
  mesh.shading = shading;
  mesh.crease = 180;
  mesh.stiffness = kStiffness;
  return mesh;
}

forceshade_subject made_of(const forceshade_mesh& mesh) {
  forceshade_subject made{};
  EXPECT_EQ(forceshade_mesh_new(&mesh, &made), FORCESHADE_OK) << forceshade_message();
  return made;
}

forceshade_subject subject_of(const tests::SoupPath& path, const Variant& its) {
  const forceshade_material rough{sizeof rough, 0, 0.5F, 0.25F};
  forceshade_mesh mesh = mesh_of(path.mesh, name_of(path.sides.front()).data(), its.shading);
  mesh.materials = &rough;
  mesh.material_count = its.is_rough ? 1 : 0;
  return made_of(mesh);
}

fast::GodObject god_object_of(const tests::SoupPath& path, const Variant& its) {
  MeshRendering rendering{
      .checked = std::get<mesh::CheckedMesh>(mesh::check_any(path.mesh)),
      .normals = path.normals,
      .sides = path.sides.front(),
      .shading = std::string_view("none") == its.shading ? mesh::Shading::none : mesh::Shading::vertex_scheme,
      .stiffness = kStiffness};
  if (its.is_rough) {
    rendering.contact = mesh::Contact::friction;
    rendering.materials.list = {{{}, 0.5F, 0.25F}};
  }
  return std::get<fast::GodObject>(fast::GodObject::build(rendering));
}

forceshade_state state_of(const mesh::GodObject& its) {
  forceshade_state state = beginning();
  state.place = static_cast<std::uint8_t>(its.place);
  state.side = static_cast<std::uint8_t>(its.side);
  state.slipping = its.is_slipping ? 1 : 0;
  std::ranges::copy(its.position, state.position);
  std::ranges::copy(its.index, state.index);
  std::ranges::copy(its.parameter, state.parameter);
  state.meeting = static_cast<std::uint8_t>(its.meeting);
  std::ranges::copy(its.further, state.further);
  std::ranges::copy(its.cell, state.cell);
  return state;
}

bool is_same(const forceshade_state& a, const forceshade_state& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

forceshade_status status_of(const mesh::Tick& tick) {
  return static_cast<forceshade_status>(tick.status);
}

// Sets with the same sides on all triangles, which alone the interface takes.
std::vector<tests::SoupPath> stored_paths() {
  std::vector<tests::SoupPath> all;
  for (const auto& entry : std::filesystem::directory_iterator(kSoups)) {
    tests::SoupPath path = tests::read_soup_path(entry.path());
    if (std::ranges::count(path.sides, path.sides.front()) == std::ssize(path.sides)) all.push_back(std::move(path));
  }
  return all;
}

TEST(c_soups, give_the_bits_the_status_and_the_state_of_cpp_step_by_step_resumed_and_in_batches) {
  std::map<int, std::size_t> places, meetings;
  std::size_t cells = 0, slipping = 0;
  const std::vector<tests::SoupPath> paths = stored_paths();
  EXPECT_GT(paths.size(), 20U);
  for (const tests::SoupPath& path : paths)
    for (const Variant& its : {Variant{"none", false}, {kShaded, false}, {"none", true}}) {
      const forceshade_subject subject = subject_of(path, its);
      const auto right = god_object_of(path, its).open();
      forceshade_session session{}, resumed{};
      ASSERT_EQ(forceshade_session_open(subject, &session), FORCESHADE_OK) << forceshade_message();
      ASSERT_EQ(forceshade_session_open(subject, &resumed), FORCESHADE_OK);
      const std::size_t count = tests::drawn(path.ticks.size());
      std::vector<float> at, forces;
      std::vector<forceshade_status> statuses;
      std::vector<forceshade_state> before, after;
      forceshade_state state = beginning();
      for (std::size_t i = 0; i < count; ++i) {
        const std::array<float, 3> position = tests::position_of(path.ticks[i]);
        const mesh::Tick tick = right->tick(position);
        std::array<float, 3> force{}, again{};
        forceshade_status status = 99, status_again = 99;
        before.push_back(state);
        ASSERT_EQ(forceshade_session_resume(resumed, &state), FORCESHADE_OK) << forceshade_message();
        ASSERT_EQ(forceshade_session_step(session, position.data(), force.data(), &status), FORCESHADE_OK);
        ASSERT_EQ(forceshade_session_step(resumed, position.data(), again.data(), &status_again), FORCESHADE_OK);
        ASSERT_EQ(bits_of(force.data()), bits_of(tick.force.data())) << "tick " << i;
        ASSERT_EQ(bits_of(again.data()), bits_of(force.data())) << "tick " << i;
        ASSERT_EQ(status, status_of(tick));
        ASSERT_EQ(status_again, status);
        ASSERT_EQ(forceshade_session_state(session, &state), FORCESHADE_OK);
        ASSERT_TRUE(is_same(state, state_of(tick.after))) << "tick " << i;
        after.push_back(state);
        at.insert(at.end(), position.begin(), position.end());
        forces.insert(forces.end(), force.begin(), force.end());
        statuses.push_back(status);
        ++places[state.place];
        ++meetings[state.meeting];
        cells += state.cell[1] > 0 ? 1 : 0;
        slipping += state.slipping;
      }
      // Each tick as the next one of a path of its own.
      std::vector<float> advanced(at.size());
      std::vector<forceshade_status> said(count);
      const forceshade_batch batch = tests::batch_of(at, advanced, said);
      ASSERT_EQ(forceshade_advance(subject, before.data(), &batch, nullptr), FORCESHADE_OK) << forceshade_message();
      EXPECT_EQ(std::memcmp(advanced.data(), forces.data(), sizeof(float) * forces.size()), 0);
      EXPECT_EQ(said, statuses);
      EXPECT_TRUE(std::ranges::equal(before, after, is_same));
      forceshade_session_close(session);
      forceshade_session_close(resumed);
      forceshade_subject_free(subject);
    }
  for (int place = FORCESHADE_IN_THE_OPEN; place <= FORCESHADE_IN_TRIANGLE; ++place) EXPECT_GT(places[place], 5U) << place;
  for (int meeting = FORCESHADE_MEETS_NOTHING; meeting <= FORCESHADE_FOOT_ON_LINE; ++meeting)
    std::printf("meeting %d: %zu\n", meeting, meetings[meeting]);
  std::printf("%zu cells beside a second piece, %zu slipping\n", cells, slipping);
  for (const int meeting : {FORCESHADE_ON_LINE, FORCESHADE_MEETS_EDGE, FORCESHADE_MEETS_TRIANGLE, FORCESHADE_MEETS_TRIANGLES})
    EXPECT_GT(meetings[meeting], 0U) << meeting;
  EXPECT_GT(cells, 50U);
  EXPECT_GT(slipping, 50U);
}

// Two boxes with a common face.
mesh::TriangleMesh boxes() {
  return tests::read_soup_path(kSoups + "cubes_face.txt").mesh;
}

TEST(c_soups, need_no_flag_and_refuse_what_is_of_regular_meshes_alone) {
  const mesh::TriangleMesh both = boxes();
  const auto digest_of = [](const forceshade_mesh& mesh) {
    const forceshade_subject subject = made_of(mesh);
    std::array<char, 65> digest{};
    EXPECT_EQ(forceshade_subject_text(subject, FORCESHADE_DIGEST, digest.data(), digest.size(), nullptr), FORCESHADE_OK);
    forceshade_subject_free(subject);
    return std::string(digest.data());
  };
  for (forceshade_mesh mesh : {mesh_of(both, nullptr, kShaded), tests::tetrahedron_mesh()}) {
    const std::string digest = digest_of(mesh);
    mesh.self_intersecting = 1;
    EXPECT_EQ(digest_of(mesh), digest) << "the flag counts for nothing";
  }
  forceshade_subject made{};
  forceshade_mesh mesh = mesh_of(both, nullptr, kShadingOfRegular);
  EXPECT_EQ(forceshade_mesh_new(&mesh, &made), FORCESHADE_BAD_VALUE);
  EXPECT_STREQ(forceshade_message(), "shading: expected vertex or none for a mesh that is not regular, got \"edge\"");
  mesh.shading = nullptr;
  mesh.contact = kContactOfRegular;
  EXPECT_EQ(forceshade_mesh_new(&mesh, &made), FORCESHADE_BAD_VALUE);
  EXPECT_STREQ(forceshade_message(), "contact: expected direct or friction for a mesh that is not regular, got \"sub-goal\"");
  EXPECT_EQ(made.handle, 0U);
}

TEST(c_soups, are_no_meshes_of_a_program_whose_states_have_no_cells) {
  const forceshade_subject regular = tests::tetrahedron("none"), soup = made_of(mesh_of(boxes(), nullptr, "none"));
  const std::array<float, 3> at{2, 2, -1}, inside{2, 2, 1};
  for (const forceshade_subject subject : {regular, soup}) {
    const bool is_soup = subject.handle == soup.handle;
    const forceshade_result expected = is_soup ? FORCESHADE_BAD_SIZE : FORCESHADE_OK;
    forceshade_session session{}, other{};
    ASSERT_EQ(forceshade_session_open(subject, &session), FORCESHADE_OK);
    ASSERT_EQ(forceshade_session_open(subject, &other), FORCESHADE_OK);
    std::array<float, 3> force{}, again{};
    for (const auto& p : {at, inside})
      ASSERT_EQ(forceshade_session_step(session, p.data(), force.data(), nullptr), FORCESHADE_OK);
    // The bytes behind the struct are another's.
    forceshade_state state{}, whole = beginning();
    std::memset(&state, 0x55, sizeof state);
    const forceshade_state filled = state;
    state.size = kFormerState;
    EXPECT_EQ(forceshade_session_state(session, &state), expected);
    EXPECT_EQ(std::memcmp(&state.meeting, &filled.meeting, sizeof state - kFormerState), 0);
    if (is_soup) {
      EXPECT_NE(std::string(forceshade_message()).find("for a mesh that is not regular"), std::string::npos);
      state.place = FORCESHADE_NOWHERE;
    } else {
      ASSERT_EQ(forceshade_session_state(session, &whole), FORCESHADE_OK);
      EXPECT_EQ(
          std::memcmp(&state.place, &whole.place, offsetof(forceshade_state, slipping) - offsetof(forceshade_state, place)), 0);
      EXPECT_EQ(std::memcmp(state.position, whole.position, kFormerState - offsetof(forceshade_state, position)), 0);
    }
    EXPECT_EQ(forceshade_session_resume(other, &state), expected);
    std::vector<float> from(inside.begin(), inside.end()), to(3);
    std::vector<forceshade_status> said(1);
    const forceshade_batch batch = tests::batch_of(from, to, said);
    EXPECT_EQ(forceshade_advance(subject, &state, &batch, nullptr), expected);
    EXPECT_EQ(std::memcmp(&state.meeting, &filled.meeting, sizeof state - kFormerState), 0);
    if (!is_soup) {
      ASSERT_EQ(forceshade_session_step(other, inside.data(), again.data(), nullptr), FORCESHADE_OK);
      EXPECT_EQ(bits_of(again.data()), bits_of(force.data()));
      EXPECT_EQ(bits_of(to.data()), bits_of(force.data()));
    }
    state.size = kFormerState + 4;
    EXPECT_EQ(forceshade_session_state(session, &state), FORCESHADE_BAD_SIZE);
    forceshade_session_close(session);
    forceshade_session_close(other);
  }
  for (const forceshade_subject subject : {regular, soup}) forceshade_subject_free(subject);
}

TEST(c_soups, take_any_state_and_begin_again_from_one_that_they_do_not_have) {
  const tests::SoupPath path = tests::read_soup_path(kSoups + "crossing_balls.txt");
  const forceshade_subject subject = subject_of(path, {kShaded, true});
  forceshade_session session{};
  ASSERT_EQ(forceshade_session_open(subject, &session), FORCESHADE_OK);
  std::vector<forceshade_state> states;
  std::array<float, 3> force{};
  for (const std::string& line : path.ticks) {
    states.push_back(beginning());
    ASSERT_EQ(forceshade_session_step(session, tests::position_of(line).data(), force.data(), nullptr), FORCESHADE_OK);
    ASSERT_EQ(forceshade_session_state(session, &states.back()), FORCESHADE_OK);
  }
  std::mt19937 random(3);
  std::size_t refused = 0, nowhere = 0, taken = 0;
  for (std::size_t i = 0; i < 8000; ++i) {
    forceshade_state state = states[random() % states.size()];
    const auto any = [&] { return static_cast<std::uint32_t>(random()); };
    const auto value = [&] {
      const std::array values{any() % 3, any() % static_cast<std::uint32_t>(path.mesh.triangles.size()),
                              (1U << 24U) - any() % 2, any()};
      return values[any() % values.size()];
    };
    for (unsigned change = 0; change <= i % 3; ++change) switch (random() % 9) {
        case 0: state.place = static_cast<std::uint8_t>(random() % 6); break;
        case 1: state.side = static_cast<std::uint8_t>(random() % 3); break;
        case 2: state.meeting = static_cast<std::uint8_t>(random() % 9); break;
        case 3: state.position[random() % 3] = std::bit_cast<float>(any()); break;
        case 4: state.index[random() % 2] = value(); break;
        case 5: state.parameter[random() % 2] = value(); break;
        case 6: state.further[random() % 2] = value(); break;
        case 7: state.cell[random() % 2] = value(); break;
        default: state.slipping = static_cast<std::uint8_t>(random()); break;
      }
    const forceshade_result result = forceshade_session_resume(session, &state);
    if (result != FORCESHADE_OK) {
      ASSERT_EQ(result, FORCESHADE_BAD_VALUE);
      ++refused;
      continue;
    }
    forceshade_state held = beginning();
    ASSERT_EQ(forceshade_session_state(session, &held), FORCESHADE_OK);
    (held.place == FORCESHADE_NOWHERE ? nowhere : taken) += 1;
    if (held.place == FORCESHADE_NOWHERE) {
      ASSERT_TRUE(is_same(held, beginning()));
    }
    for (std::size_t step = 0; step < 2; ++step) {
      forceshade_status status = 99;
      const auto at = tests::position_of(path.ticks[random() % path.ticks.size()]);
      ASSERT_EQ(forceshade_session_step(session, at.data(), force.data(), &status), FORCESHADE_OK);
      ASSERT_LE(status, FORCESHADE_UNFINISHED);
      for (const float component : force) ASSERT_TRUE(std::isfinite(component));
    }
  }
  std::printf("%zu refused, %zu nowhere, %zu taken\n", refused, nowhere, taken);
  EXPECT_GT(refused, 800U);
  EXPECT_GT(nowhere, 800U);
  EXPECT_GT(taken, 800U);
  // A position of less than the quantum, which no tick leaves.
  forceshade_state tiny = beginning(), held = beginning();
  tiny.place = FORCESHADE_IN_THE_OPEN;
  tiny.position[2] = 1e-40F;
  ASSERT_EQ(forceshade_session_resume(session, &tiny), FORCESHADE_OK);
  ASSERT_EQ(forceshade_session_state(session, &held), FORCESHADE_OK);
  EXPECT_TRUE(is_same(held, beginning()));
  forceshade_session_close(session);
  forceshade_subject_free(subject);
}

}  // namespace
}  // namespace forceshade
