// SPDX-License-Identifier: BSD-3-Clause
// Batches that threads share, and many paths over one subject: the bits of a single thread, and of a session for each path.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <random>
#include <vector>

#include "forceshade.h"
#include "tests/bindings/batches.h"
#include "tests/bindings/subjects.h"

namespace {

using forceshade::tests::batch_of;
using forceshade::tests::beginning;
using forceshade::tests::bits_of;
using forceshade::tests::law_of;
using forceshade::tests::positions;

constexpr std::size_t kBatchWithoutThreads = offsetof(forceshade_batch, threads);

struct Answers {
  std::vector<float> forces;
  std::vector<forceshade_status> statuses;
  std::size_t invalid = 0;

  explicit Answers(std::size_t count) : forces(3 * count), statuses(count, 99) {}
  bool operator==(const Answers& other) const {
    return std::memcmp(forces.data(), other.forces.data(), sizeof(float) * forces.size()) == 0 && statuses == other.statuses &&
           invalid == other.invalid;
  }
};

TEST(c_threads, give_the_bits_of_one_thread_wherever_the_numbers_lie) {
  for (const std::size_t count : {1, 1023, 2048, 5001, 20000}) {
    const std::vector<float> at = positions(count, 11);
    for (const char* name : {"wall", "bump-2p-shaded", "cylinder"}) {
      const forceshade_subject subject = law_of(name);
      Answers alone(count);
      forceshade_batch batch = batch_of(at, alone.forces, alone.statuses);
      batch.size = kBatchWithoutThreads;  // of a program from before
      batch.threads = 1000000;
      ASSERT_EQ(forceshade_forces(subject, &batch, &alone.invalid), FORCESHADE_OK) << forceshade_message();
      for (const std::size_t threads : {std::size_t{0}, std::size_t{2}, std::size_t{7}, SIZE_MAX}) {
        Answers shared(count);
        batch = batch_of(at, shared.forces, shared.statuses);
        batch.threads = threads;
        ASSERT_EQ(forceshade_forces(subject, &batch, &shared.invalid), FORCESHADE_OK);
        EXPECT_TRUE(shared == alone) << name << ", " << count << " positions, " << threads << " threads";

        // Backwards, each force in the place of its position, and every other status.
        std::vector<float> both = at;
        std::vector<forceshade_status> apart(2 * count, 99);
        batch = batch_of(both, both, apart);
        batch.threads = threads;
        batch.positions = batch.forces = both.data() + 3 * (count - 1);
        batch.position_stride = batch.force_stride = -12;
        batch.status_stride = 2;
        ASSERT_EQ(forceshade_forces(subject, &batch, nullptr), FORCESHADE_OK);
        for (std::size_t i = 0; i < count; ++i) {
          ASSERT_EQ(bits_of(&both[3 * i]), bits_of(&alone.forces[3 * i]));
          ASSERT_EQ(apart[2 * i], alone.statuses[count - 1 - i]);
          ASSERT_EQ(apart[2 * i + 1], 99);
        }
      }
      forceshade_subject_free(subject);
    }
  }
}

// Positions of so many paths, each of which goes on at random near the tetrahedron, and now and then out of the domain.
class Walks {
 public:
  explicit Walks(std::size_t count) : at(3 * count, 3) {}
  void go_on() {
    std::uniform_real_distribution<float> step(-1.5F, 1.5F);
    for (float& coordinate : at) coordinate = random_() % 200 == 0 ? 2e4F : std::clamp(coordinate, -2.0F, 6.0F) + step(random_);
  }
  std::vector<float> at;

