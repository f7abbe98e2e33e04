// SPDX-License-Identifier: BSD-3-Clause
// Renders a mesh from a file, and tests the renderer, as a stranger would: meshes_consumer MESH.off.

#include <forceshade/meshes.h>
#include <forceshade/properties.h>

#include <cstdio>

int main(int, char** arguments) {
  using namespace forceshade;
  const auto checked = mesh::check(mesh::load(arguments[1], mesh::Unit::mm));
  if (const auto* findings = std::get_if<mesh::Findings>(&checked)) return std::puts(findings->words().c_str()), 1;
  const auto& mesh = std::get<mesh::CheckedMesh>(checked);
  MeshRendering rendering{mesh, mesh::corner_normals(mesh, 180).normals, mesh::Sides::front, mesh::Shading::vertex_scheme,
                          0.5F};
  if (!mesh::facts_of(mesh).is_closed()) rendering.sides = mesh::Sides::both;
  const auto subject = properties::mesh_subject("a mesh", rendering);
  const auto session = subject->renderer().open();
  session->step({2, 2, -1});
  const Eigen::Vector3f force = session->step({2, 2, 1}).force;
  std::printf("%g N\n", static_cast<double>(force.norm()));
  bool all = force.norm() > 0.4F;
  for (const properties::PropertyResult& result : properties::run_properties(*subject, 20, 1)) {
    std::printf("%s: %s\n", result.name.c_str(), result.held ? "holds" : result.counterexample.c_str());
    all = all && result.held;
  }
  return all ? 0 : 1;
}
