// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A third-party renderer, opened on a scene: what every check takes, whichever door it came through.

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "properties/conformance/hello.h"

namespace forceshade::conformance {

// One thread at a time.
class RendererUnderTest {
 public:
  virtual ~RendererUnderTest() = default;

  virtual const Hello& hello() const = 0;

  // The answers to the next positions of the path, one for each, all in its own units; is_reset: a new path begins with
  // them, from no contact; periods: those from the tick before each position to it, each 1 where there are none. Only a
  // renderer with damping gets any. Throws files::ProcessFailed; then no further call is of use.
  virtual std::vector<Eigen::Vector3f> answers(std::span<const Eigen::Vector3f> positions, bool is_reset,
                                               std::span<const std::uint32_t> periods) = 0;

  // Nothing will be requested any more. Throws files::ProcessFailed.
  virtual void say_goodbye() = 0;
};

// Opens it on a scene (scene.h). Throws files::ProcessFailed.
using OpenRenderer = std::function<std::unique_ptr<RendererUnderTest>(const nlohmann::ordered_json& scene)>;

}  // namespace forceshade::conformance
