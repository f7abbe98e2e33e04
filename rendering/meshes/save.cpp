// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/save.h"

#include <array>
#include <string>

#include "text/number_text.h"

namespace forceshade::mesh {
namespace {

void append(std::string& text, auto number, char end) {
  text.append(number_text(number)) += end;
}

void append_point(std::string& text, const Vertex& vertex) {
  const auto& [x, y, z] = vertex;
  append(text, x, ' ');
  append(text, y, ' ');
  append(text, z, '\n');
}

constexpr std::size_t kMuch = 1 << 16;

// Writes what has come together where it is much, or all.
void flush(std::ostream& out, std::string& text, std::size_t much) {
  if (text.size() < much) return;
  out << text;
  text.clear();
}

}  // namespace

void write_off(std::ostream& out, const TriangleMesh& mesh) {
  std::string text = "OFF\n";
  append(text, mesh.vertices.size(), ' ');
  append(text, mesh.triangles.size(), ' ');
  text += "0\n";
  for (const Vertex& vertex : mesh.vertices) {
    append_point(text, vertex);
    flush(out, text, kMuch);
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    text += "3 ";
    append(text, a, ' ');
    append(text, b, ' ');
    append(text, c, '\n');
    flush(out, text, kMuch);
  }
  flush(out, text, 0);
}

void write_obj(std::ostream& out, const TriangleMesh& mesh, const std::vector<std::array<TexturePoint, 3>>& texture) {
  std::string text;
  for (const Vertex& vertex : mesh.vertices) {
    text += "v ";
    append_point(text, vertex);
    flush(out, text, kMuch);
  }
  for (const auto& points : texture)
    for (const auto& [u, v] : points) {
      text += "vt ";
      append(text, u, ' ');
      append(text, v, '\n');
      flush(out, text, kMuch);
    }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    text += 'f';
    for (std::size_t corner = 0; corner < 3; ++corner) {
      text += ' ';
      append(text, mesh.triangles[i][corner] + std::size_t{1}, '/');
      if (texture.empty())
        text.pop_back();
      else
        text += std::to_string(3 * i + corner + 1);
    }
    text += '\n';
    flush(out, text, kMuch);
  }
  flush(out, text, 0);
}

}  // namespace forceshade::mesh
