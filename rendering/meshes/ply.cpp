// SPDX-License-Identifier: BSD-3-Clause
// PLY, of Greg Turk: a header as text that lists the elements and the properties of each, then the elements as text, one in a
// line, or binary in either order of bytes.

#include <algorithm>
#include <cmath>

#include "rendering/meshes/bytes.h"
#include "rendering/meshes/numbers.h"
#include "rendering/meshes/readers.h"

namespace forceshade::mesh {
namespace {

template <class T>
double number_of(Bytes& bytes) {
  return static_cast<double>(bytes.take<T>());
}

struct Type {
  std::string_view name, other_name;
  std::uint64_t bytes;
  bool is_whole;
  double (*take)(Bytes& bytes);  // exact: no number has more than 53 bits
};
constexpr std::array<Type, 8> kTypes{{{"char", "int8", 1, true, &number_of<std::int8_t>},
                                      {"uchar", "uint8", 1, true, &number_of<std::uint8_t>},
                                      {"short", "int16", 2, true, &number_of<std::int16_t>},
                                      {"ushort", "uint16", 2, true, &number_of<std::uint16_t>},
                                      {"int", "int32", 4, true, &number_of<std::int32_t>},
                                      {"uint", "uint32", 4, true, &number_of<std::uint32_t>},
                                      {"float", "float32", 4, false, &number_of<float>},
                                      {"double", "float64", 8, false, &number_of<double>}}};

// What a property is for.
enum class Role { none, x, y, z, nx, ny, nz, u, v, indices, corner_texture };

struct Property {
  std::string name;
  const Type* type = nullptr;
  const Type* count_type = nullptr;  // of a list
  Role role = Role::none;
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  bool has(Role role) const {
    return std::any_of(properties.begin(), properties.end(),
                       [role](const Property& property) { return property.role == role; });
  }
};

struct Named {
  std::string_view name;
  Role role;
};
constexpr std::array<Named, 14> kOfVertex{{{"x", Role::x},
                                           {"y", Role::y},
                                           {"z", Role::z},
                                           {"nx", Role::nx},
                                           {"ny", Role::ny},
                                           {"nz", Role::nz},
                                           {"u", Role::u},
                                           {"v", Role::v},
                                           {"s", Role::u},
                                           {"t", Role::v},
                                           {"texture_u", Role::u},
                                           {"texture_v", Role::v},
                                           {"texture_s", Role::u},
                                           {"texture_t", Role::v}}};
constexpr std::array<Named, 3> kOfFace{
    {{"vertex_indices", Role::indices}, {"vertex_index", Role::indices}, {"texcoord", Role::corner_texture}}};

struct PlyHeader {
  bool is_text = false;
  std::endian order = std::endian::little;
  std::vector<Element> elements;
};

class HeaderReader {
 public:
  HeaderReader(Lines& lines, const std::filesystem::path& file) : lines_(lines), file_(file) {}

  PlyHeader read() {
    if (!next() || take() != "ply") throw Error(file_, "is no PLY file: expected the word ply in its first line");
    if (!next() || take() != "format") throw lines_.unexpected("format", lines_.line());
    read_format();
    while (true) {
      if (!next()) throw lines_.ended("end_header");
      const std::string_view word = take();
      if (word == "end_header") break;
      if (word == "element") {
        read_element();
      } else if (word == "property") {
        read_property();
      } else if (word != "comment" && word != "obj_info") {
        throw lines_.unexpected("comment, element, property or end_header", word);
      }
    }
    check();
    return std::move(header_);
  }

 private:
  bool next() {
    if (!lines_.next()) return false;
    words_ = Words(lines_.line());
    return true;
  }
  std::string_view take() { return words_.next(); }

  void read_format() {
    const std::string_view word = take();
    header_.is_text = word == "ascii";
    if (word == "binary_big_endian") header_.order = std::endian::big;
    if (!header_.is_text && word != "binary_little_endian" && word != "binary_big_endian")
      throw lines_.unexpected("ascii, binary_little_endian or binary_big_endian", word);
    if (const std::string_view version = take(); version != "1.0") throw lines_.unexpected("version 1.0", version);
  }

  void read_element() {
    Element element;
    element.name = take();
    const std::string_view word = take();
    const auto count = whole_number(word);
    if (!count) throw lines_.unexpected("a number of elements", word);
    element.count = *count;
    expect_room(file_, "line " + std::to_string(lines_.number()) + ": ", element.count, "of element " + in_quotes(element.name),
                1, lines_.file_size());
    for (const Element& other : header_.elements)
      if (other.name == element.name) throw lines_.error("has element " + in_quotes(element.name) + " a second time");
    header_.elements.push_back(std::move(element));
  }

  const Type* type() {
    const std::string_view word = take();
    for (const Type& type : kTypes)
      if (word == type.name || word == type.other_name) return &type;
    throw lines_.unexpected("a type: char, uchar, short, ushort, int, uint, float or double", word);
  }

  void read_property() {
    if (header_.elements.empty()) throw lines_.error("has a property in front of the first element");
    Element& element = header_.elements.back();
    Property property;
    Words rest = words_;
    if (rest.next() == "list") {
      take();
      property.count_type = type();
      if (!property.count_type->is_whole) throw lines_.error("has a list whose length is no whole number");
    }
    property.type = type();
    property.name = take();
    if (property.name.empty()) throw lines_.unexpected("the name of a property", "");
    const auto find = [&](const auto& names, bool is_list) {
      for (const Named& named : names)
        if (property.name == named.name && (property.count_type != nullptr) == is_list) property.role = named.role;
    };
    if (element.name == "vertex") find(kOfVertex, false);
    if (element.name == "face") find(kOfFace, true);
    if (property.role != Role::none && element.has(property.role))
      throw lines_.error("has property " + in_quotes(property.name) + " a second time, or another name of the same");
    if (property.role == Role::indices && !property.type->is_whole) throw lines_.error("has indices that are no whole numbers");
    element.properties.push_back(std::move(property));
  }

