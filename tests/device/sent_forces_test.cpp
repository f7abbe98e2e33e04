// SPDX-License-Identifier: BSD-3-Clause
#include "device/sent_forces.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace forceshade::device {
namespace {

using Vector = Eigen::Vector3d;

TEST(sent_forces, count_the_work_of_the_force_that_acted) {
  SentForces sent;
  sent.arrived({0, 0, 0});
  EXPECT_EQ(sent.report().acting, Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(sent.send({0, 0, 2}), Vector(0, 0, 2));
  EXPECT_EQ(sent.report().acting, Eigen::Vector3f(0, 0, 2));
  sent.arrived({5, 0, 0.5});
  EXPECT_EQ(sent.report().acted, Eigen::Vector3f(0, 0, 2));
  EXPECT_EQ(sent.report().acting, Eigen::Vector3f(0, 0, 0)) << "until something is sent again";
  EXPECT_EQ(sent.report().work, 1);
  sent.arrived({5, 0, 9});
  EXPECT_EQ(sent.report().work, 1);
}

TEST(sent_forces, assume_the_worst_of_a_step_that_was_not_seen) {
  SentForces sent;
  sent.allow({.work = 100, .longest_step = 3});
  sent.arrived({0, 0, 0});
  sent.send({0, 4, 0});
  sent.arrived({0, std::nan(""), 0});
  EXPECT_EQ(sent.report().work, 12);
  sent.send({0, 1, 0});
  sent.arrived({0, 0, 0});
  EXPECT_EQ(sent.report().work, 15) << "where the step began is not known either";
}

TEST(sent_forces, are_shortened_to_what_is_left_over_the_longest_step) {
  SentForces sent;
  sent.allow({.work = 3, .longest_step = 2});
  sent.arrived({0, 0, 0});
  EXPECT_EQ(sent.send({0, 0, 1.4}), Vector(0, 0, 1.4));
  const Vector shortened = sent.send({3, 0, 4});
  EXPECT_NEAR(shortened.norm(), 1.5, 1e-5);
  EXPECT_LE(shortened.norm(), 1.5);
  EXPECT_LE(shortened.cross(Vector(3, 0, 4)).norm(), 1e-12) << "with their direction";
  sent.send({0, 0, 1.5});
  sent.arrived({0, 0, 4});
  EXPECT_EQ(sent.send({0, 0, 1}), Vector(0, 0, 0)) << "more was given than is allowed: by a longer step";
  sent.allow({.work = 8, .longest_step = 2});
  EXPECT_EQ(sent.send({0, 0, 0.5}), Vector(0, 0, 0.5));
}

// Commands that come late, or never, or twice; a hand that runs along the force or anywhere, a step at most in each frame.
// ahead: each force is sent before the position of its frame is known.
void expect_no_more_than_is_allowed(bool ahead) {
  std::mt19937 random(1);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  double nearest = HUGE_VAL;
  for (int run = 0; run < 300; ++run) {
    const Allowance allowance{.work = uniform(0, 5), .longest_step = uniform(0.1, 10)};
    SentForces sent;
    sent.allow(allowance);
    Vector position{0, 0, 0}, acting{0, 0, 0}, command{0, 0, 0};
    double work = 0;
    for (int frame = 0; frame < 300; ++frame) {
      const Vector any = Vector(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized();
      const Vector way = uniform(0, 1) < 0.5 && acting.norm() > 0 ? acting.normalized() : any;
      const Vector step = allowance.longest_step * uniform(-0.2, 0.999999) * way;
      position += step;
      work += acting.dot(step);
      if (uniform(0, 1) < 0.7) command = uniform(0, 20) * any;
      const Vector sent_ahead = sent.send_ahead(command);
      sent.arrived(position);
      acting = ahead ? sent_ahead : sent.send(command);
      sent.acts(acting);
      ASSERT_LE(acting.norm(), command.norm());
      ASSERT_LE(work, allowance.work + 1e-9);
      ASSERT_NEAR(sent.report().work, work, 1e-9);
      nearest = std::min(nearest, allowance.work - work);
    }
  }
  EXPECT_LT(nearest, 0.01) << "the bound was reached";
}

TEST(sent_forces, give_no_more_than_is_allowed_whatever_is_commanded_when) {
  expect_no_more_than_is_allowed(false);
  expect_no_more_than_is_allowed(true);
}

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
