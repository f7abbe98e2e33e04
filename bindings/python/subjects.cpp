// SPDX-License-Identifier: BSD-3-Clause
// Subjects: from numbers, arrays and files.

#include "forceshade/subjects.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "bindings/python/arrays.h"
#include "bindings/python/interruptible.h"
#include "bindings/python/subject.h"
#include "files/printable.h"
#include "files/quantity.h"
#include "forceshade/error.h"
#include "forceshade/heights.h"
#include "forceshade/meshes.h"
#include "rendering/heights/coefficients.h"
#include "rendering/heights/samples.h"
#include "rendering/mesh_rendering.h"
#include "subjects/materials.h"
#include "subjects/options.h"
#include "subjects/read.h"
#include "text/beginning.h"
#include "text/joined.h"
#include "text/number_text.h"

namespace forceshade::python {
namespace {

// The index of a word among the names.
template <class Names>
std::size_t choice(const char* what, const std::string& word, const Names& names) {
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == word) return i;
  throw py::value_error(std::string(what) + ": expected \"" + joined(names, "\", \"", {}, "\" or \"") + "\", got \"" +
                        std::string(beginning_of(word, 64)) + '"');
}

Description law_of(const std::string& name, float radius, float width, float stiffness) {
  const auto id = law_named(name);
  if (!id)
    throw py::value_error("law: expected " + subjects::expected_law(subjects::Laws::one) + ", got \"" +
                          std::string(beginning_of(name, 64)) + '"');
  return {name, DescribedLaw{*id, {radius, width, stiffness}}};
}

// heights: (rows, columns), from the smallest y and x.
Description map_of_samples(const py::buffer& heights, float pitch, const std::string& interpolant, const std::string& edge,
                           const std::string& render, float stiffness) {
  const py::buffer_info samples = buffer_of<float>(heights);
  if (samples.ndim != 2) throw py::value_error("expected heights (rows, columns)");
  const py::ssize_t rows = samples.shape[0], columns = samples.shape[1];
  if (std::min(rows, columns) < 2 || std::max(rows, columns) > c::kMostAlong || rows * columns > c::kMostSamples)
    throw py::value_error("heights have the shape (" + std::to_string(rows) + ", " + std::to_string(columns) +
                          "); expected 2 to 32768 rows and columns, and 67108864 samples at most");
  height::Grid grid;
  grid.columns = static_cast<std::uint32_t>(columns);
  grid.rows = static_cast<std::uint32_t>(rows);
  grid.pitch = pitch;
  grid.interpolant = static_cast<height::Interpolant>(choice("interpolant", interpolant, c::kInterpolants));
  grid.edge = static_cast<height::Edge>(choice("edge", edge, c::kEdges));
  const height::Mode mode = height::kModes[choice("render", render, c::kModeNames)].mode;
  grid.values.reserve(static_cast<std::size_t>(rows * columns));
  for (std::size_t row = 0; row < grid.rows; ++row) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    for (std::size_t column = 0; column < grid.columns; ++column) {
      const float value = at<float>(samples, row, column);
      if (!(std::fabs(value) <= c::kLargestHeight))
        throw py::value_error("heights[" + std::to_string(row) + ", " + std::to_string(column) + "] is " + shortest(value) +
                              "; expected -10000 to 10000 mm");
      grid.values.push_back(value);
    }
  }
  return interruptible(
      [&](const std::atomic<bool>& stop) { return c::described(std::move(grid), mode, stiffness, Monitor({}, stop)); });
}

// A picture or an array file.
Description map_of_picture(const std::string& file, float pitch, float scale, const std::string& interpolant,
                           const std::string& edge, const std::string& render, float stiffness) {
  const heights::Source source{
      .file = file,
      .pitch = pitch,
      .scale = scale,
      .edge = static_cast<height::Edge>(choice("edge", edge, c::kEdges)),
      .interpolant = static_cast<height::Interpolant>(choice("interpolant", interpolant, c::kInterpolants))};
  const height::Mode mode = height::kModes[choice("render", render, c::kModeNames)].mode;
  const py::gil_scoped_release released;
  HeightMap map;
  map.parts.emplace_back().shape = heights::load(source);
  return {source.file.filename().string(), DescribedHeightMap{std::move(map), mode, stiffness}};
}

// The rows of an array (n, 3).
template <class Number>
std::vector<std::array<Number, 3>> rows_of_three(const py::buffer& array) {
  const py::buffer_info its = buffer_of<Number>(array);
  if (its.ndim != 2 || its.shape[1] != 3) throw py::value_error("expected vertices (n, 3) and triangles (m, 3)");
  std::vector<std::array<Number, 3>> rows(static_cast<std::size_t>(its.shape[0]));
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = {at<Number>(its, i, 0), at<Number>(its, i, 1), at<Number>(its, i, 2)};
  return rows;
}

