// SPDX-License-Identifier: BSD-3-Clause
#include "tests/meshes/god_object_paths.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "files/csv.h"
#include "forceshade/meshes.h"

namespace forceshade::tests {
namespace {

template <class Enumeration, std::size_t count>
Enumeration named(const files::Reader& rows, std::size_t column, const std::array<std::string_view, count>& names,
                  const char* expected) {
  const auto found = std::ranges::find(names, rows.text(column));
  if (found == names.end()) throw rows.unexpected(column, expected);
  return static_cast<Enumeration>(found - names.begin());
}

bool has_rim(const mesh::TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> triangles_of;
  for (const mesh::Triangle& t : mesh.triangles)
    for (const auto& [a, b] : {std::pair(t[0], t[1]), std::pair(t[1], t[2]), std::pair(t[2], t[0])})
      ++triangles_of[std::minmax(a, b)];
  return std::ranges::any_of(triangles_of, [](const auto& edge) { return edge.second == 1; });
}

mesh::Sides sides_of(const std::string& folder, const std::string& name, const mesh::TriangleMesh& mesh) {
  const std::string list = folder + "/meshes.csv";
  if (!std::filesystem::exists(list)) return has_rim(mesh) && name != "pit" ? mesh::Sides::both : mesh::Sides::front;
  std::ifstream in = files::open_input(list);
  files::Reader rows(in, list, {"name", "sides"});
  while (rows.next())
    if (rows.text(0) == name)
      return named<mesh::Sides>(rows, 1, std::array<std::string_view, 2>{"front", "both"}, "front or both");
  throw std::runtime_error(list + ": expected a row for " + name);
}

mesh::CornerNormals read_normals(const std::string& path, std::size_t triangles) {
  std::ifstream in = files::open_input(path);
  files::Reader rows(in, path, {"triangle", "corner", "nx", "ny", "nz"});
  mesh::CornerNormals normals;
  for (std::size_t i = 0; rows.next(); ++i) {
    if (rows.text(0) != std::to_string(i / 3)) throw rows.unexpected(0, "the triangles in order");
    if (rows.text(1) != std::to_string(i % 3)) throw rows.unexpected(1, "the corners 0, 1, 2");
    if (i % 3 == 0) normals.emplace_back();
    normals.back()[i % 3] = {rows.binary32(2), rows.binary32(3), rows.binary32(4)};
  }
  if (normals.size() != triangles) throw std::runtime_error(path + ": expected three normals for each triangle");
  return normals;
}

mesh::Materials read_materials(const std::string& path, std::size_t triangles) {
  std::ifstream in = files::open_input(path);
  files::Reader rows(in, path, {"triangle", "static", "dynamic"});
  mesh::Materials materials;
  for (std::uint32_t i = 0; rows.next(); ++i) {
    if (rows.text(0) != std::to_string(i)) throw rows.unexpected(0, "the triangles in order");
    materials.list.push_back({.static_friction = rows.binary32(1), .dynamic_friction = rows.binary32(2)});
    materials.of_triangle.push_back(i);
  }
  if (materials.list.size() != triangles) throw std::runtime_error(path + ": expected a material for each triangle");
  return materials;
}

// The state that the columns `feature` and `side` describe; where it is free, it has no position yet.
mesh::GodObject read_state(const files::Reader& rows, std::size_t feature, std::size_t side) {
  mesh::GodObject state;
  std::istringstream words(rows.text(feature));
  std::string kind;
  words >> kind;
  if (kind == "-") {
    if (rows.text(side) != "-") throw rows.unexpected(side, "-, as the god-object is free");
    state.place = mesh::Place::free;
    return state;
  }
  state.side = named<mesh::Side>(rows, side, mesh::kSideNames, "front or back");
  if (kind == "v") {
    state.place = mesh::Place::vertex;
    words >> state.index[0];
  } else if (kind == "e") {
    state.place = mesh::Place::edge;
    words >> state.index[0] >> state.index[1] >> state.parameter[0];
  } else if (kind == "t") {
    state.place = mesh::Place::triangle;
    words >> state.index[0] >> state.parameter[0] >> state.parameter[1];
  } else {
    throw rows.unexpected(feature, "v i, e i j m, t i k l or -");
  }
  if (!words || !(words >> std::ws).eof()) throw rows.unexpected(feature, "v i, e i j m, t i k l or -");
  return state;
}

// Every NAME for which both files are there.
std::vector<std::string> names_in(const std::string& folder, const std::string& extension, const std::string& other) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (const std::string file = entry.path().filename(); file.ends_with(extension))
      if (const std::string name = file.substr(0, file.size() - extension.size());
          std::filesystem::exists(folder + "/" + name + other))
        names.push_back(name);
  std::ranges::sort(names);
  return names;
}

// All but the ticks and the materials.
GodObjectPath read_mesh(const std::string& folder, const std::string& name) {
  GodObjectPath path;
  path.name = name;
  const std::string stem = folder + "/" + name;
  path.mesh = mesh::load(stem + ".off", mesh::Unit::mm);
  path.normals = read_normals(stem + ".normals.csv", path.mesh.triangles.size());
  path.sides = sides_of(folder, name, path.mesh);
  return path;
}

// The rows have the bit where the path has materials.
void read_ticks(GodObjectPath& path, const std::string& file) {
  std::ifstream in = files::open_input(file);
  std::vector<std::string> columns{"x_mm", "y_mm", "z_mm", "status", "feature", "side", "moves",
                                   "fx_N", "fy_N", "fz_N", "sx_N",   "sy_N",    "sz_N"};
  const bool has_friction = !path.materials.list.empty();
  if (has_friction) columns.push_back("slipping");
  files::Reader rows(in, path.name + ".csv", columns);
  mesh::GodObject before;
  while (rows.next()) {
    PathTick row;
    row.place = path.name + ".csv:" + std::to_string(rows.line());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      row.position[axis] = rows.binary32(axis);
      row.tick.force[axis] = rows.binary32(7 + axis);
      row.shaded[axis] = rows.binary32(10 + axis);
    }
    row.tick.status = named<Status>(rows, 3, mesh::kTickStatusNames, "a status");
    row.tick.moves = static_cast<std::uint16_t>(rows.binary32(6));
    row.tick.after = read_state(rows, 4, 5);
    if (has_friction) row.tick.after.is_slipping = named<bool>(rows, 13, std::array<std::string_view, 2>{"0", "1"}, "0 or 1");
    if (row.tick.status == Status::invalid) {
      if (feature_text(before) != rows.text(4)) throw rows.unexpected(4, "the state before an invalid position");
      if (before.is_slipping != row.tick.after.is_slipping) throw rows.unexpected(13, "the bit before an invalid position");
      row.tick.after = before;
    } else if ((row.tick.after.place == mesh::Place::free) != (row.tick.status == Status::free)) {
      throw rows.unexpected(4, "- where and only where the status is free");
    } else if (row.tick.after.place == mesh::Place::free) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float coordinate = row.position[axis];
        row.tick.after.position[axis] = std::fabs(coordinate) < 0x1p-30F ? 0 : coordinate;
      }
    }
    before = row.tick.after;
    path.ticks.push_back(std::move(row));
  }
  if (path.ticks.empty()) throw std::runtime_error(file + ": expected rows below the header");
}

}  // namespace

