// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/meshes/save.h"

#include <array>
#include <charconv>
#include <string>

namespace forceshade::mesh {
namespace {

template <class T>
void append(std::string& text, T number, char end) {
  std::array<char, 48> digits{};
  text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
  text += end;
}

// Writes what has come together where it is much, or all.
void flush(std::ostream& out, std::string& text, std::size_t much) {
  if (text.size() < much) return;
  out << text;
  text.clear();
}

}  // namespace

void write_off(std::ostream& out, const TriangleMesh& mesh) {
  constexpr std::size_t kMuch = 1 << 16;
  std::string text = "OFF\n";
  append(text, mesh.vertices.size(), ' ');
  append(text, mesh.triangles.size(), ' ');
  text += "0\n";
  for (const auto& [x, y, z] : mesh.vertices) {
    append(text, x, ' ');
    append(text, y, ' ');
    append(text, z, '\n');
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

}  // namespace forceshade::mesh
