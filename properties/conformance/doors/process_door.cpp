// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/doors/process_door.h"

#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

namespace forceshade::conformance {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kProtocol = "conform 1";
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
  ProcessRenderer(const std::string& command, const Json& scene, const ProcessLimits& limits) try : process_(command, limits) {
    const Json said = ask(Json{{"forceshade", kProtocol}, {"scene", scene}}.dump());
    if (const std::string protocol = text_in(said, "forceshade"); protocol != kProtocol)
      throw RendererFailed("the renderer speaks " + shown(protocol) + "; expected \"" + kProtocol + '"');
    hello_ = hello_of(said, scene);
  } catch (const std::system_error& error) {
    throw RendererFailed(std::string("the renderer's process could not be made: ") + error.what());
  } catch (const ProcessFailed& failure) {
    throw RendererFailed(failure.what());
  }

  const Hello& hello() const override { return hello_; }

  std::vector<Eigen::Vector3f> answers(std::span<const Eigen::Vector3f> positions, bool is_reset) override {
    std::string line = is_reset ? R"({"reset":true,"positions":[)" : R"({"positions":[)";
    for (const Eigen::Vector3f& position : positions) {
      line += '"';
      append(line, position);
      line += "\",";
    }
    line.back() = ']';
    const Json said = ask(line + '}');
    const auto all = said.find("answers");
    if (all == said.end() || !all->is_array())
      throw RendererFailed("the renderer answered without a list \"answers\": " +
                           shown(said.dump(-1, ' ', true, Json::error_handler_t::replace)));
    if (all->size() != positions.size())
      throw RendererFailed("the renderer answered " + std::to_string(positions.size()) + " positions with " +
                           std::to_string(all->size()) + " answers");
    std::vector<Eigen::Vector3f> answers;
    for (const Json& one : *all) {
      const auto answer = one.is_string() ? numbers_of(one.get_ref<const std::string&>()) : std::nullopt;
      if (!answer)
        throw RendererFailed("the renderer's answer " + std::to_string(answers.size()) + " is " +
                             shown(one.dump(-1, ' ', true, Json::error_handler_t::replace)) +
                             "; expected a text of 24 hexadecimal digits, those of three binary32 numbers");
      answers.push_back(*answer);
    }
    return answers;
  }

  void say_goodbye() override {
    try {
      process_.say_goodbye(R"({"goodbye":true})");
    } catch (const ProcessFailed& failure) {
      throw RendererFailed(failure.what());
    }
  }

 private:
  Json ask(const std::string& line) {
    std::string answer;
    try {
      answer = process_.ask(line);
    } catch (const ProcessFailed& failure) {
      throw RendererFailed(failure.what());
    }
    Json said = Json::parse(answer, nullptr, false);
    if (!said.is_object()) throw RendererFailed("the renderer wrote " + shown(answer) + "; expected a JSON object in one line");
    return said;
  }

  ChildProcess process_;
  Hello hello_;
};

}  // namespace

OpenRenderer process_door(const std::string& command, const ProcessLimits& limits) {
  return [=](const Json& scene) { return std::make_unique<ProcessRenderer>(command, scene, limits); };
}

}  // namespace forceshade::conformance
