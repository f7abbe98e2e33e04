// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/doors/process_door.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "files/json_line.h"
#include "files/shell.h"
#include "forceshade/error.h"
#include "properties/conformance/doors/dialogue.h"
#include "properties/conformance/doors/lines.h"

namespace forceshade::conformance {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kWhose = "renderer";

class ProcessRenderer final : public RendererUnderTest {
 public:
  ProcessRenderer(const std::string& command, const Json& scene, const files::ProcessLimits& limits)
      : dialogue_(command, limits, kWhose), hello_(hello_of(dialogue_.open(scene), scene)) {}

  const Hello& hello() const override { return hello_; }

  std::vector<Eigen::Vector3f> answers(std::span<const Eigen::Vector3f> positions, bool is_reset,
                                       std::span<const std::uint32_t> periods) override {
    return answers_in(dialogue_.say(line_of(is_reset ? kNewPath : kPositions, positions, periods)), positions.size());
  }

  void say_goodbye() override { dialogue_.say_goodbye(); }

 private:
  Dialogue dialogue_;
  Hello hello_;
};

}  // namespace

// A line that numbers_in() does not read may have any form that JSON allows, or is wrong.
std::vector<Eigen::Vector3f> answers_in(const std::string& said, std::size_t count) {
  if (auto answers = numbers_in(said, kAnswers); answers && answers->size() == count) return *std::move(answers);
  const Json object = files::object_in(said, kWhose);
  std::vector<Eigen::Vector3f> answers;
  for (const Json& one : list_in(object, "answers", count, "positions", kWhose)) {
    const auto answer = one.is_string() ? numbers_of(one.get_ref<const std::string&>()) : std::nullopt;
    if (!answer)
      throw files::ProcessFailed("the renderer's answer " + std::to_string(answers.size()) + " is " + files::shown_json(one) +
                                 "; expected a text of 24 hexadecimal digits, those of three binary32 numbers");
    answers.push_back(*answer);
  }
  return answers;
}

OpenRenderer process_door(const std::string& command, const files::ProcessLimits& limits) {
  return [=](const Json& scene) { return std::make_unique<ProcessRenderer>(command, scene, limits); };
}

OpenRenderer object_door(const std::string& file, const files::ProcessLimits& limits) {
  namespace fs = std::filesystem;
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path().parent_path() / kObjectProgram;
  if (!fs::exists(program)) throw Error("--command: expected the program " + program.string() + ", which is not there");
  files::ProcessLimits its = limits;
  its.ended_well = kObjectEndedWell;
  // A name without a slash would be looked for among the system's libraries.
  return process_door("exec " + files::quoted_for_shell(program) + ' ' + files::quoted_for_shell(fs::absolute(file)), its);
}

}  // namespace forceshade::conformance
