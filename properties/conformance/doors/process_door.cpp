// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/doors/process_door.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "properties/conformance/doors/dialogue.h"
#include "properties/conformance/doors/lines.h"

namespace forceshade::conformance {
namespace {

using Json = nlohmann::ordered_json;

class ProcessRenderer final : public RendererUnderTest {
 public:
  ProcessRenderer(const std::string& command, const Json& scene, const ProcessLimits& limits)
      : dialogue_(command, limits, "renderer"), hello_(hello_of(dialogue_.open(scene), scene)) {}

  const Hello& hello() const override { return hello_; }

  std::vector<Eigen::Vector3f> answers(std::span<const Eigen::Vector3f> positions, bool is_reset) override {
    const std::string said = dialogue_.say(line_of(is_reset ? kNewPath : kPositions, positions));
    if (auto answers = numbers_in(said, kAnswers); answers && answers->size() == positions.size()) return *std::move(answers);
    return answers_in(dialogue_.object_in(said), positions.size());
  }

  void say_goodbye() override { dialogue_.say_goodbye(); }

 private:
  // What numbers_in() does not read, in any form that JSON allows, and what is wrong with it.
  std::vector<Eigen::Vector3f> answers_in(const Json& said, std::size_t count) const {
    const Json& all = dialogue_.list_in(said, "answers", count, "positions");
    std::vector<Eigen::Vector3f> answers;
    for (const Json& one : all) {
      const auto answer = one.is_string() ? numbers_of(one.get_ref<const std::string&>()) : std::nullopt;
      if (!answer)
        throw RendererFailed("the renderer's answer " + std::to_string(answers.size()) + " is " + shown_json(one) +
                             "; expected a text of 24 hexadecimal digits, those of three binary32 numbers");
      answers.push_back(*answer);
    }
    return answers;
  }

  Dialogue dialogue_;
  Hello hello_;
};

}  // namespace

OpenRenderer process_door(const std::string& command, const ProcessLimits& limits) {
  return [=](const Json& scene) { return std::make_unique<ProcessRenderer>(command, scene, limits); };
}

}  // namespace forceshade::conformance
