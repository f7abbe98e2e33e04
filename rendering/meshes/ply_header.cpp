// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/ply_header.h"

#include <array>
#include <utility>

#include "rendering/meshes/readers.h"
#include "text/number_text.h"

namespace forceshade::mesh::ply {
namespace {

template <class T>
double number_of(Bytes& bytes) {
  return static_cast<double>(bytes.take<T>());
}

constexpr std::array<Type, 8> kTypes{{{"char", "int8", 1, true, &number_of<std::int8_t>},
                                      {"uchar", "uint8", 1, true, &number_of<std::uint8_t>},
                                      {"short", "int16", 2, true, &number_of<std::int16_t>},
                                      {"ushort", "uint16", 2, true, &number_of<std::uint16_t>},
                                      {"int", "int32", 4, true, &number_of<std::int32_t>},
                                      {"uint", "uint32", 4, true, &number_of<std::uint32_t>},
                                      {"float", "float32", 4, false, &number_of<float>},
                                      {"double", "float64", 8, false, &number_of<double>}}};

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
constexpr std::array<Named, 3> kListsOfFace{
    {{"vertex_indices", Role::indices}, {"vertex_index", Role::indices}, {"texcoord", Role::corner_texture}}};
constexpr std::array<Named, 2> kOfFace{{{"material", Role::material}, {"material_index", Role::material}}};

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
    const auto count = number_in<std::uint64_t>(word);
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
    if (element.name == "face" || element.name == kStrips) find(kListsOfFace, true);
    if (element.name == "face" && property.type->is_whole) find(kOfFace, false);
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
      if (element.name == "face" || element.name == kStrips) {
        has_faces = element.has(Role::indices);
        if (!has_faces) throw Error(file_, "has faces without the list vertex_indices");
        if (!has_vertices) throw Error(file_, "has no vertices in front of the faces");
      }
    }
    if (!has_vertices || !has_faces) throw Error(file_, "declares no element vertex, or neither face nor tristrips");
  }

  Lines& lines_;
  std::filesystem::path file_;
  Words words_{""};
  PlyHeader header_;
};

}  // namespace

PlyHeader read_header(Lines& lines, const std::filesystem::path& file) {
  return HeaderReader(lines, file).read();
}

}  // namespace forceshade::mesh::ply
