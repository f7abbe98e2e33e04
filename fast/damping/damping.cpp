// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

#include "fast/damping/exact.h"
#include "fast/damping/filter.h"
#include "fast/domain.h"
#include "fast/numbers/arithmetic.h"
#include "fast/stage.h"
#include "forceshade/fast.h"
#include "rendering/damping_range.h"

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
  const auto not_damping = [](const char* name, float value) {
    return ParameterError{name, "N·s/mm", value, kLeastDamping, kMostDamping, nullptr, "0"};
  };
  if (!is_damping(p.damping)) return not_damping("damping", p.damping);
  if (p.most != HUGE_VALF && outside(p.most, 1, 1024)) return ParameterError{"most", "", p.most, 1, 1024, nullptr, "inf"};
  if (!is_damping(p.drag)) return not_damping("drag", p.drag);
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
bool is_power_of_two(float a) noexcept {
  int exponent = 0;
  return std::frexp(a, &exponent) == 0.5F;
}
Quad quad(const std::array<double, 4>& a) noexcept {
  return Quad::load(a.data());
}
// In two vectors, as the next tick loads them: a wider load than the store before it has to wait.
void put(const Quad& from, std::array<double, 4>& to) noexcept {
  std::memcpy(&to[0], &from.low, sizeof from.low);
  std::memcpy(&to[2], &from.high, sizeof from.high);
}
void put(Four32 from, std::array<float, 3>& to) noexcept {
  std::memcpy(to.data(), &from, sizeof to);
}
std::array<float, 3> in_binary32(const Quad& a) noexcept {
  std::array<float, 3> numbers{};
  put(to_binary32(a), numbers);
  return numbers;
}
Eigen::Vector3f force_of(Four32 a) noexcept {
  a = a + Four32{};  // -0 becomes +0
  return {a[0], a[1], a[2]};
}

// The velocities after any number of periods, below 2^-20 mm/s, too, in the last of them.
Four32 decided_velocity(const Quad& v, Four32 x, const Quad& before, const damping::Parameters& p, int periods) noexcept {
  std::array<float, 3> velocity = in_binary32(v);
  const std::array<float, 3> to{x[0], x[1], x[2]}, from = in_binary32(before);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (int period = 0; period < periods; ++period) {
      if (std::fabs(velocity[axis]) < kLeastVelocity) velocity[axis] = 0;
      velocity[axis] = exact_velocity(velocity[axis], to[axis], from[axis], p, periods);
    }
  return three(velocity.data());
}

// The same as filtered_force(), sure at last; and forces that are too large, or no numbers, are handed on.
[[gnu::noinline]] Evaluation decided_force(const Quad& v, const Evaluation& spring, Stage stage,
                                           const damping::Parameters& p) noexcept {
  const std::array<float, 3> f{spring.force.x(), spring.force.y(), spring.force.z()};
  if (!std::ranges::all_of(f, [](float one) { return std::fabs(one) < kForcesEnd; }))
    return {spring.force, spring.status, stage};
  raise(stage, Stage::wide);
  return {Eigen::Vector3f(exact_force(in_binary32(v), f, p).data()), spring.status, stage};
}

// The answer at a velocity, with these B and B_t.
template <class Numbers>
FORCESHADE_INLINE Evaluation damped_by(const Quad& v, const Evaluation& spring, Stage stage, const Numbers& numbers,
                                       const damping::Parameters& p) noexcept {
  const Rounded force = filtered_force(v, three_in_binary64(spring.force.data()), numbers);
  if (force.is_sure()) [[likely]]
    return {force_of(force.value), spring.status, stage};
  return decided_force(v, spring, stage, p);
}

// The smaller of B of a path and of what it touches. Another's session may give any number.
float limited(float path, float touched) noexcept {
  if (!(touched < path)) return path;
  return touched < kLeastDamping ? 0 : touched;
}
template <class Numbers>
[[gnu::noinline]] Evaluation damped_within(const Quad& v, const Evaluation& spring, Stage stage, Numbers numbers,
                                           damping::Parameters p) noexcept {
  p.damping = limited(p.damping, spring.damping.damping);
  p.drag = limited(p.drag, spring.damping.drag);
  numbers.damping = exactly(p.damping);
  numbers.drag = exactly(p.drag);
  return damped_by(v, spring, stage, numbers, p);
}

