// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>

#include "fast/damping/exact.h"
#include "fast/damping/filter.h"
#include "fast/domain.h"
#include "fast/numbers/arithmetic.h"
#include "fast/stage.h"
#include "forceshade/fast.h"

namespace forceshade::fast {
namespace {

constexpr std::uint32_t kNoSpeed = 17;       // periods since the last valid position: that many and more give no velocity
constexpr float kLeastVelocity = 0x1p-20F;   // mm/s: what is smaller is 0
constexpr float kLargestVelocity = 0x1p32F;  // mm/s
constexpr float kForcesEnd = 0x1p26F;        // N: from there on a force is handed on as it is

std::optional<ParameterError> first_error(const damping::Parameters& p) noexcept {
  const auto outside = [](float value, float low, float high) { return !(value >= low && value <= high); };
  if (outside(p.rate, 1, 0x1p17F)) return ParameterError{"rate", "Hz", p.rate, 1, 0x1p17F};
  if (outside(p.share, 0x1p-10F, 1)) return ParameterError{"share", "", p.share, 0x1p-10F, 1};
  if (p.damping != 0 && outside(p.damping, 0x1p-20F, 16))
    return ParameterError{"damping", "N·s/mm", p.damping, 0x1p-20F, 16, nullptr, "0"};
  if (p.most != HUGE_VALF && outside(p.most, 1, 1024)) return ParameterError{"most", "", p.most, 1, 1024, nullptr, "inf"};
  if (p.drag != 0 && outside(p.drag, 0x1p-20F, 16)) return ParameterError{"drag", "N·s/mm", p.drag, 0x1p-20F, 16, nullptr, "0"};
  if (outside(p.full_at, 0x1p-10F, 1024)) return ParameterError{"full_at", "N", p.full_at, 0x1p-10F, 1024};
  return std::nullopt;
}

bool is_velocity(float v) noexcept {
  return v == 0 || (std::fabs(v) >= kLeastVelocity && std::fabs(v) <= kLargestVelocity);
}

bool is_valid(const damping::State& state) noexcept {
  if (!state.has_position) return state == damping::State{};
  return in_domain(state.position) && quantised(state.position) == state.position && state.periods <= kNoSpeed &&
         std::ranges::all_of(state.velocity, is_velocity);
}

double exactly(float a) noexcept {
  return static_cast<double>(a);
}
Quad quad(const std::array<double, 4>& a) noexcept {
  return {Pair64{a[0], a[1]}, Pair64{a[2], 0}};
}
std::array<double, 4> numbers_of(const Quad& a) noexcept {
  return {a.low[0], a.low[1], a.high[0], 0};
}
Eigen::Vector3f force_of(Four32 a) noexcept {
  a = a + Four32{};  // -0 becomes +0
  return {a[0], a[1], a[2]};
}

// The velocities after any number of periods, below 2^-20 mm/s, too, in the last of them.
[[gnu::noinline]] Quad decided_velocity(const Quad& v, const Quad& x, const Quad& before, const damping::Parameters& p,
                                        int periods, Stage& stage) noexcept {
  raise(stage, Stage::wide);
  std::array<float, 3> velocity = in_binary32(v);
  const std::array<float, 3> to = in_binary32(x), from = in_binary32(before);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (int period = 0; period < periods; ++period) {
      if (std::fabs(velocity[axis]) < kLeastVelocity) velocity[axis] = 0;
      velocity[axis] = exact_velocity(velocity[axis], to[axis], from[axis], p, periods);
    }
  return three(velocity.data());
}

// The same as filtered_force(), sure at last; and forces that are too large, or no numbers, are handed on.
[[gnu::noinline]] Eigen::Vector3f decided_force(const Quad& v, const Eigen::Vector3f& force, const damping::Parameters& p,
                                                Stage& stage) noexcept {
  const std::array<float, 3> f{force.x(), force.y(), force.z()};
  if (!std::ranges::all_of(f, [](float one) { return std::fabs(one) < kForcesEnd; })) return force;
  raise(stage, Stage::wide);
  return Eigen::Vector3f(exact_force(in_binary32(v), f, p).data());
}

}  // namespace

Damping::Damping(const damping::Parameters& p) noexcept
    : parameters_(p), numbers_{exactly(p.rate), exactly(p.share), exactly(p.damping),
                               exactly(p.most), exactly(p.drag),  1 / (exactly(p.full_at) * exactly(p.full_at))} {}

std::variant<Damping, ParameterError> Damping::build(const damping::Parameters& p) noexcept {
  if (const char* fault = arithmetic_fault_here()) return ParameterError{"arithmetic", "", 0, 0, 0, fault};
  if (const auto error = first_error(p)) return *error;
  return Damping(p);
}

damping::State Damping::state() const noexcept {
  if (periods_ == kNoPosition) return {};
  return {true, in_binary32(quad(position_)), in_binary32(quad(velocity_)), static_cast<std::uint8_t>(periods_)};
}

void Damping::resume(const damping::State& given) noexcept {
  const damping::State state = is_valid(given) ? given : damping::State{};
  position_ = numbers_of(three(state.position.data()));
  velocity_ = numbers_of(three(state.velocity.data()));
  periods_ = state.has_position ? state.periods : kNoPosition;
}

Evaluation Damping::tick(const Eigen::Vector3f& position, std::uint32_t periods, const Evaluation& spring) noexcept {
  if (parameters_.is_off()) return spring;
  if (periods_ != kNoPosition) periods_ = std::min(periods_ + std::min(periods, kNoSpeed), kNoSpeed);
  const Quad read = three(position.data());
  if (spring.status == Status::invalid || !are_at_most(absolute(read), exactly(kLargestCoordinate))) [[unlikely]]
    return {{0, 0, 0}, Status::invalid, spring.stage};
  Stage stage = spring.stage;
  Quad v = quad(velocity_);
  if (periods != 0) [[likely]] {
    const Quad x = flushed(read, exactly(kPositionQuantum)), before = quad(position_);
    SurelyRounded after = filtered_velocity(v, x, before, numbers_.rate, numbers_.share);
    if (!after.is_sure) after = velocity_of_short_numbers(v, x, before, numbers_.rate, numbers_.share);
    if (periods_ == 1 && after.is_sure) [[likely]]
      v = flushed(to_binary64(after.value), exactly(kLeastVelocity));
    else if (periods_ >= kNoSpeed)
      v = Quad(0.0);
    else
      v = flushed(decided_velocity(v, x, before, parameters_, static_cast<int>(periods_), stage), exactly(kLeastVelocity));
    velocity_ = numbers_of(v);
    position_ = numbers_of(x);
    periods_ = 0;
  }
  const SurelyRounded force = filtered_force(v, three(spring.force.data()), numbers_);
  if (force.is_sure) [[likely]]
    return {force_of(force.value), spring.status, stage};
  return {decided_force(v, spring.force, parameters_, stage), spring.status, stage};
}

}  // namespace forceshade::fast
