// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A renderer of anybody's, opened on a scene: what conform asks, through whichever door.

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace forceshade::conformance {

// What a renderer says of itself.
struct Hello {
  std::string name, version;
  bool remembers = false;                   // its force depends on the positions before
  std::optional<std::string> refusal = {};  // why it does not render this scene; nothing where it does
};

// The renderer did not answer as it has to. What it was asked is part of the words where one position is to blame.
struct RendererFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// One thread at a time.
class RendererUnderTest {
 public:
  virtual ~RendererUnderTest() = default;

  virtual const Hello& hello() const = 0;

  // The forces (N) at the next positions (mm) of the path, one for each; is_reset: a new path begins with them, from no
  // contact. Throws RendererFailed; then no further call is of use.
  virtual std::vector<Eigen::Vector3f> forces(std::span<const Eigen::Vector3f> positions, bool is_reset) = 0;

  // Nothing will be asked any more. Throws RendererFailed.
  virtual void say_goodbye() = 0;
};

// Opens it anew, on the same scene. Throws RendererFailed.
using OpenRenderer = std::function<std::unique_ptr<RendererUnderTest>()>;

}  // namespace forceshade::conformance
