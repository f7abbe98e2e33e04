// SPDX-License-Identifier: BSD-3-Clause
// Meshes that others have made are read, checked, repaired and rendered. Skipped where Debian's libcgal-demo is not installed.

#include "tests/meshes/real_meshes.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <optional>

#include "forceshade/meshes.h"
#include "forceshade/reference.h"
#include "properties/mesh_path.h"
#include "tests/meshes/god_object_paths.h"
#include "tests/meshes/rendering.h"
#include "tests/meshes/steps.h"

namespace forceshade::tests {
namespace {

constexpr float kStiffness = 0.5F;

// The kinds of faults, with how often each was found: "7 no_area".
std::string words_of(const mesh::Findings& findings) {
  constexpr std::array<const char*, mesh::kFaults> kNames{"coordinate",   "index",         "empty",        "vertex twice",
                                                          "no area",      "same vertices", "many at edge", "same direction",
                                                          "several fans", "meeting",       "undecided"};
  std::string words;
  for (std::size_t i = 0; i < mesh::kFaults; ++i)
    if (findings.counts[i] > 0) words += (words.empty() ? "" : ", ") + std::to_string(findings.counts[i]) + ' ' + kNames[i];
  return words;
}

// Along a random path both sides have the same states, statuses and forces.
void expect_rendered(const mesh::CheckedMesh& checked, const std::string& name, std::map<std::string, int>& counts) {
  const mesh::TriangleMesh& mesh = checked.mesh();
  const mesh::Sides sides = mesh::facts_of(checked).is_closed() ? mesh::Sides::front : mesh::Sides::both;
  const MeshRendering rendering{
      checked, mesh::corner_normals(checked, 60).normals, sides, mesh::Shading::vertex_scheme, kStiffness, {}};
  const fast::Mesh fast = tests::fast_mesh(rendering);
  const auto reference = tests::built(reference::GodObject::build(rendering));
  properties::MeshPath path(mesh, 1);
  mesh::GodObject state;
  const int ticks = mesh.triangles.size() <= 1000 ? 300 : 60;
  for (int i = 0; i < ticks; ++i) {
    const std::array<float, 3> position = path.next();
    const mesh::Tick expected = reference.step(state, position);
    const mesh::Tick found = fast::step(fast, state, position, kStiffness, mesh::Shading::vertex_scheme);
    ASSERT_TRUE(is_same(found, expected)) << name << ", tick " << i << ": " << show(expected) << ", found " << show(found);
    state = expected.after;
    ++counts[std::string(mesh::kTickStatusNames[static_cast<std::size_t>(expected.status)])];
  }
}

TEST(real_meshes, are_read_checked_repaired_and_rendered) {
  const RealMeshes real;
  if (real.files().empty()) GTEST_SKIP() << "Debian's libcgal-demo is not installed";
  std::map<std::string, int> counts;
  for (const std::string& file : real.files()) {
    const std::string name = std::filesystem::path(file).filename();
    std::optional<mesh::TriangleMesh> loaded;
    try {
      loaded = mesh::load(file, mesh::Unit::mm);
    } catch (const Error& error) {
      const std::string words = error.what();
      EXPECT_TRUE(words.starts_with(file + ": ")) << words;
      std::printf("%-40s %8s  refused: %s\n", name.c_str(), "", words.substr(file.size() + 2).c_str());
      ++counts["refused"];
      continue;
    }
    auto checked = mesh::check(*loaded);
    const auto* findings = std::get_if<mesh::Findings>(&checked);
    std::printf("%-40s %8zu  %s", name.c_str(), loaded->triangles.size(),
                findings == nullptr ? "held" : words_of(*findings).c_str());
    if (findings != nullptr) {
      ++counts["not a mesh"];
      auto again = mesh::check(mesh::repair(*loaded).mesh);
      findings = std::get_if<mesh::Findings>(&again);
      std::printf("; repaired: %s", findings == nullptr ? "held" : words_of(*findings).c_str());
      if (findings == nullptr) ++counts["mended"];
      checked = std::move(again);
    }
    std::printf("\n");
    if (const auto* held = std::get_if<mesh::CheckedMesh>(&checked)) {
      ++counts["rendered"];
      expect_rendered(*held, name, counts);
    }
  }
  for (const auto& [what, count] : counts) std::printf("%s: %d\n", what.c_str(), count);
  for (const char* what : {"refused", "not a mesh", "mended", "rendered", "free", "touching", "invalid"})
    EXPECT_GT(counts[what], 0) << what;
}

}  // namespace
}  // namespace forceshade::tests
