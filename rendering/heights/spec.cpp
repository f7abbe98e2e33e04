// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "files/toml_table.h"
#include "forceshade/heights.h"
#include "rendering/heights/samples.h"

namespace forceshade::heights {
namespace {

namespace fs = std::filesystem;

// One table of the file, with what a height map alone has.
class Table : public files::TomlTable {
 public:
  using TomlTable::TomlTable;

  // A scale of 0, or one so small that every height would be read as 0, leaves nothing of a grid.
  float scale(const char* key) {
    const float value = number(key);
    if (!(std::fabs(value) >= 0x1p-30F && std::isfinite(value)))
      fail(*find(key, false), key, "a finite number of at least 2^-30 mm in size");
    return value;
  }

  std::vector<height::Knot> knots(const char* key) {
    const toml::node* node = find(key, false);
    const toml::array* list = node->as_array();
    std::vector<height::Knot> all;
    for (std::size_t i = 0; list != nullptr && i < list->size(); ++i) {
      const toml::array* pair = (*list)[i].as_array();
      const auto number = [&](std::size_t k) {
        return pair != nullptr && pair->size() == 2 ? document().binary32((*pair)[k]) : std::nullopt;
      };
      const auto x = number(0), height = number(1);
      if (!x || !height) fail((*list)[i], key, "pairs of numbers [x, height]");
      all.push_back({*x, *height});
    }
    if (list == nullptr) fail(*node, key, "a list of pairs [x, height]");
    return all;
  }
};

constexpr std::array<std::pair<std::string_view, height::Edge>, 2> kEdges{
    {{"clamp", height::Edge::clamp}, {"tile", height::Edge::tile}}};
enum class Sampled { bilinear, cubic_spline, band_limited };
constexpr std::array<std::pair<std::string_view, Sampled>, 3> kInterpolants{
    {{"bilinear", Sampled::bilinear}, {"cubic-spline", Sampled::cubic_spline}, {"band-limited", Sampled::band_limited}}};

// The content of the grid of a spline: coefficients, or the heights that they were made of.
enum class Values { coefficients, heights };

height::Shape grid(Table& table, const fs::path& file, Values values) {
  const auto sampled = table.word<Sampled>("interpolant", kInterpolants, Sampled::cubic_spline);
  Source source{.file = file.parent_path() / table.text("file"),
                .pitch = table.number("pitch_mm"),
                .scale = table.scale("scale_mm"),
                .edge = table.word<height::Edge>("edge", kEdges, height::Edge::clamp)};
  if (sampled == Sampled::bilinear) source.interpolant = height::Interpolant::bilinear;
  if (sampled == Sampled::band_limited) source.shortest_wavelength = table.number("shortest_wavelength_mm");
  if (values == Values::heights) source.interpolant = height::Interpolant::bilinear;
  return load(source);
}

// The kind whose name is the word, with its numbers under their keys.
height::Shape shape(Table& table, const fs::path& file, Values values) {
  std::array<std::pair<std::string_view, std::size_t>, height::kKinds> kinds;
  for (std::size_t i = 0; i < kinds.size(); ++i) kinds[i] = {height::kKindNames[i], i};
  return height::shape_of_kind(
      table.word<std::size_t>("shape", kinds),
      [&](const auto& number) { return table.number(number.key, number.is_required ? std::nullopt : std::optional(0.0F)); },
      [&] { return height::Polygons{table.knots("knots_mm")}; }, [&] { return grid(table, file, values); });
}

height::Part part(const files::TomlFile& file, const toml::table& table, Values values) {
  Table keys(file, table);
  height::Part part{shape(keys, file.path(), values), keys.flag("negated", false)};
  keys.expect_no_other();
  return part;
}

// 16 parts and 16 surfaces of 1025 knots each, at 40 bytes a knot, take a third of it.
constexpr std::size_t kLargestFile = 4 << 20;

files::TomlFile parsed(const fs::path& file) {
  return files::TomlFile(file, kLargestFile, files::LineForm::words);
}

Spec spec_of(const fs::path& file, Values values) {
  const files::TomlFile parsed_file = parsed(file);
  Table keys(parsed_file);
  std::array<std::pair<std::string_view, height::Mode>, height::kModes.size()> renderings;
  for (std::size_t i = 0; i < renderings.size(); ++i) renderings[i] = {height::kModes[i].name, height::kModes[i].mode};
  Spec spec{{}, keys.word<height::Mode>("render", renderings)};
  for (const auto& [key, node] : parsed_file.document().root()) {
    if (key.str() == "render") continue;
    const bool is_surface = key.str() == "surface";
    const toml::array* parts = key.str() == "part" || is_surface ? node.as_array() : nullptr;
    if (!parts)
      parsed_file.fail(node, "expected render, [[part]] and [[surface]], got " + std::string(key.str()) +
                                 files::suggestion(key.str(), {"render", "part", "surface"}));
    if (is_surface && spec.mode != height::Mode::force_shaded)
      parsed_file.fail(node, "only render = \"height-map-shaded\" has a [[surface]]");
    for (const toml::node& element : *parts) {
      if (!element.is_table())
        parsed_file.fail(element, std::string(key.str()) + ": expected a table, got " + files::words_of_value(element));
      (is_surface ? spec.map.surface : spec.map.parts).push_back(part(parsed_file, *element.as_table(), values));
    }
  }
  if (spec.map.parts.empty()) throw Error(file, "expected at least one [[part]], got none");
  return spec;
}

}  // namespace

Spec read_spec(const fs::path& file) {
  return spec_of(file, Values::coefficients);
}

HeightMap read_heights(const fs::path& file) {
  return spec_of(file, Values::heights).map;
}

std::uint32_t PartLines::of(std::string parameter) const {
  if (parameter.find("knot") != std::string::npos) parameter = "knots";
  if (parameter.starts_with("centre ")) parameter.erase(0, std::string("centre ").size());
  std::replace(parameter.begin(), parameter.end(), ' ', '_');
  for (const char* unit : {"", "_mm", "_rad", "_rad_per_mm"})
    if (const auto found = keys.find(parameter + unit); found != keys.end()) return found->second;
  return part;
}

Lines lines_of_parts(const fs::path& file) {
  const files::TomlFile parsed_file = parsed(file);
  const toml::table& root = parsed_file.document().root();
  const auto lines = [&](const char* list) {
    std::vector<PartLines> all;
    const toml::array* parts = root[list].as_array();
    for (std::size_t i = 0; parts != nullptr && i < parts->size(); ++i) {
      PartLines& lines_of_part = all.emplace_back();
      lines_of_part.part = (*parts)[i].source().begin.line;
      if (const toml::table* keys = (*parts)[i].as_table())
        for (const auto& [key, value] : *keys) lines_of_part.keys[std::string(key.str())] = value.source().begin.line;
    }
    return all;
  };
  return {lines("part"), lines("surface")};
}

}  // namespace forceshade::heights
