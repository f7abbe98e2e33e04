// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An exact simulator under test, which is opened on any scene, and can be spoiled in one thing. It has no penalty: where a step
// would end in the ground, it ends at the nearest place that touches it.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "properties/conformance/simulators/simulator_under_test.h"

namespace forceshade::conformance::simulators {

using Eigen::Vector3d;

// A plane, so that a flat mesh has no inner edges; or triangles. Degenerate ones are left out.
class Ground {
 public:
  Ground() = default;  // no ground

  explicit Ground(const Simulation& scene) {
    if (const auto* box = std::get_if<GroundBox>(&scene.ground)) {
      height_ = box->centre.z() + box->half.z();
      return;
    }
    const auto& mesh = std::get<GroundMesh>(scene.ground);
    for (const auto& [a, b, c] : mesh.triangles) {
      const Corners corners{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
      if (!across(corners).isZero(0)) triangles_.push_back(corners);
    }
    normal_ = across(triangles_.front()).normalized();
    height_ = normal_.dot(triangles_.front()[0]);
    is_flat_ = std::ranges::all_of(triangles_, [&](const Corners& corners) {
      return (across(corners).normalized() - normal_).norm() < kSame && std::abs(normal_.dot(corners[0]) - height_) < kSame;
    });
  }

  bool is_flat() const { return is_flat_; }

  // The shortest way after which the sphere touches; zero where it is not in the ground.
  Vector3d way_out(const Vector3d& centre, double radius) const {
    double distance = normal_.dot(centre) - height_;
    Vector3d direction = normal_;
    if (!is_flat_) {
      const Vector3d way = way_from_triangles(centre);
      distance = way.norm();
      direction = way / distance;
    }
    return distance < radius ? Vector3d((radius - distance) * direction) : Vector3d::Zero();
  }

 private:
  using Corners = std::array<Vector3d, 3>;
  static constexpr double kSame = 1e-9, kInfinite = std::numeric_limits<double>::infinity();

  static Vector3d across(const Corners& corners) { return (corners[1] - corners[0]).cross(corners[2] - corners[0]); }

  static Vector3d nearest(const Corners& corners, const Vector3d& at) {
    const Vector3d normal = across(corners).normalized();
    Vector3d on_edges = Vector3d::Constant(kInfinite);
    bool is_inside = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3d from = at - corners[i], along = corners[(i + 1) % 3] - corners[i];
      is_inside = is_inside && along.cross(from).dot(normal) >= 0;
      const Vector3d on_edge = corners[i] + std::clamp(along.dot(from) / along.squaredNorm(), 0.0, 1.0) * along;
      if ((on_edge - at).norm() < (on_edges - at).norm()) on_edges = on_edge;
    }
    return is_inside ? Vector3d(at - normal.dot(at - corners[0]) * normal) : on_edges;
  }

  Vector3d way_from_triangles(const Vector3d& centre) const {
    Vector3d shortest = Vector3d::Constant(kInfinite);
    for (const Corners& corners : triangles_)
      if (const Vector3d way = centre - nearest(corners, centre); way.norm() < shortest.norm()) shortest = way;
    return shortest;
  }

  std::vector<Corners> triangles_;
  bool is_flat_ = true;
  Vector3d normal_{0, 0, 1};
  double height_ = -kInfinite;
};

// The state that a defect sees and may change.
struct World {
  Simulation scene;
  Ground ground = {};
  State now = {};
  std::size_t steps = 0;  // since the scene began
  std::optional<std::string> refusal = {};
};

// One step: before it; what the velocity is without the ground; and by what the ground has moved the sphere.
struct Step {
  State before;
  Vector3d free, way;
};

// Each is empty where nothing is wrong.
struct Defect {
  std::function<void(World&)> opened = {};
  std::function<void(World&, const State& before)> reset = {};
  std::function<void(const World&, Vector3d& free)> freed = {};
  std::function<bool(const World&, double depth)> misses = {};  // a contact
  std::function<void(World&, const Step&)> stepped = {};
  bool takes_any_force = false;
  SimulatorCapabilities::Reports reports = SimulatorCapabilities::Reports::force;
  double smallest_radius = 0;            // m, declared as the next one is
  std::optional<double> speed_cap = {};  // m/s
};

class OwnSimulator final : public SimulatorUnderTest {
 public:
  OwnSimulator(const Simulation& scene, const Defect& defect) : world_{scene}, defect_(defect) {
    const auto* mesh = std::get_if<GroundMesh>(&scene.ground);
    if (mesh != nullptr && !std::ranges::all_of(mesh->vertices, [](const Vector3d& at) { return at.allFinite(); }))
      world_.refusal = "a vertex is no number";
    else
      world_.ground = Ground(scene);
    if (defect_.opened) defect_.opened(world_);
    its_.reports = defect_.reports;
    its_.smallest_radius = defect_.smallest_radius;
    its_.speed_cap = defect_.speed_cap;
    its_.refusal = world_.refusal;
    world_.now = beginning();
  }

  const SimulatorCapabilities& capabilities() const override { return its_; }

  Motion apply(std::span<const Vector3d> forces, bool is_reset) override {
    if (is_reset) reset();
    if (!defect_.takes_any_force && !std::ranges::all_of(forces, [](const Vector3d& force) { return force.allFinite(); }))
      return {{}, "a force is no number"};
    Motion motion;
    for (const Vector3d& force : forces) {
      step(force);
      motion.states.push_back(world_.now);
    }
    return motion;
  }

  void say_goodbye() override {}

 private:
  State beginning() const { return {world_.scene.position, world_.scene.velocity}; }

  void reset() {
    const State before = std::exchange(world_.now, beginning());
    world_.steps = 0;
    if (defect_.reset) defect_.reset(world_, before);
  }

  // Out of one triangle, it may be in another.
  Vector3d way_out(const Vector3d& centre) const {
    constexpr int kMostTriangles = 20;
    constexpr double kTouching = 1e-13;  // m
    Vector3d all(0, 0, 0);
    for (int i = 0; i < kMostTriangles; ++i) {
      const Vector3d way = world_.ground.way_out(centre + all, world_.scene.radius);
      if (way.norm() < kTouching || (defect_.misses && defect_.misses(world_, way.norm()))) break;
      all += way;
    }
    return all;
  }

  void step(const Vector3d& force) {
    const Simulation& scene = world_.scene;
    const State before = world_.now;
    ++world_.steps;
    Vector3d free = before.velocity + scene.step() * (scene.gravity + force / scene.mass);
    if (defect_.freed) defect_.freed(world_, free);
    const Vector3d there = before.position + scene.step() * free, way = way_out(there);
    world_.now = {there + way, free + scene.rate * way};
    if (!way.isZero(0)) world_.now.contacts.push_back({way.normalized(), scene.mass * scene.rate * scene.rate * way.norm()});
    if (defect_.stepped) defect_.stepped(world_, {before, free, way});
  }

  World world_;
  Defect defect_;
  SimulatorCapabilities its_;
};

inline OpenSimulator own_simulator(const Defect& defect = {}) {
  return [=](const Simulation& scene) { return std::make_unique<OwnSimulator>(scene, defect); };
}

}  // namespace forceshade::conformance::simulators
