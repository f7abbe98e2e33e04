// SPDX-License-Identifier: BSD-3-Clause
// PLY, of Greg Turk: a header as text that lists the elements and the properties of each, then the elements as text, one in a
// line, or binary in either order of bytes.

#include "rendering/meshes/bytes.h"
#include "rendering/meshes/numbers.h"
#include "rendering/meshes/ply_header.h"
#include "rendering/meshes/readers.h"
#include "text/number_text.h"

namespace forceshade::mesh {
namespace {

using namespace ply;

// An element has a line; wrapped, it begins a line, and may go on in others.
enum class PlyLayout { lines, wrapped };

// The numbers of the body, of which those of both kinds are read in the same order.
class TextBody {
 public:
  TextBody(Lines& lines, const FileUnits& units, PlyLayout layout) : lines_(lines), units_(units), layout_(layout) {}

  void begin(const Element& element, std::uint64_t i) {
    if (!next_line()) throw lines_.ended(element.name + ' ' + std::to_string(i) + " of " + std::to_string(element.count));
  }
  void end() {
    if (const std::string_view more = words_.next(); !more.empty()) throw lines_.unexpected("the end of the line", more);
  }
  float coordinate(const Type&) { return coordinate_of(lines_, next(), units_.length); }
  float component(const Type&, const files::Decimal& unit = 1) { return component_of(lines_, next(), unit); }
  float texture(const Type& type) { return component(type, units_.texture); }
  std::uint64_t whole(const Type&, std::uint64_t most, const std::string& what) {
    const std::string_view word = next();
    const auto number = number_in<std::uint64_t>(word);
    if (!number || *number > most) throw lines_.unexpected(what + ", " + std::to_string(most) + " at most", word);
    return *number;
  }
  std::int64_t integer(const Type&, const char* what) {
    const std::string_view word = next();
    if (const auto number = number_in<std::int64_t>(word)) return *number;
    throw lines_.unexpected(what, word);
  }
  void skip(const Type&, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i)
      if (next().empty()) throw lines_.unexpected("a number", "");
  }
  void expect_numbers(std::uint64_t, const Type&) const {}
  void expect_end() {
    if (next_line()) throw lines_.unexpected("the end of the file after the last element", lines_.line());
  }
  Error error(const std::string& reason) const { return lines_.error(reason); }
  std::uint64_t line() const { return lines_.number(); }

 private:
  // Goes to the next line that has a word; false after the last one.
  bool next_line() {
    do
      if (!lines_.next()) return false;
    while (Words(lines_.line()).next().empty());
    words_ = Words(lines_.line());
    return true;
  }
  std::string_view next() {
    const std::string_view word = words_.next();
    return !word.empty() || layout_ == PlyLayout::lines || !next_line() ? word : words_.next();
  }

  Lines& lines_;
  const FileUnits& units_;
  PlyLayout layout_;
  Words words_{""};
};

class BinaryBody {
 public:
  BinaryBody(const std::filesystem::path& file, std::uint64_t begin, std::endian order, const FileUnits& units)
      : bytes_(file, begin, order), units_(units), begin_(begin) {}

  void begin(const Element&, std::uint64_t) { begin_ = bytes_.position(); }
  void end() {}
  float coordinate(const Type& type) {
    const double number = type.take(bytes_);
    const auto kept = mesh::coordinate(from_binary(number, units_.length));
    if (!kept) throw error(refusal_of_coordinate(shortest(number), units_.length));
    return *kept;
  }
  float component(const Type& type, const files::Decimal& unit = 1) {
    const double number = type.take(bytes_);
    const auto kept = mesh::coordinate(from_binary(number, unit));
    if (!kept) throw error(refusal_of_component(shortest(number), unit));
    return *kept;
  }
  float texture(const Type& type) { return component(type, units_.texture); }
  std::uint64_t whole(const Type& type, std::uint64_t most, const std::string& what) {
    const double number = type.take(bytes_);
    if (!(number >= 0 && number <= static_cast<double>(most)))
      throw error("expected " + what + ", " + std::to_string(most) + " at most, got " + shortest(number));
    return static_cast<std::uint64_t>(number);
  }
  std::int64_t integer(const Type& type, const char*) { return static_cast<std::int64_t>(type.take(bytes_)); }
  void skip(const Type& type, std::uint64_t count) { bytes_.skip(count * type.bytes); }
  void expect_numbers(std::uint64_t count, const Type& type) const {
    if (count * type.bytes > bytes_.left())
      throw error("declares a list of " + std::to_string(count) + " numbers; the file is truncated");
  }
  void expect_end() const {
    if (bytes_.left() > 0)
      throw bytes_.error(bytes_.position(),
                         "the file goes on for " + std::to_string(bytes_.left()) + " bytes after its last element");
  }
  // The error of the element that is read.
  Error error(const std::string& reason) const { return bytes_.error(begin_, reason); }
  static std::uint64_t line() { return 0; }

