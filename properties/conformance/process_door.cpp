// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/process_door.h"

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
  ProcessRenderer(const std::string& command, const std::string& scene, const ProcessLimits& limits) try
      : process_(command, limits) {
    const Json said = ask(std::string(R"({"forceshade":")") + kProtocol + R"(","scene":)" + scene + '}');
    if (text_in(said, "forceshade") != kProtocol)
      throw RendererFailed("the renderer speaks " + shown(text_in(said, "forceshade")) + "; expected \"" + kProtocol + '"');
    hello_.name = text_in(said, "name");
    hello_.version = text_in(said, "version");
    if (const auto accepts = said.find("accepts"); accepts != said.end() && *accepts == false) {
      hello_.refusal = text_in(said, "reason");
      return;
    }
    const std::string memory = text_in(said, "memory");
    if (memory != "none" && memory != "path")
      throw RendererFailed("the renderer's hello has memory " + shown(memory) + "; expected \"none\" or \"path\"");
    hello_.remembers = memory == "path";
  } catch (const std::system_error& error) {
    throw RendererFailed(std::string("the renderer's process could not be made: ") + error.what());
  } catch (const ProcessFailed& failure) {
    throw RendererFailed(failure.what());
  }

  const Hello& hello() const override { return hello_; }

  std::vector<Eigen::Vector3f> forces(std::span<const Eigen::Vector3f> positions, bool is_reset) override {
    std::string line = is_reset ? R"({"reset":true,"positions":[)" : R"({"positions":[)";
    for (const Eigen::Vector3f& position : positions) {
      line += '"';
      append(line, position);
      line += "\",";
    }
    line.back() = ']';
    const Json said = ask(line + '}');
    const auto all = said.find("forces");
    if (all == said.end() || !all->is_array())
      throw RendererFailed("the renderer answered without a list \"forces\": " +
                           shown(said.dump(-1, ' ', true, Json::error_handler_t::replace)));
    if (all->size() != positions.size())
      throw RendererFailed("the renderer answered " + std::to_string(positions.size()) + " positions with " +
                           std::to_string(all->size()) + " forces");
    std::vector<Eigen::Vector3f> forces;
    for (const Json& one : *all) {
      const auto force = one.is_string() ? numbers_of(one.get_ref<const std::string&>()) : std::nullopt;
      if (!force)
        throw RendererFailed("the renderer's force " + std::to_string(forces.size()) + " is " +
                             shown(one.dump(-1, ' ', true, Json::error_handler_t::replace)) +
                             "; expected a text of 24 hexadecimal digits, those of three binary32 numbers");
      forces.push_back(*force);
    }
    return forces;
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

  static std::string text_in(const Json& said, const char* key) {
    const auto found = said.find(key);
    if (found == said.end()) throw RendererFailed(std::string("the renderer's hello has no key \"") + key + '"');
    if (!found->is_string()) throw RendererFailed(std::string("the renderer's hello has no text as \"") + key + '"');
    return found->get<std::string>();
  }

  ChildProcess process_;
  Hello hello_;
};

}  // namespace

OpenRenderer process_door(const std::string& command, const std::string& scene, const ProcessLimits& limits) {
  return [=] { return std::make_unique<ProcessRenderer>(command, scene, limits); };
}

}  // namespace forceshade::conformance
