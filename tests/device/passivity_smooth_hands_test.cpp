// SPDX-License-Identifier: BSD-3-Clause
// A hand that moves smoothly on an account that is almost empty feels no buzz.

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <cstdio>

#include "tests/device/unmoved_hand.h"
#include "tests/support/drawn.h"
#include "tests/support/silent.h"

namespace forceshade::device {
namespace {

// One swing along an axis, in mm, Hz and turns.
struct Swing {
  int size, frequency, phase;  // in hundredths
};

std::ostream& operator<<(std::ostream& out, const Swing& swing) {
  return out << "{" << swing.size << ", " << swing.frequency << ", " << swing.phase << "}";
}

// At most 12 mm, and 300 mm/s.
rc::Gen<Swing> any_swing() {
  return rc::gen::mapcat(rc::gen::inRange(10, 400), [](int frequency) {
    const int fast = static_cast<int>(300 * 100 / (2 * M_PI * frequency / 100));
    return rc::gen::build<Swing>(rc::gen::set(&Swing::size, rc::gen::inRange(1, std::min(1200, fast))),
                                 rc::gen::set(&Swing::frequency, rc::gen::just(frequency)),
                                 rc::gen::set(&Swing::phase, rc::gen::inRange(0, 100)));
  });
}

double at(const Swing& swing, double time) {
  return 0.01 * swing.size * std::sin(2 * M_PI * (0.01 * swing.frequency * time + 0.01 * swing.phase));
}

// In counts of 0.03 mm, as encoders have it.
Position counted(const Position& position) {
  return 0.03 * (position / 0.03).array().round().matrix();
}

// Strokes that empty the account, a second's way to where the hand begins, and three seconds of it.
TEST(passivity_controller, lets_no_smooth_hand_feel_a_buzz) {
  for (const LawId id : {LawId::wall, LawId::bump_1p_shaded, LawId::bump_2p_shaded, LawId::bump_3p_shaded})
    for (const Kind kind : {Kind::tank, Kind::damping})
      for (const bool latency : {false, true}) {
        const PassivitySettings settings = passivity_settings({.resolution = 0.03F, .latency = latency}, 1000);
        float worst = 0;
        double lowest = 0;
        std::size_t altered = 0;
        rc::detail::TestParams params;
        params.seed = 20261;
        params.maxSuccess = static_cast<int>(tests::drawn(200));
        tests::Silent silent;
        const auto result = rc::detail::checkTestable(
            [&] {
              const auto swings = *rc::gen::container<std::array<Swing, 6>>(any_swing());
              const int deep = *rc::gen::inRange(-200, 800);  // hundredths of a mm, in the middle
              const auto hand_at = [&](double time) {
                return Position(at(swings[0], time) + at(swings[1], time), at(swings[2], time) + at(swings[3], time),
                                0.3 * (at(swings[4], time) + at(swings[5], time)) - 0.01 * deep);
              };
              Hand hand(law_of(id), kind, settings);
              for (int round = 0; round < 12; ++round) hand.go_round(stroke(kBump, 4), 0.2);
              const Position from = hand.at;
              for (int tick = 0; tick <= 1000; ++tick) hand.go_to(counted(from + (hand_at(0) - from) * (tick / 1000.0)));
              hand.chatter = {};
              for (int tick = 1; tick < 3000; ++tick) hand.go_to(counted(hand_at(tick / 1000.0)));
              worst = std::max(worst, hand.chatter.worst);
              lowest = std::min(lowest, static_cast<double>(hand.lowest));
              altered += hand.controller.account().altered;
              RC_ASSERT(hand.chatter.ticks == 0U);
              RC_ASSERT(hand.lowest >= -settings.epsilon - kRounding);
            },
            rc::detail::TestMetadata{}, params, silent, std::unordered_map<std::string, rc::detail::Reproduce>{});
        rc::detail::FailureResult failure;
        if (result.match(failure)) {
          ADD_FAILURE() << words_of(id) << ", " << words_of(kind) << (latency ? ", latency" : "") << ": "
                        << failure.description;
          for (const auto& [type, value] : failure.counterExample) ADD_FAILURE() << type << " " << value;
        }
        std::printf("  %-14s %-8s %s: alternates by %.4f N, lowest %7.4f of epsilon, %zu ticks altered\n", words_of(id).c_str(),
                    words_of(kind), latency ? "latency" : "       ", static_cast<double>(worst), lowest / settings.epsilon,
                    altered);
        EXPECT_TRUE(altered > 0 || id == LawId::wall) << words_of(id);
      }
}

}  // namespace
}  // namespace forceshade::device
