// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The paths on which forces with damping are compared: positions with the periods between them.

#include <cstdint>
#include <deque>
#include <memory>

#include "properties/positions.h"
#include "properties/split_mix.h"

namespace forceshade::conformance {

inline constexpr std::uint32_t kPause = 20;  // periods, after which no speed is left

struct Tick {
  properties::Aimed aimed;
  std::uint32_t periods = 1;  // since the tick before
};

// A subject's own stream of positions where there is no damping. Else every second one is reached by a stroke at the speed of a
// hand, which follows a pause; and some periods are missed, or none passed.
class Strokes {
 public:
  Strokes(std::unique_ptr<properties::Positions> positions, bool has_damping, std::uint64_t seed)
      : positions_(std::move(positions)), has_damping_(has_damping), seed_(seed) {}

  Tick next();

 private:
  std::uint64_t drawn() { return properties::split_mix(seed_, count_++); }

  std::unique_ptr<properties::Positions> positions_;
  bool has_damping_;
  std::uint64_t seed_, count_ = 0;
  std::deque<Tick> coming_;
};

}  // namespace forceshade::conformance