// The answer at a velocity.
template <class Numbers>
FORCESHADE_INLINE Evaluation damped(const Quad& v, const Evaluation& spring, Stage stage, const Numbers& numbers,
                                    const damping::Parameters& p) noexcept {
  if (spring.damping.damping < p.damping || spring.damping.drag < p.drag) [[unlikely]]
    return damped_within(v, spring, stage, numbers, p);
  return damped_by(v, spring, stage, numbers, p);
}

}  // namespace

Damping::Damping(const damping::Parameters& p) noexcept
    : parameters_(p),
      numbers_{.keep = 1 - exactly(p.share),
               .gain = exactly(p.share) * exactly(p.rate),
               .damping = exactly(p.damping),
               .most = exactly(p.most),
               .drag = exactly(p.drag),
               .per_square = 1 / (exactly(p.full_at) * exactly(p.full_at)),
               .is_short = is_power_of_two(p.share),
               .has_drag = p.drag != 0} {}

std::variant<Damping, ParameterError> Damping::build(const damping::Parameters& p) noexcept {
  if (const char* fault = arithmetic_fault_here()) return ParameterError{"arithmetic", "", 0, 0, 0, fault};
  if (const auto error = first_error(p)) return *error;
  return Damping(p);
}

damping::State Damping::state() const noexcept {
  damping::State its;
  if (periods_ == kNoPosition) return its;
  its.has_position = true;
  its.periods = static_cast<std::uint8_t>(periods_);
  put(to_binary32(quad(position_)), its.position);
  put(to_binary32(quad(velocity_)), its.velocity);
  return its;
}

void Damping::resume(const damping::State& given) noexcept {
  const damping::State state = is_valid(given) ? given : damping::State{};
  put(three_in_binary64(state.position.data()), position_);
  put(three_in_binary64(state.velocity.data()), velocity_);
  periods_ = state.has_position ? state.periods : kNoPosition;
}

// The usual tick: a period after a valid position, and binary64 is sure.
Evaluation Damping::tick(const Eigen::Vector3f& position, std::uint32_t periods, const Evaluation& spring) noexcept {
  if (parameters_.is_off()) return spring;
  const Four32 read = three(position.data());
  if (periods_ == 0 && periods == 1 && spring.status != Status::invalid &&
      are_at_most(absolute(read), three(kLargestCoordinate))) [[likely]] {
    const Quad x = to_binary64(flushed(read, three(kPositionQuantum)));
    const Rounded velocity = filtered_velocity(quad(velocity_), x, quad(position_), numbers_);
    if (velocity.is_sure()) [[likely]] {
      const Quad v = to_binary64(flushed(velocity.value, three(kLeastVelocity)));
      put(v, velocity_);
      put(x, position_);
      return damped(v, spring, spring.stage, numbers_, parameters_);
    }
  }
  return rare_tick(position, periods, spring);
}

[[gnu::noinline]] Evaluation Damping::rare_tick(const Eigen::Vector3f& position, std::uint32_t periods,
                                                const Evaluation& spring) noexcept {
  if (periods_ != kNoPosition) periods_ = std::min(periods_ + std::min(periods, kNoSpeed), kNoSpeed);
  const Four32 read = three(position.data());
  if (spring.status == Status::invalid || !are_at_most(absolute(read), three(kLargestCoordinate)))
    return {{0, 0, 0}, Status::invalid, spring.stage};
  Stage stage = spring.stage;
  Quad v = quad(velocity_);
  if (periods != 0) {
    const Four32 x = flushed(read, three(kPositionQuantum));
    if (periods_ >= kNoSpeed) {
      v = Quad(0.0);
    } else {
      const Four32 decided = decided_velocity(v, x, quad(position_), parameters_, static_cast<int>(periods_));
      v = to_binary64(flushed(decided, three(kLeastVelocity)));
      raise(stage, Stage::wide);
    }
    put(v, velocity_);
    put(to_binary64(x), position_);
    periods_ = 0;
  }
  return damped(v, spring, stage, numbers_, parameters_);
}

}  // namespace forceshade::fast
