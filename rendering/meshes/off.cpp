// SPDX-License-Identifier: BSD-3-Clause
// OFF, the Geomview Object File Format: the word OFF, the numbers of vertices, faces and edges, then the vertices and the
// faces, as words between white space. In front of OFF stand ST where vertices have points of a texture, C where they have
// colours, N where normals.

#include "rendering/meshes/readers.h"
#include "text/number_text.h"

namespace forceshade::mesh {
namespace {

// The layouts of the words, since many files have colours that their first word does not declare. Lines: a vertex or a face has
// a line, at whose end colours may stand. Wrapped: it begins a line, and may go on in others. Words: line ends mean nothing.
enum class Layout { lines, wrapped, words };

class Text {
 public:
  Text(const std::filesystem::path& file, Layout layout) : lines_(file), layout_(layout) {}

  // Goes to where the next thing begins.
  void begin(const std::string& what) {
    if (layout_ == Layout::words && has_more()) return;
    if (!lines_.next_with_words()) throw lines_.ended(what);
    words_ = Words(lines_.line());
  }
  // Empty at the end of a line where those count, and of the file.
  std::string_view next() {
    if (layout_ != Layout::lines && !has_more() && lines_.next_with_words()) words_ = Words(lines_.line());
    return words_.next();
  }
  bool has_more() const { return !Words(words_).next().empty(); }
  void expect_end() {
    if ((layout_ == Layout::words && has_more()) || lines_.next_with_words())
      throw lines_.unexpected("the end of the file after the last face", lines_.line());
  }
  const Lines& lines() const { return lines_; }
  Layout layout() const { return layout_; }

 private:
  Lines lines_;
  Layout layout_;
  Words words_{""};
};

struct Header {
  bool has_texture = false, has_colours = false, has_normals = false;
  std::uint64_t vertices = 0, faces = 0;
};

std::uint64_t number_of(const Lines& lines, std::string_view word, const char* what) {
  const auto number = number_in<std::uint64_t>(word);
  if (!number) throw lines.unexpected(what, word);
  return *number;
}

Header header_of(Text& text, const std::filesystem::path& file) {
  const Lines& lines = text.lines();
  Header header;
  text.begin("the word OFF");
  const std::string_view word = text.next();
  std::string_view kind = word;
  const auto take = [&kind](std::string_view prefix) {
    if (!kind.starts_with(prefix)) return false;
    kind.remove_prefix(prefix.size());
    return true;
  };
  header.has_texture = take("ST");
  header.has_colours = take("C");
  header.has_normals = take("N");
  // The first number may follow without white space, as in the files of ModelNet.
  if (!take("OFF") || (!kind.empty() && !number_in<std::uint64_t>(kind)))
    throw lines.unexpected("OFF, after none or some of ST, C and N", word);
  std::string_view first = kind;
  if (first.empty()) {
    if (!text.has_more()) text.begin("the numbers of vertices and faces");
    first = text.next();
    if (first == "BINARY") throw lines.error("is OFF BINARY; expected OFF as text");
  }
  header.vertices = number_of(lines, first, "a number of vertices");
  header.faces = number_of(lines, text.next(), "a number of faces");
  const bool is_words = text.layout() == Layout::words;
  if (is_words || text.has_more()) number_of(lines, text.next(), "a number of edges");
  if (!is_words && text.has_more()) throw lines.unexpected("the end of the line", text.next());
  const std::string place = "line " + std::to_string(lines.number()) + ": ";
  // The shortest are "0 0 0" and "3 0 0 0", and white space.
  expect_room(file, place, header.vertices, "vertices", 6, lines.file_size());
  expect_room(file, place, header.faces, "faces", 8, lines.file_size());
  return header;
}

void read_vertex(Text& text, const Header& header, const FileUnits& units, Builder& builder) {
  const Lines& lines = text.lines();
  Vertex vertex;
  for (float& x : vertex) x = coordinate_of(lines, text.next(), units.length);
  builder.vertices.push_back(vertex);
  if (header.has_normals) {
    Normal normal;
    for (float& x : normal) x = component_of(lines, text.next());
    builder.normals.push_back(normal);
  }
  if (text.layout() == Layout::words) {
    for (int i = 0; header.has_colours && i < 4; ++i) component_of(lines, text.next());
    if (!header.has_texture) return;
    const float u = component_of(lines, text.next(), units.texture);
    builder.texture.push_back({u, component_of(lines, text.next(), units.texture)});
  } else if (header.has_texture) {
    // Colours, of which there may be any number, stand between normals and the texture, which ends the line.
    std::array<std::string_view, 2> last;
    while (text.has_more()) last = {last[1], text.next()};
    builder.texture.push_back({component_of(lines, last[0], units.texture), component_of(lines, last[1], units.texture)});
  }
}

void read_face(Text& text, const Header& header, Builder& builder, std::vector<Corner>& corners) {
  const Lines& lines = text.lines();
  const std::uint64_t line = lines.number();
  const std::string_view count = text.next();
  const auto corner_count = number_in<std::uint64_t>(count);
  if (!corner_count || *corner_count < 3) throw lines.unexpected("a number of corners of 3 or more", count);
  corners.clear();
  for (std::uint64_t k = 0; k < *corner_count; ++k) {
    const std::string_view word = text.next();
    const auto index = number_in<std::uint64_t>(word);
    if (!index || *index >= header.vertices)
      throw lines.unexpected("the index of a vertex, below " + std::to_string(header.vertices), word);
    const auto vertex = static_cast<std::uint32_t>(*index);
    corners.push_back({vertex, header.has_normals ? vertex : Corner::kNone, header.has_texture ? vertex : Corner::kNone});
  }
  builder.add_face(corners, line);  // a colour may follow
}

LoadedMesh read_as(Layout layout, const std::filesystem::path& file, const FileUnits& units) {
  Text text(file, layout);
  const Header header = header_of(text, file);
  Builder builder;
  builder.reserve_vertices(header.vertices);
  builder.reserve_triangles(header.faces);
  for (std::uint64_t i = 0; i < header.vertices; ++i) {
    text.begin("vertex " + std::to_string(i) + " of " + std::to_string(header.vertices));
    read_vertex(text, header, units, builder);
  }
  std::vector<Corner> corners;
  for (std::uint64_t i = 0; i < header.faces; ++i) {
    text.begin("face " + std::to_string(i) + " of " + std::to_string(header.faces));
    read_face(text, header, builder, corners);
  }
  text.expect_end();
  if (!builder.has_faces()) throw text.lines().ended("at least one face");
  return builder.take(file);
}

}  // namespace

// A file that can be read in no layout is wrong as lines, in which most are written.
LoadedMesh read_off(const std::filesystem::path& file, const FileUnits& units) {
  try {
    return read_as(Layout::lines, file, units);
  } catch (const Error&) {
    for (const Layout layout : {Layout::wrapped, Layout::words}) try {
        return read_as(layout, file, units);
      } catch (const Error&) {
      }
    throw;
  }
}

}  // namespace forceshade::mesh
