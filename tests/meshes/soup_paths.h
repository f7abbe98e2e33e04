// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Stored paths of a god-object on sets of triangles: tests/golden/soups.

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "forceshade/mesh.h"
#include "text/number_text.h"

namespace forceshade::tests {

inline std::string words(const std::array<float, 3>& numbers) {
  return shortest(numbers[0]) + ' ' + shortest(numbers[1]) + ' ' + shortest(numbers[2]);
}

inline float number(const std::string& word) {
  return word == "nan" ? std::nanf("") : std::strtof(word.c_str(), nullptr);
}

struct SoupPath {
  mesh::TriangleMesh mesh;
  std::vector<mesh::Sides> sides;
  mesh::CornerNormals normals;
  std::vector<std::string> ticks;
};

inline SoupPath read_soup_path(const std::filesystem::path& file) {
  SoupPath path;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream text(line);
    std::vector<std::string> all;
    for (std::string word; text >> word;) all.push_back(word);
    if (all[0] == "sides") {
      for (const char c : all[1]) path.sides.push_back(c == 'f' ? mesh::Sides::front : mesh::Sides::both);
    } else if (all[0] == "v") {
      path.mesh.vertices.push_back({number(all[1]), number(all[2]), number(all[3])});
    } else if (all[0] == "t") {
      const auto index = [&](std::size_t i) { return static_cast<std::uint32_t>(std::stoul(all[i])); };
      path.mesh.triangles.push_back({index(1), index(2), index(3)});
      std::array<mesh::Normal, 3> corners{};
      for (std::size_t i = 0; i < 3 && all.size() > 4; ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) corners[i][axis] = number(all[4 + (all.size() > 7 ? 3 * i : 0) + axis]);
      path.normals.push_back(corners);
    } else {
      path.ticks.push_back(line);
    }
  }
  return path;
}

// That of a line of the ticks.
inline std::array<float, 3> position_of(const std::string& line) {
  std::array<std::string, 3> words;
  std::istringstream(line.substr(0, line.find(','))) >> words[0] >> words[1] >> words[2];
  return {number(words[0]), number(words[1]), number(words[2])};
}

}  // namespace forceshade::tests
