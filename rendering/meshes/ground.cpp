// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/ground.h"

#include <algorithm>

#include "rendering/meshes/findings.h"
#include "rendering/meshes/readers.h"

namespace forceshade::mesh {
namespace {

// Adds the names of an object's faces, in front of which the ground has so many triangles.
void add_names(FaceNames& all, const std::string& object, const FaceNames& its, std::size_t before, std::size_t triangles) {
  if (its.names.empty() && all.names.empty()) return;
  const auto first = static_cast<std::uint32_t>(all.names.size());
  for (const std::string& name : its.names) all.names.push_back(object + '/' + name);
  all.of_triangle.resize(before, FaceNames::kNone);
  for (const std::uint32_t place : its.of_triangle)
    all.of_triangle.push_back(place == FaceNames::kNone ? FaceNames::kNone : first + place);
  all.of_triangle.resize(before + triangles, FaceNames::kNone);
}

// The last object whose first face or vertex is not behind this one.
const GroundObject& object_of(const std::vector<GroundObject>& objects, std::uint32_t index,
                              std::uint32_t GroundObject::*first) {
  return *std::prev(std::ranges::upper_bound(objects, index, {}, first));
}

}  // namespace

bool Ground::add(const std::string& name, LoadedMesh its, const scene::Pose& placement) {
  TriangleMesh& all = loaded.mesh;
  const std::size_t vertices = all.vertices.size(), triangles = all.triangles.size();
  if (vertices + its.mesh.vertices.size() > kMost || triangles + its.mesh.triangles.size() > kMost) return false;
  objects.push_back({name, static_cast<std::uint32_t>(vertices), static_cast<std::uint32_t>(triangles),
                     its.mesh.triangles.size(), std::move(its.lines)});
  const std::vector<Vertex> at_place = placed(std::move(its.mesh.vertices), placement);
  all.vertices.insert(all.vertices.end(), at_place.begin(), at_place.end());
  for (Triangle triangle : its.mesh.triangles) {
    for (std::uint32_t& vertex : triangle) vertex += static_cast<std::uint32_t>(vertices);
    all.triangles.push_back(triangle);
  }
  add_names(loaded.materials, name, its.materials, triangles, its.mesh.triangles.size());
  add_names(loaded.groups, name, its.groups, triangles, its.mesh.triangles.size());
  for (const std::string& note : its.notes) loaded.notes.push_back("object " + name + ": " + note);
  return true;
}

const GroundObject& Ground::object_of_triangle(std::uint32_t triangle) const {
  return object_of(objects, triangle, &GroundObject::first_triangle);
}

const GroundObject& Ground::object_of_vertex(std::uint32_t vertex) const {
  return object_of(objects, vertex, &GroundObject::first_vertex);
}

std::string Ground::words_of_face(std::uint32_t triangle) const {
  const GroundObject& object = object_of_triangle(triangle);
  const std::uint32_t its = triangle - object.first_triangle;
  return "object " + object.name + ", face " + std::to_string(its) +
         (object.lines.empty() ? "" : " (line " + std::to_string(object.lines[its]) + ')');
}

std::string Ground::words_of_vertex(std::uint32_t vertex) const {
  const GroundObject& object = object_of_vertex(vertex);
  return "object " + object.name + ", vertex " + std::to_string(vertex - object.first_vertex);
}

// Objects have no vertex in common, so that only two faces that meet can be of two of them.
std::string Ground::words(const Finding& finding) const {
  const std::vector<std::uint32_t>&triangles = finding.triangles, &vertices = finding.vertices;
  if (triangles.empty() && vertices.empty()) return words_of(finding);
  const GroundObject& object = triangles.empty() ? object_of_vertex(vertices[0]) : object_of_triangle(triangles[0]);
  if (triangles.size() == 2 && &object_of_triangle(triangles[1]) != &object)
    return words_of_face(triangles[0]) + ", and " + words_of_face(triangles[1]) + ", meet, but have no vertex in common";
  Finding its = finding;
  for (std::uint32_t& triangle : its.triangles) triangle -= object.first_triangle;
  for (std::uint32_t& vertex : its.vertices) vertex -= object.first_vertex;
  return "object " + object.name + ": " + words_of(its, object.lines);
}

std::string Ground::words(const Findings& findings) const {
  return words_of(findings, [&](const Finding& finding) { return words(finding); });
}

}  // namespace forceshade::mesh
