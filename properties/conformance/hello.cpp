// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/hello.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "files/json_line.h"
#include "forceshade/mesh.h"
#include "forceshade/reference.h"

namespace forceshade::conformance {
namespace {

using Json = nlohmann::ordered_json;
using files::KeyReader;
using files::one_of;
using files::shown_json;

std::array<Axis, 3> frame_in(const KeyReader& its) {
  static const std::string kExpected =
      "a list like [\"x\", \"z\", \"-y\"]: the direction in the scene of each of its own axes, x, y and z once each";
  const Json& value = its.value("frame", kExpected);
  std::array<Axis, 3> frame;
  std::array<bool, 3> is_there{};
  if (!value.is_array() || value.size() != 3) its.refuse("frame", value, kExpected);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string word = value[i].is_string() ? value[i].get<std::string>() : "";
    frame[i].is_opposite = word.starts_with('-');
    const std::string axis = word.substr(frame[i].is_opposite);
    if (axis != "x" && axis != "y" && axis != "z") its.refuse("frame", value, kExpected);
    frame[i].index = static_cast<std::size_t>(axis[0] - 'x');
    is_there[frame[i].index] = true;
  }
  if (std::ranges::count(is_there, true) != 3) its.refuse("frame", value, kExpected);
  return frame;
}

// The parameters by their names in damping::Parameters; the rate is that of the renderer.
damping::Parameters damping_in(const KeyReader& its, const Json& value, const std::optional<double>& rate) {
  if (!value.is_object()) its.refuse("damping", value, "an object like {\"damping\": 0.002, \"share\": 0.3}");
  if (!rate) its.refuse("rate_Hz", nullptr, "a number where it damps, since each position is a tick");
  const KeyReader keys(value, "the damping of the renderer's hello");
  keys.expect_no_key_but({"share", "damping", "most", "drag", "full_at"});
  damping::Parameters p{.rate = static_cast<float>(*rate)};
  const auto read = [&](const char* key, float& parameter) {
    if (value.contains(key)) parameter = static_cast<float>(keys.number(key, 0, 1024, "a number from 0 to 1024"));
  };
  read("share", p.share);
  read("damping", p.damping);
  if (value.contains("most") && value.at("most").is_null())
    p.most = HUGE_VALF;
  else
    read("most", p.most);
  read("drag", p.drag);
  read("full_at", p.full_at);
  const auto built = reference::Damping::build(p);
  if (const auto* error = std::get_if<ParameterError>(&built)) its.refuse("damping", value, error->message());
  return p;
}

// The value of the key, a list of words.
const Json& list_in(const KeyReader& its, const std::string& key, const std::string& expected) {
  const Json& value = its.value(key, expected);
  if (!value.is_array() || !std::ranges::all_of(value, [](const Json& one) { return one.is_string(); }))
    its.refuse(key, value, expected);
  return value;
}

std::string undeclared(const std::string& key, const Json& declared, const Json& needed) {
  return "it declares " + key + ' ' + shown_json(declared) + " and not " + needed.dump();
}

// The words of the key "materials" that a scene's materials need.
Json words_of_materials(const Json& scene) {
  Json words = Json::array();
  if (!scene.contains("mesh") || !scene.at("mesh").contains("materials")) return words;
  const Json& materials = scene.at("mesh").at("materials");
  if (std::ranges::any_of(materials, [](const Json& one) { return one.at("static_friction") != "0x0p+0"; }))
    words.push_back("friction");
  if (std::ranges::any_of(materials, [](const Json& one) { return one.contains("damping_N_s_per_mm"); }))
    words.push_back("damping");
  if (std::ranges::any_of(materials, [](const Json& one) { return !one.at("stiffness_N_per_mm").is_null(); }))
    words.push_back("stiffness");
  return words;
}

// The key may be absent, as it was before there were materials: then it renders none.
std::optional<std::string> refusal_of_materials(const KeyReader& its, const Json& said, const Json& scene) {
  const Json none = Json::array();
  const Json& declared =
      said.contains("materials")
          ? list_in(its, "materials",
                    "a list of what it renders of a scene's materials: \"friction\", \"stiffness\", \"damping\"")
          : none;
  for (const Json& word : words_of_materials(scene))
    if ((word != "damping" || said.contains("damping")) && std::ranges::find(declared, word) == declared.end())
      return undeclared("materials", declared, word);
  return std::nullopt;
}

// The refusal of a scene with a mesh that has something beyond what the renderer declares.
std::optional<std::string> refusal_of_mesh(const KeyReader& its, const Json& said, const Json& scene) {
  const Json& parameters = scene.at("parameters");
  for (const auto& [key, names] :
       {std::pair("sides", std::vector<std::string>(mesh::kSidesNames.begin(), mesh::kSidesNames.end())),
        {"shading", {mesh::kShadingNames.begin(), mesh::kShadingNames.end()}}}) {
    const std::string expected = "a list of what it renders of " + one_of(names);
    const Json& value = list_in(its, key, expected);
    if (std::ranges::find(value, parameters.at(key)) == value.end()) return undeclared(key, value, parameters.at(key));
  }
  // The key may be absent, as it was before any set of triangles was rendered.
  const bool is_any = said.contains("meshes") && its.word("meshes", {"regular", "any"}) == 1;
  if (parameters.contains("triangles") && !is_any) return undeclared("meshes", "regular", "any");
  return std::nullopt;
}

}  // namespace

