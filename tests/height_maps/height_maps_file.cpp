// SPDX-License-Identifier: BSD-3-Clause
#include "tests/height_maps/height_maps_file.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "files/csv.h"

namespace forceshade::tests {
namespace {

std::vector<float> numbers_in(const std::string& text) {
  std::istringstream in(text);
  std::vector<float> numbers;
  for (std::string word; in >> word;) numbers.push_back(std::strtof(word.c_str(), nullptr));
  return numbers;
}

height::Shape grid_of(const std::string& shape, const std::vector<float>& n) {
  const bool is_bilinear = shape.starts_with("bilinear"), is_tiled = shape.ends_with("tile");
  return std::make_shared<const height::Grid>(
      height::Grid{static_cast<std::uint32_t>(n[0]),
                   static_cast<std::uint32_t>(n[1]),
                   n[2],
                   is_tiled ? height::Edge::tile : height::Edge::clamp,
                   is_bilinear ? height::Interpolant::bilinear : height::Interpolant::cubic_spline,
                   {n.begin() + 3, n.end()}});
}

// The numbers of a kind in the order in which include/forceshade/height_map.h has them.
height::Shape shape_of(const std::string& shape, const std::vector<float>& n) {
  const auto named = std::ranges::find(height::kKindNames, shape);
  if (named == height::kKindNames.end()) return grid_of(shape, n);
  const auto index = static_cast<std::size_t>(named - height::kKindNames.begin());
  const auto polygons = [&] {
    height::Polygons polygons;
    for (std::size_t i = 0; i < n.size(); i += 2) polygons.knots.push_back({n[i], n.at(i + 1)});
    return polygons;
  };
  const auto grid = []() -> height::Shape { throw std::invalid_argument("a grid has the name of its interpolant and edge"); };
  std::size_t i = 0;
  return height::shape_of_kind(
      index, [&](const auto&) { return n.at(i++); }, polygons, grid);
}

}  // namespace

std::map<std::string, HeightMap> height_maps_in(const std::string& path) {
  std::ifstream in = files::open_input(path);
  files::Reader rows(in, path, {"map", "use", "negated", "shape", "numbers"});
  std::map<std::string, HeightMap> maps;
  while (rows.next()) {
    HeightMap& map = maps[rows.text(0)];
    (rows.text(1) == "map" ? map.parts : map.surface)
        .push_back({shape_of(rows.text(3), numbers_in(rows.text(4))), rows.text(2) == "1"});
  }
  return maps;
}

}  // namespace forceshade::tests
