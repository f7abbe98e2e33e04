// SPDX-License-Identifier: BSD-3-Clause
// Damping: both sides answer alike in every bit; parameters and states are checked; what is off is not there.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <map>
#include <random>
#include <string>

#include "fast/damping/exact.h"
#include "tests/damping/both_sides.h"
#include "tests/support/allocations.h"
#include "tests/support/drawn.h"

namespace forceshade {
namespace {

using damping::Parameters, damping::State;
constexpr float kInfinity = std::numeric_limits<float>::infinity(), kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr Parameters kOil{.rate = 1000, .share = 0.25F, .damping = 0.002F, .drag = 0.001F};

// Draws numbers from short lists as often as from all that are allowed: ties and limits need round numbers.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  std::uint64_t below(std::uint64_t end) { return random_() % end; }
  bool once_in(std::uint64_t times) { return below(times) == 0; }
  double between(double low, double high) { return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53; }
  // A size from 2^low to 2^high, with any sign.
  float of_any_size(double low, double high) {
    const auto size = static_cast<float>(std::exp2(between(low, high)));
    return once_in(2) ? -size : size;
  }
  template <std::size_t kCount>
  float one_of(const std::array<float, kCount>& list) {
    return list[below(kCount)];
  }
  Eigen::Vector3f vector(double size) {
    return {static_cast<float>(between(-size, size)), static_cast<float>(between(-size, size)),
            static_cast<float>(between(-size, size))};
  }
  Eigen::Vector3f vector_of_any_size(double low, double high) {
    return {of_any_size(low, high), of_any_size(low, high), of_any_size(low, high)};
  }

  Parameters parameters() {
    Parameters p;
    p.rate = once_in(2) ? one_of(std::array{1.0F, 1000.0F, 500.0F, 131072.0F}) : std::fabs(of_any_size(0, 17));
    p.share = once_in(2) ? one_of(std::array{1.0F, 0.5F, 0.25F, 0x1p-10F}) : std::fabs(of_any_size(-10, 0));
    p.most = once_in(2) ? one_of(std::array{1.0F, 1.5F, 2.0F, 1024.0F, kInfinity}) : std::fabs(of_any_size(0, 10));
    p.full_at = once_in(2) ? one_of(std::array{0.25F, 1.0F, 0x1p-10F}) : std::fabs(of_any_size(-10, 10));
    for (float* const one : {&p.damping, &p.drag})
      *one = once_in(3) ? one_of(std::array{0.0F, 0x1p-20F, 0x1p-9F, 0.5F, 16.0F}) : std::fabs(of_any_size(-20, 4));
    if (once_in(2)) p.drag = 0;
    return p;
  }

  // The velocity with which a force's s, 1 - B (v·f)/f², is a limit or makes s·f a tie, or a step beside it; or one nearly
  // across the force, so that v·f cancels.
  Eigen::Vector3f velocity_for(const Eigen::Vector3f& force, const Parameters& p) {
    const std::array<float, 6> scales{0, 0.5F, 1.5F, 2, std::isinf(p.most) ? 4 : p.most, 1.25F};
    Eigen::Vector3f v = (1 - one_of(scales)) / (p.damping > 0 ? p.damping : 1) * force;
    if (once_in(3)) {
      v.x() = of_any_size(12, 26) / (p.damping > 0 ? p.damping : 1) * force.norm();
      v.y() = v.x() * of_any_size(-20, -6);
      v.z() = -(v.x() * force.x() + v.y() * force.y()) / force.z();
    }
    for (int i = 0; i < 3; ++i) {
      if (once_in(4)) v(i) = std::nextafter(v(i), once_in(2) ? kInfinity : -kInfinity);
      if (!(std::fabs(v(i)) >= 0x1p-20F && std::fabs(v(i)) <= 0x1p32F)) v(i) = 0;
    }
    return v;
  }

 private:
  std::mt19937_64 random_;
};

// One path of a hundred ticks with drawn parameters.
class RandomPath {
 public:
  RandomPath(std::uint64_t seed, std::map<std::string, int>& reached)
      : draw_(seed), parameters_(draw_.parameters()), both_(parameters_), reached_(reached), kind_(draw_.below(3)) {}

  void follow() {
    for (int tick = 0; tick < 100 && !::testing::Test::HasFailure(); ++tick) step();
  }

