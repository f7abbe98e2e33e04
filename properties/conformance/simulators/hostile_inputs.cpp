// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "properties/conformance/simulators/invariants_of_runs.h"
#include "properties/conformance/simulators/thresholds.h"

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

}  // namespace

std::vector<RunInvariant> hostile_inputs() {
  const Courses resting{resting_on({})};
  return {{"after a force that is no number and a reset, all is as before", resting, force_that_is_no_number},
          {"1e30 N move the sphere by as much, or are refused", resting, huge_force},
          {"a vertex that is no number, 0.9 m away, leaves the floor where it is", resting, vertex_that_is_no_number},
          {"a degenerate triangle, 0.9 m away, leaves the floor where it is", resting, degenerate_triangle}};
}

}  // namespace forceshade::conformance::simulators
