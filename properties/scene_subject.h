// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A scene of objects that move as a subject: each object is a subject of its own.

#include <memory>
#include <string>
#include <vector>

#include "forceshade/properties.h"
#include "properties/kind_of_library.h"

namespace forceshade::properties {

// An object of a scene, with its motion in the ticks of a path.
struct MovingSubject {
  std::string name;
  std::shared_ptr<const Subject> subject;
  std::shared_ptr<const scene::Motion> motion;
};

class SceneSubject final : public KindOfLibrary {
 public:
  // rate_hz: ticks per second, for the rendering. Throws std::invalid_argument where a side refuses the scene.
  SceneSubject(Identity identity, std::vector<MovingSubject> objects, double rate_hz);

  const Rendering& rendering() const override { return rendering_; }
  std::vector<std::string> parts() const override;
  std::unique_ptr<ReferenceSession> open_reference() const override;
  // Those of one object after the other, at where they are in the world in that tick.
  std::unique_ptr<Positions> positions(std::uint64_t seed) const override;
  std::vector<Eigen::Vector3f> draw_path(Chooser& choose) const override;
  // These are the properties of one object, which is drawn, in its axes: they are checked of the answers that are added.
  Violation check_continuity(Chooser& choose) const override;
  Violation check_unit_normals(Chooser& choose) const override;
  Violation check_passivity(Chooser& choose) const override;
  std::vector<std::function<Violation()>> fixed_loops() const override;
  // "work of motion": in each tick, the work on the hand is that of each object's force along the step that this object sees,
  // less the work of that force along what the object's own motion adds to the step. An object at rest adds nothing.
  std::vector<FurtherProperty> further_properties() const override;
  Expected expected() const override;
  // None is known: a motion can give any energy.
  std::vector<LoopEnergy> energies(const Monitor&) const override { return {}; }
  // Each object with drawn parameters, and all motions from a drawn tick on.
  DrawnSubject with_drawn_parameters(std::uint64_t seed) const override;
  std::uint64_t points_of_a_set(std::uint64_t points) const override { return (points + 31) / 32; }

 private:
  Violation check_work_of_motion(Chooser& choose) const;
  const MovingSubject& drawn_object(Chooser& choose) const;

  std::vector<MovingSubject> objects_;
  Rendering rendering_;
};

}  // namespace forceshade::properties
