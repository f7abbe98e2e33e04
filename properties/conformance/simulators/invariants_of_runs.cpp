// SPDX-License-Identifier: BSD-3-Clause

#include <Eigen/LU>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "properties/conformance/simulators/course.h"
#include "properties/conformance/simulators/invariants_of_steps.h"

namespace forceshade::conformance::simulators {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInfinite = std::numeric_limits<double>::infinity();
constexpr double kHuge = 1e30;  // N
constexpr double kAway = 0.9;   // m
constexpr std::size_t kHostileStep = 60;

// The sphere lies where it lies on the course itself, or the simulator has refused in words.
void look_at_rest(Bench& bench, const Course& course, const Run& run, Finding& finding) {
  if (run.refusal) finding.note("it refuses: " + *run.refusal);
  const std::vector<State>& truth = bench.run(course).states;
  for (std::size_t k = 1; k < run.states.size(); ++k)
    finding.look(felt_millimetres((run.states[k].position - truth[k].position).norm(), kPath, "away from where it lay"),
                 course.scene.name, k);
}

// True if it rests on such a floor where nothing is hostile.
bool is_case(Bench& bench, const Course& course, Finding& finding) {
  const Run& run = bench.run(course);
  if (run.refusal)
    finding.skip(*run.refusal);
  else
    finding.count();
  return !run.refusal;
}

// The vertex that is nearest to a place so far away from the sphere, in each of four directions.
std::vector<std::uint32_t> vertices_away(const Course& course) {
  const auto& vertices = std::get<GroundMesh>(course.scene.ground).vertices;
  std::vector<std::uint32_t> found;
  for (const Eigen::Vector3d& direction : {Eigen::Vector3d(1, 0, 0), {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}) {
    const Eigen::Vector3d place = course.scene.position + kAway * direction;
    const auto nearest = std::ranges::min_element(vertices, {}, [&](const auto& vertex) { return (vertex - place).norm(); });
    found.push_back(static_cast<std::uint32_t>(nearest - vertices.begin()));
  }
  return found;
}

// Each is a case, in which the mesh is spoiled at one vertex.
template <class Spoil>
void look_at_spoiled(Bench& bench, const Course& course, Finding& finding, Spoil spoil) {
  for (const std::uint32_t vertex : vertices_away(course)) {
    if (!is_case(bench, course, finding)) return;
    Course spoiled = course;
    spoil(std::get<GroundMesh>(spoiled.scene.ground), vertex);
    look_at_rest(bench, course, bench.run_anew(spoiled), finding);
  }
}

void vertex_that_is_no_number(Bench& bench, const Course& course, Finding& finding) {
  look_at_spoiled(bench, course, finding,
                  [](GroundMesh& mesh, std::uint32_t vertex) { mesh.vertices[vertex].setConstant(kNan); });
}

void degenerate_triangle(Bench& bench, const Course& course, Finding& finding) {
  look_at_spoiled(bench, course, finding, [](GroundMesh& mesh, std::uint32_t vertex) {
    mesh.triangles.push_back({vertex, vertex, vertex});
  });
}

bool is_finite(const Run& run) {
  return std::ranges::all_of(run.states,
                             [](const State& state) { return state.position.allFinite() && state.velocity.allFinite(); });
}

void force_that_is_no_number(Bench& bench, const Course& course, Finding& finding) {
  if (!is_case(bench, course, finding)) return;
  const Bench::Disturbed runs = bench.run_disturbed(course, kHostileStep, {kNan, 0, 0});
  if (!is_finite(runs.disturbed)) finding.violated("a force that is no number is answered with a motion that is not finite");
  look_at_rest(bench, course, runs.after_reset, finding);
}

void huge_force(Bench& bench, const Course& course, Finding& finding) {
  if (!is_case(bench, course, finding)) return;
  const Bench::Disturbed runs = bench.run_disturbed(course, kHostileStep, {kHuge, 0, 0});
  const Run& run = runs.disturbed;
  if (!is_finite(run)) finding.violated("1e30 N is answered with a motion that is no number");
  if (run.refusal) {
    finding.note("it refuses: " + *run.refusal);
  } else {
    const double truth = std::min(kHuge / course.scene.mass * course.scene.step(), run.simulator.speed_cap.value_or(kInfinite)),
                 is = run.states[kHostileStep].velocity.norm();
    finding.look({std::abs(is - truth), kShare * truth, measured_instead_of(truth, is, "m/s")}, course.scene.name,
                 kHostileStep);
  }
  look_at_rest(bench, course, runs.after_reset, finding);
}

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

std::vector<RunInvariant> hostile_inputs() {
  const Courses resting{resting_on({})};
  return {{"after a force that is no number and a reset, all is as before", resting, force_that_is_no_number},
          {"1e30 N move the sphere by as much, or are refused", resting, huge_force},
          {"a vertex that is no number, 0.9 m away, leaves the floor where it is", resting, vertex_that_is_no_number},
          {"a degenerate triangle, 0.9 m away, leaves the floor where it is", resting, degenerate_triangle}};
}

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
