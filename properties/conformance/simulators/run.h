// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A simulator's answers on a course, and what follows from them.

#include <cstddef>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "properties/conformance/simulators/course.h"
#include "properties/conformance/simulators/simulator_under_test.h"

namespace forceshade::conformance::simulators {

struct Run {
  Course course;
  SimulatorCapabilities simulator;  // as it was opened on this course
  std::vector<State> states = {};   // the first is the beginning
  std::optional<std::string> refusal = {};

  // In step k, from 1: what the ground pushed with, in N, as the motion shows it, m Δv/Δt - applied - weight; and as the
  // simulator reports it.
  Eigen::Vector3d shown_force(std::size_t k) const;
  Eigen::Vector3d reported_force(std::size_t k) const;

  double energy(std::size_t k) const;         // J: kinetic and potential, less the work of the applied force
  double fastest(std::size_t until_k) const;  // m/s
  double clearance(std::size_t k) const;      // m between the sphere and the ground; negative where they overlap
};

// Runs courses, each in a simulator that is opened for it, and keeps what was answered.
class Bench {
 public:
  explicit Bench(const OpenSimulator& open) : open_(open) {}

  // Throws files::ProcessFailed, as all of these do.
  const Run& run(const Course& course);
  Run run_anew(const Course& course) const;

  // The course after a reset, in a simulator that has run it before with other forces.
  Run run_after_reset(const Course& course) const;

  struct Disturbed {
    Run disturbed, after_reset;
  };
  // With another force in one step; then a reset, and the course as it is.
  Disturbed run_disturbed(const Course& course, std::size_t step, const Eigen::Vector3d& force) const;

 private:
  const OpenSimulator& open_;
  std::list<Run> runs_;  // references to them stay valid
};

}  // namespace forceshade::conformance::simulators
