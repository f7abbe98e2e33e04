// SPDX-License-Identifier: BSD-3-Clause
#include "device/sent_share.h"

#include <gtest/gtest.h>

namespace forceshade::device {
namespace {

using namespace std::chrono_literals;

constexpr std::int64_t kMillisecond = 1'000'000;
const Eigen::Vector3d kOrder{0, 0, 3};

// At 1 kHz, of an order of 3 N: the share that acts.
class Frames {
 public:
  double send(double age_ms, double most = 1, const Eigen::Vector3d& order = kOrder) {
    const double part = std::min(share.next(static_cast<std::int64_t>(age_ms * kMillisecond)), most);
    share.acts(order, part * order);
    return part;
  }
  SentShare share{24ms, 1000};
};

TEST(sent_share, falls_with_the_age_of_an_order_and_grows_by_a_five_hundredth_a_frame) {
  Frames frames;
  EXPECT_EQ(frames.send(0), 1);
  EXPECT_EQ(frames.send(3), 1) << "an eighth of the time";
  EXPECT_EQ(frames.share.fades(), 0);
  EXPECT_NEAR(frames.send(13.5), 0.5, 1e-12);
  for (int frame = 1; frame < 250; ++frame) ASSERT_NEAR(frames.send(0), 0.5 + frame * 0.002, 1e-9) << frame;
  EXPECT_EQ(frames.share.fades(), 1);
  EXPECT_NEAR(frames.share.seconds(), 0.25, 1e-9);
  frames.send(0);
  EXPECT_EQ(frames.send(0), 1);
  frames.send(9);
  EXPECT_EQ(frames.share.fades(), 2);
}

TEST(sent_share, grows_as_slowly_after_the_device_was_sent_less_for_another_reason) {
  Frames frames;
  EXPECT_EQ(frames.send(0, 0.25), 0.25);
  EXPECT_NEAR(frames.send(0), 0.252, 1e-12);
  EXPECT_EQ(frames.share.fades(), 1);
}

TEST(sent_share, counts_no_fade_while_a_force_is_switched_off_and_one_when_it_comes_back) {
  Frames frames;
  frames.send(0, 0);
  EXPECT_EQ(frames.share.fades(), 0);
  EXPECT_NEAR(frames.send(0), 0.002, 1e-12);
  EXPECT_EQ(frames.share.fades(), 1);
}

TEST(sent_share, is_whole_again_after_an_order_of_no_force) {
  Frames frames;
  frames.send(20);
  frames.send(0, 1, {0, 0, 0});
  EXPECT_EQ(frames.send(0), 1);
  EXPECT_EQ(frames.share.fades(), 1);
}

}  // namespace
}  // namespace forceshade::device
