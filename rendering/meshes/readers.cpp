// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/readers.h"

#include <cmath>

#include "rendering/meshes/numbers.h"

namespace forceshade::mesh {

void Naming::begin(std::string_view name) {
  if (name == name_) return;
  name_ = name;
  place_ = FaceNames::kNone;
}

void Naming::add(std::size_t before) {
  if (name_.empty()) return;
  if (place_ == FaceNames::kNone) {
    const auto [at, is_new] = places_.emplace(name_, static_cast<std::uint32_t>(named_.names.size()));
    if (is_new) named_.names.push_back(name_);
    place_ = at->second;
  }
  named_.of_triangle.resize(before, FaceNames::kNone);
  named_.of_triangle.push_back(place_);
}

FaceNames Naming::take(std::size_t triangles) {
  if (!named_.names.empty()) named_.of_triangle.resize(triangles, FaceNames::kNone);
  return std::move(named_);
}

void Builder::add_face(std::span<const Corner> corners, std::uint64_t line) {
  ++faces_;
  if (corners.size() > 3) ++split_faces_;
  if (corners.size() > kMostCorners) {
    if (!too_long_) too_long_ = {faces_, line, corners.size()};
    return;
  }
  for (const Corner& corner : corners) {
    if (corner.normal == Corner::kNone && !without_normal_) without_normal_ = faces_;
    if (corner.texture == Corner::kNone && !without_texture_) without_texture_ = faces_;
  }
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const std::array<Corner, 3> triangle{corners[0], corners[i - 1], corners[i]};
    for (Naming* names : {&materials, &groups}) names->add(loaded_.mesh.triangles.size());
    loaded_.mesh.triangles.push_back({triangle[0].vertex, triangle[1].vertex, triangle[2].vertex});
    if (line > 0) loaded_.lines.push_back(line);
    if (!without_normal_)
      loaded_.normals.push_back({normals[triangle[0].normal], normals[triangle[1].normal], normals[triangle[2].normal]});
    if (!without_texture_)
      loaded_.texture.push_back({texture[triangle[0].texture], texture[triangle[1].texture], texture[triangle[2].texture]});
  }
}

LoadedMesh Builder::take(const std::filesystem::path& file) {
  if (too_long_)
    throw Error(file, (too_long_->line > 0 ? "line " + std::to_string(too_long_->line) + ": " : "") + "face " +
                          std::to_string(too_long_->face) + " has " + std::to_string(too_long_->corners) +
                          " corners; expected at most " + std::to_string(kMostCorners) + ": split it into triangles first");
  if (loaded_.mesh.triangles.empty()) throw Error(file, "has no face");
  if (loaded_.mesh.triangles.size() > kMost || vertices.size() > kMost)
    throw Error(file, "has more than " + std::to_string(kMost) + " triangles or vertices");
  if (split_faces_ > 0)
    loaded_.notes.push_back(std::to_string(split_faces_) +
                            " faces with more than 3 corners are split into triangles, each from the face's first corner");
  const auto forget = [&](auto& list, const auto& pool, const auto& without, const char* what) {
    if (!without) return;
    list = {};
    if (!pool.empty())
      loaded_.notes.push_back(std::string(what) + " are not used: face " + std::to_string(*without) + " has none at a corner");
  };
  forget(loaded_.normals, normals, without_normal_, "normals");
  forget(loaded_.texture, texture, without_texture_, "points of the texture");
  loaded_.mesh.vertices = std::move(vertices);
  loaded_.materials = materials.take(loaded_.mesh.triangles.size());
  loaded_.groups = groups.take(loaded_.mesh.triangles.size());
  return std::move(loaded_);
}

std::optional<float> coordinate(float number) {
  if (!(std::fabs(number) <= kLargest)) return std::nullopt;
  return std::fabs(number) < kSmallest ? 0.0F : number;
}

float coordinate_of(const Lines& lines, std::string_view word, Unit unit) {
  const std::optional<float> number = from_decimal(word, unit);
  if (!number) throw lines.unexpected("a coordinate", word);
  const std::optional<float> kept = coordinate(*number);
  if (!kept) throw lines.error(refusal_of_coordinate(in_quotes(word), unit));
  return *kept;
}

float component_of(const Lines& lines, std::string_view word, const files::Decimal& unit) {
  const std::optional<float> number = from_decimal(word, unit);
  const std::optional<float> kept = number ? coordinate(*number) : std::nullopt;
  if (!kept) throw lines.error(refusal_of_component(word.empty() ? "the end of the line" : in_quotes(word), unit));
  return *kept;
}

std::string refusal_of_coordinate(const std::string& got, Unit unit) {
  const std::string refusal = "expected a coordinate within 10000 mm, got ";
  if (unit == Unit::mm) return refusal + got;
  std::string number = got;
  std::erase(number, '"');
  return refusal + number + ' ' + std::string(kUnitNames[static_cast<std::size_t>(unit)]) +
         "; a small mesh that lies far away has to be moved in its file, because a scene moves it only after that";
}

std::string refusal_of_component(const std::string& got, const files::Decimal& unit) {
  if (unit.is_one()) return "expected a number within 10000, got " + got;
  return "expected a point of the texture within 10000 mm, got " + got + " times " + unit.text() + " mm";
}

void expect_room(const std::filesystem::path& file, const std::string& place, std::uint64_t number, const std::string& things,
                 std::uint64_t bytes_each, std::uint64_t bytes) {
  const std::string declared = place + "declares " + std::to_string(number) + ' ' + things;
  if (number > kMost) throw Error(file, declared + "; expected " + std::to_string(kMost) + " at most");
  if (number * bytes_each > bytes)
    throw Error(file, declared + ", more than the file's " + std::to_string(bytes) + " bytes can hold");
}

}  // namespace forceshade::mesh