 private:
  Bytes bytes_;
  const FileUnits& units_;
  std::uint64_t begin_;
};

constexpr std::uint64_t kLongestList = std::uint64_t{1} << 32;
// The index that begins another strip: -1, also in a type without a sign.
constexpr std::int64_t kNextStrip = -1, kUnsignedNextStrip = 0xFFFFFFFF;

template <class Body>
void skip_property(Body& body, const Property& property) {
  std::uint64_t count = 1;
  if (property.count_type != nullptr) count = body.whole(*property.count_type, kLongestList, "the length of a list");
  body.skip(*property.type, count);
}

template <class Body>
void read_vertices(Body& body, const Element& element, Builder& builder) {
  const bool has_normals = element.has(Role::nx) && element.has(Role::ny) && element.has(Role::nz);
  const bool has_texture = element.has(Role::u) && element.has(Role::v);
  builder.reserve_vertices(element.count);
  for (std::uint64_t i = 0; i < element.count; ++i) {
    Vertex vertex{};
    Normal normal{};
    TexturePoint texture{};
    body.begin(element, i);
    for (const Property& property : element.properties) {
      const Type& type = *property.type;
      switch (property.role) {
        case Role::x: vertex[0] = body.coordinate(type); break;
        case Role::y: vertex[1] = body.coordinate(type); break;
        case Role::z: vertex[2] = body.coordinate(type); break;
        case Role::nx: normal[0] = body.component(type); break;
        case Role::ny: normal[1] = body.component(type); break;
        case Role::nz: normal[2] = body.component(type); break;
        case Role::u: texture[0] = body.texture(type); break;
        case Role::v: texture[1] = body.texture(type); break;
        default: skip_property(body, property);
      }
    }
    body.end();
    builder.vertices.push_back(vertex);
    if (has_normals) builder.normals.push_back(normal);
    if (has_texture) builder.texture.push_back(texture);
  }
}

template <class Body>
void read_faces(Body& body, const Element& element, Builder& builder) {
  const bool has_corner_texture = element.has(Role::corner_texture);
  const bool has_normals = !builder.normals.empty(), has_texture = !builder.texture.empty() && !has_corner_texture;
  if (has_corner_texture) builder.texture.clear();
  builder.reserve_triangles(element.count);
  std::vector<Corner> corners;
  std::vector<TexturePoint> texture;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    corners.clear();
    texture.clear();
    body.begin(element, i);
    for (const Property& property : element.properties) {
      const Type& type = *property.type;
      if (property.role == Role::indices) {
        const std::uint64_t count = body.whole(*property.count_type, kLongestList, "a number of corners");
        if (count < 3) throw body.error("has a face of " + std::to_string(count) + " corners; expected 3 or more");
        body.expect_numbers(count, type);
        for (std::uint64_t k = 0; k < count; ++k) {
          if (builder.vertices.empty()) throw body.error("has a face, but there is no vertex");
          const auto vertex =
              static_cast<std::uint32_t>(body.whole(type, builder.vertices.size() - 1, "the index of a vertex"));
          corners.push_back({vertex, has_normals ? vertex : Corner::kNone, has_texture ? vertex : Corner::kNone});
        }
      } else if (property.role == Role::corner_texture) {
        const std::uint64_t count = body.whole(*property.count_type, kLongestList, "the length of a list");
        body.expect_numbers(count, type);
        if (count % 2 != 0) throw body.error("has an odd number of numbers for the points of the texture");
        for (std::uint64_t k = 0; k < count / 2; ++k) {
          const float u = body.texture(type);
          texture.push_back({u, body.texture(type)});
        }
      } else if (property.role == Role::material) {
        builder.materials.begin(std::to_string(body.integer(type, "the whole number of a material")));
      } else {
        skip_property(body, property);
      }
    }
    body.end();
    if (!texture.empty() && texture.size() != corners.size())
      throw body.error("has " + std::to_string(texture.size()) + " points of the texture for " +
                       std::to_string(corners.size()) + " corners");
    for (std::size_t k = 0; k < texture.size(); ++k) {
      corners[k].texture = static_cast<std::uint32_t>(builder.texture.size());
      builder.texture.push_back(texture[k]);
    }
    builder.add_face(corners, body.line());
  }
}

