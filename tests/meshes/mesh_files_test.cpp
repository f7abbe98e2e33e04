// SPDX-License-Identifier: BSD-3-Clause
// Meshes from files: what is read, and the words in which the rest is refused.

#include <gtest/gtest.h>

#include <cmath>

#include "forceshade/meshes/load.h"
#include "forceshade/tests/support/temporary_directory.h"

namespace forceshade::mesh {
namespace {

using tests::TemporaryDirectory;

// A mesh, or the words of the refusal behind the file's name.
struct Loaded {
  LoadedMesh mesh;
  std::string refusal;
};

Loaded of_text(const std::string& name, const std::string& text, Unit unit = Unit::mm) {
  const TemporaryDirectory directory;
  const std::string file = directory.write(name, text);
  try {
    return {load_with_corners(file, unit), ""};
  } catch (const Error& error) {
    const std::string words = error.what();
    EXPECT_TRUE(words.starts_with(file + ": ")) << words;
    return {{}, words.substr(std::min(words.size(), file.size() + 2))};
  }
}

const std::string kFaces = "3 0 1 2\n3 0 2 3\n";

TEST(off, has_its_vertices_and_triangles_in_order) {
  for (const char* head :
       {"OFF\n4 2 0\n", "OFF 4 2 0\n", "OFF 4 2\n", "# a comment\n\nOFF # too\n\n4 2 5 # and here\n", "COFF\r\n4 2 0\r\n"}) {
    const Loaded got = of_text("a.off", std::string(head) + "0 0 0\n1 0 0\r\n1\t1 0\n\n0 1e0 -0 # corner\n" + kFaces);
    EXPECT_EQ(got.refusal, "") << head;
    const std::vector<Vertex> vertices{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    EXPECT_EQ(got.mesh.mesh.vertices, vertices) << head;
    EXPECT_EQ(got.mesh.mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}})) << head;
    EXPECT_TRUE(got.mesh.normals.empty() && got.mesh.texture.empty() && got.mesh.notes.empty()) << head;
  }
}

}  // namespace
}  // namespace forceshade::mesh
