// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One hash per mesh of the god-object's states and forces along a path: as tests/fast/same_bits.h for laws, and by its means.
// Meshes and paths come from bits.

#include <cmath>
#include <memory>
#include <vector>

#include "forceshade/fast.h"
#include "tests/fast/same_bits.h"
#include "tests/meshes/rendering.h"

namespace forceshade::tests {

struct MeshScene {
  const char* name;
  mesh::TriangleMesh mesh;
  mesh::CornerNormals normals;
  mesh::Sides sides;
  mesh::Shading shading;
  mesh::Texture texture = {};
  mesh::Materials materials = {};  // with friction, if any
};

// 12 x 12 cells of 1 mm, of heights up to 2 mm.
inline mesh::TriangleMesh rough_sheet() {
  constexpr std::uint32_t kCells = 12;
  std::mt19937_64 random(3);
  mesh::TriangleMesh sheet;
  for (std::uint32_t j = 0; j <= kCells; ++j)
    for (std::uint32_t i = 0; i <= kCells; ++i)
      sheet.vertices.push_back(
          {static_cast<float>(i) - 6, static_cast<float>(j) - 6, static_cast<float>(random() % 2048) * 0x1p-10F});
  for (std::uint32_t j = 0; j < kCells; ++j)
    for (std::uint32_t i = 0; i < kCells; ++i) {
      const std::uint32_t a = j * (kCells + 1) + i, b = a + 1, c = b + kCells + 1, d = a + kCells + 1;
      sheet.triangles.push_back({a, b, c});
      sheet.triangles.push_back({a, c, d});
    }
  return sheet;
}

inline mesh::TriangleMesh octahedron() {
  return {{{5, 0, 0}, {-5, 0, 0}, {0, 5, 0}, {0, -5, 0}, {0, 0, 5}, {0, 0, -5}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

// At each corner the direction from the origin to the vertex, 3 for its z.
inline mesh::CornerNormals normals_towards(const mesh::TriangleMesh& of) {
  mesh::CornerNormals normals;
  for (const mesh::Triangle& triangle : of.triangles) {
    normals.emplace_back();
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const mesh::Vertex& vertex = of.vertices[triangle[corner]];
      normals.back()[corner] = {vertex[0] * 0.125F, vertex[1] * 0.125F, vertex[2] * 0.375F};
    }
  }
  return normals;
}

// At each corner x and y of its vertex, a little stretched; a dent, a hill and ripples over it.
inline mesh::Texture texture_above(const mesh::TriangleMesh& of) {
  mesh::Texture texture{
      {}, {{{height::Cone{1, 0.5F, 1, 3}, true}, {height::Gaussian{-1, -2, 1, 2}}, {height::Grating{0.125F, 2, 1, 0}}}}};
  for (const mesh::Triangle& triangle : of.triangles) {
    texture.corners.emplace_back();
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const mesh::Vertex& vertex = of.vertices[triangle[corner]];
      texture.corners.back()[corner] = {{1.25F * vertex[0], vertex[1]}, {1.25F, 0, 0.125F * vertex[2]}, {0, 1, 0}};
    }
  }
  return texture;
}

inline std::vector<MeshScene> mesh_scenes() {
  const mesh::TriangleMesh sheet = rough_sheet(), solid = octahedron();
  return {{"mesh-sheet", sheet, {}, mesh::Sides::both, mesh::Shading::none},
          {"mesh-octahedron", solid, {}, mesh::Sides::front, mesh::Shading::none},
          {"mesh-octahedron-shaded", solid, normals_towards(solid), mesh::Sides::front, mesh::Shading::vertex_scheme},
          {"mesh-octahedron-textured", solid, normals_towards(solid), mesh::Sides::front, mesh::Shading::texture_scheme,
           texture_above(solid)},
          {"mesh-sheet-rough", sheet, {}, mesh::Sides::both, mesh::Shading::none, {}, {{{{}, 0.5F, 0.375F}}, {}}},
          {"mesh-octahedron-rough-shaded",
           solid,
           normals_towards(solid),
           mesh::Sides::front,
           mesh::Shading::vertex_scheme,
           {},
           {{{{}, 0.75F, 0.25F}, {{}, HUGE_VALF, 0.125F}, {}}, {0, 1, 2, 0, 1, 2, 0, 1}}}};
}

// Steps of every size within about 8 mm of the origin, jumps, positions of few bits, any bits.
class MeshBits {
 public:
  std::array<float, 3> next() {
    const std::uint64_t kind = random_() % 64;
    for (float& coordinate : at_) {
      const auto bits = static_cast<std::int32_t>(random_());
      const float part = static_cast<float>(bits >> 8);  // of 24 bits
      if (kind == 0) {
        coordinate = part * 0x1p-20F;
      } else if (kind < 4) {
        coordinate = static_cast<float>(bits >> 28);
      } else {
        const float scale = __builtin_bit_cast(float, static_cast<std::uint32_t>(127 - 28 + static_cast<int>(kind % 8)) << 23);
        coordinate += part * scale;
        if (!(coordinate < 8 && coordinate > -8)) coordinate = 0;
      }
    }
    if (kind != 63) return at_;
    return {at_[0], __builtin_bit_cast(float, static_cast<std::uint32_t>(random_())), at_[2]};
  }

 private:
  std::mt19937_64 random_{1996};
  std::array<float, 3> at_{};
};

inline std::unique_ptr<fast::TickSession> session_of(const MeshScene& scene) {
  const mesh::Contact contact = scene.materials.list.empty() ? mesh::kUsualContact : mesh::Contact::friction;
  const MeshRendering rendering{checked(scene.mesh), scene.normals, scene.sides,    scene.shading, 0.7F,
                                scene.texture,       contact,       scene.materials};
  return built(fast::GodObject::build(rendering)).open();
}

inline Bits bits_of(const MeshScene& scene) {
  const auto session = session_of(scene);
  MeshBits positions;
  Hash hash;
  Bits bits{};
  for (int i = 0; i < 100'000; ++i) {
    const mesh::Tick tick = session->tick(positions.next());
    note({{tick.force[0], tick.force[1], tick.force[2]}, tick.status}, hash, bits);
    hash.add(std::uint32_t{tick.moves});
    hash.add(static_cast<std::uint32_t>(tick.after.place) << 8 | static_cast<std::uint32_t>(tick.after.side));
    for (const std::uint32_t number : tick.after.index) hash.add(number);
    for (const std::uint32_t number : tick.after.parameter) hash.add(number);
  }
  bits.hash = hash.hex();
  return bits;
}

// Two meshes, of which each is placed anew in every tick, by quaternions and translations of few bits or of any.
inline Bits bits_of_moving_objects() {
  const std::vector<MeshScene> scenes = mesh_scenes();
  std::vector<std::unique_ptr<fast::Session>> objects;
  objects.push_back(session_of(scenes.front()));
  objects.push_back(session_of(scenes.back()));
  auto session = built(fast::SceneSession::build(std::move(objects)));
  MeshBits positions;
  std::mt19937_64 random(1995);
  std::array<scene::Pose, 2> poses;
  Hash hash;
  Bits bits{};
  for (int i = 0; i < 100'000; ++i) {
    for (scene::Pose& pose : poses) {
      const std::uint64_t kind = random() % 8;
      const float scale = kind == 0 ? 1 : 0x1p-22F;
      const auto draw = [&] {
        return static_cast<std::int32_t>(random() % (kind == 0 ? 5 : 1U << 24)) - (kind == 0 ? 2 : 1 << 23);
      };
      if (kind > 2) continue;  // as it was
      for (float& one : pose.rotation) one = scale * static_cast<float>(draw());
      for (float& one : pose.translation) one = scale * static_cast<float>(draw());
    }
    const std::array<float, 3> p = positions.next();
    note(session.step({p[0], p[1], p[2]}, poses), hash, bits);
    for (std::size_t object = 0; object < poses.size(); ++object)
      for (const float component : session.of(object).force) hash.add(component);
  }
  bits.hash = hash.hex();
  return bits;
}

}  // namespace forceshade::tests
