// SPDX-License-Identifier: BSD-3-Clause
#include "reference/soups/god_object.h"

#include <algorithm>

#include "reference/soups/force.h"
#include "rendering/mesh_rendering.h"

namespace forceshade::reference::soups {
namespace {

using mesh::Meeting;

struct Kind {
  PlaceKind kind, of_foot;
  mesh::Place place;
  Meeting meeting;
  std::size_t indices, further, parameters;  // the numbers of each, in this order
};
// `crossing` has its corner before its parameter, as `line` of mesh::GodObject.
constexpr std::array kKinds{
    Kind{PlaceKind::free, PlaceKind::free, mesh::Place::free, Meeting::none, 0, 0, 0},
    Kind{PlaceKind::vertex, PlaceKind::free, mesh::Place::vertex, Meeting::none, 1, 0, 0},
    Kind{PlaceKind::edge, PlaceKind::free, mesh::Place::edge, Meeting::none, 2, 0, 1},
    Kind{PlaceKind::triangle, PlaceKind::free, mesh::Place::triangle, Meeting::none, 1, 0, 2},
    Kind{PlaceKind::crossing, PlaceKind::free, mesh::Place::triangle, Meeting::line, 2, 1, 1},
    Kind{PlaceKind::edges, PlaceKind::free, mesh::Place::edge, Meeting::edges, 2, 2, 0},
    Kind{PlaceKind::edge_and_triangle, PlaceKind::free, mesh::Place::edge, Meeting::edge_and_triangle, 2, 1, 0},
    Kind{PlaceKind::triangles, PlaceKind::free, mesh::Place::triangle, Meeting::triangles, 2, 1, 0},
    Kind{PlaceKind::foot, PlaceKind::triangle, mesh::Place::triangle, Meeting::foot_on_triangle, 1, 0, 0},
    Kind{PlaceKind::foot, PlaceKind::edge, mesh::Place::edge, Meeting::foot_on_edge, 2, 0, 0},
    Kind{PlaceKind::foot, PlaceKind::crossing, mesh::Place::triangle, Meeting::foot_on_line, 2, 1, 0}};

class SoupTicks final : public meshes::Ticks {
 public:
  explicit SoupTicks(const MeshRendering& rendering)
      : has_friction_(rendering.contact == mesh::Contact::friction),
        soup_(rendering.mesh(), {rendering.sides}, materials_of(rendering)),
        normals_(rendering.shading == mesh::Shading::vertex_scheme ? rendering.normals : mesh::CornerNormals()) {
    for (std::size_t i = 0; i < rendering.mesh().triangles.size(); ++i)
      stiffness_.push_back(material_of(rendering.materials, i).stiffness.value_or(rendering.stiffness));
  }

  meshes::ExactTick tick(const mesh::GodObject& before, const std::array<float, 3>& position,
                         unsigned most_moves) const override {
    const Tick made = soups::tick(soup_, state_of(before), position, most_moves);
    meshes::ExactTick tick{{made.status, static_cast<std::uint16_t>(made.moves), {}, object_of(made.after)}, {}};
    tick.tick.after.is_slipping = has_friction_ && made.after.is_slipping;
    if (made.rest) tick.force = exact_force(*made.rest, stiffness_at(*made.rest), normals_);
    return tick;
  }

 private:
  static std::vector<mesh::Material> materials_of(const MeshRendering& rendering) {
    std::vector<mesh::Material> all;
    if (!rendering.materials.list.empty())
      for (std::size_t i = 0; i < rendering.mesh().triangles.size(); ++i) all.push_back(material_of(rendering.materials, i));
    return all;
  }
  // The largest of the triangles that hold r.
  float stiffness_at(const Rest& rest) const {
    float largest = 0;
    for (const Triangle* triangle : rest.r.star->triangles()) largest = std::max(largest, stiffness_[triangle->number]);
    return largest;
  }

  bool has_friction_;
  Soup soup_;
  mesh::CornerNormals normals_;   // none: the force is not shaded
  std::vector<float> stiffness_;  // of each triangle of the file, N/mm
};

}  // namespace

State state_of(const mesh::GodObject& object) {
  if (object.place == mesh::Place::nowhere) return {};
  const auto& its = *std::ranges::find_if(
      kKinds, [&](const Kind& kind) { return kind.place == object.place && kind.meeting == object.meeting; });
  Place place{its.kind, its.of_foot, {}, {}};
  place.numbers.insert(place.numbers.end(), object.index.begin(), object.index.begin() + its.indices);
  place.numbers.insert(place.numbers.end(), object.further.begin(), object.further.begin() + its.further);
  place.numbers.insert(place.numbers.end(), object.parameter.begin(), object.parameter.begin() + its.parameters);
  if (its.kind == PlaceKind::free || its.kind == PlaceKind::foot) place.position = object.position;
  return {place, {object.cell[0], object.side == mesh::Side::back, object.cell[1]}, object.is_slipping};
}

mesh::GodObject object_of(const State& state) {
  mesh::GodObject object;
  if (!state.place) return object;
  const auto& its = *std::ranges::find_if(
      kKinds, [&](const Kind& kind) { return kind.kind == state.place->kind && kind.of_foot == state.place->of_foot; });
  object.place = its.place;
  object.meeting = its.meeting;
  object.position = state.place->position;
  auto number = state.place->numbers.begin();
  const auto take = [&](std::array<std::uint32_t, 2>& into, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) into[i] = static_cast<std::uint32_t>(*number++);
  };
  take(object.index, its.indices);
  take(object.further, its.further);
  take(object.parameter, its.parameters);
  object.is_slipping = state.is_slipping;
  if (its.kind == PlaceKind::free) return object;
  const auto& [triangle, is_behind, piece] = state.cell;
  object.side = is_behind ? mesh::Side::back : mesh::Side::front;
  object.cell = {static_cast<std::uint32_t>(triangle), static_cast<std::uint32_t>(piece)};
  return object;
}

std::unique_ptr<const meshes::Ticks> ticks_of(const MeshRendering& rendering) {
  return std::make_unique<SoupTicks>(rendering);
}

}  // namespace forceshade::reference::soups
