// SPDX-License-Identifier: BSD-3-Clause
#include "device/triple_buffer.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <thread>

namespace forceshade::device {
namespace {

TEST(latest, is_empty_before_anything_is_published) {
  TripleBuffer<int> mailbox;
  EXPECT_EQ(mailbox.latest(), 0);
  EXPECT_EQ(mailbox.latest(), 0);
}

TEST(latest, gives_the_last_value_again_and_again) {
  TripleBuffer<int> mailbox;
  for (int i = 1; i <= 10; ++i) {
    mailbox.publish(-i);
    mailbox.publish(i);
    EXPECT_EQ(mailbox.latest(), i);
    EXPECT_EQ(mailbox.latest(), i);
  }
}

TEST(latest, leaves_a_value_alone_until_the_next_is_asked_for) {
  TripleBuffer<int> mailbox;
  for (int i = 0; i < 10; ++i) {
    const int& value = mailbox.latest();
    for (int j = 1; j <= 4; ++j) {
      mailbox.publish(10 * i + j);
      EXPECT_EQ(value, i == 0 ? 0 : 10 * (i - 1) + 4);
    }
  }
}

TEST(latest, is_never_torn_and_never_goes_back) {
  using BigFloatBall = std::array<std::uint64_t, 32>;
  TripleBuffer<BigFloatBall> mailbox;
  constexpr std::uint64_t kChanges = 200;
  std::atomic<bool> enough = false;
  std::thread writer([&] {
    for (std::uint64_t i = 1; !enough; ++i) {
      BigFloatBall value;
      value.fill(i);
      mailbox.publish(value);
    }
  });
  std::uint64_t last = 0;
  for (std::uint64_t changes = 0; changes < kChanges;) {
    const BigFloatBall value = mailbox.latest();
    const bool whole = std::count(value.begin(), value.end(), value[0]) == static_cast<std::ptrdiff_t>(value.size());
    const bool forwards = value[0] >= last;
    EXPECT_TRUE(whole) << last;
    EXPECT_TRUE(forwards) << last;
    if (!whole || !forwards) break;
    if (value[0] == last)
      std::this_thread::yield();
    else
      ++changes;
    last = value[0];
  }
  enough = true;
  writer.join();
}

}  // namespace
}  // namespace forceshade::device