// Strips of triangles: each vertex from the third on ends a triangle with the two before it, and every second triangle is
// turned over. -1 begins another strip. A triangle with a vertex twice joins strips and is no face.
template <class Body>
void read_strips(Body& body, const Element& element, Builder& builder) {
  const bool has_normals = !builder.normals.empty(), has_texture = !builder.texture.empty();
  const auto corner = [&](std::uint32_t vertex) {
    return Corner{vertex, has_normals ? vertex : Corner::kNone, has_texture ? vertex : Corner::kNone};
  };
  const auto vertices = static_cast<std::int64_t>(builder.vertices.size());
  for (std::uint64_t i = 0; i < element.count; ++i) {
    body.begin(element, i);
    for (const Property& property : element.properties) {
      if (property.role != Role::indices) {
        skip_property(body, property);
        continue;
      }
      const std::uint64_t count = body.whole(*property.count_type, kLongestList, "the length of a list");
      body.expect_numbers(count, *property.type);
      std::uint64_t length = 0;  // of the strip so far
      std::array<std::uint32_t, 2> last{};
      const auto expect_strip = [&] {
        if (length == 1 || length == 2)
          throw body.error("has a strip of " + std::to_string(length) + " vertices; expected 3 or more");
      };
      for (std::uint64_t k = 0; k < count; ++k) {
        const std::int64_t number = body.integer(*property.type, "the index of a vertex, or -1");
        if (number == kNextStrip || number == kUnsignedNextStrip) {
          expect_strip();
          length = 0;
          continue;
        }
        if (!(number >= 0 && number < vertices))
          throw body.error("has a strip with vertex " + std::to_string(number) + "; expected the index of a vertex, below " +
                           std::to_string(vertices) + ", or -1");
        const auto vertex = static_cast<std::uint32_t>(number);
        const auto [first, second] = last;
        if (++length >= 3 && first != second && second != vertex && first != vertex) {
          const bool is_turned = length % 2 == 0;
          builder.add_face(std::array{corner(is_turned ? second : first), corner(is_turned ? first : second), corner(vertex)},
                           body.line());
        }
        last = {second, vertex};
      }
      expect_strip();
    }
    body.end();
  }
}

template <class Body>
LoadedMesh read_body(Body& body, const PlyHeader& header, const std::filesystem::path& file) {
  Builder builder;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      read_vertices(body, element, builder);
    } else if (element.name == "face") {
      read_faces(body, element, builder);
    } else if (element.name == kStrips) {
      read_strips(body, element, builder);
    } else {
      for (std::uint64_t i = 0; i < element.count; ++i) {
        body.begin(element, i);
        for (const Property& property : element.properties) skip_property(body, property);
        body.end();
      }
    }
  }
  body.expect_end();
  if (!builder.has_faces()) throw body.error("has no face");
  return builder.take(file);
}

}  // namespace

LoadedMesh read_ply(const std::filesystem::path& file, const FileUnits& units) {
  Lines lines(file);
  const PlyHeader header = read_header(lines, file);
  if (!header.is_text) {
    BinaryBody body(file, lines.position(), header.order, units);
    return read_body(body, header, file);
  }
  return in_either_layout(
      [&] {
        TextBody body(lines, units, PlyLayout::lines);
        return read_body(body, header, file);
      },
      [&] {
        Lines again(file);
        TextBody body(again, units, PlyLayout::wrapped);
        return read_body(body, read_header(again, file), file);
      });
}

}  // namespace forceshade::mesh
