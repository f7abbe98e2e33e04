// SPDX-License-Identifier: BSD-3-Clause
// OBJ, of Wavefront: lines v x y z, vt u v, vn x y z, and f with the number of each in its list, from 1, or from the end below
// 0. usemtl and g name the faces after them.

#include <algorithm>
#include <array>

#include "rendering/meshes/readers.h"
#include "text/number_text.h"

namespace forceshade::mesh {
namespace {

// The keywords that make no faces: names, points, lines, drawing.
constexpr std::array<std::string_view, 14> kWithoutFaces{
    "o", "s", "mtllib", "usemap", "maplib", "p", "l", "mg", "bevel", "lod", "vp", "c_interp", "shadow_obj", "trace_obj"};

// The place that a number of a face's corner has in its list, which holds `count` so far.
std::optional<std::uint32_t> place_of(std::string_view number, std::size_t count) {
  const std::int64_t index = number_in<std::int64_t>(number).value_or(0), size = static_cast<std::int64_t>(count);
  if (index == 0 || index > size || index < -size) return std::nullopt;
  return static_cast<std::uint32_t>(index > 0 ? index - 1 : size + index);
}

// The text up to the next /, which goes too.
std::string_view part_of(std::string_view& word) {
  const std::size_t slash = std::min(word.find('/'), word.size());
  const std::string_view part = word.substr(0, slash);
  word.remove_prefix(std::min(slash + 1, word.size()));
  return part;
}

class Reader {
 public:
  Reader(const std::filesystem::path& file, const FileUnits& units) : file_(file), units_(units), lines_(file) {}

  LoadedMesh read() {
    while (lines_.next_with_words()) read_line(whole_line());
    if (!builder_.has_faces()) throw lines_.ended("at least one face");
    return builder_.take(file_);
  }

 private:
  // A line that ends in \ goes on in the next one.
  std::string_view whole_line() {
    if (!lines_.line().ends_with('\\')) return lines_.line();
    joined_ = lines_.line();
    while (joined_.ends_with('\\')) {
      joined_.back() = ' ';
      if (!lines_.next()) throw lines_.ended("the line that \\ joins to the one before");
      joined_ += lines_.line().substr(0, lines_.line().find('#'));
      if (joined_.size() > Lines::kLongest)
        throw lines_.error("is joined to more than " + std::to_string(Lines::kLongest) + " bytes");
    }
    return joined_;
  }

  void read_line(std::string_view line) {
    Words words(line);
    const std::string_view keyword = words.next();
    if (keyword == "v") {
      Vertex vertex;
      for (float& x : vertex) x = coordinate_of(lines_, words.next(), units_.length);
      builder_.vertices.push_back(vertex);  // a weight or a colour may follow
    } else if (keyword == "vn") {
      Normal normal;
      for (float& x : normal) x = component_of(lines_, words.next());
      builder_.normals.push_back(normal);
    } else if (keyword == "vt") {
      const float u = component_of(lines_, words.next(), units_.texture);
      const std::string_view v = words.next();
      builder_.texture.push_back({u, v.empty() ? 0.0F : component_of(lines_, v, units_.texture)});
    } else if (keyword == "f") {
      read_face(words);
    } else if (keyword == "usemtl") {
      builder_.materials.begin(words.rest());
    } else if (keyword == "g") {
      builder_.groups.begin(words.rest());
    } else if (std::find(kWithoutFaces.begin(), kWithoutFaces.end(), keyword) == kWithoutFaces.end()) {
      throw lines_.unexpected("v, vt, vn, f or a keyword without faces, such as o, g, s, l, usemtl", keyword);
    }
  }

  void read_face(Words& words) {
    corners_.clear();
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) corners_.push_back(corner_of(word));
    if (corners_.size() < 3)
      throw lines_.error("has a face of " + std::to_string(corners_.size()) + " corners; expected 3 or more");
    builder_.add_face(corners_, lines_.number());
  }

  // "12", "12/7", "12//3" or "12/7/3": vertex, texture, normal.
  Corner corner_of(std::string_view word) const {
    std::string_view rest = word;
    const std::string_view vertex = part_of(rest), texture = part_of(rest), normal = part_of(rest);
    Corner corner;
    const auto find = [&](std::uint32_t& place, std::string_view number, std::size_t count, const char* what) {
      const auto found = place_of(number, count);
      if (!found)
        throw lines_.unexpected("the number of a " + std::string(what) + " above, of which there are " + std::to_string(count),
                                word);
      place = *found;
    };
    find(corner.vertex, vertex, builder_.vertices.size(), "vertex");
    if (!texture.empty()) find(corner.texture, texture, builder_.texture.size(), "point of the texture");
    if (!normal.empty()) find(corner.normal, normal, builder_.normals.size(), "normal");
    if (!rest.empty()) throw lines_.unexpected("a corner such as 12, 12/7, 12//3 or 12/7/3", word);
    return corner;
  }

  std::filesystem::path file_;
  const FileUnits& units_;
  Lines lines_;
  Builder builder_;
  std::string joined_;
  std::vector<Corner> corners_;
};

}  // namespace

LoadedMesh read_obj(const std::filesystem::path& file, const FileUnits& units) {
  return Reader(file, units).read();
}

}  // namespace forceshade::mesh
