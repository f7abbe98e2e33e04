// SPDX-License-Identifier: BSD-3-Clause
// Damping through the C interface: the bits of the stage in C++, behind forces that lie anywhere, and what is refused.

#include <gtest/gtest.h>

#include <array>
#include <cfenv>
#include <cmath>
#include <cstring>
#include <functional>
#include <random>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "forceshade.h"
#include "forceshade/fast.h"
#include "tests/bindings/batches.h"
#include "tests/bindings/misuse.h"
#include "tests/bindings/subjects.h"
#include "tests/support/allocations.h"

namespace forceshade {
namespace {

constexpr forceshade_damping kOil{sizeof kOil, 1000, 0.25F, 0.01F, 2, 0.002F, 0.25F};

constexpr forceshade_damping_state kBegin{sizeof kBegin, 0, 0, {}, {}};

damping::State numbers_of(const forceshade_damping_state& its) {
  return {its.has_position == 1, std::to_array(its.position), std::to_array(its.velocity), its.periods};
}

// The forces that a mesh gave, the periods, and what the stage in C++ makes of them, as one path and as a tick of many.
class CDamping : public testing::Test {
 protected:
  static constexpr std::size_t kCount = 5000;

  CDamping() : at(tests::positions(kCount, 3)), springs(at.size()), said(kCount), path(at.size()), said_of_path(kCount) {
    for (std::size_t i = 0; i < kCount; i += 9) std::fill_n(at.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, 1.0F);
    const forceshade_subject mesh = tests::tetrahedron("edge", true);
    forceshade_session session{};
    forceshade_session_open(mesh, &session);
    const forceshade_batch all = tests::batch_of(at, springs, said);
    EXPECT_EQ(forceshade_session_steps(session, &all, nullptr), FORCESHADE_OK) << forceshade_message();
    forceshade_session_close(session);
    forceshade_subject_free(mesh);
    std::mt19937 random(5);
    for (std::size_t i = 0; i < kCount; ++i) periods.push_back(i % 3 == 0 ? static_cast<std::uint32_t>(random() % 20) : 1);
    fast::Damping stage = built();
    for (std::size_t i = 0; i < kCount; ++i) put(stage.tick(position(i), periods[i], spring(i)), i, path, said_of_path);
    after = stage.state();
  }

  static fast::Damping built() {
    return std::get<fast::Damping>(
        fast::Damping::build({kOil.rate, kOil.share, kOil.damping, kOil.most, kOil.drag, kOil.full_at}));
  }
  Eigen::Vector3f position(std::size_t i) const { return Eigen::Vector3f(&at[3 * i]); }
  fast::Evaluation spring(std::size_t i) const { return {Eigen::Vector3f(&springs[3 * i]), static_cast<Status>(said[i])}; }
  static void put(const fast::Evaluation& answer, std::size_t i, std::vector<float>& forces,
                  std::vector<forceshade_status>& statuses) {
    for (std::size_t axis = 0; axis < 3; ++axis) forces[3 * i + axis] = answer.force(static_cast<Eigen::Index>(axis));
    statuses[i] = static_cast<forceshade_status>(answer.status);
  }

