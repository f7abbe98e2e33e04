// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a servo loop renders: a law or a height map.

#include <utility>
#include <variant>

#include "forceshade/fast/height_map_field.h"
#include "forceshade/fast/law.h"

namespace forceshade::fast {

// Evaluates as what it was made of does: without allocation, lock or exception.
class Renderer {
 public:
  Renderer(Law law) noexcept : law_(std::move(law)) {}
  Renderer(HeightMapField map) noexcept : law_(std::move(map)) {}

  Evaluation evaluate(const Eigen::Vector3f& position) const noexcept {
    return std::visit([&](const auto& law) { return law.evaluate(position); }, law_);
  }

 private:
  std::variant<Law, HeightMapField> law_;
};

}  // namespace forceshade::fast
