// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/weld.h"

#include <algorithm>
#include <bit>
#include <span>

#include "forceshade/meshes.h"
#include "rendering/half_edges.h"
#include "rendering/meshes/predicates.h"

namespace forceshade::mesh {

std::uint32_t Welder::place_of(const Vertex& vertex) {
  if (2 * (vertices_.size() + 1) > slots_.size()) grow();
  const std::size_t mask = slots_.size() - 1;
  auto slot = static_cast<std::size_t>(hash_of(vertex) & mask);
  for (; slots_[slot] != 0; slot = (slot + 1) & mask)
    if (vertices_[slots_[slot] - 1] == vertex) return slots_[slot] - 1;
  vertices_.push_back(vertex);
  slots_[slot] = static_cast<std::uint32_t>(vertices_.size());
  return slots_[slot] - 1;
}

// Every bit of the coordinates reaches the low bits, which name the slot (the finaliser of MurmurHash3, Appleby 2011).
std::uint64_t Welder::hash_of(const Vertex& vertex) {
  std::uint64_t hash = 0;
  for (const float x : vertex) {
    hash ^= std::bit_cast<std::uint32_t>(x);
    hash ^= hash >> 33;
    hash *= 0xFF51AFD7ED558CCDU;
    hash ^= hash >> 33;
    hash *= 0xC4CEB9FE1A85EC53U;
    hash ^= hash >> 33;
  }
  return hash;
}

void Welder::grow() {
  slots_.assign(slots_.empty() ? 1024 : 2 * slots_.size(), 0);
  const std::size_t mask = slots_.size() - 1;
  for (std::uint32_t i = 0; i < vertices_.size(); ++i) {
    auto slot = static_cast<std::size_t>(hash_of(vertices_[i]) & mask);
    while (slots_[slot] != 0) slot = (slot + 1) & mask;
    slots_[slot] = i + 1;
  }
}

Welded welded(const TriangleMesh& mesh) {
  std::vector<bool> is_used(mesh.vertices.size(), false);
  for (const Triangle& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) is_used[v] = true;
  Welder welder;
  std::vector<std::uint32_t> first, lowest(mesh.vertices.size(), 0);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!is_used[v]) continue;
    const std::uint32_t place = welder.place_of(mesh.vertices[v]);
    if (place == first.size()) first.push_back(v);
    lowest[v] = first[place];
  }
  Welded result{{mesh.vertices, {}}, {}};
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    if (!has_area({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]})) continue;
    result.mesh.triangles.push_back({lowest[a], lowest[b], lowest[c]});
    result.number.push_back(i);
  }
  return result;
}

Sides usual_sides(const CheckedMesh& checked) {
  const auto is_balanced = [](const TriangleMesh& mesh) {
    bool is_so = true;
    for_each_edge(mesh, [&](std::span<const std::uint32_t> half_edges) {
      const auto one_way = std::ranges::count_if(
          half_edges, [&](std::uint32_t h) { return start_of(mesh, h) == start_of(mesh, half_edges[0]); });
      is_so = is_so && 2 * static_cast<std::size_t>(one_way) == half_edges.size();
    });
    return is_so;
  };
  return is_balanced(checked.is_regular() ? checked.mesh() : welded(checked.mesh()).mesh) ? Sides::front : Sides::both;
}

}  // namespace forceshade::mesh
