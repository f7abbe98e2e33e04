// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/weld.h"

#include <bit>

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

}  // namespace forceshade::mesh
