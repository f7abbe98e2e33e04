// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Meshes at their places in a scene as one mesh, the ground (docs/scenes.md), with the names of the objects that they are.

#include <cstdint>
#include <string>
#include <vector>

#include "forceshade/meshes.h"
#include "rendering/meshes/placement.h"

namespace forceshade::mesh {

// A part of the ground: its vertices and triangles follow each other in the ground's lists.
struct GroundObject {
  std::string name;  // a terminal can show it
  std::uint32_t first_vertex = 0, first_triangle = 0;
  std::uint64_t triangles = 0;
  std::vector<std::uint64_t> lines;  // LoadedMesh::lines of its file
};

struct Ground {
  // All objects in their order. Materials and groups are named "OBJECT/NAME", and notes begin with the object's name. It has
  // no lines, normals or texture: see GroundObject for the lines.
  LoadedMesh loaded;
  std::vector<GroundObject> objects;

  // Adds an object. False where the ground would then have more triangles or vertices than a mesh can have; it is not added.
  bool add(const std::string& name, LoadedMesh loaded, const scene::Pose& placement);

  // As Findings::words(), with the names of the objects and with the numbers that faces and vertices have in an object's file.
  std::string words(const Findings& findings) const;

  // "object floor, vertex 3", of a vertex of the ground.
  std::string words_of_vertex(std::uint32_t vertex) const;

 private:
  std::string words(const Finding& finding) const;
  const GroundObject& object_of_triangle(std::uint32_t triangle) const;
  const GroundObject& object_of_vertex(std::uint32_t vertex) const;
  std::string words_of_face(std::uint32_t triangle) const;
};

}  // namespace forceshade::mesh
