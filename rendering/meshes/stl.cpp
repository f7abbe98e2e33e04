// SPDX-License-Identifier: BSD-3-Clause
// STL, of 3D Systems: triangles with their coordinates, as text or binary. The format repeats a vertex in every triangle, so
// vertices with equal coordinates are one. The normals are not read: the order of the corners says where the front is.

#include <algorithm>
#include <cctype>
#include <string_view>

#include "files/file_kind.h"
#include "rendering/meshes/bytes.h"
#include "rendering/meshes/lines.h"
#include "rendering/meshes/numbers.h"
#include "rendering/meshes/readers.h"
#include "rendering/meshes/weld.h"
#include "text/letters.h"

namespace forceshade::mesh {
namespace {

constexpr std::uint64_t kHead = 84, kTriangle = 50;  // bytes: a text of 80 and the number of triangles; a triangle

void add_triangle(Builder& builder, Welder& welder, const std::array<Vertex, 3>& vertices, std::uint64_t line) {
  std::array<Corner, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i].vertex = welder.place_of(vertices[i]);
  builder.add_face(corners, line);
}

LoadedMesh taken(Builder& builder, Welder& welder, const std::filesystem::path& file, std::uint64_t triangles) {
  builder.vertices = welder.take();
  const std::size_t count = builder.vertices.size();
  LoadedMesh loaded = builder.take(file);
  loaded.notes.push_back("STL repeats its vertices: of " + std::to_string(3 * triangles) +
                         ", those with equal coordinates are one, " + std::to_string(count) + " in all");
  return loaded;
}

LoadedMesh read_binary(const std::filesystem::path& file, Unit unit, std::uint64_t triangles) {
  Bytes bytes(file, kHead, std::endian::little);
  Builder builder;
  Welder welder;
  builder.reserve_triangles(triangles);
  for (std::uint64_t i = 0; i < triangles; ++i) {
    bytes.skip(12);  // the normal
    std::array<Vertex, 3> vertices;
    for (Vertex& vertex : vertices)
      for (float& x : vertex) {
        const std::uint64_t place = bytes.position();
        const float number = bytes.take<float>();
        const auto kept = coordinate(from_binary(static_cast<double>(number), unit));
        if (!kept) throw bytes.error(place, refusal_of_coordinate(shortest(static_cast<double>(number)), unit));
        x = *kept;
      }
    bytes.skip(2);  // some programs use them for a colour
    add_triangle(builder, welder, vertices, 0);
  }
  return taken(builder, welder, file, triangles);
}

// Lines: each begins with its keyword, and what a line has more is not read, but for that of a vertex. Words: line ends mean
// nothing, but that a name ends with its line, unless "facet normal" ends it.
enum class StlLayout { lines, words };

class StlText {
 public:
  StlText(const std::filesystem::path& file, Unit unit, StlLayout layout)
      : file_(file), unit_(unit), lines_(file), layout_(layout) {}

  LoadedMesh read() {
    std::uint64_t triangles = 0;
    while (lines_.next_with_words()) {
      words_ = Words(lines_.line());
      expect_word("solid");
      skip_name();
      if (layout_ == StlLayout::lines) expect_no_facet();
      next("facet or endsolid");
      for (; is("facet"); next("facet or endsolid"), ++triangles) {
        const std::uint64_t line = lines_.number();
        expect_word("facet");
        skip_normal();
        next("outer loop");
        expect_word("outer");
        expect_word("loop");
        std::array<Vertex, 3> vertices;
        for (Vertex& vertex : vertices) {
          next("vertex");
          expect_word("vertex");
          for (float& x : vertex) x = coordinate_of(lines_, word(), unit_);
          if (layout_ == StlLayout::words) continue;
          if (const std::string_view more = word(); !more.empty()) throw lines_.unexpected("the end of the line", more);
        }
        next("endloop");
        expect_word("endloop");
        next("endfacet");
        expect_word("endfacet");
        if (layout_ == StlLayout::lines) expect_no_facet();
        add_triangle(builder_, welder_, vertices, line);
      }
      expect_word("endsolid");
      skip_name();
      expect_no_facet();
    }
    if (triangles == 0) throw lines_.ended("at least one face");
    return taken(builder_, welder_, file_, triangles);
  }

