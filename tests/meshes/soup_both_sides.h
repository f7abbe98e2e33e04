// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Ticks of both sides on sets of triangles, in every column as words that can be compared.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "fast/soups/session.h"
#include "reference/soups/god_object.h"
#include "tests/meshes/soup_paths.h"
#include "tests/meshes/uncut.h"

namespace forceshade::tests {

using Position = std::array<float, 3>;

// A tick of either side.
struct SoupTick {
  Status status = Status::invalid;
  std::size_t moves = 0, looks = 0;
  std::string place;                                // as in the stored paths
  Position position{};                              // mm: free: where it is; a foot: of which hand
  std::tuple<std::size_t, bool, std::size_t> cell;  // triangle, seen from behind, piece
  bool is_slipping = false;
  Position force{}, shaded{};  // N

  bool is_free() const { return place == "free"; }
  // The columns of a stored path behind the position. The cell's triangle goes without saying where it is the lowest one.
  std::string line(std::size_t lowest = SIZE_MAX) const {
    if (status == Status::invalid) return "i";
    std::string text = std::to_string(moves) + (status == Status::unfinished ? "u" : "");
    if (status == Status::free) return text;
    const auto& [triangle, is_behind, piece] = cell;
    text += ',' + place + ',' + (is_behind ? "b" : "f");
    if (piece > 0 || triangle != lowest) text += ' ' + std::to_string(triangle);
    if (piece > 0) text += ' ' + std::to_string(piece);
    if (force == Position{} && shaded == Position{}) return text;
    return text + ',' + words(force) + (force == shaded ? "" : ',' + words(shaded));
  }
  // Every column.
  std::string text() const {
    return line() + (is_slipping ? " slips, " : ", ") + place + ", " + words(position) + ", " + words(force) + ", " +
           words(shaded) + ", " + std::to_string(looks) + " looks";
  }
};

// The exact side's session.
class ExactSoup {
 public:
  ExactSoup(const mesh::TriangleMesh& mesh, const std::vector<mesh::Sides>& sides, const std::vector<mesh::Material>& materials,
            mesh::CornerNormals normals, float stiffness)
      : soup_(mesh, sides, materials), normals_(std::move(normals)), stiffness_(stiffness) {}

  SoupTick tick(const Position& position) {
    if (!std::ranges::all_of(position, [](float x) { return std::abs(x) <= 1e4F; })) return {};
    const reference::soups::Tick made = reference::soups::tick(soup_, state_, position);
    state_ = made.after;
    const auto rounded = [&](const mesh::CornerNormals& normals) -> Position {
      if (!made.rest) return {};
      using reference::meshes::nearest_binary32;
      const auto [x, y, z] = exact_force(*made.rest, stiffness_, normals);
      return {nearest_binary32(x), nearest_binary32(y), nearest_binary32(z)};
    };
    const auto& place = *state_.place;
    return {made.status, made.moves,         made.looks,  words(place),     place.position,
            state_.cell, state_.is_slipping, rounded({}), rounded(normals_)};
  }
  // The lowest triangle that holds the state's point, which touches.
  std::size_t lowest() const {
    return reference::soups::Star(soup_, point_of(soup_, *state_.place)).triangles().front()->number;
  }

 private:
  static std::string words(const reference::soups::Place& place) {
    static constexpr std::array kNames{"free", "v", "e", "t", "c", "ee", "ef", "fff", "q"};
    std::string text = kNames[static_cast<std::size_t>(place.kind)];
    if (place.kind == reference::soups::PlaceKind::foot)
      text += std::string(" ") + kNames[static_cast<std::size_t>(place.of_foot)];
    for (const std::size_t number : place.numbers) text += ' ' + std::to_string(number);
    return text;
  }

  reference::soups::Soup soup_;
  mesh::CornerNormals normals_;
  float stiffness_;
  reference::soups::State state_;
};

// The real-time side's sessions without and with shading, which share a state.
class FastSoup {
 public:
  FastSoup(const mesh::TriangleMesh& mesh, const std::vector<mesh::Sides>& sides, const std::vector<mesh::Material>& materials,
           const mesh::CornerNormals& normals, float stiffness)
      : soup(std::make_shared<const fast::soups::Soup>(mesh, sides, materials, normals)),
        plain(soup, stiffness, false),
        shaded(soup, stiffness, !normals.empty()) {}

  SoupTick tick(const Position& position) {
    const fast::soups::Tick tick = plain.tick(position), other = shaded.tick(position);
    EXPECT_TRUE(tick.after == other.after) << words(position);
    const auto& [place, cell, is_slipping] = tick.after;
    return {tick.status, tick.moves, plain.looks(), words(place), place.position, {cell.triangle, cell.is_behind, cell.piece},
            is_slipping, tick.force, other.force};
  }
  std::size_t lowest() const {
    fast::soups::Point x = *point_of(*soup, plain.state().place);
    x.forget();
    std::vector<const fast::Face*> all;
    for (const fast::Face& face : soup->faces()) all.push_back(&face);
    std::vector<fast::soups::Star::Held> held;
    find_held(x, all, held);
    return held.front().face->index();
  }

  std::shared_ptr<const fast::soups::Soup> soup;
  fast::soups::Session plain, shaded;

 private:
  using PlaceKind = fast::soups::PlaceKind;
  static std::string words(const Position& numbers) { return tests::words(numbers); }
  static std::string words(const fast::soups::Place& place) {
    static constexpr std::array kNames{"nowhere", "free", "v", "e", "t", "c", "ee", "ef", "fff", "q"};
    static constexpr std::array<std::size_t, 10> kNumbers{0, 0, 1, 3, 3, 4, 4, 3, 3, 0};
    std::string text = kNames[static_cast<std::size_t>(place.kind)];
    std::size_t count = kNumbers[static_cast<std::size_t>(place.kind)];
    if (place.kind == PlaceKind::foot) {
      text += std::string(" ") + kNames[static_cast<std::size_t>(place.of_foot)];
      count = place.of_foot == PlaceKind::triangle ? 1 : place.of_foot == PlaceKind::edge ? 2 : 3;
    }
    for (std::size_t i = 0; i < count; ++i) text += ' ' + std::to_string(place.numbers[i]);
    return text;
  }
};

// The tick at the end of a path that both sides go.
inline SoupTick last_tick(const mesh::TriangleMesh& mesh, const std::vector<Position>& path,
                          const std::vector<mesh::Sides>& sides = {mesh::Sides::both},
                          const mesh::CornerNormals& normals = {}) {
  ExactSoup exact(mesh, sides, {}, normals, 1);
  FastSoup fast(mesh, sides, {}, normals, 1);
  SoupTick last;
  for (const Position& p : path) {
    last = fast.tick(p);
    EXPECT_EQ(last.text(), exact.tick(p).text());
  }
  return last;
}
inline std::string last_place(const mesh::TriangleMesh& mesh, const std::vector<Position>& path,
                              const std::vector<mesh::Sides>& sides = {mesh::Sides::both},
                              const mesh::CornerNormals& normals = {}) {
  return last_tick(mesh, path, sides, normals).place;
}

}  // namespace forceshade::tests
