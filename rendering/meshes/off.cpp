// SPDX-License-Identifier: BSD-3-Clause
// OFF, the Geomview Object File Format: the word OFF, the numbers of vertices, faces and edges, then one line for each vertex
// and each face. In front of OFF stand ST where vertices have points of a texture, C where they have colours, N where normals.

#include "rendering/meshes/readers.h"

namespace forceshade::mesh {
namespace {

struct Header {
  bool has_texture = false, has_normals = false;
  std::uint64_t vertices = 0, faces = 0;
};

std::uint64_t number_of(const Lines& lines, std::string_view word, const char* what) {
  const auto number = whole_number(word);
  if (!number) throw lines.unexpected(what, word);
  return *number;
}

Header header_of(Lines& lines, const std::filesystem::path& file) {
  Header header;
  if (!lines.next_with_words()) throw lines.ended("the word OFF");
  Words words(lines.line());
  const std::string_view word = words.next();
  std::string_view kind = word;
  const auto take = [&kind](std::string_view prefix) {
    if (!kind.starts_with(prefix)) return false;
    kind.remove_prefix(prefix.size());
    return true;
  };
  header.has_texture = take("ST");
  take("C");
  header.has_normals = take("N");
  if (kind != "OFF") throw lines.unexpected("OFF, after none or some of ST, C and N", word);
  std::string_view first = words.next();
  if (first == "BINARY") throw lines.error("is OFF BINARY; expected OFF as text");
  if (first.empty()) {
    if (!lines.next_with_words()) throw lines.ended("the numbers of vertices and faces");
    words = Words(lines.line());
    first = words.next();
  }
  header.vertices = number_of(lines, first, "a number of vertices");
  header.faces = number_of(lines, words.next(), "a number of faces");
  if (const std::string_view edges = words.next(); !edges.empty()) number_of(lines, edges, "a number of edges");
  if (const std::string_view more = words.next(); !more.empty()) throw lines.unexpected("the end of the line", more);
  const std::string place = "line " + std::to_string(lines.number()) + ": ";
  // The shortest are "0 0 0" and "3 0 0 0", and the end of the line.
  expect_room(file, place, header.vertices, "vertices", 6, lines.file_size());
  expect_room(file, place, header.faces, "faces", 8, lines.file_size());
  return header;
}

}  // namespace

LoadedMesh read_off(const std::filesystem::path& file, const FileUnits& units) {
  Lines lines(file);
  const Header header = header_of(lines, file);
  Builder builder;
  builder.reserve_vertices(header.vertices);
  builder.reserve_triangles(header.faces);
  for (std::uint64_t i = 0; i < header.vertices; ++i) {
    if (!lines.next_with_words()) throw lines.ended("vertex " + std::to_string(i) + " of " + std::to_string(header.vertices));
    Words words(lines.line());
    Vertex vertex;
    for (float& x : vertex) x = coordinate_of(lines, words.next(), units.length);
    builder.vertices.push_back(vertex);
    if (header.has_normals) {
      Normal normal;
      for (float& x : normal) x = component_of(lines, words.next());
      builder.normals.push_back(normal);
    }
    // Colours, of which there may be any number, stand between normals and the texture, which ends the line.
    if (header.has_texture) {
      std::array<std::string_view, 2> last;
      for (std::string_view word = words.next(); !word.empty(); word = words.next()) last = {last[1], word};
      builder.texture.push_back({component_of(lines, last[0], units.texture), component_of(lines, last[1], units.texture)});
    }
  }
  std::vector<Corner> corners;
  for (std::uint64_t i = 0; i < header.faces; ++i) {
    if (!lines.next_with_words()) throw lines.ended("face " + std::to_string(i) + " of " + std::to_string(header.faces));
    Words words(lines.line());
    const std::string_view count = words.next();
    const auto corner_count = whole_number(count);
    if (!corner_count || *corner_count < 3) throw lines.unexpected("a number of corners of 3 or more", count);
    corners.clear();
    for (std::uint64_t k = 0; k < *corner_count; ++k) {
      const std::string_view word = words.next();
      const auto index = whole_number(word);
      if (!index || *index >= header.vertices)
        throw lines.unexpected("the index of a vertex, below " + std::to_string(header.vertices), word);
      const auto vertex = static_cast<std::uint32_t>(*index);
      corners.push_back({vertex, header.has_normals ? vertex : Corner::kNone, header.has_texture ? vertex : Corner::kNone});
    }
    builder.add_face(corners, lines.number());  // a colour may follow
  }
  if (lines.next_with_words()) throw lines.unexpected("the end of the file after the last face", lines.line());
  if (!builder.has_faces()) throw lines.ended("a face, of which there is none");
  return builder.take(file);
}

}  // namespace forceshade::mesh
