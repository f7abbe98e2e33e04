// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A third kind of subject, with memory: a wall with hysteresis. The tip is held once it is below z = 0, and let go once it is
// above the release height r. Held, it feels the spring F_z = -K·z, which between 0 and r pulls it down. So between 0 and r the
// force depends on the path, as it does on a mesh.

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "forceshade/properties.h"

namespace forceshade::tests {

struct StickyWallParameters {
  float stiffness = 0.5F;  // K, N/mm
  float release = 1;       // r, mm, above 0
};

class StickyWall final : public properties::Subject {
 public:
  using Open = std::function<std::unique_ptr<fast::Session>(const StickyWallParameters& p)>;

  // A product of two binary32 numbers, rounded once.
  static std::unique_ptr<fast::Session> open_fast(const StickyWallParameters& p);

  explicit StickyWall(const StickyWallParameters& p, Open open = &open_fast);

  const Rendering& rendering() const override { return rendering_; }
  std::unique_ptr<properties::ReferenceSession> open_reference() const override;
  std::unique_ptr<properties::Positions> positions(std::uint64_t seed) const override;
  std::vector<Eigen::Vector3f> draw_path(properties::Chooser& choose) const override;
  properties::Violation check_continuity(properties::Chooser& choose) const override;
  properties::Violation check_unit_normals(properties::Chooser& choose) const override;
  properties::Violation check_passivity(properties::Chooser& choose) const override;
  properties::Expected expected() const override { return {{"z = the release height, on the way up"}, true, false}; }
  // Each time round the hand loses K·r²/2, so no loop gives it any energy.
  std::vector<properties::LoopEnergy> energies(const Monitor&) const override;
  properties::DrawnSubject with_drawn_parameters(std::uint64_t seed) const override;
  std::uint64_t points_of_a_set(std::uint64_t) const override { return 1024; }

 private:
  StickyWallParameters p_;
  Open open_;
  Rendering rendering_;
};

}  // namespace forceshade::tests
