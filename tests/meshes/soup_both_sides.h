// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Ticks of both sides on sets of triangles, in every column as texts that can be compared.

#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "reference/soups/god_object.h"
#include "tests/meshes/soup_words.h"
#include "tests/meshes/uncut.h"

namespace forceshade::tests {

namespace exact = reference::soups;

using Position = std::array<float, 3>;

inline std::string comparable(const exact::Place& place) {
  std::string text = std::to_string(static_cast<int>(place.kind)) + '/' + std::to_string(static_cast<int>(place.of_foot));
  for (const std::size_t number : place.numbers) text += ' ' + std::to_string(number);
  return text;
}
// The same of the real-time side, whose list begins with `nowhere`.
inline std::string comparable(const fast::soups::Place& place) {
  using fast::soups::PlaceKind;
  const auto kind = [](PlaceKind its) { return std::to_string(its == PlaceKind::nowhere ? 0 : static_cast<int>(its) - 1); };
  std::string text = kind(place.kind) + '/' + kind(place.of_foot);
  const std::string all = words(place);
  std::istringstream in(all);
  for (std::string word; in >> word;)
    if (std::isdigit(static_cast<unsigned char>(word[0])) != 0) text += ' ' + word;
  return text;
}

inline std::string numbers(const Position& force) {
  return words(force);
}
inline Position rounded(const std::array<reference::meshes::RootSum, 3>& force) {
  using reference::meshes::nearest_binary32;
  return {nearest_binary32(force[0]), nearest_binary32(force[1]), nearest_binary32(force[2])};
}

inline std::string text_of(const exact::Tick& tick, float stiffness, const mesh::CornerNormals& normals) {
  std::string text = std::to_string(static_cast<int>(tick.status)) + ' ' + std::to_string(tick.moves) + ' ' +
                     (tick.after.is_slipping ? "slips " : "") + comparable(*tick.after.place) + ' ' +
                     words(tick.after.place->position);
  if (!tick.rest) return text;
  const auto& [triangle, is_behind, piece] = tick.after.cell;
  return text + " | " + std::to_string(triangle) + (is_behind ? "b" : "f") + std::to_string(piece) + " | " +
         numbers(rounded(exact::exact_force(*tick.rest, stiffness))) + " | " +
         numbers(rounded(exact::exact_force(*tick.rest, stiffness, normals)));
}
inline std::string text_of(const fast::soups::Tick& tick, const fast::soups::Tick& shaded) {
  std::string text = std::to_string(static_cast<int>(tick.status)) + ' ' + std::to_string(tick.moves) + ' ' +
                     (tick.after.is_slipping ? "slips " : "") + comparable(tick.after.place) + ' ' +
                     words(tick.after.place.position);
  if (tick.status == Status::free) return text;
  const auto& cell = tick.after.cell;
  return text + " | " + std::to_string(cell.triangle) + (cell.is_behind ? "b" : "f") + std::to_string(cell.piece) + " | " +
         numbers(tick.force) + " | " + numbers(shaded.force);
}

// The state at the end of a path that both sides go.
inline fast::soups::State last_state(const mesh::TriangleMesh& mesh, const std::vector<Position>& path,
                                     const std::vector<mesh::Sides>& sides = {mesh::Sides::both},
                                     const mesh::CornerNormals& normals = {}) {
  const exact::Soup exact_soup(mesh, sides);
  const auto soup = std::make_shared<const fast::soups::Soup>(mesh, sides, std::vector<mesh::Material>{}, normals);
  fast::soups::Session session(soup, 1, false), shaded(soup, 1, !normals.empty());
  exact::State state;
  for (const Position& p : path) {
    const exact::Tick made = exact::tick(exact_soup, state, p);
    state = made.after;
    const fast::soups::Tick its = session.tick(p);
    EXPECT_EQ(text_of(its, shaded.tick(p)), text_of(made, 1, normals));
  }
  return session.state();
}
inline std::string last_place(const mesh::TriangleMesh& mesh, const std::vector<Position>& path) {
  return words(last_state(mesh, path).place);
}

}  // namespace forceshade::tests
