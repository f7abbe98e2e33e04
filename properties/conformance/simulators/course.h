// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The simulations on which invariants are looked at, each with a constant force on the sphere and the truth about its ground.

#include <cstddef>
#include <vector>

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

// The deviations from the truth that still count as right. A hand notices a change of a force by about 7 %, and of
// a place at the fingertip by about 1 mm; these are a seventh of the first and the second itself (docs/conformance.md).

inline constexpr double kShare = 0.01;         // of the true force or speed
inline constexpr double kPath = 1e-3;          // m
inline constexpr double kLeastSpeed = 1;       // m/s: kShare is taken of this where the true speed is less
inline constexpr double kSettlingTime = 0.25;  // s, after which what a simulation began with no longer matters
inline constexpr double kClear = 1e-3;         // m above the ground: more is out of contact, whatever margin a simulator has

// (1 + kShare)² - 1: the share of its kinetic energy that a body has more if it is faster by kShare.
inline constexpr double kEnergyShare = 2 * kShare + kShare * kShare;

}  // namespace forceshade::conformance::simulators
