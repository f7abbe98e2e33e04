// SPDX-License-Identifier: BSD-3-Clause
#include "fast/meshes/grid_point.h"

#include <algorithm>

#include "fast/domain.h"

namespace forceshade::fast {

GridPoint grid_point_of(const Mesh& mesh, const mesh::GodObject& object) noexcept {
  GridPoint grid_point;
  const auto is_vertex = [&](std::uint32_t v) { return v < mesh.vertices() && mesh.first_around(v) != kRim; };
  switch (object.place) {
    case mesh::Place::nowhere: return {};
    case mesh::Place::free:
      // A tick leaves no other position: the exact differences count on it.
      if (!std::ranges::all_of(object.position, [](float x) { return is_plain(x); })) return {};
      grid_point.position = object.position;
      break;
    case mesh::Place::vertex:
      if (!is_vertex(object.index[0])) return {};
      grid_point.half = mesh.first_around(object.index[0]);
      break;
    case mesh::Place::edge: {
      if (!is_vertex(object.index[0]) || object.parameter[0] == 0 || object.parameter[0] >= kGrid) return {};
      const HalfEdge first = mesh.first_around(object.index[0]);
      HalfEdge h = first;
      bool is_found = false, is_turned = false;
      do {
        is_found = mesh.start(next(h)) == object.index[1];
        is_turned = !is_found && mesh.twin(previous(h)) == kRim && mesh.start(previous(h)) == object.index[1];
        if (is_found || is_turned) break;
        h = mesh.around(h);
      } while (h != kRim && h != first);
      if (!is_found && !is_turned) return {};
      grid_point.half = is_turned ? previous(h) : h;
      grid_point.weight[0] = is_turned ? kGrid - object.parameter[0] : object.parameter[0];
      break;
    }
    case mesh::Place::triangle:
      if (object.index[0] >= mesh.faces() || object.parameter[0] == 0 || object.parameter[1] == 0 ||
          object.parameter[0] >= kGrid || object.parameter[1] >= kGrid - object.parameter[0])
        return {};
      grid_point.half = 3 * mesh.face_of_file(object.index[0]);
      grid_point.weight = object.parameter;
      break;
  }
  grid_point.place = object.place;
  grid_point.side = object.side;
  return grid_point;
}

mesh::GodObject object_of(const Mesh& mesh, const GridPoint& grid_point) noexcept {
  mesh::GodObject object;
  object.place = grid_point.place;
  object.side = grid_point.side;
  switch (grid_point.place) {
    case mesh::Place::nowhere: break;
    case mesh::Place::free: object.position = grid_point.position; break;
    case mesh::Place::vertex: object.index[0] = mesh.start(grid_point.half); break;
    case mesh::Place::edge: {
      const std::uint32_t a = mesh.start(grid_point.half), b = mesh.start(next(grid_point.half));
      object.index = a < b ? std::array{a, b} : std::array{b, a};
      object.parameter[0] = a < b ? grid_point.weight[0] : kGrid - grid_point.weight[0];
      break;
    }
    case mesh::Place::triangle:
      object.index[0] = mesh.face(face_of(grid_point.half)).index();
      object.parameter = grid_point.weight;
      break;
  }
  return object;
}

}  // namespace forceshade::fast
