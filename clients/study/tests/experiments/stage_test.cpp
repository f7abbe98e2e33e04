// SPDX-License-Identifier: BSD-3-Clause
#include "study/apparatus/stage.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <random>
#include <thread>

#include "tests/device/servo_loop_fixture.h"
#include "tests/support/allocations.h"

namespace forceshade::apparatus {
namespace {

using Eigen::Vector3f;

constexpr float kHalf = 25.4F;  // mm: the middle of each bump

Placed bump(LawId id, float radius, float x) {
  const auto law = std::get<fast::Law>(fast::Law::build(id, {.radius = radius, .width = 25.4F, .stiffness = 0.5F}));
  return {fast::session_of(law), {x, 0, 0}};
}

std::unique_ptr<Stimulus> pair_of(std::uint32_t number, LawId right, float radius) {
  return std::make_unique<Stimulus>(
      Stimulus{number, bump(LawId::bump_cylinder, 15.24F, -kHalf), bump(right, radius, kHalf), 0});
}

void expect_same(const fast::Evaluation& a, const fast::Evaluation& b) {
  EXPECT_EQ(a.force, b.force);
  EXPECT_EQ(a.status, b.status);
}

const Vector3f kFree{0, 0, 5};

TEST(stage, gives_no_force_before_the_first_stimulus) {
  Stage stage;
  expect_same(stage.step({0, 0, -1}), {});
  EXPECT_EQ(stage.shown(), 0U);
}

TEST(stage, gives_each_side_the_force_of_its_own_bump) {
  Stage stage;
  stage.offer(pair_of(1, LawId::bump_2p_shaded, 25.4F));
  stage.step(kFree);
  ASSERT_EQ(stage.shown(), 1U);
  Placed left = bump(LawId::bump_cylinder, 15.24F, 0), right = bump(LawId::bump_2p_shaded, 25.4F, 0);
  std::mt19937 random(1);
  std::uniform_real_distribution<float> across(-60, 60), height(-4, 8);
  int contacts[2] = {0, 0};
  for (int i = 0; i < 20000; ++i) {
    const Vector3f at(across(random), across(random), height(random));
    const bool is_left = at.x() < 0;
    const Vector3f own = at - Vector3f(is_left ? -kHalf : kHalf, 0, 0);
    const fast::Evaluation expected = (is_left ? left : right).session->step(own);
    expect_same(stage.step(at), expected);
    contacts[is_left ? 0 : 1] += expected.status == Status::contact ? 1 : 0;
  }
  EXPECT_GT(contacts[0], 1000);
  EXPECT_GT(contacts[1], 1000);
}

TEST(stage, with_a_single_bump_has_it_on_both_sides) {
  Stage stage;
  stage.offer(std::make_unique<Stimulus>(Stimulus{1, bump(LawId::bump_1p_shaded, 15.24F, 0), std::nullopt, 0}));
  stage.step(kFree);
  for (const float x : {-5.0F, 5.0F}) {
    const Vector3f force = stage.step({x, 0, -1}).force;
    EXPECT_GT(force.x() * x, 0) << "away from the middle";
  }
}

// The force beyond a bump: K depth, straight up, for every law but the round bump, whose cylinder is wider below the plane than
// on it. Its force is the plane's at the seam down to where the cylinder begins there.
TEST(stage, has_the_same_force_on_both_sides_of_the_seam_down_to_where_a_cylinder_begins) {
  int laws = 0, deep = 0;
  for (const LawName& law : kLaws) {
    if (!law.name.starts_with("bump-")) continue;
    ++laws;
    for (const float radius : {15.24F, 35.56F, 60.0F}) {
      const double r = static_cast<double>(radius), axis = std::sqrt(r * r - 12.7 * 12.7);
      const double half = static_cast<double>(kHalf);
      const double begins = law.id == LawId::bump_cylinder && r > half ? axis - std::sqrt(r * r - half * half) : HUGE_VAL;
      Placed left = bump(LawId::bump_1p_shaded, 15.24F, -kHalf), right = bump(law.id, radius, kHalf);
      for (float depth = 0.05F; depth < 12; depth += 0.05F) {
        const Vector3f at(0, 1, -depth);
        const fast::Evaluation a = left.session->step(at - left.origin), b = right.session->step(at - right.origin);
        if (static_cast<double>(depth) < begins - 1e-3) {
          expect_same(a, b);
        } else if (static_cast<double>(depth) > begins + 1e-3) {
          EXPECT_NE(a.force, b.force) << law.name << ' ' << radius << ' ' << depth;
          ++deep;
        }
      }
    }
  }
  EXPECT_EQ(laws, 7);
  EXPECT_GT(deep, 20);
}

TEST(stage, exchanges_only_where_the_force_does_not_change) {
  Stage stage;
  stage.offer(pair_of(1, LawId::bump_1p_shaded, 15.24F));
  stage.step(kFree);
  std::mt19937 random(2);
  std::uniform_real_distribution<float> across(-60, 60), height(-3, 3);
  std::unique_ptr<Stimulus> before = pair_of(1, LawId::bump_1p_shaded, 15.24F), after;
  int waited = 0, in_contact = 0, exchanged = 0;
  std::uint32_t number = 1;
  for (int i = 0; i < 20000; ++i) {
    const Vector3f at(across(random), 0, height(random));
    if (!after) {
      const float radius = 15.24F + 0.254F * static_cast<float>(random() % 80);
      stage.offer(pair_of(++number, LawId::bump_1p_shaded, radius));
      after = pair_of(number, LawId::bump_1p_shaded, radius);
    }
    const Stimulus::Answer old = before->step(at), next = after->step(at);
    const bool may = old.right.force == next.right.force && old.right.status == next.right.status;
    expect_same(stage.step(at), old.felt);
    stage.collect();
    if (may) {
      ASSERT_EQ(stage.shown(), number);
      ++exchanged;
      in_contact += old.felt.status == Status::contact ? 1 : 0;
      before = std::move(after);
    } else {
      ASSERT_EQ(stage.shown(), std::uint64_t{number} << 32 | (number - 1));
      ++waited;
    }
  }
  EXPECT_GT(exchanged, 1000);
  EXPECT_GT(in_contact, 100) << "on the plane that both have";
  EXPECT_GT(waited, 1000);
}

// A bump may reach across the seam, as a wide cylinder does. The tip that crosses the seam next would be in the new one.
TEST(stage, waits_while_the_side_that_is_not_felt_would_change_under_the_tip) {
  for (const bool is_left_felt : {true, false}) {
    const auto stimulus = [&](std::uint32_t number, float radius) {
      const float x = is_left_felt ? kHalf : -kHalf;
      Placed changes = bump(LawId::bump_1p_shaded, radius, x), stays = bump(LawId::bump_cylinder, 15.24F, -x);
      return std::make_unique<Stimulus>(is_left_felt ? Stimulus{number, std::move(stays), std::move(changes), 2 * kHalf}
                                                     : Stimulus{number, std::move(changes), std::move(stays), -2 * kHalf});
    };
    const Vector3f at(is_left_felt ? kHalf + 5 : -kHalf - 5, 0, -1);
    const Stimulus::Answer old = stimulus(1, 15.24F)->step(at), next = stimulus(2, 25.4F)->step(at);
    expect_same(old.felt, next.felt);
    ASSERT_NE(is_left_felt ? old.right.force : old.left.force, is_left_felt ? next.right.force : next.left.force);
    Stage stage;
    stage.offer(stimulus(1, 15.24F));
    stage.step(kFree);
    stage.offer(stimulus(2, 25.4F));
    stage.step(at);
    EXPECT_EQ(stage.shown(), std::uint64_t{2} << 32 | 1U);
    stage.step(kFree);
    EXPECT_EQ(stage.shown(), 2U);
  }
}

TEST(stage, forgets_an_offer_that_a_later_one_replaces) {
  Stage stage;
  stage.offer(pair_of(1, LawId::bump_1p_shaded, 15.24F));
  stage.step(kFree);
  const Vector3f pressed(kHalf + 5, 0, -1);
  stage.offer(pair_of(2, LawId::bump_1p_shaded, 20));
  stage.step(pressed);
  stage.offer(pair_of(3, LawId::bump_1p_shaded, 25));
  stage.step(pressed);
  EXPECT_EQ(stage.shown(), (std::uint64_t{3} << 32 | 1));
  stage.step(kFree);
  EXPECT_EQ(stage.shown(), 3U);
}

TEST(stage, goes_on_with_what_it_has_while_nobody_collects) {
  Stage stage;
  for (std::uint32_t number = 1; number <= 2; ++number) {
    stage.offer(pair_of(number, LawId::bump_1p_shaded, 15.24F));
    stage.step(kFree);
  }
  // The first was retired, and is collected by this offer; the second is retired then, and nobody collects it.
  stage.offer(pair_of(3, LawId::bump_1p_shaded, 15.24F));
  stage.step(kFree);
  EXPECT_EQ(stage.shown(), 3U);
  stage.collect();
  stage.step(kFree);
  EXPECT_EQ(stage.shown(), 3U);
}

// Remembers how often it was stepped, and whether the path began inside.
struct Remembering final : fast::Session {
  fast::Evaluation step(const Vector3f& position) noexcept override {
    const bool is_inside = position.z() < 0;
    if (!has_begun) fell_in = is_inside;
    has_begun = true;
    if (!is_inside) fell_in = false;
    if (!is_inside || fell_in) return {};
    return {{0, 0, -position.z()}, Status::contact, fast::Stage::binary64};
  }
  bool has_begun = false, fell_in = false;
};

TEST(stage, never_begins_a_renderer_with_a_memory_inside_its_object) {
  Stage stage;
  const auto remembering = [](std::uint32_t number) {
    return std::make_unique<Stimulus>(Stimulus{number, Placed{std::make_unique<Remembering>(), {0, 0, 0}}, std::nullopt, 0});
  };
  stage.offer(remembering(1));
  stage.step(kFree);
  stage.step({0, 0, -1});
  stage.offer(remembering(2));
  EXPECT_EQ(stage.step({0, 0, -1}).force, Vector3f(0, 0, 1));
  EXPECT_EQ(stage.shown(), (std::uint64_t{2} << 32 | 1));
  stage.step(kFree);
  EXPECT_EQ(stage.shown(), 2U);
  EXPECT_EQ(stage.step({0, 0, -2}).force, Vector3f(0, 0, 2));
}

// Counts the calls of look_ahead().
struct Looking final : fast::Session {
  explicit Looking(int& its_looks) : looks(its_looks) {}
  fast::Evaluation step(const Vector3f&) noexcept override { return {}; }
  void look_ahead() noexcept override { ++looks; }
  int& looks;
};

TEST(stage, looks_ahead_in_both_bumps_of_what_is_shown) {
  Stage stage;
  stage.look_ahead();  // there is none yet
  int left = 0, right = 0;
  stage.offer(std::make_unique<Stimulus>(Stimulus{1, Placed{std::make_unique<Looking>(left), {-kHalf, 0, 0}},
                                                  Placed{std::make_unique<Looking>(right), {kHalf, 0, 0}}, 0}));
  stage.step(kFree);
  stage.look_ahead();
  EXPECT_EQ(left, 1);
  EXPECT_EQ(right, 1);
}

// Says whether it was destroyed by the thread of a loop.
struct Freed final : fast::Session {
  fast::Evaluation step(const Vector3f&) noexcept override { return {}; }
  ~Freed() override {
    ++freed;
    if (is_in_loop) ++freed_in_loop;
  }
  static inline std::atomic<int> freed = 0, freed_in_loop = 0;
  static inline thread_local bool is_in_loop = false;
};

TEST(stage, allocates_nothing_in_the_loop_and_frees_nothing_there) {
  Stage stage;
  const auto tracked = [](std::uint32_t number) {
    auto stimulus = pair_of(number, LawId::bump_3p_shaded, 16 + static_cast<float>(number % 9));
    if (number % 2 == 0) stimulus->left->session = std::make_unique<Freed>();
    return stimulus;
  };
  std::atomic<bool> done = false;
  std::atomic<std::size_t> exchanges = 0;
  std::size_t allocations = 0;
  std::thread loop([&] {
    Freed::is_in_loop = true;
    std::uint64_t last = 0;
    const std::size_t before = tests::allocations();
    for (std::uint64_t tick = 0; !done; ++tick) {
      stage.step({tick % 2 == 0 ? 20.0F : -20.0F, 0, tick % 5 == 0 ? 1.0F : -1.0F});
      if (const std::uint64_t now = stage.shown() & 0xFFFFFFFF; now != last) {
        ++exchanges;
        last = now;
      }
    }
    allocations = tests::allocations() - before;
  });
  for (std::uint32_t number = 1; exchanges < 200; ++number) stage.offer(tracked(number));
  done = true;
  loop.join();
  EXPECT_EQ(allocations, 0U);
  EXPECT_GT(Freed::freed, 50);
  EXPECT_EQ(Freed::freed_in_loop, 0);
}

}  // namespace
}  // namespace forceshade::apparatus