Description mesh_of_arrays(const py::buffer& vertices, const py::buffer& triangles, const std::optional<std::string>& sides,
                           const std::optional<std::string>& shading, const std::optional<std::string>& contact, double crease,
                           float stiffness,
                           const std::vector<std::tuple<std::optional<float>, float, float, float, float>>& materials,
                           const std::vector<std::uint32_t>& material_of_triangle) {
  mesh::TriangleMesh all{rows_of_three<float>(vertices), rows_of_three<std::uint32_t>(triangles)};
  mesh::Materials surface{{}, material_of_triangle};
  for (const auto& [its_stiffness, static_friction, dynamic_friction, damping, drag] : materials)
    surface.list.push_back({its_stiffness, static_friction, dynamic_friction, {damping, drag}});
  const mesh::Contact usual = has_friction(surface) ? mesh::Contact::friction : mesh::kUsualContact;
  const auto rule = contact ? static_cast<mesh::Contact>(choice("contact", *contact, mesh::kContactNames)) : usual;
  const std::size_t scheme = shading ? choice("shading", *shading, c::shading_names()) : has_corner_normals(rule) ? 0 : 1;
  const auto blocked =
      sides ? std::optional(static_cast<mesh::Sides>(choice("sides", *sides, mesh::kSidesNames))) : std::nullopt;
  if (!(crease >= 0 && crease <= 180)) throw py::value_error("crease is " + shortest(crease) + "; expected 0 to 180 degrees");
  const auto checked =
      interruptible([&](const std::atomic<bool>& stop) { return mesh::check_any(std::move(all), Monitor({}, stop)); });
  const py::gil_scoped_release released;
  if (const auto* findings = std::get_if<mesh::Findings>(&checked)) {
    std::string words = findings->words();
    if (words.ends_with('\n')) words.pop_back();
    throw py::value_error("the mesh cannot be rendered: " + words);
  }
  const auto& any = std::get<mesh::CheckedMesh>(checked);
  const auto its_shading = static_cast<mesh::Shading>(scheme);
  if (const std::string words = c::refusal_of(any, its_shading, rule); !words.empty()) throw py::value_error(words);
  return c::described(any, blocked, its_shading, rule, crease, stiffness, std::move(surface));
}

Description of_file(const std::string& file) {
  return interruptible([&](const std::atomic<bool>& stop) { return subjects::read_file(file, Monitor({}, stop)); });
}

// The options of the command line, in words.
Description of_options(const std::vector<std::pair<std::string, std::string>>& options) {
  subjects::Options all;
  for (const auto& [key, value] : options) all.add({key, value, key});
  return interruptible([&](const std::atomic<bool>& stop) { return subjects::read_one(all, Monitor({}, stop)); });
}

// Throws Error, as a ValueError.
template <class Parse>
auto parsed(const Parse& parse, const std::string& name, const std::string& text) {
  try {
    return parse(name, text);
  } catch (const Error& error) {
    throw py::value_error(error.what());
  }
}

// The parameters of an identity: numbers as floats, words as strings.
py::dict parameters_of(const Identity& identity) {
  py::dict all;
  for (const auto& [key, value] : identity.parameters) {
    const py::str name(key);
    if (const auto* number = std::get_if<float>(&value))
      all[name] = static_cast<double>(*number);
    else
      all[name] = std::get<std::string>(value);
  }
  return all;
}

// Rows of three of a mesh, where they lie, which `owner` keeps alive.
template <class Number>
py::object rows_of(const std::vector<std::array<Number, 3>>& rows, const py::object& owner) {
  return view_of(rows.empty() ? nullptr : rows[0].data(), rows.size(), 3, owner);
}

const height::Grid* only_grid(const HeightMap& map) {
  const auto* grid = map.parts.size() == 1 && !map.parts[0].negated
                         ? std::get_if<std::shared_ptr<const height::Grid>>(&map.parts[0].shape)
                         : nullptr;
  return grid == nullptr ? nullptr : grid->get();
}

py::object rows_of(const height::Grid& grid, const py::object& owner) {
  return view_of(grid.values.data(), grid.rows, grid.columns, owner);
}