 private:
  void step() {
    const Eigen::Vector3f force = next_force();
    std::uint32_t periods = draw_.once_in(8) ? static_cast<std::uint32_t>(draw_.below(20)) : 1;
    if (draw_.once_in(100)) periods = UINT32_MAX;
    if (draw_.once_in(10)) {
      const Eigen::Vector3f velocity = draw_.velocity_for(force, parameters_);
      both_.resume({true, both_.reference.state().position, {velocity.x(), velocity.y(), velocity.z()}, 0});
      periods = 0;
    }
    move();
    const bool is_refused = draw_.once_in(60);
    const State before = both_.reference.state();
    const fast::Evaluation found = both_.tick(position_, periods, force, is_refused ? Status::invalid : Status::contact);
    note(force, before, periods, found);
  }

  void move() {
    if (draw_.once_in(20)) return;
    if (kind_ == 0)
      position_ = draw_.vector_of_any_size(-31, 13.28);
    else if (kind_ == 1)
      position_ += draw_.vector(0.3);
    else
      position_ = 0.03F * Eigen::Vector3f(static_cast<float>(draw_.below(9)), static_cast<float>(draw_.below(9)), 0);
    if (draw_.once_in(60)) position_ = {0, draw_.one_of(std::array{kNaN, kInfinity, 10001.0F}), 0};
    if (!(position_.array().abs() <= 1e4F).all() && !draw_.once_in(3)) position_.setZero();
  }

  Eigen::Vector3f next_force() {
    if (draw_.once_in(40)) return Eigen::Vector3f::Zero();
    Eigen::Vector3f force = kind_ == 0 ? draw_.vector_of_any_size(-149, 26) : draw_.vector(2);
    if (draw_.once_in(2)) force.x() = force.y() = 0;
    if (draw_.once_in(100)) force.z() = draw_.one_of(std::array{kNaN, -kInfinity, 0x1p26F, 0x1.fffffep25F});
    return force;
  }

  void note(const Eigen::Vector3f& force, const State& before, std::uint32_t periods, const fast::Evaluation& found) {
    const State& after = both_.reference.state();
    ++reached_[found.stage == fast::Stage::wide ? "integers" : "binary64"];
    if (found.status == Status::invalid) {
      ++reached_["invalid"];
      return;
    }
    const std::uint64_t gap = std::uint64_t{before.periods} + periods;
    if (before.has_position && gap > 1) ++reached_["missed positions"];
    if (before.has_position && gap > 16) ++reached_["too long a gap"];
    if (before.velocity != after.velocity && after.velocity == std::array<float, 3>{}) ++reached_["comes to rest"];
    if (force.isZero(0)) ++reached_["no force"];
    if (!force.isZero(0) && found.force.isZero(0)) ++reached_["s = 0"];
    if (!force.isZero(0) && parameters_.most > 1 && found.force == parameters_.most * force) ++reached_["s = S"];
    if (parameters_.drag > 0 && found.force != force) ++reached_["drag"];
    if (found.force.cwiseAbs().maxCoeff() < 0x1p-126F && !found.force.isZero(0)) ++reached_["subnormal"];
    if (!found.force.allFinite()) ++reached_["no number"];
  }