 private:
  std::mt19937 random_{5};
};

class CThreads : public testing::TestWithParam<bool> {};

TEST_P(CThreads, advance_each_path_as_a_session_of_its_own) {
  constexpr std::size_t kPaths = 3500, kTicks = 60;
  const forceshade_subject subject = forceshade::tests::tetrahedron(GetParam() ? "vertex" : "none", GetParam());
  std::vector<forceshade_session> sessions(kPaths);
  for (auto& session : sessions) ASSERT_EQ(forceshade_session_open(subject, &session), FORCESHADE_OK);
  // The states of a program whose header is newer are longer.
  struct Longer {
    forceshade_state its;
    std::array<char, 24> more;
  };
  std::vector<forceshade_state> states(kPaths, beginning());
  std::vector<Longer> longer(kPaths, {beginning(sizeof(Longer)), {}});
  Walks walks(kPaths);
  std::size_t contacts = 0, slipping = 0, invalid = 0;
  for (std::size_t tick = 0; tick < kTicks; ++tick) {
    walks.go_on();
    Answers one(kPaths), three(kPaths);
    forceshade_batch batch = batch_of(walks.at, one.forces, one.statuses);
    ASSERT_EQ(forceshade_advance(subject, states.data(), &batch, &one.invalid), FORCESHADE_OK) << forceshade_message();
    std::vector<float> apart(4 * kPaths);  // with a number between two positions, so that they are taken in blocks
    for (std::size_t i = 0; i < kPaths; ++i) std::copy_n(&walks.at[3 * i], 3, &apart[4 * i]);
    batch = batch_of(walks.at, three.forces, three.statuses);
    batch.positions = apart.data();
    batch.position_stride = 16;
    batch.threads = 3;
    ASSERT_EQ(forceshade_advance(subject, &longer[0].its, &batch, &three.invalid), FORCESHADE_OK);
    EXPECT_TRUE(one == three);
    invalid += one.invalid;
    for (std::size_t i = 0; i < kPaths; ++i) {
      std::array<float, 3> force{};
      forceshade_status status = 99;
      forceshade_session_step(sessions[i], &walks.at[3 * i], force.data(), &status);
      ASSERT_EQ(bits_of(&one.forces[3 * i]), bits_of(force.data())) << "path " << i << ", tick " << tick;
      ASSERT_EQ(one.statuses[i], status);
      forceshade_state state = beginning();
      forceshade_session_state(sessions[i], &state);
      ASSERT_EQ(std::memcmp(&state, &states[i], sizeof state), 0) << "path " << i << ", tick " << tick;
      ASSERT_EQ(states[i].place, longer[i].its.place);
      contacts += status == FORCESHADE_CONTACT ? 1 : 0;
      slipping += state.slipping;
      if (tick % 16 != 15 || i % 5 != 0) continue;
      // A path that begins again, with a state of 0 or with one that belongs to no mesh.
      forceshade_session_reset(sessions[i]);
      states[i] = beginning();
      longer[i].its = beginning(sizeof(Longer));
      if (i % 3 == 0) {
        states[i] = state;
        states[i].side = 2;
      } else if (i % 2 == 0) {
        states[i].place = 5;
      } else if (i % 7 == 0) {
        states[i].place = FORCESHADE_IN_TRIANGLE;
        states[i].index[0] = 77;
      }
    }
  }
  std::printf("%zu contacts, %zu slipping, %zu invalid\n", contacts, slipping, invalid);
  EXPECT_GT(contacts, kPaths);
  EXPECT_EQ(slipping > kPaths / 4, GetParam());
  EXPECT_GT(invalid, kPaths / 4);
  for (const auto& session : sessions) forceshade_session_close(session);
  forceshade_subject_free(subject);
}

INSTANTIATE_TEST_SUITE_P(friction, CThreads, testing::Bool());

TEST(c_threads, advance_of_what_remembers_nothing_gives_its_forces_and_leaves_the_states) {
  constexpr std::size_t kCount = 3000;
  const forceshade_subject subject = law_of("bump-3p");
  const std::vector<float> at = positions(kCount, 2);
  Answers right(kCount), advanced(kCount);
  forceshade_batch batch = batch_of(at, right.forces, right.statuses);
  ASSERT_EQ(forceshade_forces(subject, &batch, &right.invalid), FORCESHADE_OK);
  std::vector<forceshade_state> states(kCount, beginning());
  const std::vector<forceshade_state> before = states;
  batch = batch_of(at, advanced.forces, advanced.statuses);
  batch.threads = 2;
  ASSERT_EQ(forceshade_advance(subject, states.data(), &batch, &advanced.invalid), FORCESHADE_OK);
  EXPECT_TRUE(advanced == right);
  EXPECT_EQ(std::memcmp(states.data(), before.data(), sizeof states[0] * kCount), 0);
  forceshade_subject_free(subject);
}

}  // namespace
