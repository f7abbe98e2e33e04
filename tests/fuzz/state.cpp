// SPDX-License-Identifier: BSD-3-Clause
// The state of a god-object and some positions after it, as bytes: the number of a set of triangles; place, side, slipping,
// meeting; position, index, parameter, further, cell; then positions.

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include "bindings/c/states.h"
#include "forceshade/fast.h"
#include "forceshade/meshes.h"
#include "tests/fuzz/input_file.h"
#include "tests/meshes/soup_paths.h"

namespace {

using namespace forceshade;

struct Numbers {
  std::uint8_t place, side, slipping, meeting;
  float position[3];
  std::uint32_t index[2], parameter[2], further[2], cell[2];
};

// Shaded where there are normals: to compute them under sanitizers takes minutes.
fast::GodObject god_object_on(mesh::TriangleMesh triangles, mesh::CornerNormals normals = {}) {
  const mesh::Shading shading = normals.empty() ? mesh::Shading::none : mesh::Shading::vertex_scheme;
  const auto any = std::get<mesh::CheckedMesh>(mesh::check_any(std::move(triangles)));
  const MeshRendering rendering{.checked = any,
                                .normals = std::move(normals),
                                .sides = mesh::usual_sides(any),
                                .shading = shading,
                                .stiffness = 0.5F,
                                .contact = mesh::Contact::friction,
                                .materials = {{{{}, 0.5F, 0.25F}}, {}}};
  return std::get<fast::GodObject>(fast::GodObject::build(rendering));
}

// A regular mesh, then the stored sets of triangles.
std::vector<fast::GodObject> god_objects() {
  std::vector<fast::GodObject> all{
      god_object_on({{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}})};
  std::set<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(FORCESHADE_SOURCE_DIR "/tests/golden/soups"))
    files.insert(entry.path());
  for (const std::filesystem::path& file : files) {
    tests::SoupPath path = tests::read_soup_path(file);
    all.push_back(god_object_on(std::move(path.mesh), std::move(path.normals)));
  }
  return all;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::vector<fast::GodObject> all = god_objects();
  Numbers numbers{};
  if (size < 1 + sizeof numbers) return 0;
  std::memcpy(&numbers, data + 1, sizeof numbers);
  const fast::GodObject& god_object = all[data[0] % all.size()];
  const auto session = god_object.open(), other = god_object.open();
  const bool is_state = c::is_state(numbers);
  const mesh::GodObject given = c::god_object_of(numbers);
  fuzz::require(is_state || given == mesh::GodObject(), "what is no state is that of a beginning");
  session->resume(given);
  mesh::GodObject held = session->tick({NAN, 0, 0}).after;
  fuzz::require(held.place == mesh::Place::nowhere || held.place == given.place, "a state is taken as it is, or not at all");
  for (std::size_t at = 1 + sizeof numbers; at + sizeof(mesh::Vertex) <= size && at < 400; at += sizeof(mesh::Vertex)) {
    mesh::Vertex position{};
    std::memcpy(&position, data + at, sizeof position);
    const mesh::Tick tick = session->tick(position);
    for (const float component : tick.force) fuzz::require(std::isfinite(component), "a force is a number");
    other->resume(held);
    const mesh::Tick again = other->tick(position);
    fuzz::require(again.force == tick.force && again.status == tick.status && again.after == tick.after,
                  "a state is all that a session remembers");
    held = tick.after;
  }
  return 0;
}
