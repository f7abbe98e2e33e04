// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is checked and certified: one notion for laws, height maps and whatever else renders a force. A subject is a rendering,
// which is all that a device is driven with, the exact definition of its force along a path, and what may be expected of both.

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "properties/positions.h"
#include "properties/rendered.h"
#include "reference/law.h"
#include "rendering/monitor.h"
#include "rendering/renderer/rendering.h"
#include "rendering/results.h"

namespace forceshade::properties {

// One path through the definition. One thread at a time.
class ReferenceSession {
 public:
  virtual ~ReferenceSession() = default;

  // position: mm, the next one of the path. Throws std::domain_error where the definition cannot be decided.
  virtual reference::Rounded step(const Eigen::Vector3f& position) = 0;
};

// A property beside the four by which a subject is certified. `check` draws its case.
struct FurtherProperty {
  std::string name;
  std::function<Violation()> check;
};

// What may be expected of the force: where it jumps, in words; whether its direction is a unit vector; whether no loop gives
// energy.
struct Expected {
  std::vector<std::string> jumps;
  bool has_unit_directions = true;
  bool is_conservative = false;
};

class Subject;

// A subject of the same kind with other parameters, and these in words: "K = 0.25 N/mm: ".
struct DrawnSubject {
  std::unique_ptr<Subject> subject;
  std::string parameters;
};

// Everything is const and may be called from several threads at once, but for what draws a case: that uses RapidCheck's
// operator*, so it is called inside a property (run.h) and in one thread.
class Subject {
 public:
  virtual ~Subject() = default;

  // The renderer that is checked, and what it is said to render.
  virtual const Rendering& rendering() const = 0;
  const Identity& identity() const { return rendering().identity; }
  const Renderer& renderer() const { return rendering().renderer; }

  // What it is made of, in words, a line each: the parts of a height map. Empty where the identity says all.
  virtual std::vector<std::string> parts() const { return {}; }

  // A path through the exact definition.
  virtual std::unique_ptr<ReferenceSession> open_reference() const = 0;

  // Where to look: an endless stream, the same for the same seed. This must outlive it.
  virtual std::unique_ptr<Positions> positions(std::uint64_t seed) const = 0;

  // A path to compare along, for equivalence; two positions where the force depends on nothing but the position.
  virtual std::vector<Eigen::Vector3f> draw_path() const = 0;

  // The properties, each on a case that it draws.
  virtual Violation check_continuity() const = 0;
  virtual Violation check_unit_normals() const = 0;
  virtual Violation check_passivity() const = 0;
  // Closed paths that belong to passivity whatever is drawn.
  virtual std::vector<std::function<Violation()>> fixed_loops() const { return {}; }
  virtual std::vector<FurtherProperty> further_properties() const { return {}; }

  virtual Expected expected() const = 0;
  // The energy of loops by their depth. Throws reference::NotEnclosed, Interrupted.
  virtual std::vector<LoopEnergy> energies(const Monitor& monitor) const = 0;

  // The subject with parameters from all of the domain.
  virtual DrawnSubject with_drawn_parameters(std::uint64_t seed) const = 0;
  // How many of `points` to compare with one set of them.
  virtual std::uint64_t points_of_a_set(std::uint64_t points) const = 0;
};

}  // namespace forceshade::properties
