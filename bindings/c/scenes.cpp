// SPDX-License-Identifier: BSD-3-Clause
// Scenes of the C interface: one path of the hand each, through objects that move, for one thread at a time.

#include <memory>
#include <string>
#include <vector>

#include "bindings/c/batch.h"
#include "bindings/c/damped.h"
#include "bindings/c/entered.h"
#include "bindings/c/subject.h"

namespace forceshade::c {
namespace {

struct Scene : fast::SceneSession {
  static constexpr const char* kBusy = "another thread is in this scene, which is for one at a time";
  static constexpr const char* kNone = "invalid scene handle: it was never opened, or has been closed";
  static constexpr const char* kTooMany = "there are too many scenes; expected some to be closed";

  explicit Scene(fast::SceneSession session) : fast::SceneSession(std::move(session)) {}
};

constinit Lasting<Scene> scenes;

static_assert(sizeof(forceshade_pose) == sizeof(scene::Pose) && alignof(forceshade_pose) == alignof(scene::Pose) &&
              offsetof(forceshade_pose, rotation) == offsetof(scene::Pose, rotation));

// Returns what use(answer) does with the scene's answer at the next position, or an error code after setting the error text.
template <class Use>
forceshade_result after_step(forceshade_scene scene, const float* position, const forceshade_pose* poses, std::size_t count,
                             const float* force, const Use& use) noexcept {
  if (position == nullptr || poses == nullptr || force == nullptr)
    return fail(FORCESHADE_NULL_POINTER, "position, poses or force is NULL");
  const Entered entered(scenes.table, scene.handle);
  if (!entered) return entered.result;
  if (count != entered->size()) return fail(FORCESHADE_BAD_VALUE, "count: expected one pose for each object of the scene");
  return use(entered->step(*as_vectors(position), {reinterpret_cast<const scene::Pose*>(poses), count}));
}

}  // namespace
}  // namespace forceshade::c

using namespace forceshade;
using namespace forceshade::c;

forceshade_result forceshade_scene_open(const forceshade_subject* objects, size_t count, forceshade_scene* made) {
  return guarded([&]() -> forceshade_result {
    if (objects == nullptr || made == nullptr) return fail(FORCESHADE_NULL_POINTER, "objects or made is NULL");
    if (count > scene::kMostObjects)  // before any of them is read
      return fail(FORCESHADE_BAD_VALUE,
                  "number of objects is " + std::to_string(count) + "; expected 1 to " + std::to_string(scene::kMostObjects));
    std::vector<std::unique_ptr<fast::Session>> sessions;
    for (std::size_t i = 0; i < count; ++i) {
      const Subject* const its = subject_of(objects[i]);
      if (its == nullptr) return bad_subject();
      sessions.push_back(its->renderer.open());
    }
    auto built = fast::SceneSession::build(std::move(sessions));
    if (const auto* error = std::get_if<ParameterError>(&built)) return fail_with(*error);
    const auto opened = [&] { return std::make_unique<Scene>(std::get<fast::SceneSession>(std::move(built))); };
    return open(scenes.table, opened, made->handle);
  });
}

forceshade_result forceshade_scene_close(forceshade_scene scene) {
  return guarded([&]() -> forceshade_result {
    const Entered entered(scenes.table, scene.handle);
    if (!entered) return entered.result;
    scenes.table.take(scene.handle);
    return FORCESHADE_OK;
  });
}

forceshade_result forceshade_scene_step(forceshade_scene scene, const float* position, const forceshade_pose* poses,
                                        size_t count, float* force, forceshade_status* status) {
  return after_step(scene, position, poses, count, force,
                    [&](const fast::Evaluation& answer) { return give(answer, force, status); });
}

forceshade_result forceshade_scene_damped_step(forceshade_scene scene, const forceshade_damping* damping,
                                               forceshade_damping_state* state, uint32_t periods, const float* position,
                                               const forceshade_pose* poses, size_t count, float* force,
                                               forceshade_status* status) {
  return with_damping(damping, state, [&](LastDamping& its) {
    return after_step(scene, position, poses, count, force, [&](const fast::Evaluation& answer) {
      return its.tick(*state, periods, position, answer, force, status);
    });
  });
}

forceshade_result forceshade_scene_object(forceshade_scene scene, size_t object, float* force, forceshade_status* status) {
  if (force == nullptr) return fail(FORCESHADE_NULL_POINTER, "force is NULL");
  const Entered entered(scenes.table, scene.handle);
  if (!entered) return entered.result;
  if (object >= entered->size()) return fail(FORCESHADE_BAD_VALUE, "object: expected the number of one, from 0");
  return give(entered->of(object), force, status);
}
