// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/hello.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "files/printable.h"
#include "forceshade/mesh.h"
#include "properties/conformance/doors/child_process.h"

namespace forceshade::conformance {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLongestText = 1000;  // bytes

std::string shown_json(const Json& value) {
  if (value.is_string()) return shown(value.get_ref<const std::string&>());
  const std::string quoted = shown(value.dump(-1, ' ', true, Json::error_handler_t::replace));
  return quoted.substr(1, quoted.size() - 2);
}

const Json& value_in(const Json& said, const std::string& key, const std::string& expected) {
  const auto found = said.find(key);
  if (found == said.end()) throw RendererFailed("the renderer's hello has no key \"" + key + "\"; expected " + expected);
  return *found;
}

[[noreturn]] void refuse(const std::string& key, const Json& value, const std::string& expected) {
  throw RendererFailed("the renderer's hello has " + key + ' ' + shown_json(value) + "; expected " + expected);
}

// "a", "b" or "c".
std::string one_of(const std::vector<std::string>& words) {
  std::string list;
  for (std::size_t i = 0; i < words.size(); ++i)
    list += (i == 0 ? "\"" : i + 1 < words.size() ? ", \"" : " or \"") + words[i] + '"';
  return list;
}

// Which of these words it is.
std::size_t word_in(const Json& said, const std::string& key, const std::vector<std::string>& words) {
  const std::string expected = one_of(words);
  const Json& value = value_in(said, key, expected);
  const auto found = std::ranges::find_if(words, [&](const std::string& word) { return value == word; });
  if (found == words.end()) refuse(key, value, expected);
  return static_cast<std::size_t>(found - words.begin());
}

double number_in(const Json& said, const std::string& key, double least, double most, const std::string& expected) {
  const Json& value = value_in(said, key, expected);
  if (!value.is_number() || !(value.get<double>() >= least && value.get<double>() <= most)) refuse(key, value, expected);
  return value.get<double>();
}

std::optional<double> number_or_null_in(const Json& said, const std::string& key, double least, double most,
                                        const std::string& expected) {
  if (value_in(said, key, expected).is_null()) return std::nullopt;
  return number_in(said, key, least, most, expected);
}

std::array<Axis, 3> frame_in(const Json& said) {
  static const std::string kExpected =
      "a list like [\"x\", \"z\", \"-y\"]: the direction in the scene of each of its own axes, x, y and z once each";
  const Json& value = value_in(said, "frame", kExpected);
  std::array<Axis, 3> frame;
  std::array<bool, 3> is_there{};
  if (!value.is_array() || value.size() != 3) refuse("frame", value, kExpected);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string word = value[i].is_string() ? value[i].get<std::string>() : "";
    frame[i].is_opposite = word.starts_with('-');
    const std::string axis = word.substr(frame[i].is_opposite);
    if (axis != "x" && axis != "y" && axis != "z") refuse("frame", value, kExpected);
    frame[i].index = static_cast<std::size_t>(axis[0] - 'x');
    is_there[frame[i].index] = true;
  }
  if (std::ranges::count(is_there, true) != 3) refuse("frame", value, kExpected);
  return frame;
}

// Whether what a scene with a mesh has is among what it declares.
std::optional<std::string> refusal_of_mesh(const Json& said, const Json& scene) {
  const Json& parameters = scene.at("parameters");
  for (const auto& [key, names] :
       {std::pair("sides", std::vector<std::string>(mesh::kSidesNames.begin(), mesh::kSidesNames.end())),
        {"shading", {mesh::kShadingNames.begin(), mesh::kShadingNames.end()}}}) {
    const std::string expected = "a list of what it renders of " + one_of(names);
    const Json& value = value_in(said, key, expected);
    if (!value.is_array() || !std::ranges::all_of(value, [](const Json& one) { return one.is_string(); }))
      refuse(key, value, expected);
    if (std::ranges::find(value, parameters.at(key)) == value.end())
      return "it declares " + std::string(key) + ' ' + value.dump(-1, ' ', true, Json::error_handler_t::replace) + " and not " +
             parameters.at(key).dump();
  }
  return std::nullopt;
}

}  // namespace

bool Hello::has_own_units() const {
  for (std::size_t i = 0; i < 3; ++i)
    if (frame[i].index != i || frame[i].is_opposite) return true;
  return answer != Answer::force || millimetres != 1 || newtons != 1;
}

std::string text_in(const Json& said, const std::string& key, const std::string& expected) {
  const Json& value = value_in(said, key, expected);
  if (!value.is_string() || value.get_ref<const std::string&>().size() > kLongestText) refuse(key, value, expected);
  return files::printable(value.get<std::string>());
}

Hello hello_of(const Json& said, const Json& scene) {
  Hello hello;
  word_in(said, "kind", {"renderer"});
  hello.name = text_in(said, "name");
  hello.version = text_in(said, "version");
  if (const auto accepts = said.find("accepts"); accepts != said.end() && *accepts == false) {
    hello.refusal = text_in(said, "reason");
    return hello;
  }
  hello.remembers = word_in(said, "memory", {"none", "path"}) == 1;
  hello.answer = static_cast<Answer>(word_in(said, "answers", {"force", "impulse", "closest point"}));
  hello.claims_definition = word_in(said, "claims", {"definition", "invariants"}) == 0;
  hello.millimetres = word_in(said, "length_unit", {"mm", "m"}) == 0 ? 1 : 1000;
  hello.newtons = word_in(said, "force_unit", {"N", "mN"}) == 0 ? 1 : 1e-3;
  hello.frame = frame_in(said);
  hello.domain = static_cast<float>(
      number_in(said, "domain_mm", 1, 10'000, "a number from 1 to 10000: the largest coordinate for which it gives a force"));
  hello.rate =
      number_or_null_in(said, "rate_Hz", 1, 1e6, "a number from 1 to 1e6, or null where a force does not depend on time");
  hello.loop_energy =
      number_or_null_in(said, "loop_energy_mJ", 0, 1e9,
                        "the most energy that a closed path gives the hand, 0 or more, or null where it may be any");
  std::vector<std::string> keys{"memory", "answers",   "claims",  "length_unit",   "force_unit",
                                "frame",  "domain_mm", "rate_Hz", "loop_energy_mJ"};
  if (hello.answer == Answer::impulse && !hello.rate)
    refuse("rate_Hz", nullptr, "a number where it answers with an impulse, which is a force times the length of a tick");
  if (scene.at("kind") == "mesh") {
    hello.refusal = refusal_of_mesh(said, scene);
    const double radius = number_in(said, "proxy_radius_mm", 0, 10'000, "the radius of its god-object or proxy, 0 of a point");
    if (radius > 0 && hello.claims_definition)
      refuse("claims", said.at("claims"),
             R"("invariants" where proxy_radius_mm is not 0, since the definition's god-object is a point)");
    keys.insert(keys.end(), {"sides", "shading", "proxy_radius_mm"});
  }
  for (const std::string& key : keys) hello.declared[key] = said.at(key);
  return hello;
}

}  // namespace forceshade::conformance
