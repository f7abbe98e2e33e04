// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/identity.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <utility>

#include "rendering/identity/digest.h"
#include "text/number_text.h"

namespace forceshade {
namespace {

// A part in words: its kind, its numbers under their keys in a TOML file, and a grid's samples.
struct PartWords {
  std::string kind;
  std::vector<std::pair<std::string_view, float>> numbers;
  std::vector<std::pair<std::string_view, std::string_view>> words = {};
  std::span<const float> samples = {};
};

template <height::HasNumbers Kind>
PartWords described(const Kind& shape) {
  PartWords words{std::string(Kind::kName), {}};
  for (const height::Number<Kind>& number : Kind::numbers()) words.numbers.emplace_back(number.key, shape.*number.member);
  return words;
}
PartWords described(const height::Polygons& p) {
  PartWords words{std::string(height::Polygons::kName), {}};
  for (const height::Knot& knot : p.knots) {
    words.numbers.emplace_back("x_mm", knot.x);
    words.numbers.emplace_back("height_mm", knot.height);
  }
  return words;
}
PartWords described(const std::shared_ptr<const height::Grid>& g) {
  // At most 2^15 columns and rows: binary32 numbers.
  return {std::string(height::Grid::kName),
          {{"columns", static_cast<float>(g->columns)}, {"rows", static_cast<float>(g->rows)}, {"pitch_mm", g->pitch}},
          {{"edge", g->edge == height::Edge::tile ? "tile" : "clamp"},
           {"interpolant", g->interpolant == height::Interpolant::bilinear ? "bilinear" : "cubic-spline"}},
          g->values};
}

PartWords described(const height::Part& part) {
  PartWords words = std::visit([](const auto& shape) { return described(shape); }, part.shape);
  if (part.negated) words.words.emplace_back("negated", "true");
  return words;
}

struct Role {
  std::string words;
  const std::vector<height::Part>* parts;
};
std::array<Role, 2> roles(const HeightMap& map) {
  return {{{"", &map.parts}, {"depth from ", &map.surface}}};
}

}  // namespace

const IdentityValue* Identity::parameter(std::string_view key) const {
  for (const auto& [its, value] : parameters)
    if (its == key) return &value;
  return nullptr;
}

bool Identity::has_parameters_of(const Identity& other) const {
  return parameters.size() == other.parameters.size() &&
         std::all_of(parameters.begin(), parameters.end(), [&](const auto& one) {
           const IdentityValue* its = other.parameter(one.first);
           return its != nullptr && *its == one.second;
         });
}

Identity identity_of(LawId law, const Parameters& p) {
  Identity identity{kLawKind, std::string(name_of(law)), {}};
  if (has_bump_geometry(law)) identity.parameters = {{"radius_mm", p.radius}, {"width_mm", p.width}};
  identity.parameters.emplace_back("stiffness_N_per_mm", p.stiffness);
  return identity;
}

std::optional<LawAndParameters> law_of(const Identity& identity) {
  const auto law = identity.kind == kLawKind ? law_named(identity.name) : std::nullopt;
  if (!law) return std::nullopt;
  LawAndParameters found{*law, {}};
  const auto take = [&](const char* key, float& number) {
    const IdentityValue* value = identity.parameter(key);
    if (value == nullptr || !std::holds_alternative<float>(*value)) return false;
    number = std::get<float>(*value);
    return true;
  };
  if (!take("stiffness_N_per_mm", found.parameters.stiffness)) return std::nullopt;
  if (has_bump_geometry(*law) && !(take("radius_mm", found.parameters.radius) && take("width_mm", found.parameters.width)))
    return std::nullopt;
  return found;
}

std::string text_of(const IdentityValue& value) {
  const auto* number = std::get_if<float>(&value);
  return number != nullptr ? shortest(*number) : std::get<std::string>(value);
}

bool is_conservative_map(const Identity& identity) {
  const IdentityValue* rendering = identity.parameter("rendering");
  return rendering != nullptr && text_of(*rendering) == name_of(height::Mode::conservative);
}

std::string parameters_in_words(const Identity& identity) {
  static constexpr std::array<std::array<std::string_view, 2>, 3> kUnits{
      {{"_N_per_mm", " N/mm"}, {"_mm", " mm"}, {"_Hz", " Hz"}}};
  std::string words;
  for (const auto& [key, value] : identity.parameters) {
    std::string name = key, unit;
    for (const auto& [ending, its] : kUnits)
      if (unit.empty() && name.ends_with(ending)) {
        name.resize(name.size() - ending.size());
        unit = its;
      }
    words += (words.empty() ? "" : ", ") + name + ' ' + text_of(value) + unit;
  }
  return words;
}

Identity identity_of(const std::string& name, const HeightMap& map, height::Mode mode, float stiffness) {
  Digest digest;
  for (const auto& [role, parts] : roles(map))
    for (const height::Part& part : *parts) {
      const PartWords words = described(part);
      digest.line(role + words.kind);
      for (const auto& [key, value] : words.numbers) {
        digest.line(std::string(key));
        digest.number(value);
      }
      for (const auto& [key, word] : words.words) digest.line(std::string(key) + ' ' + std::string(word));
      digest.line(std::to_string(words.samples.size()));
      for (const float sample : words.samples) digest.number(sample);
    }
  return {kHeightMapKind, name, {{"rendering", std::string(name_of(mode))}, {"stiffness_N_per_mm", stiffness}}, digest.hex()};
}

std::vector<std::string> words_of(const HeightMap& map) {
  std::vector<std::string> lines;
  for (const auto& [role, parts] : roles(map))
    for (const height::Part& part : *parts) {
      const PartWords words = described(part);
      std::string line = role + words.kind + ':';
      for (const auto& [key, value] : words.numbers) line += ' ' + std::string(key) + ' ' + shortest(value) + ',';
      for (const auto& [key, word] : words.words) line += ' ' + std::string(key) + ' ' + std::string(word) + ',';
      line.pop_back();
      lines.push_back(std::move(line));
    }
  return lines;
}

}  // namespace forceshade
