// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The hash of a path through the damper, as those of same_bits.h.

#include "same_bits.h"

namespace forceshade::tests {

// Parameters with and without drag, of few bits and of many.
inline constexpr std::array<damping::Parameters, 4> kDampers{
    {{.rate = 1000, .share = 1, .damping = 0x1p-9F},
     {.rate = 1000, .share = 0.5F, .damping = 0x1.9p-8F, .most = 1.5F, .drag = 0x1p-10F},
     {.rate = 500, .share = 0x1.99999ap-4F, .damping = 0x1.0624dep-8F, .most = 1024, .drag = 0x1.0624dep-10F},
     {.rate = 131072, .share = 0x1.fffffep-1F, .damping = 16, .most = 4, .drag = 0x1p-20F, .full_at = 0x1p-10F}}};

inline Bits bits_of_damping() {
  std::mt19937_64 random(1995);
  Hash hash;
  Bits bits{};
  for (const damping::Parameters& parameters : kDampers) {
    const auto built = fast::Damping::build(parameters);
    if (const auto* error = std::get_if<ParameterError>(&built)) throw std::runtime_error(error->message());
    auto damping = std::get<fast::Damping>(built);
    Eigen::Vector3f position(0, 0, 0);
    for (int i = 0; i < 50'000; ++i) {
      const std::uint64_t kind = random() % 16;
      // A step of up to 1/4 mm in multiples of 2^-18 mm or of 2^-5 mm; or any bits, of which many are no position.
      const auto step = [&](std::uint32_t range, float unit) {
        return static_cast<float>(static_cast<std::int32_t>(random() % (2 * range + 1)) - static_cast<std::int32_t>(range)) *
               unit;
      };
      Eigen::Vector3f read = position;
      for (float& one : read) {
        if (kind < 12) one += kind < 8 ? step(1U << 16, 0x1p-18F) : step(8, 0x1p-5F);
        if (kind == 12) one = __builtin_bit_cast(float, static_cast<std::uint32_t>(random()));
      }
      if (read.array().abs().maxCoeff() < 100) position = read;
      Eigen::Vector3f force;
      for (float& one : force) {
        one = kind == 13 ? 0 : step(1U << 23, 0x1p-22F);
        // Any size below 2^26 N, subnormal ones included.
        if (kind == 14) one = __builtin_bit_cast(float, static_cast<std::uint32_t>(random()) % 0x4C800000U);
      }
      const auto periods = static_cast<std::uint32_t>(kind == 15 ? random() % 20 : 1);
      note(damping.tick(read, periods, {force, kind == 13 ? Status::free : Status::contact}), hash, bits);
      for (const float component : damping.state().velocity) hash.add(component);
    }
  }
  bits.hash = hash.hex();
  return bits;
}

}  // namespace forceshade::tests
