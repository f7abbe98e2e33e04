// SPDX-License-Identifier: BSD-3-Clause
// Answers of the C interface wherever they are written, after a resume, and for handles of every kind.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "bindings/c/batch.h"
#include "bindings/c/table.h"
#include "forceshade.h"
#include "tests/bindings/batches.h"
#include "tests/bindings/subjects.h"

namespace forceshade {
namespace {

using tests::beginning;
using tests::bits_of;

constexpr std::size_t kCount = 1300;  // more than two blocks

forceshade_subject map() {
  static constexpr std::array<float, 16> kHeights{0, 1, 0, 1, 1, 0, 1, 0, 0, 1, 0, 1, 1, 0, 1, 0};
  forceshade_height_map its{};
  its.size = sizeof its;
  its.heights = kHeights.data();
  its.columns = its.rows = 4;
  its.column_stride = 4;
  its.row_stride = 16;
  its.pitch = 2;
  its.stiffness = 0.5F;
  forceshade_subject made{};
  EXPECT_EQ(forceshade_height_map_new(&its, &made), FORCESHADE_OK) << forceshade_message();
  return made;
}

// A path about the tetrahedron, and some positions of any bits at all.
std::vector<float> path() {
  std::mt19937 random(8);
  std::uniform_real_distribution<float> step(-0.5F, 0.5F);
  std::vector<float> all = tests::positions(kCount, 8);
  std::array<float, 3> at{2, 2, 2};
  for (std::size_t i = 0; i < kCount; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      at[axis] = std::clamp(at[axis] + step(random), -1.0F, 6.0F);
      if (i % 9 != 0) all[3 * i + axis] = at[axis];
    }
  return all;
}

// The places of numbers: in floats, and in statuses.
struct Layout {
  const char* what;
  std::size_t between, component;  // positions and forces
  bool in_place, has_statuses;
  std::size_t status_stride, threads;
  bool is_backwards = false;  // of positions alone
};

constexpr std::array<Layout, 10> kLayouts{{{"without gaps", 3, 1, false, true, 1, 1},
                                           {"in place", 3, 1, true, true, 1, 1},
                                           {"in place, by three threads", 3, 1, true, true, 1, 3},
                                           {"with gaps", 4, 1, false, true, 1, 1},
                                           {"with gaps, in place", 5, 1, true, true, 1, 1},
                                           {"in columns, in place", 1, kCount, true, true, 1, 1},
                                           {"with gaps between statuses", 3, 1, false, true, 3, 1},
                                           {"in place, with gaps between statuses", 3, 1, true, true, 2, 1},
                                           {"in place, without statuses", 3, 1, true, false, 1, 1},
                                           {"positions backwards, in rows with gaps", 5, 1, false, true, 2, 1, true}}};

TEST(c_answers, are_the_same_wherever_they_are_written) {
  const std::vector<float> at = path();
  const std::array<forceshade_subject, 3> subjects{tests::law_of("bump-3p-shaded"), map(), tests::tetrahedron("none", true)};
  for (const forceshade_subject subject : subjects) {
    forceshade_session one{}, many{};
    ASSERT_EQ(forceshade_session_open(subject, &one), FORCESHADE_OK);
    ASSERT_EQ(forceshade_session_open(subject, &many), FORCESHADE_OK);
    std::vector<float> forces(at.size());
    std::vector<forceshade_status> statuses(kCount);
    std::size_t contacts = 0;
    for (std::size_t i = 0; i < kCount; ++i) {
      ASSERT_EQ(forceshade_session_step(one, &at[3 * i], &forces[3 * i], &statuses[i]), FORCESHADE_OK);
      contacts += statuses[i] == FORCESHADE_CONTACT ? 1 : 0;
    }
    const auto outside = static_cast<std::size_t>(std::ranges::count(statuses, FORCESHADE_INVALID));
    EXPECT_GT(contacts, 50U);
    EXPECT_GT(outside, 10U);
    for (const Layout& its : kLayouts)
      for (const bool is_path : {true, false}) {
        if (!is_path && subject.handle == subjects[2].handle) continue;  // whose forces depend on the path
        SCOPED_TRACE(std::string(its.what) + (is_path ? ", steps" : ", forces"));
        const auto place = [&](std::size_t i, std::size_t axis) { return i * its.between + axis * its.component; };
        std::vector<float> from(std::max(its.between, std::size_t{3}) * kCount, -1), apart(from.size(), -1);
        for (std::size_t i = 0; i < kCount; ++i)
          for (std::size_t axis = 0; axis < 3; ++axis)
            from[place(its.is_backwards ? kCount - 1 - i : i, axis)] = at[3 * i + axis];
        std::vector<float>& to = its.in_place ? from : apart;
        std::vector<forceshade_status> given(its.status_stride * kCount, 99);
        forceshade_batch batch = tests::batch_of(from, to, given);
        batch.count = kCount;
        batch.position_stride = batch.force_stride = 4 * static_cast<std::ptrdiff_t>(its.between);
        batch.position_component = batch.force_component = 4 * static_cast<std::ptrdiff_t>(its.component);
        if (its.is_backwards) {
          batch.positions = &from[place(kCount - 1, 0)];
          batch.position_stride = -batch.position_stride;
        }
        batch.status_stride = static_cast<std::ptrdiff_t>(its.status_stride);
        batch.threads = its.threads;
        if (!its.has_statuses) batch.statuses = nullptr;
        std::size_t invalid = 0;
        forceshade_session_reset(many);
        ASSERT_EQ(is_path ? forceshade_session_steps(many, &batch, &invalid) : forceshade_forces(subject, &batch, &invalid),
                  FORCESHADE_OK)
            << forceshade_message();
        EXPECT_EQ(invalid, outside);
        for (std::size_t i = 0; i < kCount; ++i) {
          const std::array<float, 3> force{to[place(i, 0)], to[place(i, 1)], to[place(i, 2)]};
          ASSERT_EQ(bits_of(force.data()), bits_of(&forces[3 * i])) << i;
          if (its.between == 5) {
            ASSERT_EQ(to[place(i, 3)], -1) << "what lies between is not touched";
          }
          for (std::size_t k = 0; k < its.status_stride; ++k)
            ASSERT_EQ(given[i * its.status_stride + k], k == 0 && its.has_statuses ? statuses[i] : 99) << i;
        }
      }
    forceshade_session_close(one);
    forceshade_session_close(many);
    forceshade_subject_free(subject);
  }
}

TEST(c_answers, of_a_session_that_was_resumed_or_reset_are_those_of_its_state) {
  const std::vector<float> at = path();
  const forceshade_subject mesh = tests::tetrahedron("none", true);
  forceshade_session first{}, second{}, fresh{};
  for (forceshade_session* session : {&first, &second, &fresh})
    ASSERT_EQ(forceshade_session_open(mesh, session), FORCESHADE_OK);
  forceshade_subject_free(mesh);  // sessions stay
  forceshade_state state = beginning();
  const auto expect_nowhere = [&] {
    ASSERT_EQ(forceshade_session_state(first, &state), FORCESHADE_OK);
    EXPECT_EQ(state.place, FORCESHADE_NOWHERE);
  };
  expect_nowhere();
  const auto step = [&](forceshade_session session, std::size_t i) {
    std::array<float, 3> force{};
    forceshade_status status = 99;
    EXPECT_EQ(forceshade_session_step(session, &at[3 * i], force.data(), &status), FORCESHADE_OK);
    return std::pair(bits_of(force.data()), status);
  };
  int slipping = 0;
  for (std::size_t i = 0; i < kCount; ++i) {
    forceshade_state resumed = beginning();
    ASSERT_EQ(forceshade_session_state(first, &state), FORCESHADE_OK);
    ASSERT_EQ(forceshade_session_resume(second, &state), FORCESHADE_OK);
    ASSERT_EQ(forceshade_session_state(second, &resumed), FORCESHADE_OK);
    ASSERT_EQ(std::memcmp(&state, &resumed, sizeof state), 0) << "before a step, " << i;
    slipping += state.slipping;
    ASSERT_EQ(step(first, i), step(second, i)) << i;
  }
  EXPECT_GT(slipping, 50);
  // A program that was built with a newer header has a longer struct.
  struct Newer {
    forceshade_state known;
    std::uint64_t more;
  } newer{beginning(sizeof(Newer)), 7};
  ASSERT_EQ(forceshade_session_state(first, &newer.known), FORCESHADE_OK) << forceshade_message();
  ASSERT_EQ(forceshade_session_resume(second, &newer.known), FORCESHADE_OK) << forceshade_message();
  EXPECT_EQ(newer.known.size, sizeof newer);
  EXPECT_EQ(newer.more, 7U);
  ASSERT_EQ(step(first, 0), step(second, 0));
  ASSERT_EQ(forceshade_session_reset(first), FORCESHADE_OK);
  expect_nowhere();
  for (std::size_t i = 1; i < 100; ++i) ASSERT_EQ(step(first, i), step(fresh, i)) << i;
  for (const forceshade_session session : {first, second, fresh}) forceshade_session_close(session);
}

TEST(c_answers, of_an_unfinished_tick_say_so) {
  for (const auto& [status, expected] : {std::pair{Status::free, FORCESHADE_FREE},
                                         {Status::contact, FORCESHADE_CONTACT},
                                         {Status::invalid, FORCESHADE_INVALID},
                                         {Status::unfinished, FORCESHADE_UNFINISHED}}) {
    EXPECT_EQ(c::status_of(status), expected);
  }
}

TEST(c_handles, are_each_given_once_and_are_none_before_and_after) {
  const auto table = std::make_unique<c::Table<int>>();
  EXPECT_EQ(table->find(0), nullptr);
  EXPECT_EQ(table->take(0), nullptr);
  std::vector<std::uint64_t> handles;
  while (const std::uint64_t handle = table->add(std::make_unique<int>(static_cast<int>(handles.size()))))
    handles.push_back(handle);
  ASSERT_EQ(handles.size(), c::Table<int>::kSlots);
  for (const std::size_t i : {std::size_t{0}, std::size_t{1}, handles.size() / 2, handles.size() - 1}) {
    ASSERT_NE(table->find(handles[i]), nullptr);
    EXPECT_EQ(*table->find(handles[i]), static_cast<int>(i));
    EXPECT_EQ(*table->take(handles[i]), static_cast<int>(i));
    EXPECT_EQ(table->take(handles[i]), nullptr) << "it was taken before";
    const std::uint64_t again = table->add(std::make_unique<int>(-1));
    EXPECT_NE(again, 0U) << "its slot is there again";
    EXPECT_NE(again, handles[i]);
    EXPECT_EQ(table->find(handles[i]), nullptr) << "the old handle is invalid";
    EXPECT_EQ(*table->find(again), -1);
    EXPECT_EQ(table->add(std::make_unique<int>(0)), 0U) << "no other one is";
    handles[i] = again;
  }
  for (const std::uint64_t handle : handles) table->take(handle);
}

TEST(c_handles, of_sessions_end_in_a_sentence_and_come_back) {
  const forceshade_subject subject = tests::law_of("bump-3p-shaded");
  std::vector<forceshade_session> sessions;
  forceshade_session session{};
  forceshade_result result = FORCESHADE_OK;
  while ((result = forceshade_session_open(subject, &session)) == FORCESHADE_OK) sessions.push_back(session);
  EXPECT_EQ(result, FORCESHADE_NO_MEMORY);
  EXPECT_STREQ(forceshade_message(), "there are too many sessions; expected some to be closed");
  EXPECT_EQ(sessions.size(), 65536U);
  EXPECT_EQ(session.handle, sessions.back().handle) << "nothing is written where nothing is made";
  EXPECT_EQ(forceshade_session_close(sessions.back()), FORCESHADE_OK);
  EXPECT_EQ(forceshade_session_open(subject, &sessions.back()), FORCESHADE_OK);
  for (const forceshade_session its : sessions) EXPECT_EQ(forceshade_session_close(its), FORCESHADE_OK);
  forceshade_subject_free(subject);
}

// They have 4095 bytes at most, the last of which end a character.
TEST(c_answers, in_words_are_cut_between_two_characters) {
  forceshade_subject made{};
  for (std::size_t before = 0; before < 3; ++before) {
    std::string key(before, 'k');
    for (int i = 0; i < 3000; ++i) key += "\xE2\x82\xAC";  // the euro, of three bytes
    const std::string file = key + ".toml";
    ASSERT_EQ(forceshade_subject_read(file.c_str(), &made), FORCESHADE_BAD_INPUT);
    const std::string words = forceshade_message();
    EXPECT_EQ(words.size(), 4095 - (4095 - before) % 3);
    EXPECT_EQ(words, file.substr(0, words.size()));
  }
}

}  // namespace
}  // namespace forceshade