  std::vector<float> at, springs;
  std::vector<forceshade_status> said;
  std::vector<std::uint32_t> periods;
  std::vector<float> path;
  std::vector<forceshade_status> said_of_path;
  damping::State after;
};

TEST_F(CDamping, of_a_path_is_that_of_cpp_in_every_bit_step_by_step_and_in_batches) {
  forceshade_damping_state state = kBegin;
  std::vector<float> one = springs, many = springs;
  std::vector<forceshade_status> said_one = said, said_many = said;
  const std::size_t allocated = tests::allocations();
  for (std::size_t i = 0; i < kCount; ++i)
    ASSERT_EQ(forceshade_damping_step(&kOil, &state, periods[i], &at[3 * i], &one[3 * i], &said_one[i]), FORCESHADE_OK);
  EXPECT_EQ(tests::allocations(), allocated);
  EXPECT_EQ(one, path);
  EXPECT_EQ(said_one, said_of_path);
  EXPECT_NE(path, springs);
  EXPECT_EQ(numbers_of(state), after);

  state = kBegin;
  std::size_t outside = 0, of_all = 0;
  for (std::size_t begin = 0; begin < kCount; begin += 1000) {
    const forceshade_batch part =
        tests::batch_of(std::span(at).subspan(3 * begin, 3000), std::span(many).subspan(3 * begin, 3000),
                        std::span(said_many).subspan(begin, 1000));
    ASSERT_EQ(forceshade_damping_steps(&kOil, &state, &periods[begin], &part, &outside), FORCESHADE_OK) << forceshade_message();
    of_all += outside;
  }
  EXPECT_EQ(many, path);
  EXPECT_EQ(said_many, said_of_path);
  EXPECT_EQ(numbers_of(state), after);
  EXPECT_EQ(of_all, static_cast<std::size_t>(std::ranges::count(said_of_path, FORCESHADE_INVALID)));
  EXPECT_GT(of_all, 0U);
}

// Backwards, component by component, without statuses and periods.
TEST_F(CDamping, of_arrays_with_gaps_is_the_same) {
  std::vector<float> forces(springs.size()), expected(springs.size());
  std::vector<forceshade_status> unused(kCount);
  fast::Damping stage = built();
  for (std::size_t i = 0; i < kCount; ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) forces[axis * kCount + kCount - 1 - i] = springs[3 * i + axis];
    put(stage.tick(position(i), 1, {spring(i).force, Status::contact}), i, expected, unused);
  }
  forceshade_batch batch = tests::batch_of(at, forces, {});
  batch.forces = &forces[kCount - 1];
  batch.force_stride = -4;
  batch.force_component = 4 * kCount;
  forceshade_damping_state state = kBegin;
  ASSERT_EQ(forceshade_damping_steps(&kOil, &state, nullptr, &batch, nullptr), FORCESHADE_OK) << forceshade_message();
  for (std::size_t i = 0; i < kCount; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) ASSERT_EQ(forces[axis * kCount + kCount - 1 - i], expected[3 * i + axis]);
  EXPECT_EQ(numbers_of(state), stage.state());
}

// Two ticks of as many paths as there are positions; also in a program that was built with a newer header.
TEST_F(CDamping, of_many_paths_is_that_of_each) {
  struct Newer {
    forceshade_damping_state known{sizeof(Newer), 0, 0, {}, {}};
    double more = 3;
  };
  std::vector<forceshade_damping_state> states(kCount, kBegin);
  std::vector<Newer> newer(kCount);
  std::vector<fast::Damping> stages(kCount, built());
  std::vector<float> forces, others, expected(springs.size());
  std::vector<forceshade_status> statuses, said_expected(kCount);
  for (const float step : {0.0F, 0.125F}) {
    for (float& x : at) x += step;
    statuses = said;
    forces = others = springs;
    for (std::size_t i = 0; i < kCount; ++i)
      put(stages[i].tick(position(i), periods[i], spring(i)), i, expected, said_expected);
    forceshade_batch batch = tests::batch_of(at, forces, statuses);
    batch.threads = 3;
    ASSERT_EQ(forceshade_damping_advance(&kOil, states.data(), periods.data(), &batch, nullptr), FORCESHADE_OK);
    EXPECT_EQ(forces, expected);
    EXPECT_EQ(statuses, said_expected);
    statuses = said;
    batch.forces = others.data();
    ASSERT_EQ(forceshade_damping_advance(&kOil, &newer[0].known, periods.data(), &batch, nullptr), FORCESHADE_OK);
    EXPECT_EQ(others, expected);
    for (std::size_t i = 0; i < kCount; ++i) {
      ASSERT_EQ(numbers_of(states[i]), stages[i].state());
      ASSERT_EQ(numbers_of(newer[i].known), stages[i].state());
      ASSERT_EQ(newer[i].more, 3);
    }
  }
  EXPECT_NE(expected, springs);
  forceshade_batch none = tests::batch_of({}, {}, {});
  EXPECT_EQ(forceshade_damping_advance(&kOil, nullptr, nullptr, &none, nullptr), FORCESHADE_OK);
}

// A thread that damps two paths by turns, also by other numbers, and a program that changes a state between two ticks.
TEST_F(CDamping, of_each_path_is_its_own_whatever_was_damped_before) {
  forceshade_damping_state one = kBegin, other = kBegin;
  fast::Damping stage = built(), second = built();
  forceshade_damping thin = kOil;
  thin.damping = 0.005F;
  for (std::size_t i = 0; i < kCount; ++i) {
    const bool is_first = i % 7 < 4;
    fast::Damping& right = is_first ? stage : second;
    forceshade_damping_state& its = is_first ? one : other;
    if (i % 5 == 0 && its.has_position == 1) {
      its.velocity[1] = i % 2 == 0 ? 0 : -its.velocity[1];
      right.resume(numbers_of(its));
    }
    if (i % 50 == 0) {
      its = kBegin;
      right.reset();
    }
    if (i % 11 == 0) {
      std::array<float, 3> force{1, 2, 3};
      forceshade_damping_state third = one;
      ASSERT_EQ(forceshade_damping_step(&thin, &third, 1, &at[3 * i], force.data(), nullptr), FORCESHADE_OK);
    }
    std::array<float, 3> force{springs[3 * i], springs[3 * i + 1], springs[3 * i + 2]};
    forceshade_status status = said[i];
    ASSERT_EQ(forceshade_damping_step(&kOil, &its, periods[i], &at[3 * i], force.data(), &status), FORCESHADE_OK);
    const fast::Evaluation expected = right.tick(position(i), periods[i], spring(i));
    ASSERT_EQ(tests::bits_of(force.data()), tests::bits_of(expected.force.data())) << i;
    ASSERT_EQ(numbers_of(its), right.state()) << i;
  }
}

// After a tick of another path that has left all numbers but one as they are in this state.
TEST_F(CDamping, of_a_state_that_differs_in_one_number_from_the_last_one_is_its_own) {
  struct Case {
    const char* what;
    void (*change)(forceshade_damping_state& its);
  };
  for (const Case& its : {Case{"position", [](forceshade_damping_state& state) { state.position[0] -= 0.125F; }},
                          {"velocity", [](forceshade_damping_state& state) { state.velocity[2] += 5; }},
                          {"periods", [](forceshade_damping_state& state) { state.periods += 3; }},
                          {"no position", [](forceshade_damping_state& state) { state.has_position = 0; }}}) {
    forceshade_damping_state last = kBegin;
    std::array<float, 3> force{};
    for (const float z : {0.0F, -0.25F}) {
      const std::array<float, 3> hand{0, 0, z};
      force = {1, 2, 3};
      ASSERT_EQ(forceshade_damping_step(&kOil, &last, 1, hand.data(), force.data(), nullptr), FORCESHADE_OK);
    }
    const std::array<float, 3> next{0.125F, 0, -0.5F};
    const auto expected_of = [&](const forceshade_damping_state& from) {
      fast::Damping stage = built();
      stage.resume(numbers_of(from));
      return stage.tick(Eigen::Vector3f(next.data()), 1, {Eigen::Vector3f(1, 2, 3), Status::contact});
    };
    forceshade_damping_state changed = last;
    its.change(changed);
    const Eigen::Vector3f expected = expected_of(changed).force;
    EXPECT_NE(tests::bits_of(expected.data()), tests::bits_of(expected_of(last).force.data())) << its.what;
    force = {1, 2, 3};
    ASSERT_EQ(forceshade_damping_step(&kOil, &changed, 1, next.data(), force.data(), nullptr), FORCESHADE_OK);
    EXPECT_EQ(tests::bits_of(force.data()), tests::bits_of(expected.data())) << its.what;
  }
}

TEST_F(CDamping, of_a_subjects_file_is_that_of_its_table_at_a_rate) {
  const auto read = [](const std::string& text) {
    forceshade_subject made{};
    EXPECT_EQ(forceshade_subject_parse(text.data(), text.size(), "its.toml", &made), FORCESHADE_OK) << forceshade_message();
    return made;
  };
  const forceshade_subject plain = read("law = \"wall\"\n"),
                           oily = read(
                               "law = \"wall\"\n[damping]\ndamping = 0.002\nmost = 3\ndrag = \"1Ns/m\"\nfull_at = "
                               "\"0.5N\"\ntime = \"2ms\"\n");
  forceshade_damping its{};
  its.size = sizeof its;
  ASSERT_EQ(forceshade_subject_damping(oily, 500, &its), FORCESHADE_OK) << forceshade_message();
  const forceshade_damping expected{sizeof its, 500, 0.5F, 0.002F, 3, 0.001F, 0.5F};
  EXPECT_EQ(std::memcmp(&its, &expected, sizeof its), 0);
  std::array<float, 3> force{};
  forceshade_damping_state state = kBegin;
  for (const float z : {0.0F, -1.0F}) {  // at 500 mm/s, half of which the filter takes
    const std::array<float, 3> p{0, 0, z};
    ASSERT_EQ(forceshade_force(oily, p.data(), force.data(), nullptr), FORCESHADE_OK);
    ASSERT_EQ(forceshade_damping_step(&its, &state, 1, p.data(), force.data(), nullptr), FORCESHADE_OK);
  }
  EXPECT_FLOAT_EQ(force[2], 0.5F + 0.002F * 250);
  ASSERT_EQ(forceshade_subject_damping(plain, 1000, &its), FORCESHADE_OK);
  EXPECT_EQ(its.rate, 1000);
  EXPECT_EQ(its.damping, 0);
  EXPECT_EQ(its.drag, 0);
  const forceshade_damping before = its;
  EXPECT_EQ(forceshade_subject_damping(oily, 0, &its), FORCESHADE_BAD_VALUE);
  EXPECT_STREQ(forceshade_message(), "rate is 0 Hz; expected 1 to 131072 Hz");
  its.size = 8;
  EXPECT_EQ(forceshade_subject_damping(oily, 1000, &its), FORCESHADE_BAD_SIZE);
  EXPECT_EQ(forceshade_subject_damping(oily, 1000, nullptr), FORCESHADE_NULL_POINTER);
  its.size = sizeof its;
  EXPECT_EQ(std::memcmp(&its, &before, sizeof its), 0) << "nothing was written";
  for (const forceshade_subject subject : {plain, oily}) forceshade_subject_free(subject);
}

// Gives what two calls give, where no material limits it.
TEST_F(CDamping, of_a_session_in_one_call_is_that_of_two) {
  const forceshade_subject mesh = tests::tetrahedron("edge", true);
  forceshade_session session{};
  forceshade_session_open(mesh, &session);
  forceshade_damping_state state = kBegin;
  std::vector<float> forces(at.size());
  std::vector<forceshade_status> statuses(kCount);
  const std::size_t allocated = tests::allocations();
  for (std::size_t i = 0; i < kCount; ++i)
    ASSERT_EQ(forceshade_session_damped_step(session, &kOil, &state, periods[i], &at[3 * i], &forces[3 * i], &statuses[i]),
              FORCESHADE_OK);
  EXPECT_EQ(tests::allocations(), allocated);
  EXPECT_EQ(forces, path);
  EXPECT_EQ(statuses, said_of_path);
  EXPECT_EQ(numbers_of(state), after);
  forceshade_session_close(session);
  forceshade_subject_free(mesh);
}

TEST_F(CDamping, a_misuse_has_its_result_and_its_sentence) {
  using tests::Misuse;
  using tests::Use;
  std::array<float, 6> places{1, 2, 3, 4, 5, 6}, forces{};
  std::array<forceshade_status, 2> statuses{};
  std::array<forceshade_damping_state, 2> states{kBegin, kBegin};
  const forceshade_batch two = tests::batch_of(places, forces, statuses);
  const auto with = [&](const std::function<void(forceshade_damping&)>& change) -> Use {
    forceshade_damping its = kOil;
    change(its);
    return [=, &two, &states] { return forceshade_damping_steps(&its, states.data(), nullptr, &two, nullptr); };
  };
  const auto of_batch = [&](auto* call) {
    return [=, &two, &states](const std::function<void(forceshade_batch&)>& change) -> Use {
      forceshade_batch its = two;
      change(its);
      return [=, &states] { return call(&kOil, states.data(), nullptr, &its, nullptr); };
    };
  };
  forceshade_damping_state small{};
  const auto null = FORCESHADE_NULL_POINTER, size = FORCESHADE_BAD_SIZE, value = FORCESHADE_BAD_VALUE;
  float *const at = places.data(), *const force = forces.data();
  std::vector<Misuse> misuses{
      {"damping null", [&] { return forceshade_damping_step(nullptr, &states[0], 1, at, force, nullptr); }, null, "damping"},
      {"state null", [&] { return forceshade_damping_step(&kOil, nullptr, 1, at, force, nullptr); }, null, "state is NULL"},
      {"position null", [&] { return forceshade_damping_step(&kOil, &states[0], 1, nullptr, force, nullptr); }, null,
       "position"},
      {"force null", [&] { return forceshade_damping_step(&kOil, &states[0], 1, at, nullptr, nullptr); }, null,
       "force is NULL"},
      {"state size", [&] { return forceshade_damping_step(&kOil, &small, 1, at, force, nullptr); }, size, "damping_state)"},
      {"states size", [&] { return forceshade_damping_advance(&kOil, &small, nullptr, &two, nullptr); }, size,
       "damping_state)"},
      {"batch null", [&] { return forceshade_damping_steps(&kOil, &states[0], nullptr, nullptr, nullptr); }, null, "batch"},
      {"size", with([](auto& its) { its.size = 4; }), size, "sizeof(forceshade_damping)"},
      {"rate", with([](auto& its) { its.rate = 0; }), value, "rate is 0 Hz; expected 1 to 131072 Hz"},
      {"rate NaN", with([](auto& its) { its.rate = NAN; }), value, "rate is nan"},
      {"share", with([](auto& its) { its.share = 1.5F; }), value, "share is 1.5"},
      {"damping", with([](auto& its) { its.damping = -1; }), value, "damping is -1 N·s/mm"},
      {"most", with([](auto& its) { its.most = 0; }), value, "most is 0"},
      {"drag", with([](auto& its) { its.drag = 17; }), value, "drag is 17 N·s/mm"},
      {"full at", with([](auto& its) { its.full_at = INFINITY; }), value, "full_at is inf N"}};
  for (auto* const call : {&forceshade_damping_steps, &forceshade_damping_advance}) {
    add(misuses, tests::misuses_of_batches("batch ", of_batch(call)));
    misuses.push_back({"in place", of_batch(call)([&](auto& its) { its.forces = at; }), value, "positions beside the forces"});
  }
  expect_each(misuses, &forceshade_message, 40);
  forceshade_damping other = kOil;
  other.rate = 999;  // which this thread has not used yet
  std::fesetround(FE_UPWARD);
  const forceshade_result of_step = forceshade_damping_step(&other, &states[0], 1, at, force, nullptr);
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(of_step, FORCESHADE_BAD_ARITHMETIC);
  // Nothing was written.
  EXPECT_EQ(places, (std::array<float, 6>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(forces, (std::array<float, 6>{}));
  for (const auto& state : states) EXPECT_EQ(numbers_of(state), damping::State{});
  EXPECT_EQ(forceshade_damping_step(&other, &states[0], 1, at, force, nullptr), FORCESHADE_OK);
  EXPECT_EQ(forceshade_has("damping"), 1);
}

}  // namespace
}  // namespace forceshade
