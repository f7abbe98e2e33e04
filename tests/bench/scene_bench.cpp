// SPDX-License-Identifier: BSD-3-Clause
// The time of a tick with objects that move, beside that of one mesh at rest: forceshade_scene_bench [TRIANGLES]. Each object
// is a sphere of so many triangles; the hand strokes the first, and the others turn 150 mm and more away.

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "forceshade/fast.h"
#include "forceshade/meshes.h"
#include "tests/bench/mesh_workloads.h"
#include "tests/bench/timing.h"

namespace forceshade::bench {
namespace {

constexpr std::size_t kTicks = 20000;

fast::GodObject sphere_of(const MeshWorkload& workload) {
  auto checked = mesh::check(workload.mesh);
  auto built = fast::GodObject::build({std::get<mesh::CheckedMesh>(std::move(checked)),
                                       {},
                                       mesh::Sides::front,
                                       mesh::Shading::none,
                                       static_cast<float>(kMeshStiffness)});
  return std::get<fast::GodObject>(std::move(built));
}

// The poses of all objects in one tick: the first turns back and forth about z by up to 0.1 rad, the others all around.
void place(std::span<scene::Pose> poses, std::size_t tick) {
  const double t = static_cast<double>(tick) * kTick;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double half = i == 0 ? 0.05 * std::sin(t) : t + static_cast<double>(i);
    poses[i].rotation = {static_cast<float>(std::cos(half)), 0, i == 0 ? 0 : static_cast<float>(0.5 * std::sin(half)),
                         static_cast<float>(std::sin(half))};
    poses[i].translation = i == 0 ? std::array<float, 3>{} : std::array<float, 3>{200.0F * static_cast<float>(i), 3, 5};
  }
}

fast::SceneSession session_of(const fast::GodObject& sphere, std::size_t objects) {
  std::vector<std::unique_ptr<fast::Session>> sessions;
  for (std::size_t i = 0; i < objects; ++i) sessions.push_back(sphere.open());
  return std::get<fast::SceneSession>(fast::SceneSession::build(std::move(sessions)));
}

// moves: true if the objects get a new pose in each tick; else they rest where the first is not moved.
Times time_scene(const MeshWorkload& workload, const fast::GodObject& sphere, std::size_t objects, bool moves,
                 const Scale& scale) {
  Times times = kNone;
  for (int pass = 0; pass < kPasses; ++pass) {
    fast::SceneSession session = session_of(sphere, objects);
    std::vector<scene::Pose> poses(objects);
    place(poses, 0);
    for (const auto& p : workload.approach) session.step(Eigen::Vector3f(p.data()), poses);
    std::size_t tick = 0;
    std::vector<double> measured;
    measured.reserve(workload.contact.size());
    const std::size_t before = allocations;
    for (const auto& p : workload.contact) {
      if (moves) place(poses, ++tick);
      measured.push_back(time_of(scale, [&] { keep(session.step(Eigen::Vector3f(p.data()), poses)); }));
    }
    times = least(times, summary(std::move(measured), allocations - before));
  }
  return times;
}

int run(int f) {
  const MeshWorkload workload = sphere_workload(f, kTicks, 0);
  const Scale scale = bench::scale();
  const fast::GodObject sphere = sphere_of(workload);
  std::printf("spheres of %zu triangles\n", workload.mesh.triangles.size());
  Times alone = kNone;
  std::vector<double> times;
  for (int pass = 0; pass < kPasses; ++pass) {
    const auto session = sphere.open();
    for (const auto& p : workload.approach) session->tick(p);
    alone = least(alone, measure(workload.contact, scale, times, [&](const auto& p) { keep(session->tick(p)); }));
  }
  print("the mesh alone", alone);
  for (const std::size_t objects : {std::size_t{1}, std::size_t{10}}) {
    print((std::to_string(objects) + " at rest").c_str(), time_scene(workload, sphere, objects, false, scale));
    print((std::to_string(objects) + " that move").c_str(), time_scene(workload, sphere, objects, true, scale));
  }
  return 0;
}

}  // namespace
}  // namespace forceshade::bench

int main(int count, char** arguments) {
  const double triangles = count > 1 ? std::atof(arguments[1]) : 12000;
  return forceshade::bench::run(std::max(1, static_cast<int>(std::lround(std::sqrt(triangles / 20)))));
}
