// SPDX-License-Identifier: BSD-3-Clause
// Subjects of the C interface: from numbers, freed, and what they are.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <optional>
#include <string>

#include "bindings/c/described.h"
#include "bindings/c/errors.h"
#include "bindings/c/strided.h"
#include "bindings/c/subject.h"
#include "forceshade/meshes.h"
#include "rendering/mesh_rendering.h"
#include "rendering/meshes/readers.h"
#include "subjects/options.h"
#include "text/beginning.h"
#include "text/joined.h"
#include "text/number_text.h"

namespace forceshade::c {
namespace {

// The index of the word among the names; of `usual` where it is null. Nothing for another word, after setting the error text.
template <class Names>
std::optional<std::size_t> choice(const char* what, const char* word, const Names& names, std::size_t usual) {
  if (word == nullptr) return usual;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == word) return i;
  fail(FORCESHADE_BAD_VALUE, std::string(what) + ": expected " + joined(names, ", ", {}, " or ") + ", got \"" +
                                 std::string(beginning_of(word, 64)) + '"');
  return std::nullopt;
}

forceshade_result wrong_size(const char* name, std::size_t got, std::size_t expected) {
  return fail(FORCESHADE_BAD_SIZE, std::string(name) + ".size is " + std::to_string(got) + "; expected sizeof(" + name + "), " +
                                       std::to_string(expected));
}

forceshade_result null(const char* what) noexcept {
  return fail(FORCESHADE_NULL_POINTER, what);
}

// The samples as a grid has them.
forceshade_result read_grid(const forceshade_height_map& map, height::Grid& grid) {
  if (map.columns < 2 || map.rows < 2 || map.columns > kMostAlong || map.rows > kMostAlong ||
      std::int64_t{map.columns} * map.rows > kMostSamples)
    return fail(FORCESHADE_BAD_SIZE, "columns and rows are " + std::to_string(map.columns) + " and " +
                                         std::to_string(map.rows) + "; expected 2 to 32768 each, and 67108864 samples at most");
  if (!is_stride(map.column_stride) || !is_stride(map.row_stride))
    return fail(FORCESHADE_BAD_SIZE, "column_stride and row_stride are " + std::to_string(map.column_stride) + " and " +
                                         std::to_string(map.row_stride) + "; expected multiples of 4");
  grid.columns = map.columns;
  grid.rows = map.rows;
  grid.pitch = map.pitch;
  grid.values.reserve(std::size_t{map.columns} * map.rows);
  for (std::uint32_t row = 0; row < map.rows; ++row)
    for (std::uint32_t column = 0; column < map.columns; ++column) {
      const float height = *at(map.heights, row, map.row_stride, column, map.column_stride);
      if (!(std::fabs(height) <= kLargestHeight))
        return fail(FORCESHADE_BAD_VALUE, "the height of column " + std::to_string(column) + ", row " + std::to_string(row) +
                                              " is " + forceshade::shortest(height) + "; expected -10000 to 10000 mm");
      grid.values.push_back(height);
    }
  return FORCESHADE_OK;
}

forceshade_result new_height_map(const forceshade_height_map& map, forceshade_subject* made) {
  height::Grid grid;
  if (const forceshade_result read = read_grid(map, grid); read != FORCESHADE_OK) return read;
  const auto interpolant = choice("interpolant", map.interpolant, kInterpolants, 1);
  const auto edge = choice("edge", map.edge, kEdges, 0), mode = choice("render", map.render, kModeNames, 0);
  if (!interpolant || !edge || !mode) return FORCESHADE_BAD_VALUE;
  grid.interpolant = static_cast<height::Interpolant>(*interpolant);
  grid.edge = static_cast<height::Edge>(*edge);
  return add_subject(described(std::move(grid), height::kModes[*mode].mode, map.stiffness), made);
}

// The end of the struct in programs that were built before a mesh had materials.
constexpr std::size_t kWithoutMaterials = offsetof(forceshade_mesh, materials);

// The struct of the program, as far as it goes; what it does not have is 0.
forceshade_mesh known_of(const forceshade_mesh& given) {
  forceshade_mesh known{};
  std::memcpy(&known, &given, std::min(given.size, sizeof known));
  return known;
}

forceshade_result read_materials(const forceshade_mesh& its, mesh::Materials& all) {
  if (its.material_count == 0) return FORCESHADE_OK;
  if (its.materials == nullptr) return null("mesh->materials is NULL");
  const std::size_t size = its.materials->size;  // of each, in a program that was built with a newer header, too
  if (size < sizeof(forceshade_material)) return wrong_size("forceshade_material", size, sizeof(forceshade_material));
  for (std::size_t i = 0; i < its.material_count; ++i) {
    forceshade_material one;
    std::memcpy(&one, reinterpret_cast<const char*>(its.materials) + i * size, sizeof one);
    if (one.size != size) return wrong_size("forceshade_material", one.size, size);
    all.list.push_back(
        {one.stiffness == 0 ? std::nullopt : std::optional(one.stiffness), one.static_friction, one.dynamic_friction});
  }
  if (its.material_of_triangle != nullptr)
    all.of_triangle.assign(its.material_of_triangle, its.material_of_triangle + its.triangle_count);
  return FORCESHADE_OK;
}

forceshade_result new_mesh(const forceshade_mesh& its, forceshade_subject* made) {
  mesh::TriangleMesh triangles;
  if (its.vertex_count > mesh::kMost || its.triangle_count > mesh::kMost)  // before any of them is read
    return fail(FORCESHADE_BAD_SIZE, "vertex_count and triangle_count are " + std::to_string(its.vertex_count) + " and " +
                                         std::to_string(its.triangle_count) + "; expected " + std::to_string(mesh::kMost) +
                                         " at most");
  triangles.vertices.resize(its.vertex_count);
  for (std::size_t i = 0; i < its.vertex_count; ++i) std::copy_n(its.vertices + 3 * i, 3, triangles.vertices[i].begin());
  triangles.triangles.resize(its.triangle_count);
  for (std::size_t i = 0; i < its.triangle_count; ++i) std::copy_n(its.triangles + 3 * i, 3, triangles.triangles[i].begin());
  mesh::Materials materials;
  if (const forceshade_result read = read_materials(its, materials); read != FORCESHADE_OK) return read;
  const mesh::Contact usual = has_friction(materials) ? mesh::Contact::friction : mesh::kUsualContact;
  const auto contact = choice("contact", its.contact, mesh::kContactNames, static_cast<std::size_t>(usual));
  if (!contact) return FORCESHADE_BAD_VALUE;
  const auto rule = static_cast<mesh::Contact>(*contact);
  const auto shading = choice("shading", its.shading, shading_names(), has_corner_normals(rule) ? 0 : 1);
  const auto sides = choice("sides", its.sides, mesh::kSidesNames, 0);
  if (!shading || !sides) return FORCESHADE_BAD_VALUE;
  if (!(its.crease >= 0 && its.crease <= 180))
    return fail(FORCESHADE_BAD_VALUE, "crease is " + forceshade::shortest(its.crease) + "; expected 0 to 180 degrees");
  const auto checked = mesh::check_any(std::move(triangles));
  if (const auto* findings = std::get_if<mesh::Findings>(&checked))
    return fail(FORCESHADE_BAD_VALUE, "the mesh cannot be rendered: " + findings->words());
  const auto& any = std::get<mesh::CheckedMesh>(checked);
  const auto scheme = static_cast<mesh::Shading>(*shading);
  if (const std::string words = refusal_of(any, scheme, rule); !words.empty()) return fail(FORCESHADE_BAD_VALUE, words);
  const auto said = its.sides == nullptr ? std::nullopt : std::optional(static_cast<mesh::Sides>(*sides));
  return add_subject(described(any, said, scheme, rule, its.crease, its.stiffness, std::move(materials)), made);
}

}  // namespace
}  // namespace forceshade::c

