// SPDX-License-Identifier: BSD-3-Clause
// A batch that threads are to share is done whole where the system starts none of them, or only the first.

#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <thread>
#include <vector>

#include "forceshade.h"
#include "tests/bindings/batches.h"
#include "tests/bindings/subjects.h"

namespace {

int calls = 0, granted = 0;

}  // namespace

// In the place of the system's: it does the thread's work at once where it is granted, and starts none.
extern "C" int pthread_create(pthread_t* made, const pthread_attr_t*, void* (*work)(void*), void* its) {
  if (calls++ >= granted) return EAGAIN;
  *made = pthread_self();
  work(its);
  return 0;
}
extern "C" int pthread_join(pthread_t, void**) {
  return 0;
}

namespace {

TEST(c_threads, that_the_system_does_not_start_leave_the_work_to_the_calling_one) {
  const forceshade_subject subject = forceshade::tests::law_of("bump-2p");
  const std::vector<float> at = forceshade::tests::positions(6000, 8);
  std::vector<float> right(at.size());
  std::vector<forceshade_status> statuses(at.size() / 3);
  forceshade_batch batch = forceshade::tests::batch_of(at, right, statuses);
  std::size_t expected = 0;
  ASSERT_EQ(forceshade_forces(subject, &batch, &expected), FORCESHADE_OK);
  for (granted = 0; granted <= 4; ++granted) {
    calls = 0;
    std::vector<float> forces(at.size(), 7);
    batch = forceshade::tests::batch_of(at, forces, statuses);
    batch.threads = 4;
    std::size_t invalid = 0;
    ASSERT_EQ(forceshade_forces(subject, &batch, &invalid), FORCESHADE_OK);
    EXPECT_EQ(calls, std::min(granted + 1, 3));
    EXPECT_EQ(invalid, expected);
    for (std::size_t i = 0; i < at.size(); i += 3)
      ASSERT_EQ(forceshade::tests::bits_of(&forces[i]), forceshade::tests::bits_of(&right[i])) << granted;
  }
  // The struct of a program from before there were threads ends before their number.
  calls = 0;
  batch.size = offsetof(forceshade_batch, threads);
  ASSERT_EQ(forceshade_forces(subject, &batch, nullptr), FORCESHADE_OK);
  EXPECT_EQ(calls, 0);
  forceshade_subject_free(subject);
}

}  // namespace