 private:
  // Goes to where the next keyword stands.
  void next(const char* expected) {
    if (layout_ == StlLayout::words && !Words(words_).next().empty()) return;
    if (!lines_.next_with_words()) throw lines_.ended(expected);
    words_ = Words(lines_.line());
  }
  // Empty at the end of a line where those count, and of the file.
  std::string_view word() {
    const std::string_view word = words_.next();
    if (!word.empty() || layout_ == StlLayout::lines || !lines_.next_with_words()) return word;
    words_ = Words(lines_.line());
    return words_.next();
  }
  bool is(const char* keyword) const { return small_letters(Words(words_).next()) == keyword; }
  void expect_word(const char* expected) {
    const std::string_view found = word();
    if (small_letters(found) != expected) throw lines_.unexpected(expected, found);
  }
  void expect_no_facet() const {
    if (is("facet")) throw lines_.unexpected("the end of the line", "facet");
  }
  void skip_name() {
    for (Words rest = words_; !Words(words_).next().empty(); rest = words_)
      if (small_letters(words_.next()) == "facet" && is("normal")) {
        words_ = rest;
        return;
      }
  }
  // The word normal and three numbers, in whose place anything may stand.
  void skip_normal() {
    for (int i = 0; layout_ == StlLayout::words && i < 4 && !is("outer"); ++i) word();
  }

  std::filesystem::path file_;
  Unit unit_;
  Lines lines_;
  StlLayout layout_;
  Words words_{""};
  Builder builder_;
  Welder welder_;
};

// The first bytes of a file behind blanks, up to the end of its first triangle, if it is binary.
std::string head_of(const std::filesystem::path& file) {
  std::string head;
  for (Bytes bytes(file, 0, std::endian::little); head.size() < kHead + kTriangle && bytes.left() > 0;) {
    const char byte = bytes.take<char>();
    if (!head.empty() || kBlank.find(byte) == kBlank.npos) head += byte;
  }
  return head;
}

// Many binary files begin with the word solid, too. No text has a zero byte, but a binary file of less than 2^24 triangles has
// one in their number.
bool begins_with_solid(std::string_view head) {
  if (head.starts_with(files::kByteOrderMark)) head.remove_prefix(files::kByteOrderMark.size());
  head.remove_prefix(std::min(head.find_first_not_of(kBlank), head.size()));
  return small_letters(head.substr(0, 5)) == "solid";
}

}  // namespace

// The size decides: a file of the size that it declares is binary.
LoadedMesh read_stl(const std::filesystem::path& file, const FileUnits& units) {
  const std::uint64_t size = size_of(file);
  std::uint64_t triangles = 0;
  if (size >= kHead) {
    triangles = Bytes(file, kHead - 4, std::endian::little).take<std::uint32_t>();
    if (size == kHead + kTriangle * triangles) return read_binary(file, units.length, triangles);
  }
  const std::string head = head_of(file);
  const bool is_text = head.find('\0') == head.npos;
  if (is_text && begins_with_solid(head))
    return in_either_layout([&] { return StlText(file, units.length, StlLayout::lines).read(); },
                            [&] { return StlText(file, units.length, StlLayout::words).read(); });
  if (is_text && std::ranges::all_of(head, [](unsigned char c) { return c >= 0x80 || std::isprint(c) || std::isspace(c); }))
    throw Error(file, "is no STL file: expected the word solid" +
                          std::string(size < kHead ? ", or 84 bytes and more" : ", got another text"));
  if (size < kHead) throw Error(file, "is no STL file: expected the word solid, or 84 bytes and more");
  throw Error(file, "byte 80: declares " + std::to_string(triangles) + " triangles, which take " +
                        std::to_string(kHead + kTriangle * triangles) + " bytes; the file has " + std::to_string(size));
}

}  // namespace forceshade::mesh
