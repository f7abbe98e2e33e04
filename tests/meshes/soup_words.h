// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Ticks of the real-time side on sets of triangles, as the lines of the stored paths.

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>

#include "fast/soups/session.h"
#include "tests/meshes/soup_paths.h"

namespace forceshade::tests {

inline std::string words(const fast::soups::Place& place) {
  using fast::soups::PlaceKind;
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

// The lowest triangle that holds the state's point.
inline std::uint32_t lowest_triangle(const fast::soups::Soup& soup, const fast::soups::Place& place) {
  fast::soups::Point x = *point_of(soup, place);
  x.forget();
  std::vector<const fast::Face*> all;
  for (const fast::Face& face : soup.faces()) all.push_back(&face);
  std::vector<fast::soups::Star::Held> held;
  find_held(x, all, held);
  return held.front().face->index();
}

// The line of one tick of sessions without and with shading, which share a state.
inline std::string line_of_tick(const fast::soups::Soup& soup, fast::soups::Session& plain, fast::soups::Session& shaded,
                                const std::array<float, 3>& position) {
  const fast::soups::Tick tick = plain.tick(position), other = shaded.tick(position);
  const std::string where = words(position) + ',';
  if (!(tick.after == other.after)) return where + "differs with shading";
  if (tick.status == Status::invalid) return where + 'i';
  std::string text = where + std::to_string(tick.moves) + (tick.status == Status::unfinished ? "u" : "");
  if (tick.status == Status::free) return text;
  const auto& [place, cell, is_slipping] = tick.after;
  text += ',' + words(place) + ',' + (cell.is_behind ? "b" : "f");
  if (cell.piece > 0 || cell.triangle != lowest_triangle(soup, place)) text += ' ' + std::to_string(cell.triangle);
  if (cell.piece > 0) text += ' ' + std::to_string(cell.piece);
  if (tick.force == std::array<float, 3>{} && other.force == std::array<float, 3>{}) return text;
  return text + ',' + words(tick.force) + (tick.force == other.force ? "" : ',' + words(other.force));
}

}  // namespace forceshade::tests