  // Checks what is declared against the size of the file.
  void check() const {
    bool has_vertices = false, has_faces = false;
    for (const Element& element : header_.elements) {
      if (element.properties.empty()) throw Error(file_, "has element " + in_quotes(element.name) + " without a property");
      std::uint64_t least = 0;  // bytes of one element
      for (const Property& property : element.properties)
        least += header_.is_text ? 2 : (property.count_type != nullptr ? property.count_type : property.type)->bytes;
      expect_room(file_, "", element.count, "of element " + in_quotes(element.name), least, lines_.file_size());
      if (element.name == "vertex") {
        has_vertices = element.has(Role::x) && element.has(Role::y) && element.has(Role::z);
        if (!has_vertices) throw Error(file_, "has vertices without x, y and z");
      }
      if (element.name == "face") {
        has_faces = element.has(Role::indices);
        if (!has_faces) throw Error(file_, "has faces without the list vertex_indices");
        if (!has_vertices) throw Error(file_, "has no vertices in front of the faces");
      }
    }
    if (!has_vertices || !has_faces) throw Error(file_, "declares no element vertex, or none face");
  }

  Lines& lines_;
  std::filesystem::path file_;
  Words words_{""};
  PlyHeader header_;
};

// The numbers of the body, of which those of both kinds are read in the same order.
class TextBody {
 public:
  TextBody(Lines& lines, Unit unit) : lines_(lines), unit_(unit) {}

  void begin(const Element& element, std::uint64_t i) {
    if (!lines_.next()) throw lines_.ended(element.name + ' ' + std::to_string(i) + " of " + std::to_string(element.count));
    words_ = Words(lines_.line());
  }
  void end() {
    if (const std::string_view more = words_.next(); !more.empty()) throw lines_.unexpected("the end of the line", more);
  }
  float coordinate(const Type&) { return coordinate_of(lines_, words_.next(), unit_); }
  float component(const Type&) { return component_of(lines_, words_.next()); }
  std::uint64_t whole(const Type&, std::uint64_t most, const std::string& what) {
    const std::string_view word = words_.next();
    const auto number = whole_number(word);
    if (!number || *number > most) throw lines_.unexpected(what + ", " + std::to_string(most) + " at most", word);
    return *number;
  }
  void skip(const Type&, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i)
      if (words_.next().empty()) throw lines_.unexpected("a number", "");
  }
  void expect_numbers(std::uint64_t, const Type&) const {}
  void expect_end() {
    while (lines_.next())
      if (!Words(lines_.line()).next().empty())
        throw lines_.unexpected("the end of the file after the last element", lines_.line());
  }
  Error error(const std::string& reason) const { return lines_.error(reason); }
  std::uint64_t line() const { return lines_.number(); }

 private:
  Lines& lines_;
  Unit unit_;
  Words words_{""};
};

class BinaryBody {
 public:
  BinaryBody(const std::filesystem::path& file, std::uint64_t begin, std::endian order, Unit unit)
      : bytes_(file, begin, order), unit_(unit), begin_(begin) {}

  void begin(const Element&, std::uint64_t) { begin_ = bytes_.position(); }
  void end() {}
  float coordinate(const Type& type) { return within(type.take(bytes_), unit_); }
  float component(const Type& type) { return within(type.take(bytes_), Unit::mm); }
  std::uint64_t whole(const Type& type, std::uint64_t most, const std::string& what) {
    const double number = type.take(bytes_);
    if (!(number >= 0 && number <= static_cast<double>(most)))
      throw error("expected " + what + ", " + std::to_string(most) + " at most, got " + words_of(number));
    return static_cast<std::uint64_t>(number);
  }
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
  float within(double number, Unit unit) const {
    const auto kept = mesh::coordinate(from_binary(number, unit));
    if (!kept) throw error("expected a number within 10000 mm, got " + words_of(number));
    return *kept;
  }

  Bytes bytes_;
  Unit unit_;
  std::uint64_t begin_;
};

constexpr std::uint64_t kLongestList = std::uint64_t{1} << 32;

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
  builder.vertices.reserve(element.count);
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
        case Role::u: texture[0] = body.component(type); break;
        case Role::v: texture[1] = body.component(type); break;
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
  builder.reserve(element.count);
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
          const float u = body.component(type);
          texture.push_back({u, body.component(type)});
        }
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

template <class Body>
LoadedMesh read_body(Body& body, const PlyHeader& header, const std::filesystem::path& file) {
  Builder builder;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      read_vertices(body, element, builder);
    } else if (element.name == "face") {
      read_faces(body, element, builder);
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

LoadedMesh read_ply(const std::filesystem::path& file, Unit unit) {
  Lines lines(file);
  const PlyHeader header = HeaderReader(lines, file).read();
  if (header.is_text) {
    TextBody body(lines, unit);
    return read_body(body, header, file);
  }
  BinaryBody body(file, lines.position(), header.order, unit);
  return read_body(body, header, file);
}

}  // namespace forceshade::mesh