using namespace forceshade::c;

forceshade_result forceshade_law_new(const char* law, const forceshade_law* parameters, forceshade_subject* made) {
  return guarded([&]() -> forceshade_result {
    if (law == nullptr || parameters == nullptr || made == nullptr) return null("law, parameters or made is NULL");
    if (parameters->size < sizeof(forceshade_law))
      return wrong_size("forceshade_law", parameters->size, sizeof(forceshade_law));
    const auto id = forceshade::law_named(law);
    if (!id)
      return fail(FORCESHADE_BAD_VALUE, "law: expected " + forceshade::subjects::expected_law(forceshade::subjects::Laws::one) +
                                            ", got \"" + std::string(forceshade::beginning_of(law, 64)) + '"');
    return add_subject({law, forceshade::DescribedLaw{*id, {parameters->radius, parameters->width, parameters->stiffness}}},
                       made);
  });
}

forceshade_result forceshade_height_map_new(const forceshade_height_map* map, forceshade_subject* made) {
  return guarded([&] {
    if (map == nullptr || made == nullptr) return null("map or made is NULL");
    if (map->size < sizeof(forceshade_height_map))
      return wrong_size("forceshade_height_map", map->size, sizeof(forceshade_height_map));
    return map->heights == nullptr ? null("map->heights is NULL") : new_height_map(*map, made);
  });
}

forceshade_result forceshade_mesh_new(const forceshade_mesh* mesh, forceshade_subject* made) {
  return guarded([&] {
    if (mesh == nullptr || made == nullptr) return null("mesh or made is NULL");
    if (mesh->size != kWithoutMaterials && mesh->size < sizeof(forceshade_mesh))
      return wrong_size("forceshade_mesh", mesh->size, sizeof(forceshade_mesh));
    const forceshade_mesh known = known_of(*mesh);
    if (known.vertices == nullptr || known.triangles == nullptr) return null("mesh->vertices or mesh->triangles is NULL");
    return new_mesh(known, made);
  });
}

forceshade_result forceshade_subject_free(forceshade_subject subject) {
  return guarded([&]() -> forceshade_result {
    if (forceshade::c::subjects.table.take(subject.handle) != nullptr) return FORCESHADE_OK;
    return bad_subject();
  });
}

forceshade_result forceshade_subject_text(forceshade_subject subject, int32_t what, char* text, size_t size, size_t* length) {
  return guarded([&]() -> forceshade_result {
    const Subject* const its = subject_of(subject);
    if (its == nullptr) return bad_subject();
    if (const forceshade_result wrong = check_room(text, size); wrong != FORCESHADE_OK) return wrong;
    const auto words = [&]() -> std::optional<std::string> {
      switch (what) {
        case FORCESHADE_KIND: return its->identity.kind;
        case FORCESHADE_NAME: return its->identity.name;
        case FORCESHADE_PARAMETERS: return parameters_in_words(its->identity);
        case FORCESHADE_DIGEST: return its->identity.digest;
        default: return std::nullopt;
      }
    }();
    if (!words)
      return fail(FORCESHADE_BAD_VALUE, "what is " + std::to_string(what) + "; expected FORCESHADE_KIND to FORCESHADE_DIGEST");
    give(*words, text, size, length);
    return FORCESHADE_OK;
  });
}
