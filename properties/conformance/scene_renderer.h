// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A renderer under test in the units and the frame of the scene: positions in mm, forces in N.

#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "properties/conformance/renderer_under_test.h"

namespace forceshade::conformance {

class SceneRenderer {
 public:
  // stiffness: of the scene, N/mm.
  SceneRenderer(std::unique_ptr<RendererUnderTest> renderer, float stiffness);

  const Hello& hello() const { return renderer_->hello(); }

  // The position next to this one that both can write: a binary32 number of mm need not be one of m.
  Eigen::Vector3f writable(const Eigen::Vector3f& position) const;
  // True if the renderer declares to answer it.
  bool is_in_domain(const Eigen::Vector3f& position) const;

  // The forces at the next positions, which are writable; an answer that is no force in N is made one, and rounded once.
  // periods: as of RendererUnderTest. Throws files::ProcessFailed.
  std::vector<Eigen::Vector3f> forces(std::span<const Eigen::Vector3f> positions, bool is_reset,
                                      std::span<const std::uint32_t> periods = {});
  // The same of a whole path, which begins anew, in requests of at most kBatch positions.
  std::vector<Eigen::Vector3f> forces_along(std::span<const Eigen::Vector3f> path, std::span<const std::uint32_t> periods = {});
  static constexpr std::size_t kBatch = 1024;

  void say_goodbye() { renderer_->say_goodbye(); }

 private:
  Eigen::Vector3f to_its_units(const Eigen::Vector3f& position) const;
  Eigen::Vector3f force_of(const Eigen::Vector3f& answer, const Eigen::Vector3f& position) const;

  std::unique_ptr<RendererUnderTest> renderer_;
  double stiffness_;
};

}  // namespace forceshade::conformance
