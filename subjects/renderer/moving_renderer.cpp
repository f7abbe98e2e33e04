// SPDX-License-Identifier: BSD-3-Clause
// A scene whose objects move from tick to tick of a path.

#include <cstdint>
#include <stdexcept>
#include <utility>

#include "forceshade/renderer.h"

namespace forceshade {
namespace {

using Motions = std::vector<std::shared_ptr<const scene::Motion>>;

// The first step of a path is tick 0, whatever its position is.
class MovingSession final : public fast::Session {
 public:
  MovingSession(fast::SceneSession scene, Motions motions)
      : scene_(std::move(scene)), motions_(std::move(motions)), poses_(motions_.size()) {}

  fast::Evaluation step(const Eigen::Vector3f& position) noexcept override {
    for (std::size_t i = 0; i < poses_.size(); ++i) poses_[i] = motions_[i]->at(tick_);
    ++tick_;
    return scene_.step(position, poses_);
  }

 private:
  fast::SceneSession scene_;
  Motions motions_;
  std::vector<scene::Pose> poses_;  // of this tick
  std::uint64_t tick_ = 0;
};

std::variant<fast::SceneSession, ParameterError> opened(const std::vector<MovingRenderer>& objects) {
  std::vector<std::unique_ptr<fast::Session>> sessions;
  for (const MovingRenderer& one : objects) sessions.push_back(one.renderer.open());
  return fast::SceneSession::build(std::move(sessions));
}

}  // namespace

std::variant<Renderer, ParameterError> renderer_of(std::vector<MovingRenderer> objects) {
  const auto tried = opened(objects);
  if (const auto* error = std::get_if<ParameterError>(&tried)) return *error;
  return Renderer{
      [its = std::make_shared<const std::vector<MovingRenderer>>(std::move(objects))]() -> std::unique_ptr<fast::Session> {
        auto scene = opened(*its);
        if (const auto* error = std::get_if<ParameterError>(&scene)) throw std::runtime_error(error->message());
        Motions motions;
        for (const MovingRenderer& one : *its) motions.push_back(one.motion);
        return std::make_unique<MovingSession>(std::get<fast::SceneSession>(std::move(scene)), std::move(motions));
      }};
}

}  // namespace forceshade
