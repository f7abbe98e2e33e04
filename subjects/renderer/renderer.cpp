// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/renderer.h"

#include <exception>
#include <limits>
#include <utility>

namespace forceshade {
namespace {

// A field that many sessions share.
template <class Field>
struct Shared {
  std::shared_ptr<const Field> field;

  fast::Evaluation evaluate(const Eigen::Vector3f& position) const noexcept { return field->evaluate(position); }
};

// step() must not throw, so what the function throws is kept for exception().
class AnsweringSession final : public fast::Session {
 public:
  explicit AnsweringSession(std::function<fast::Evaluation(const Eigen::Vector3f& position)> evaluate)
      : evaluate_(std::move(evaluate)) {}

  fast::Evaluation step(const Eigen::Vector3f& position) noexcept override {
    exception_.reset();
    try {
      return evaluate_(position);
    } catch (...) {
      exception_ = current_exception_words();
      return {Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()), Status::invalid};
    }
  }

  const std::optional<std::string>& exception() const { return exception_; }

 private:
  std::function<fast::Evaluation(const Eigen::Vector3f& position)> evaluate_;
  std::optional<std::string> exception_;
};

}  // namespace

Renderer renderer_of(const fast::Law& law) {
  return {[law] { return fast::session_of(law); },
          [law](std::span<const Eigen::Vector3f> positions, std::span<Eigen::Vector3f> forces, fast::InstructionSet set) {
            return law.force(positions, forces, set);
          }};
}

Renderer renderer_of(const fast::HeightMapField& map) {
  const Shared<fast::HeightMapField> law{std::make_shared<const fast::HeightMapField>(map)};
  return {[law] { return fast::session_of(law); },
          [law](std::span<const Eigen::Vector3f> positions, std::span<Eigen::Vector3f> forces, fast::InstructionSet set) {
            return law.field->force(positions, forces, set);
          },
          true};
}

Renderer renderer_of(const fast::GodObject& god_object) {
  return {[god_object] { return god_object.open(); }};
}

std::unique_ptr<fast::Session> answering(std::function<fast::Evaluation(const Eigen::Vector3f& position)> evaluate) {
  return std::make_unique<AnsweringSession>(std::move(evaluate));
}

std::optional<std::string> exception_of(const fast::Session& session) {
  const auto* its = dynamic_cast<const AnsweringSession*>(&session);
  return its == nullptr ? std::nullopt : its->exception();
}

std::string current_exception_words() {
  try {
    throw;
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "something that is no std::exception";
  }
}

}  // namespace forceshade