  Draw draw_;
  Parameters parameters_;
  tests::DampingOfBothSides both_;
  std::map<std::string, int>& reached_;
  std::uint64_t kind_;
  Eigen::Vector3f position_{0, 0, 0};
};

TEST(damping, fast_is_the_reference_in_every_bit) {
  std::map<std::string, int> reached;
  const std::size_t paths = tests::drawn(4000);
  for (std::size_t seed = 0; seed < paths && !HasFailure(); ++seed) RandomPath(seed, reached).follow();
  for (const char* event : {"integers", "binary64", "invalid", "missed positions", "too long a gap", "comes to rest",
                            "no force", "s = 0", "s = S", "drag", "subnormal", "no number"}) {
    std::printf("%9d %s\n", reached[event], event);
    EXPECT_GT(reached[event], 0) << event;
  }
}

// Without the first stage.
TEST(damping, integers_alone_are_the_reference_in_every_bit) {
  Draw draw(7);
  const std::size_t ticks = tests::drawn(40000);
  for (std::size_t tick = 0; tick < ticks && !HasFailure(); ++tick) {
    const Parameters p = draw.parameters();
    auto reference = std::get<reference::Damping>(reference::Damping::build(p));
    const Eigen::Vector3f force = draw.once_in(2) ? draw.vector(2) : draw.vector_of_any_size(-149, 25.9);
    const Eigen::Vector3f v = draw.velocity_for(force, p), from = draw.vector(10), to = from + draw.vector(0.1);
    const State before{true, {from.x(), from.y(), from.z()}, {v.x(), v.y(), v.z()}, 0};
    const auto periods = 1 + static_cast<std::uint32_t>(draw.below(3));
    reference.resume(before);
    reference::Rounded spring;
    spring.force = force;
    spring.status = Status::contact;
    if (!p.is_off()) {
      const Eigen::Vector3f exact = reference.tick(from, 0, spring).force;
      const std::array<float, 3> found = fast::exact_force(before.velocity, {force.x(), force.y(), force.z()}, p);
      EXPECT_TRUE(tests::same_bits(Eigen::Vector3f(found.data()), exact)) << tests::shown(force) << ", " << tests::shown(v);
      reference.resume(before);
      reference.tick(to, periods, spring);
      for (std::size_t i = 0; i < 3; ++i) {
        float one = before.velocity[i];
        for (std::uint32_t period = 0; period < periods; ++period) {
          one = fast::exact_velocity(one, to(static_cast<Eigen::Index>(i)), before.position[i], p, static_cast<int>(periods));
          if (std::fabs(one) < 0x1p-20F) one = 0;
        }
        EXPECT_EQ(one, reference.state().velocity[i]) << tests::shown(from) << " to " << tests::shown(to);
      }
    }
  }
}

TEST(damping, what_binary64_knows_takes_no_integers) {
  tests::DampingOfBothSides filtered({.rate = 1000, .share = 0.3F, .damping = 1});
  filtered.resume({true, {0, 0, 0.1F}, {0, 0, 10}, 0});
  EXPECT_NE(filtered.tick({0, 0, -0.2F}, 1, {0, 0, 1}).stage, fast::Stage::wide) << "s = S";
  EXPECT_NE(filtered.tick({0, 0, -0.21F}, 1, {0, 0, 0}).stage, fast::Stage::wide) << "no force";
  EXPECT_NE(filtered.tick({0, 0, 0.7F}, 1, {0, 0, 1}).stage, fast::Stage::wide) << "s = 0";
  // A tie.
  tests::DampingOfBothSides both({.rate = 1000, .share = 0.5F, .damping = 1});
  both.resume({true, {0, 0, 1}, {0, 0, 1 + 0x1p-23F}, 0});
  EXPECT_NE(both.tick({0, 0, 1 + 0x1p-9F}, 1, {0, 0, 1}).stage, fast::Stage::wide);
  EXPECT_EQ(both.fast.state().velocity[2], (1 + 1000 * 0x1p-9F) / 2);
}

TEST(damping, a_force_that_is_too_large_is_handed_on) {
  for (const Eigen::Vector3f& force :
       {Eigen::Vector3f(0, 0, 0x1p26F), Eigen::Vector3f(0, -0x1p26F, 0), Eigen::Vector3f(0x1p126F, 0, 1)}) {
    tests::DampingOfBothSides both({.rate = 1000, .damping = 1, .drag = 1});
    both.resume({true, {0, 0, 0}, {3, 5, 7}, 0});
    EXPECT_EQ(both.tick({0, 0, 0}, 0, force).force, force);
  }
  tests::DampingOfBothSides both({.rate = 1000, .damping = 16});
  both.resume({true, {0, 0, 0}, {0, 0, -0x1p32F}, 0});
  EXPECT_EQ(both.tick({0, 0, 0}, 0, {0, 0, 0x1.fffffep25F}).force, Eigen::Vector3f(0, 0, 0x1.fffffep26F)) << "S of it";
}

// In binary64 s is S, though it is less; or the force is no tie, though it is; or λ is 1, though it is less. Each gives another
// force.
TEST(damping, what_binary64_cannot_know_is_decided_by_integers) {
  struct Row {
    Parameters parameters;
    std::array<float, 3> velocity;
    Eigen::Vector3f force, damped;
  };
  const std::array rows{
      Row{{.rate = 1000, .damping = 1, .most = 1023},
          {0, 0, -0x1.071036p+9F},
          {0x1.8b5ep-32F, 0, 0x1.0794p-1F},
          {0x1.8afb28p-22F, 0, 0x1.07521ap+9F}},
      Row{{.rate = 1000, .damping = 0x1p-4F, .drag = 0x1p-20F},
          {0, 0, -0x1p-20F},
          {0, 0, 0x1.c435dep+0F},
          {0, 0, 0x1.c435ep+0F}},
      Row{{.rate = 1000, .damping = 0x1.29f19ap+2F, .most = 1024, .drag = 0x1.0faf02p+3F, .full_at = 0x1.384bcep+1F},
          {0x1.a8b382p+30F, -0x1.fb172cp+5F, -0x1.2c7324p+30F},
          {0x1.494f7p-1F, 0x1.09160ap-1F, 0x1.d17f3ep-1F},
          {-0x1.c2b85ap+33F, 0x1.0cb584p+9F, 0x1.3edb46p+33F}},
      // A small force, beside which the speed along it is large.
      Row{{.rate = 1000, .drag = 0x1.8ef6d6p-2F},
          {0, 0, 0x1.655068p+10F},
          {0x1.2520cep-9F, 0, -0x1.8219acp-4F},
          {-0x1.e041fep+0F, 0, -0x1.1c4fdep-3F}},
      // S f is a tie, and drag along f exactly 0: what binary64 makes of it is a rounding in proportion to S.
      Row{{.rate = 1000, .damping = 16, .most = 513, .drag = 0x1.8p-20F},
          {0, 0, -0x1.7d7fd4p+6F},
          {0, 0, 0x1.a652p-1F},
          {0, 0, 0x1.a72528p+8F}}};
  for (const Row& row : rows) {
    tests::DampingOfBothSides both(row.parameters);
    both.resume({true, {0, 0, 0}, row.velocity, 0});
    const fast::Evaluation found = both.tick({0, 0, 0}, 0, row.force);
    EXPECT_EQ(found.force, row.damped) << tests::shown(row.force);
    EXPECT_EQ(found.stage, fast::Stage::wide);
  }
}

// The words of both sides for a refused parameter, "" where none is.
std::string refused(const Parameters& p) {
  const auto words = [](const auto& built) {
    const auto* const error = std::get_if<ParameterError>(&built);
    return error == nullptr ? std::string() : error->message();
  };
  const std::string found = words(fast::Damping::build(p));
  EXPECT_EQ(found, words(reference::Damping::build(p)));
  return found;
}

TEST(damping, parameters_have_their_ranges) {
  const auto above = [](float a) { return std::nextafter(a, kInfinity); };
  const auto below = [](float a) { return std::nextafter(a, -kInfinity); };
  struct Range {
    std::string name;
    float Parameters::*one;
    float low, high;
    std::string expected;
    float besides = kNaN;  // a value outside that is allowed
  };
  const std::string damping = "expected 0, or 9.536743e-07 to 16 N·s/mm";
  for (const Range& range : {Range{"rate", &Parameters::rate, 1, 131072, "expected 1 to 131072 Hz"},
                             Range{"share", &Parameters::share, 0x1p-10F, 1, "expected 0.0009765625 to 1"},
                             Range{"damping", &Parameters::damping, 0x1p-20F, 16, damping, 0},
                             Range{"most", &Parameters::most, 1, 1024, "expected inf, or 1 to 1024", kInfinity},
                             Range{"drag", &Parameters::drag, 0x1p-20F, 16, damping, 0},
                             Range{"full_at", &Parameters::full_at, 0x1p-10F, 1024, "expected 0.0009765625 to 1024 N"}}) {
    const auto with = [&](float value) {
      Parameters p = kOil;
      p.*range.one = value;
      return refused(p);
    };
    for (const float value : {range.low, range.high}) EXPECT_EQ(with(value), "");
    for (const float value : {below(range.low), above(range.high), -1.0F, kNaN, -kInfinity, 0.0F, kInfinity}) {
      const std::string words = with(value);
      if (value == range.besides)
        EXPECT_EQ(words, "");
      else
        EXPECT_TRUE(words.starts_with(range.name + " is ") && words.ends_with("; " + range.expected)) << words;
    }
  }
  EXPECT_EQ(refused({}), "rate is 0 Hz; expected 1 to 131072 Hz") << "there is no default";
}

TEST(damping, off_is_the_spring_in_every_bit) {
  tests::DampingOfBothSides both({.rate = 1000});
  EXPECT_TRUE(both.fast.parameters().is_off());
  for (const Eigen::Vector3f& position : {Eigen::Vector3f(0, 0, 1), Eigen::Vector3f(0, 0, 2), Eigen::Vector3f(kNaN, 0, 0)})
    for (const Eigen::Vector3f& force : {Eigen::Vector3f(0.1F, -0.0F, 0x1p-149F), Eigen::Vector3f(kInfinity, kNaN, 0)}) {
      const fast::Evaluation found = both.tick(position, 1, force);
      EXPECT_TRUE(tests::same_bits(found.force, force));
      EXPECT_EQ(found.status, Status::contact);
      EXPECT_EQ(both.fast.state(), State());
    }
}

TEST(damping, a_state_goes_out_and_in) {
  Draw draw(3);
  tests::DampingOfBothSides first(kOil), second(kOil);
  for (int tick = 0; tick < 50; ++tick) {
    const Eigen::Vector3f position = tick % 7 == 0 ? Eigen::Vector3f(kNaN, 0, 0) : draw.vector(1), force = draw.vector(1);
    second.resume(first.fast.state());
    EXPECT_EQ(second.fast.state(), first.fast.state());
    const Eigen::Vector3f expected = first.tick(position, 1, force).force;
    EXPECT_EQ(second.tick(position, 1, force).force, expected);
  }
  first.fast.reset();
  first.reference.reset();
  EXPECT_EQ(first.fast.state(), State());
  EXPECT_EQ(first.reference.state(), State());
}

TEST(damping, a_state_that_no_tick_gives_counts_as_the_first) {
  const State good{true, {1, 0x1p-30F, -1e4F}, {0x1p-20F, -0x1p32F, 0}, 17};
  tests::DampingOfBothSides both(kOil);
  both.resume(good);
  EXPECT_EQ(both.fast.state(), good);
  EXPECT_EQ(both.reference.state(), good);
  for (const State& bad :
       {State{true, {kNaN, 0, 0}, {}, 0}, State{true, {0x1.388002p13F, 0, 0}, {}, 0},
        State{true, {0, 0x1.fffffep-31F, 0}, {}, 0}, State{true, {}, {0x1.fffffep-21F, 0, 0}, 0},
        State{true, {}, {0, 0x1.000002p32F, 0}, 0}, State{true, {}, {0, 0, kNaN}, 0}, State{true, {}, {0, 4, 0}, 18},
        State{false, {1, 0, 0}, {}, 0}, State{false, {}, {1, 0, 0}, 0}, State{false, {}, {}, 1}}) {
    both.resume(good);
    both.resume(bad);
    EXPECT_EQ(both.fast.state(), State());
    EXPECT_EQ(both.reference.state(), State());
    EXPECT_EQ(both.tick({0, 0, 0}, 0, {0, 1, 1}).force, Eigen::Vector3f(0, 1, 1));
  }
}

TEST(damping, the_same_reading_again_leaves_the_state_as_it_is) {
  tests::DampingOfBothSides both(kOil);
  const Eigen::Vector3f force(0, 0, 1);
  both.tick({0, 0, 0}, 0, force);
  EXPECT_EQ(both.fast.state(), State()) << "no time has passed, so there is no position yet";
  both.tick({0, 0, 0}, 1, force);
  const Eigen::Vector3f damped = both.tick({0, 0, 0.1F}, 1, force).force;
  const State before = both.fast.state();
  EXPECT_EQ(both.tick({0, 0, 0.2F}, 0, force).force, damped);
  EXPECT_EQ(both.fast.state(), before);
  EXPECT_EQ(both.tick({kNaN, 0, 0}, 0, force).status, Status::invalid);
  EXPECT_EQ(both.fast.state(), before);
}

TEST(damping, a_tick_allocates_nothing) {
  Draw draw(5);
  auto damping = std::get<fast::Damping>(fast::Damping::build(kOil));
  bool is_wide = false;
  const std::size_t before = tests::allocations();
  for (int tick = 0; tick < 2000; ++tick) {
    const Eigen::Vector3f position = draw.vector(1), force = draw.vector(1);
    is_wide |= damping.tick(position, tick % 5 == 0 ? 3 : 1, {force, Status::contact}).stage == fast::Stage::wide;
  }
  EXPECT_EQ(tests::allocations(), before);
  EXPECT_TRUE(is_wide);
}

}  // namespace
}  // namespace forceshade
