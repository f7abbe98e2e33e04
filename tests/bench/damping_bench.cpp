// SPDX-License-Identifier: BSD-3-Clause
// The time of a tick of a law with damping behind it, beside that without, with damping that is off, and with the same
// arithmetic in binary64 without bounds of its errors, checks of a position, or missed ones.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "forceshade/damped.h"

namespace forceshade::bench {
namespace {

constexpr std::size_t kPositions = 4096;  // a power of two: a remainder by any other takes a nanosecond

// A finger at 1 kHz that strokes the thesis's bump, up to 60 mm/s, always in contact.
std::vector<Eigen::Vector3f> stroke() {
  std::vector<Eigen::Vector3f> positions;
  for (std::size_t i = 0; i < kPositions; ++i) {
    const auto ms = static_cast<float>(i);
    positions.emplace_back(10 * std::sin(0.006F * ms), 30 * std::sin(0.0011F * ms), -1 - 0.5F * std::sin(0.01F * ms));
  }
  return positions;
}

class Naive final : public fast::Session {
 public:
  Naive(std::unique_ptr<fast::Session> session, const damping::Parameters& p) noexcept
      : session_(std::move(session)),
        keep_(1 - double{p.share}),
        gain_(double{p.share} * double{p.rate}),
        damping_(p.damping),
        most_(p.most),
        drag_(p.drag),
        per_square_(1 / (double{p.full_at} * double{p.full_at})) {}

  fast::Evaluation step(const Eigen::Vector3f& position) noexcept override {
    return damped(position, session_->step(position));
  }

 private:
  // As the library's: not a part of step().
  [[gnu::noinline]] fast::Evaluation damped(const Eigen::Vector3f& position, const fast::Evaluation& spring) noexcept {
    std::array<double, 3> f{};
    double square = 0, along = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      const auto x = static_cast<double>(position(axis));
      v_[i] = static_cast<double>(static_cast<float>(keep_ * v_[i] + gain_ * (x - x_[i])));
      x_[i] = x;
      f[i] = static_cast<double>(spring.force(axis));
      square += f[i] * f[i];
      along += v_[i] * f[i];
    }
    if (square == 0) return spring;
    const double ratio = along / square, scale = std::min(most_, std::max(0.0, 1 - damping_ * ratio));
    const double drag = drag_ == 0 ? 0 : drag_ * std::min(1.0, scale * square * per_square_);
    const auto component = [&](std::size_t i) { return static_cast<float>(scale * f[i] - drag * (v_[i] - ratio * f[i])); };
    return {{component(0), component(1), component(2)}, spring.status, spring.stage};
  }

  std::unique_ptr<fast::Session> session_;
  double keep_, gain_, damping_, most_, drag_, per_square_;
  std::array<double, 3> x_{}, v_{};
};

void steps(benchmark::State& state, fast::Session& session) {
  const auto positions = stroke();
  std::size_t i = 0;
  for (auto _ : state) {
    const fast::Evaluation answer = session.step(positions[i++ % kPositions]);
    benchmark::DoNotOptimize(std::as_const(answer));
  }
}

std::unique_ptr<fast::Session> bump() {
  return fast::session_of(std::get<fast::Law>(fast::Law::build(LawId::bump_2p_shaded, {15.24F, 25.4F, 0.5F})));
}
void tick(benchmark::State& state, const damping::Parameters& parameters) {
  steps(state, *fast::damped(bump(), std::get<fast::Damping>(fast::Damping::build(parameters))));
}
void naive(benchmark::State& state, const damping::Parameters& parameters) {
  steps(state, *std::make_unique<Naive>(bump(), parameters));
}

constexpr damping::Parameters kOff{.rate = 1000}, kDamping{.rate = 1000, .damping = 0.002F},
    kHalf{.rate = 1000, .share = 0.5F, .damping = 0.002F}, kFiltered{.rate = 1000, .share = 0.1F, .damping = 0.002F},
    kDrag{.rate = 1000, .share = 0.1F, .damping = 0.002F, .drag = 0.001F};

BENCHMARK_CAPTURE(tick, off, kOff);
BENCHMARK_CAPTURE(tick, damping, kDamping);
BENCHMARK_CAPTURE(tick, damping_half, kHalf);
BENCHMARK_CAPTURE(tick, damping_filtered, kFiltered);
BENCHMARK_CAPTURE(tick, damping_and_drag, kDrag);
BENCHMARK_CAPTURE(naive, damping, kDamping);
BENCHMARK_CAPTURE(naive, damping_and_drag, kDrag);

}  // namespace
}  // namespace forceshade::bench

BENCHMARK_MAIN();