// The heights of the samples of a map that was read from a file: where they lie, or, of a spline, as the file has them. None
// where the map is another one than a grid alone.
py::object heights_of(const py::object& its, const std::string& file, std::optional<float> pitch, std::optional<float> scale) {
  const auto& described = std::get<DescribedHeightMap>(its.cast<const Subject&>().description.what);
  const height::Grid* grid = only_grid(described.map);
  if (grid == nullptr) return py::none();
  if (grid->interpolant == height::Interpolant::bilinear) return rows_of(*grid, its);
  using Held = std::shared_ptr<const height::Grid>;
  Held read = interruptible([&](const std::atomic<bool>&) -> Held {
    if (pitch) return heights::load({file, *pitch, *scale, grid->edge, height::Interpolant::bilinear});
    const HeightMap map = heights::read_heights(file);
    return only_grid(map) == nullptr ? nullptr : std::get<Held>(map.parts[0].shape);
  });
  if (read != nullptr && read->rows == grid->rows && read->columns == grid->columns) {
    std::vector<float> coefficients = read->values;
    heights::make_coefficients(coefficients, grid->columns, grid->rows, grid->edge);
    for (float& value : coefficients) value = heights::without_tiny(value);
    if (coefficients == grid->values) {
      auto* const held = new Held(std::move(read));
      return rows_of(**held, py::capsule(held, [](void* at) { delete static_cast<Held*>(at); }));
    }
  }
  throw Error(file + " has changed since the map was read; expected the same heights");
}

const mesh::TriangleMesh& mesh_of(const Subject& subject) {
  return std::get<MeshRendering>(subject.description.what).mesh();
}

}  // namespace

Subject::Subject(Description what) : c::Subject(built(c::build(what))), description(std::move(what)) {}

void add_subjects(py::module_& module) {
  py::class_<Description>(module, "Description").def_property_readonly("kind", [](const Description& description) {
    constexpr std::array kKinds{"law", "height map", "mesh", "scene"};
    return kKinds[description.what.index()];
  });
  module.def("laws", [] {
    py::list names;
    for (const LawName& law : kLaws) names.append(std::string(law.name));
    return names;
  });
  module.attr("usual_radius") = subjects::kUsualRadius;  // as the command has them
  module.attr("usual_width") = subjects::kUsualWidth;
  module.attr("usual_stiffness") = subjects::kUsualStiffness;
  module.def("law_of", &law_of);
  module.def("map_of_samples", &map_of_samples);
  module.def("map_of_picture", &map_of_picture);
  module.def("mesh_of_arrays", &mesh_of_arrays);
  module.def("of_file", &of_file);
  module.def("of_options", &of_options);
  module.def("friction", [](const std::string& name, const std::string& text) {
    const mesh::Material made = parsed(subjects::parse_friction, name, text);
    return std::pair(made.static_friction, made.dynamic_friction);
  });
  module.def("length",
             [](const std::string& name, const std::string& text) { return parsed(files::parse_length, name, text); });
  module.def("stiffness",
             [](const std::string& name, const std::string& text) { return parsed(files::parse_stiffness, name, text); });
  module.def("angle", [](const std::string& name, const std::string& text) { return parsed(files::parse_angle, name, text); });

  py::class_<Subject, std::shared_ptr<Subject>> subject(module, "Subject");
  subject.def(py::init<Description>());
  subject.def_property_readonly("_kind", [](const Subject& its) { return its.identity.kind; });
  subject.def_property_readonly("_name", [](const Subject& its) { return files::printable(its.identity.name); });
  subject.def_property_readonly("_digest", [](const Subject& its) { return its.identity.digest; });
  subject.def_property_readonly("_words", [](const Subject& its) { return parameters_in_words(its.identity); });
  subject.def_property_readonly("_parameters", [](const Subject& its) { return parameters_of(its.identity); });
  subject.def_property_readonly("_is_regular", [](const Subject& its) { return its.is_regular; });
  subject.def_property_readonly("_is_damped", [](const Subject& its) { return !its.damping.parameters.is_off(); });
  subject.def("_damping_at", [](const Subject& its, float rate) {
    const damping::Parameters at = its.damping.at(static_cast<double>(rate));
    return std::array{at.rate, at.share, at.damping, at.most, at.drag, at.full_at};
  });
  subject.def("_heights_of", &heights_of);
  subject.def_property_readonly(
      "_vertices", [](const py::object& its) { return rows_of(mesh_of(its.cast<const Subject&>()).vertices, its); });
  subject.def_property_readonly(
      "_faces", [](const py::object& its) { return rows_of(mesh_of(its.cast<const Subject&>()).triangles, its); });
  add_forces(module, subject);
  add_paths(subject);
}

}  // namespace forceshade::python
