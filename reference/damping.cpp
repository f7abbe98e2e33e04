// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <boost/multiprecision/gmp.hpp>
#include <cmath>

#include "forceshade/reference.h"
#include "reference/meshes/rounding.h"
#include "reference/position.h"

namespace forceshade::reference {
namespace {

// No expression templates: what is computed is what is written.
using Ratio = boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;

constexpr int kLongestGap = 16;                  // periods
constexpr float kSlowest = 0x1p-20F;             // mm/s
constexpr float kFastest = 0x1p32F;              // mm/s
constexpr float kLeastDamping = 1.0F / 1048576;  // N·s/mm, of what is not 0
constexpr float kTooStrong = 0x1p26F;            // N

Ratio ratio(float value) {
  return Ratio(static_cast<double>(value));
}

float nearest(const Ratio& exact) {
  return meshes::nearest_binary32(meshes::Fraction{numerator(exact), denominator(exact)}, 0);
}

bool is_within(float value, float low, float high) {
  return low <= value && value <= high;
}

std::optional<ParameterError> refused(const damping::Parameters& p) {
  if (!is_within(p.rate, 1, 131072)) return ParameterError{"rate", "Hz", p.rate, 1, 131072};
  if (!is_within(p.share, 1.0F / 1024, 1)) return ParameterError{"share", "", p.share, 1.0F / 1024, 1};
  for (const auto& [name, value] : {std::pair{"damping", p.damping}, std::pair{"drag", p.drag}})
    if (value != 0 && !is_within(value, kLeastDamping, 16))
      return ParameterError{name, "N·s/mm", value, kLeastDamping, 16, nullptr, "0"};
  if (!is_within(p.most, 1, 1024) && !(std::isinf(p.most) && p.most > 0))
    return ParameterError{"most", "", p.most, 1, 1024, nullptr, "inf"};
  if (!is_within(p.full_at, 1.0F / 1024, 1024)) return ParameterError{"full_at", "N", p.full_at, 1.0F / 1024, 1024};
  return std::nullopt;
}

// F of the definition; f is not 0.
Eigen::Vector3f damped(const Eigen::Vector3f& force, const std::array<float, 3>& velocity, const damping::Parameters& p) {
  std::array<Ratio, 3> f, v;
  for (std::size_t i = 0; i < 3; ++i) {
    f[i] = ratio(force(static_cast<Eigen::Index>(i)));
    v[i] = ratio(velocity[i]);
  }
  const Ratio square = f[0] * f[0] + f[1] * f[1] + f[2] * f[2], along = v[0] * f[0] + v[1] * f[1] + v[2] * f[2];
  Ratio scale = 1 - ratio(p.damping) * along / square;
  if (scale < 0) scale = 0;
  if (std::isfinite(p.most) && scale > ratio(p.most)) scale = ratio(p.most);
  Ratio full = scale * square / (ratio(p.full_at) * ratio(p.full_at));
  if (full > 1) full = 1;
  Eigen::Vector3f result;
  for (std::size_t i = 0; i < 3; ++i)
    result(static_cast<Eigen::Index>(i)) = nearest(scale * f[i] - full * ratio(p.drag) * (v[i] - along * f[i] / square));
  return result;
}

// Parameters of which no more acts than is let. A number that is no B counts as 0, and none as no limit.
damping::Parameters within(const damping::Limits& limits, damping::Parameters p) {
  for (const auto& [its, most] : {std::pair{&p.damping, limits.damping}, std::pair{&p.drag, limits.drag}})
    if (most < *its) *its = most < kLeastDamping ? 0 : most;
  return p;
}

bool is_state(const damping::State& state) {
  if (!state.has_position) return state == damping::State();
  const auto is_place = [](float x) { return in_domain(x) && quantised(x) == x; };
  const auto is_speed = [](float v) { return v == 0 || is_within(std::fabs(v), kSlowest, kFastest); };
  return std::ranges::all_of(state.position, is_place) && std::ranges::all_of(state.velocity, is_speed) &&
         state.periods <= kLongestGap + 1;
}

}  // namespace

std::variant<Damping, ParameterError> Damping::build(const damping::Parameters& parameters) {
  if (const auto error = refused(parameters)) return *error;
  return Damping(parameters);
}

void Damping::resume(const damping::State& state) {
  state_ = is_state(state) ? state : damping::State();
}

Rounded Damping::tick(const Eigen::Vector3f& position, std::uint32_t periods, const Rounded& spring) {
  if (parameters_.damping == 0 && parameters_.drag == 0) return spring;
  if (state_.has_position)
    state_.periods =
        static_cast<std::uint8_t>(std::min<std::uint64_t>(std::uint64_t{state_.periods} + periods, kLongestGap + 1));
  if (spring.status == Status::invalid || !in_domain(position)) {
    Rounded none;
    none.status = Status::invalid;
    return none;
  }
  if (periods > 0) move_to(position);
  Rounded answer = spring;
  if (!(answer.force.array().abs() < kTooStrong).all()) return answer;
  if (answer.force.isZero(0))
    answer.force.setZero();
  else
    answer.force = damped(answer.force, state_.velocity, within(spring.damping, parameters_));
  return answer;
}

void Damping::move_to(const Eigen::Vector3f& position) {
  const bool has_speed = state_.has_position && state_.periods <= kLongestGap;
  for (std::size_t i = 0; i < 3; ++i) {
    const float x = quantised(position(static_cast<Eigen::Index>(i)));
    float& v = state_.velocity[i];
    if (has_speed) {
      const Ratio speed = ratio(parameters_.rate) * (ratio(x) - ratio(state_.position[i])) / int{state_.periods};
      for (int period = 0; period < state_.periods; ++period) {
        v = nearest(ratio(v) + ratio(parameters_.share) * (speed - ratio(v)));
        if (std::fabs(v) < kSlowest) v = 0;
      }
    } else {
      v = 0;
    }
    state_.position[i] = x;
  }
  state_.has_position = true;
  state_.periods = 0;
}

}  // namespace forceshade::reference
