// SPDX-License-Identifier: BSD-3-Clause
// Scenes: one path of the hand each, through objects that move, for one thread at a time.

#include <algorithm>
#include <array>
#include <atomic>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "bindings/c/batch.h"
#include "bindings/python/arrays.h"
#include "bindings/python/damping.h"
#include "bindings/python/entered.h"
#include "bindings/python/subject.h"

namespace forceshade::python {
namespace {

struct Scene {
  static constexpr const char* kBusy = "another thread is in this scene; expected one thread at a time, or a scene for each";

  Scene(fast::SceneSession session, const std::optional<DampingNumbers>& numbers)
      : path(std::move(session)), damping(damping_of(numbers)) {}

  fast::SceneSession path;
  std::optional<fast::Damping> damping;
  forceshade_status status = FORCESHADE_FREE;  // of the last step
  std::atomic<bool> is_busy = false;
};

std::unique_ptr<Scene> scene_of(const std::vector<std::shared_ptr<Subject>>& objects,
                                const std::optional<DampingNumbers>& damping) {
  expect_arithmetic();
  std::vector<std::unique_ptr<fast::Session>> sessions;
  for (const auto& object : objects) sessions.push_back(object->renderer.open());
  return std::make_unique<Scene>(built(fast::SceneSession::build(std::move(sessions))), damping);
}

// position: three numbers; poses: seven for each object, its translation and its quaternion; the package has looked.
std::array<float, 3> step_scene(Scene& scene, const std::array<float, 3>& position, const py::buffer& poses,
                                std::uint32_t periods) {
  const Entered entered(scene);
  entered.or_throw();
  expect_arithmetic();
  const py::buffer_info of = buffer_of<float>(poses);
  std::array<scene::Pose, scene::kMostObjects> placed;
  const std::size_t count = std::min(static_cast<std::size_t>(of.shape[0]), placed.size());
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 7; ++k) (k < 3 ? placed[i].translation[k] : placed[i].rotation[k - 3]) = at<float>(of, i, k);
  const Eigen::Vector3f hand(position.data());
  fast::Evaluation answer = scene.path.step(hand, std::span(placed).first(count));
  if (scene.damping) answer = scene.damping->tick(hand, periods, answer);
  scene.status = c::status_of(answer.status);
  return {answer.force.x(), answer.force.y(), answer.force.z()};
}

std::vector<std::array<float, 3>> forces_of_objects(Scene& scene) {
  const Entered entered(scene);
  entered.or_throw();
  std::vector<std::array<float, 3>> all;
  for (std::size_t i = 0; i < scene.path.size(); ++i) {
    const Eigen::Vector3f& force = scene.path.of(i).force;
    all.push_back({force.x(), force.y(), force.z()});
  }
  return all;
}

}  // namespace

void add_scenes(py::module_& module) {
  py::class_<Scene> scene(module, "Scene");
  scene.def(py::init(&scene_of), py::arg(), py::arg() = py::none());
  scene.def("_step", &step_scene);
  scene.def("_forces", &forces_of_objects);
  add_damping_state(scene);
  scene.def_property_readonly("_status", [](const Scene& its) { return static_cast<int>(its.status); });
}

}  // namespace forceshade::python