bool Hello::has_own_units() const {
  for (std::size_t i = 0; i < 3; ++i)
    if (frame[i].index != i || frame[i].is_opposite) return true;
  return answer != Answer::force || millimetres != 1 || newtons != 1;
}

Hello hello_of(const Json& said, const Json& scene) {
  const KeyReader its(said, "the renderer's hello");
  Hello hello;
  its.word("kind", {"renderer"});
  hello.name = its.text("name");
  hello.version = its.text("version");
  hello.refusal = its.refusal();
  if (hello.refusal) return hello;
  hello.remembers = its.word("memory", {"none", "path"}) == 1;
  hello.answer = static_cast<Answer>(its.word("answers", {"force", "impulse", "closest point"}));
  hello.claims_definition = its.word("claims", {"definition", "invariants"}) == 0;
  hello.millimetres = its.word("length_unit", {"mm", "m"}) == 0 ? 1 : 1000;
  hello.newtons = its.word("force_unit", {"N", "mN"}) == 0 ? 1 : 1e-3;
  hello.frame = frame_in(its);
  hello.domain = static_cast<float>(
      its.number("domain_mm", 1, 10'000, "a number from 1 to 10000: the largest coordinate for which it gives a force"));
  hello.rate = its.number_or_null("rate_Hz", 1, 1e6, "a number from 1 to 1e6, or null where a force does not depend on time");
  hello.loop_energy = its.number_or_null(
      "loop_energy_mJ", 0, 1e9, "the most energy that a closed path gives the hand, 0 or more, or null where it may be any");
  std::vector<std::string> keys{"memory", "answers",   "claims",  "length_unit",   "force_unit",
                                "frame",  "domain_mm", "rate_Hz", "loop_energy_mJ"};
  if (hello.answer == Answer::impulse && !hello.rate)
    its.refuse("rate_Hz", nullptr, "a number where it answers with an impulse, which is a force times the length of a tick");
  if (said.contains("damping")) {
    hello.damping = damping_in(its, said.at("damping"), hello.rate);
    if (!hello.remembers) its.refuse("memory", said.at("memory"), "\"path\" where it damps");
    if (hello.answer == Answer::closest_point)
      its.refuse("answers", said.at("answers"), "a force or an impulse where it damps");
    if (scene.at("kind") == "scene") hello.refusal = "damping in scenes of several objects is not checked";
    keys.emplace_back("damping");
  }
  if (scene.at("kind") == "mesh") {
    hello.refusal = refusal_of_mesh(its, said, scene);
    if (!hello.refusal) hello.refusal = refusal_of_materials(its, said, scene);
    const double radius = its.number("proxy_radius_mm", 0, 10'000, "the radius of its god-object or proxy, 0 of a point");
    if (radius > 0 && hello.claims_definition)
      its.refuse("claims", said.at("claims"),
                 R"("invariants" where proxy_radius_mm is not 0, since the definition's god-object is a point)");
    keys.insert(keys.end(), {"sides", "shading", "proxy_radius_mm"});
    for (const char* const key : {"materials", "meshes"})
      if (said.contains(key)) keys.emplace_back(key);
  }
  for (const std::string& key : keys) hello.declared[key] = said.at(key);
  return hello;
}

}  // namespace forceshade::conformance