std::vector<std::string> god_object_paths_in(const std::string& folder) {
  return names_in(folder, ".off", ".csv");
}

GodObjectPath read_god_object_path(const std::string& folder, const std::string& name) {
  GodObjectPath path = read_mesh(folder, name);
  read_ticks(path, folder + "/" + name + ".csv");
  return path;
}

std::vector<std::string> friction_paths_in(const std::string& folder) {
  return names_in(folder, ".materials.csv", ".csv");
}

GodObjectPath read_friction_path(const std::string& meshes, const std::string& folder, const std::string& name) {
  GodObjectPath path = read_mesh(meshes, name);
  path.materials = read_materials(folder + "/" + name + ".materials.csv", path.mesh.triangles.size());
  read_ticks(path, folder + "/" + name + ".csv");
  return path;
}

std::string feature_text(const mesh::GodObject& state) {
  const auto text = [](char kind, auto... numbers) {
    std::string all(1, kind);
    (all.append(1, ' ').append(std::to_string(numbers)), ...);
    return all;
  };
  switch (state.place) {
    case mesh::Place::vertex: return text('v', state.index[0]);
    case mesh::Place::edge: return text('e', state.index[0], state.index[1], state.parameter[0]);
    case mesh::Place::triangle: return text('t', state.index[0], state.parameter[0], state.parameter[1]);
    default: return "-";
  }
}

std::string show(const mesh::Tick& tick) {
  std::string text(mesh::kTickStatusNames[static_cast<std::size_t>(tick.status)]);
  text += ", " + feature_text(tick.after) + ", " + std::string(mesh::kSideNames[static_cast<std::size_t>(tick.after.side)]);
  if (tick.after.is_slipping) text += ", slipping";
  text += ", " + std::to_string(tick.moves) + " moves, (";
  for (const float component : tick.force) text += shortest(component) + " ";
  text.back() = ')';
  return text;
}

bool is_same(const mesh::Tick& a, const mesh::Tick& b) {
  const auto bits = [](const mesh::Tick& tick) { return std::bit_cast<std::array<std::uint32_t, 3>>(tick.force); };
  return a.status == b.status && a.moves == b.moves && a.after == b.after && bits(a) == bits(b);
}

}  // namespace forceshade::tests
