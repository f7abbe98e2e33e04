// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The simulations on which invariants are looked at, each with a constant force on the sphere and the truth about its ground.

#include <cstddef>
#include <vector>

#include "properties/conformance/simulators/profile.h"
#include "properties/conformance/simulators/simulation.h"

namespace forceshade::conformance::simulators {

struct Course {
  Simulation scene;
  Profile profile;
  Eigen::Vector3d push{0, 0, 0};  // N
  std::size_t steps = 240;

  bool operator==(const Course&) const = default;

  Eigen::Vector3d normal() const;                                              // of the ground's first part
  Eigen::Vector3d force() const { return scene.mass * scene.gravity + push; }  // N, all that does not come from the ground
  double load() const { return -normal().dot(force()); }                       // N, what a flat ground pushes with
  Eigen::Vector3d along_ground(const Eigen::Vector3d& v) const { return v - normal() * normal().dot(v); }
  std::size_t settled() const;  // the first step after kSettlingTime
};

using Courses = std::vector<Course>;

Courses slides();                // a sphere slides over a plane
Courses rests();                 // begins at rest and exactly touching
Courses static_at(double rate);  // the same, pushed, at another rate than usual
Courses drops();                 // falls 0.2 m
Courses leaves();                // begins touching and goes up
Courses obstacles();             // slides over a ridge, a step, a thin plate
Courses meetings();              // over and onto floors of faces that meet in more ways than those of a plain mesh
Courses all_courses();

// The floor on which a sphere rests on the inside of a triangle, with something else in its mesh.
Course resting_on(const Tessellation& tessellation);
Course oblique_slide(const Tessellation& tessellation);

}  // namespace forceshade::conformance::simulators
