// SPDX-License-Identifier: BSD-3-Clause
#include "fast/soups/god_object.h"

#include <algorithm>

#include "fast/domain.h"
#include "rendering/mesh_rendering.h"

namespace forceshade::fast::soups {
namespace {

using mesh::Meeting;

// The numbers of each list of a mesh::GodObject, in the order of those of a Place.
struct Kind {
  PlaceKind kind, of_foot;
  mesh::Place place;
  Meeting meeting;
  std::size_t indices, further, parameters;
};
constexpr PlaceKind kNo = PlaceKind::nowhere;
constexpr std::array kKinds{
    Kind{PlaceKind::free, kNo, mesh::Place::free, Meeting::none, 0, 0, 0},
    Kind{PlaceKind::vertex, kNo, mesh::Place::vertex, Meeting::none, 1, 0, 0},
    Kind{PlaceKind::edge, kNo, mesh::Place::edge, Meeting::none, 2, 0, 1},
    Kind{PlaceKind::triangle, kNo, mesh::Place::triangle, Meeting::none, 1, 0, 2},
    Kind{PlaceKind::crossing, kNo, mesh::Place::triangle, Meeting::line, 2, 1, 1},
    Kind{PlaceKind::edges, kNo, mesh::Place::edge, Meeting::edges, 2, 2, 0},
    Kind{PlaceKind::edge_and_triangle, kNo, mesh::Place::edge, Meeting::edge_and_triangle, 2, 1, 0},
    Kind{PlaceKind::triangles, kNo, mesh::Place::triangle, Meeting::triangles, 2, 1, 0},
    Kind{PlaceKind::foot, PlaceKind::triangle, mesh::Place::triangle, Meeting::foot_on_triangle, 1, 0, 0},
    Kind{PlaceKind::foot, PlaceKind::edge, mesh::Place::edge, Meeting::foot_on_edge, 2, 0, 0},
    Kind{PlaceKind::foot, PlaceKind::crossing, mesh::Place::triangle, Meeting::foot_on_line, 2, 1, 0}};

}  // namespace

State state_of(const mesh::GodObject& object) noexcept {
  const auto its = std::ranges::find_if(
      kKinds, [&](const Kind& kind) { return kind.place == object.place && kind.meeting == object.meeting; });
  if (its == kKinds.end()) return {};
  Place place{its->kind, its->of_foot, {}, {}};
  auto number = place.numbers.begin();
  number = std::copy_n(object.index.begin(), its->indices, number);
  number = std::copy_n(object.further.begin(), its->further, number);
  std::copy_n(object.parameter.begin(), its->parameters, number);
  const bool is_free = its->kind == PlaceKind::free;
  if (is_free || its->kind == PlaceKind::foot) {
    // A tick leaves no other position: the integers count on it.
    if (!std::ranges::all_of(object.position, [](float x) { return is_plain(x); })) return {};
    place.position = object.position;
  }
  if (is_free) return {place, {}, false};
  return {place, {object.cell[0], object.side == mesh::Side::back, object.cell[1]}, object.is_slipping};
}

mesh::GodObject object_of(const State& state) noexcept {
  mesh::GodObject object;
  const auto its = std::ranges::find_if(
      kKinds, [&](const Kind& kind) { return kind.kind == state.place.kind && kind.of_foot == state.place.of_foot; });
  if (its == kKinds.end()) return object;
  object.place = its->place;
  object.meeting = its->meeting;
  object.position = state.place.position;
  auto number = state.place.numbers.begin();
  const auto take = [&](std::array<std::uint32_t, 2>& into, std::size_t count) {
    std::copy_n(number, count, into.begin());
    number += static_cast<std::ptrdiff_t>(count);
  };
  take(object.index, its->indices);
  take(object.further, its->further);
  take(object.parameter, its->parameters);
  if (its->kind == PlaceKind::free) return object;
  object.is_slipping = state.is_slipping;
  object.side = state.cell.is_behind ? mesh::Side::back : mesh::Side::front;
  object.cell = {state.cell.triangle, state.cell.piece};
  return object;
}

std::shared_ptr<const Soup> soup_of(const MeshRendering& rendering) {
  std::vector<mesh::Material> materials;
  if (!rendering.materials.list.empty())
    for (std::size_t i = 0; i < rendering.mesh().triangles.size(); ++i)
      materials.push_back(material_of(rendering.materials, i));
  return std::make_shared<const Soup>(
      rendering.mesh(), std::vector{rendering.sides}, materials,
      rendering.shading == mesh::Shading::vertex_scheme ? rendering.normals : mesh::CornerNormals());
}

mesh::Tick SoupSession::tick(const std::array<float, 3>& position) noexcept {
  std::uint64_t in_integers = 0;
  exact_decisions = &in_integers;
  const Tick tick = session_.tick(position);
  exact_decisions = nullptr;
  stage_ = in_integers == 0 ? Stage::binary64 : Stage::wide;
  mesh::Tick result{tick.status, tick.moves, tick.force, object_of(tick.after), tick.damping};
  result.after.is_slipping = result.after.is_slipping && has_friction_;
  return result;
}

}  // namespace forceshade::fast::soups
