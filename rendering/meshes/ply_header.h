// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The header of a PLY file: the elements, and the properties of each in their order. Included by source files alone.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "rendering/meshes/bytes.h"
#include "rendering/meshes/lines.h"

namespace forceshade::mesh::ply {

struct Type {
  std::string_view name, other_name;
  std::uint64_t bytes;
  bool is_whole;
  double (*take)(Bytes& bytes);  // exact: no number has more than 53 bits
};
// The use of a property.
enum class Role { none, x, y, z, nx, ny, nz, u, v, indices, corner_texture, material };

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

// The element whose lists are strips of triangles, as scanners write it.
inline constexpr std::string_view kStrips = "tristrips";

struct PlyHeader {
  bool is_text = false;
  std::endian order = std::endian::little;
  std::vector<Element> elements;
};

// Leaves `lines` at the end of the header. Throws Error: what is no header, or one of elements that the file cannot hold.
PlyHeader read_header(Lines& lines, const std::filesystem::path& file);

}  // namespace forceshade::mesh::ply
