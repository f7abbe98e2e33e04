// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cstdint>

#include "properties/conformance/simulators/invariants_of_runs.h"
#include "properties/conformance/simulators/thresholds.h"

namespace forceshade::conformance::simulators {
namespace {

const Eigen::Matrix3d kSame = Eigen::Matrix3d::Identity();
const Eigen::Matrix3d kQuarterTurn = (Eigen::Matrix3d() << 0, -1, 0, 1, 0, 0, 0, 0, 1).finished();
const Eigen::Matrix3d kMirror = (Eigen::Matrix3d() << 1, 0, 0, 0, -1, 0, 0, 0, 1).finished();

// Calls look() for each step of two runs.
template <class Look>
void look_at_both(const Run& one, const Run& other, Finding& finding, Look look) {
  if (const auto& refusal = one.refusal ? one.refusal : other.refusal) return finding.skip(*refusal);
  finding.count();
  for (std::size_t k = 1; k < one.states.size(); ++k) finding.look(look(k), other.course.scene.name, k);
}

// The motion in the other scene has to be that on the course, turned or mirrored.
void look_at_paths(Bench& bench, const Course& course, const Simulation& scene, const Eigen::Matrix3d& by, Finding& finding) {
  Course other_course = course;
  other_course.scene = scene;
  other_course.push = by * course.push;
  const Run one = bench.run(course), other = bench.run_anew(other_course);
  look_at_both(one, other, finding, [&](std::size_t k) {
    return felt_millimetres((other.states[k].position - by * one.states[k].position).norm(), kPath, "apart");
  });
}

void in_millimetres(Bench& bench, const Course& course, Finding& finding) {
  Simulation scene = course.scene;
  scene.units_per_metre = 1000;
  look_at_paths(bench, course, scene, kSame, finding);
}

void turned(Bench& bench, const Course& course, Finding& finding) {
  look_at_paths(bench, course, transformed(course.scene, kQuarterTurn), kQuarterTurn, finding);
}

void mirrored(Bench& bench, const Course& course, Finding& finding) {
  look_at_paths(bench, course, transformed(course.scene, kMirror), kMirror, finding);
}

void with_other_numbers(Bench& bench, const Course& course, Finding& finding) {
  look_at_paths(bench, course, renumbered(course.scene), kSame, finding);
}

// As on the course, in motion, and once it has settled in force.
void look_at_twins(Bench& bench, const Course& course, const Simulation& twin, Finding& finding) {
  Course other_course = course;
  other_course.scene = twin;
  const Run &one = bench.run(course), other = bench.run_anew(other_course);
  look_at_both(one, other, finding, [&](std::size_t k) {
    return felt_millimetres((other.states[k].position - one.states[k].position).norm(), kPath, "apart");
  });
  if (one.refusal || other.refusal) return;
  for (std::size_t k = course.settled(); k < one.states.size(); ++k)
    finding.look(felt_newtons((other.shown_force(k) - one.shown_force(k)).norm(), kShare * course.load(), "apart"), twin.name,
                 k);
}

void each_triangle_twice(Bench& bench, const Course& course, Finding& finding) {
  look_at_twins(bench, course, doubled(course.scene), finding);
}

void some_triangles_in_two(Bench& bench, const Course& course, Finding& finding) {
  look_at_twins(bench, course, split(course.scene), finding);
}

bool same_numbers(double one, double other) {
  return std::bit_cast<std::uint64_t>(one) == std::bit_cast<std::uint64_t>(other);
}

bool same_numbers(const Eigen::Vector3d& one, const Eigen::Vector3d& other) {
  return std::equal(one.begin(), one.end(), other.begin(), [](double a, double b) { return same_numbers(a, b); });
}

bool same_numbers(const State& one, const State& other) {
  return same_numbers(one.position, other.position) && same_numbers(one.velocity, other.velocity) &&
         std::ranges::equal(one.contacts, other.contacts, [](const Contact& a, const Contact& b) {
           return same_numbers(a.normal, b.normal) && same_numbers(a.force, b.force);
         });
}

void look_at_bits(const Run& one, const Run& other, Finding& finding) {
  look_at_both(one, other, finding, [&](std::size_t k) {
    const bool is_same = same_numbers(one.states[k], other.states[k]);
    return Felt{is_same ? 0.0 : 1.0, 0,
                is_same ? "all bits are the same"
                        : "other bits: " + measured((one.shown_force(k) - other.shown_force(k)).norm(), "N apart")};
  });
}

void twice(Bench& bench, const Course& course, Finding& finding) {
  look_at_bits(bench.run(course), bench.run_anew(course), finding);
}

void after_a_reset(Bench& bench, const Course& course, Finding& finding) {
  look_at_bits(bench.run(course), bench.run_after_reset(course), finding);
}

}  // namespace

std::vector<RunInvariant> comparisons() {
  const Courses typical{oblique_slide({}), drops()[1], obstacles()[0]};
  return {{"millimetres and metres give the same motion", typical, in_millimetres},
          {"a quarter turn of the scene turns the motion", typical, turned},
          {"a mirrored scene gives the mirrored motion", typical, mirrored},
          {"other numbers of triangles and vertices change nothing", typical, with_other_numbers},
          {"faces that coincide feel like one", {oblique_slide({}), resting_on({})}, each_triangle_twice},
          {"a split face feels like the whole", {oblique_slide({}), resting_on({})}, some_triangles_in_two},
          {"the same run twice gives the same bits", typical, twice},
          {"a reset equals a fresh start", typical, after_a_reset}};
}

}  // namespace forceshade::conformance::simulators
