// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/doors/process_door.h"

#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "properties/conformance/doors/dialogue.h"

namespace forceshade::conformance {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kHexDigits = 24;  // of three binary32 numbers

// The eight hexadecimal digits of each component, one after the other.
void append(std::string& line, const Eigen::Vector3f& numbers) {
  constexpr const char* kDigits = "0123456789abcdef";
  for (const float number : numbers)
    for (int shift = 28; shift >= 0; shift -= 4) line += kDigits[std::bit_cast<std::uint32_t>(number) >> shift & 15U];
}

std::optional<Eigen::Vector3f> numbers_of(const std::string& text) {
  Eigen::Vector3f numbers;
  if (text.size() != kHexDigits) return std::nullopt;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const char* const begin = text.data() + 8 * axis;
    std::uint32_t bits = 0;
    if (const auto [end, error] = std::from_chars(begin, begin + 8, bits, 16); error != std::errc() || end != begin + 8)
      return std::nullopt;
    numbers[axis] = std::bit_cast<float>(bits);
  }
  return numbers;
}

class ProcessRenderer final : public RendererUnderTest {
 public:
  ProcessRenderer(const std::string& command, const Json& scene, const ProcessLimits& limits)
      : dialogue_(command, limits, "renderer"), hello_(hello_of(dialogue_.open(scene), scene)) {}

  const Hello& hello() const override { return hello_; }

  std::vector<Eigen::Vector3f> answers(std::span<const Eigen::Vector3f> positions, bool is_reset) override {
    std::string line = is_reset ? R"({"reset":true,"positions":[)" : R"({"positions":[)";
    for (const Eigen::Vector3f& position : positions) {
      line += '"';
      append(line, position);
      line += "\",";
    }
    line.back() = ']';
    const Json said = dialogue_.ask(line + '}');
    const Json& all = dialogue_.list_in(said, "answers", positions.size(), "positions");
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

  void say_goodbye() override { dialogue_.say_goodbye(); }

 private:
  Dialogue dialogue_;
  Hello hello_;
};

}  // namespace

OpenRenderer process_door(const std::string& command, const ProcessLimits& limits) {
  return [=](const Json& scene) { return std::make_unique<ProcessRenderer>(command, scene, limits); };
}

}  // namespace forceshade::conformance
