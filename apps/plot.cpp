// SPDX-License-Identifier: BSD-3-Clause
// forceshade plot: pictures of a law, a height map or a mesh, and figures of the thesis drawn again.

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>

#include "apps/command.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/signals.h"
#include "apps/subject_option.h"
#include "files/csv.h"
#include "files/output_folder.h"
#include "files/quantity.h"
#include "forceshade/checks.h"
#include "properties/mesh_energy.h"
#include "properties/mesh_subject.h"
#include "rendering/meshes/placement.h"
#include "report/mesh_picture.h"
#include "report/pictures.h"
#include "report/thesis_figures.h"

namespace forceshade::apps {
namespace {

using properties::Picture;
using properties::SideView;
using properties::Ticked;

Picture force_of(const SideView& view) {
  const properties::ForceProfile profile(view, view.depths);
  return force_profile(view, profile, profile.side, profile.up);
}

struct Kind {
  const char* name;
  Picture (*draw)(const SideView& view);
};
constexpr std::array kKinds{Kind{"force", force_of}, Kind{"directions", properties::direction_field},
                            Kind{"geometry", properties::cross_section}, Kind{"energy", properties::energy_map}};

struct PlotOptions {
  std::string what = "all";
  std::string y = "0", from = "-12.7mm", to = "12.7mm";

  std::vector<Kind> kinds() const {
    std::vector<Kind> chosen;
    for (const Kind& kind : kKinds)
      if (what == "all" || what == kind.name) chosen.push_back(kind);
    return chosen;
  }

  properties::Range range() const {
    const properties::Range range{files::parse_length("--at", y), files::parse_length("--from", from),
                                  files::parse_length("--to", to)};
    const auto check = [](const std::string& option, float got, float low, float high) {
      if (!(got >= low && got <= high)) throw Error("--" + ParameterError{option.c_str(), "mm", got, low, high}.message());
    };
    check("at", range.y, -9999, 9999);
    check("from", range.from, -9999, 9999);
    check("to", range.to, range.from + 0.01F, 9999);
    return range;
  }
};

std::string stem(const std::string& name, const Kind& kind) {
  return name + '-' + kind.name;
}

// A law or a height map that will be drawn. Its view is built when it is its turn.
struct PlannedView {
  std::string name;
  std::function<SideView()> view;
};

PlannedView view_of_law(const DescribedLaw& described) {
  return {std::string(name_of(described.law)), [id = described.law, parameters = described.parameters] {
            SideView view = side_view(properties::Drawn(id, parameters));
            view.heading = {view.name, has_bump_geometry(id) ? "R = " + shortest(parameters.radius) +
                                                                   " mm, w = " + shortest(parameters.width) + " mm, "
                                                             : ""};
            view.heading.parameters += "K = " + shortest(parameters.stiffness) + " N/mm";
            return view;
          }};
}

PlannedView view_of_height_map(const std::string& title, const DescribedHeightMap& its, const properties::Range& range) {
  const std::string name = std::filesystem::path(title).stem();
  return {name, [=] {
            SideView view = side_view(built(properties::fast_rendering(its.map, its.mode, its.stiffness)), name, range);
            view.heading = {title, std::string(name_of(its.mode)) + ", K = " + shortest(its.stiffness) +
                                       " N/mm, y = " + shortest(range.y) + " mm"};
            return view;
          }};
}

PlannedView view_of(const Description& what, const PlotOptions& options) {
  if (const auto* law = std::get_if<DescribedLaw>(&what.what)) return view_of_law(*law);
  return view_of_height_map(what.name, std::get<DescribedHeightMap>(what.what), options.range());
}

std::vector<std::string> files(const std::vector<PlannedView>& views, const std::vector<Kind>& kinds) {
  std::vector<std::string> all;
  for (const PlannedView& one : views)
    for (const Kind& kind : kinds)
      for (const char* ending : {".svg", ".png"}) all.push_back(stem(one.name, kind) + ending);
  return all;
}

void write(const Picture& picture, const std::string& stem, const files::OutputFolder& folder) {
  const auto drawn = [&](std::string (*file)(const Picture&)) {
    try {
      std::string bytes = file(picture);
      if (!interrupted()) return bytes;
    } catch (const properties::PlotError&) {  // a terminal's Ctrl-C ends gnuplot, too
      if (!interrupted()) throw;
    }
    throw Interrupted("not all pictures were drawn");
  };
  folder.write(stem + ".svg", drawn(properties::svg_file));
  folder.write(stem + ".png", drawn(properties::png_file));
}

// Puts what was drawn in place, and prints its names.
void finish(files::OutputFolder& folder, const OutFolder& out, const std::vector<std::string>& names) {
  folder.commit();
  for (const std::string& name : names) std::printf("%s\n", (std::filesystem::path(out.path()) / name).c_str());
}

// The fast path's ticks at the positions of a CSV, in their order; "-" is standard input.
std::vector<Ticked> path_of(const std::string& input, fast::TickSession& session) {
  std::ifstream file;
  if (input != "-") file = files::open_input(input);
  files::Reader rows(input == "-" ? std::cin : file, input == "-" ? "standard input" : input, {"x_mm", "y_mm", "z_mm"});
  std::vector<Ticked> path;
  while (rows.next()) {
    if (interrupted()) throw Interrupted("no picture was drawn");
    const std::array<float, 3> position{rows.binary32(0), rows.binary32(1), rows.binary32(2)};
    path.push_back({position, session.tick(position)});
  }
  return path;
}

// The meshes of a scene, each where it is in the first tick.
mesh::TriangleMesh first_tick_of(const Description& described) {
  mesh::TriangleMesh all;
  for (const auto& [name, what, motion] : std::get<DescribedScene>(described.what).objects) {
    const auto* its = std::get_if<MeshRendering>(&what.what);
    if (its == nullptr)
      throw Error(described.name + ": expected meshes alone in the picture of a scene, got the object " + name);
    const auto before = static_cast<std::uint32_t>(all.vertices.size());
    const std::vector<mesh::Vertex> vertices = mesh::placed(its->mesh().vertices, motion.at(0));
    all.vertices.insert(all.vertices.end(), vertices.begin(), vertices.end());
    for (const auto& [a, b, c] : its->mesh().triangles) all.triangles.push_back({before + a, before + b, before + c});
  }
  return all;
}

struct MeshPlotOptions {
  std::string input;
  properties::ViewDirection direction;

  // Coloured by what the shading can give to the hand.
  void draw_energy(const std::string& title, const MeshRendering& rendering, const OutFolder& out) const {
    if (!input.empty()) throw Error("--input: expected without --what energy, got both");
    if (const std::string why = properties::why_no_energy_bound(rendering); !why.empty()) throw Error(title + ": " + why);
    std::vector<double> rates = properties::largest_turns(rendering).of_triangle;
    for (double& rate : rates) rate *= static_cast<double>(rendering.stiffness);
    const std::string words = "; K = " + shortest(rendering.stiffness) + " N/mm; mJ for each mm of path 1 mm deep, at most";
    draw(title, "-energy", rendering.mesh(), {}, words, out, rates);
  }

  void draw(const std::string& title, const MeshRendering& rendering, const OutFolder& out) const {
    std::vector<Ticked> path;
    if (!input.empty()) path = path_of(input, *properties::fast_god_object(rendering)(rendering.stiffness));
    std::string words;
    if (!path.empty())
      words = "; K = " + shortest(rendering.stiffness) + " N/mm, shading " + std::string(name_of(rendering.shading)) +
              ", sides " + std::string(name_of(rendering.sides));
    const auto unfinished =
        std::ranges::count_if(path, [](const Ticked& one) { return one.tick.status == Status::unfinished; });
    if (unfinished > 0) words += "; " + std::to_string(unfinished) + " of " + std::to_string(path.size()) + " ticks unfinished";
    draw(title, "-mesh", rendering.mesh(), path, words, out);
  }

  // A scene whose objects move, in its first tick.
  void draw(const Description& scene, const OutFolder& out) const {
    if (!input.empty()) throw Error("--input: expected without objects that move, got " + scene.name);
    draw(scene.name, "-mesh", first_tick_of(scene), {}, "; the first tick", out);
  }

 private:
  void draw(const std::string& title, const std::string& end, const mesh::TriangleMesh& mesh, const std::vector<Ticked>& path,
            const std::string& words, const OutFolder& out, std::span<const double> values = {}) const {
    const std::string name = std::filesystem::path(title).stem();
    const std::vector<std::string> names{name + end + ".svg", name + end + ".png"};
    out.expect_room_for(names);
    files::OutputFolder& folder = out.folder();
    const std::string caption = std::to_string(mesh.triangles.size()) + " triangles" + words;
    write(mesh_picture(mesh, path, direction, name, {title, caption}, values), name + end, folder);
    finish(folder, out, names);
  }
};

// Figures of the thesis again, with their numbers.
void draw_thesis(const OutFolder& out) {
  const std::vector<properties::ThesisFigure> figures = properties::thesis_figures();
  std::vector<std::string> names;
  for (const properties::ThesisFigure& figure : figures)
    for (const char* ending : {".svg", ".png", ".csv"}) names.push_back(figure.name + ending);
  out.expect_room_for(names);
  files::OutputFolder& folder = out.folder();
  for (const properties::ThesisFigure& figure : figures) {
    write(figure.picture, figure.name, folder);
    folder.write(figure.name + ".csv", figure.csv);
  }
  finish(folder, out, names);
}

}  // namespace

void add_plot(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand(
      "plot", "Draw a law or a height map: force profile, directions, nominal geometry, energy map; or a mesh or scene");
  const auto subject = std::make_shared<SubjectOption>(*command, subjects::Laws::several);
  const auto options = std::make_shared<PlotOptions>();
  const auto mesh_options = std::make_shared<MeshPlotOptions>();
  const auto add = [&](const char* name, std::string& value, const char* help) {
    add_length(*command, name, value, help)->needs("--height-map");
  };
  add("--at", options->y, "y of the section of a height map that is drawn");
  add("--from", options->from, "x where the section begins");
  add("--to", options->to, "x where it ends");
  const CLI::Option* what_picture =
      add_word(
          *command, "--what", options->what,
          "the picture; of a mesh, energy: the most that its shading can give to the hand; thesis: its figures, of no subject",
          {"force", "directions", "geometry", "energy", "all", "thesis"})
          ->excludes("--scene");
  std::vector<const CLI::Option*> of_a_mesh{
      command
          ->add_option("--input", mesh_options->input,
                       "positions as CSV (x_mm, y_mm, z_mm) in their order, whose path on a mesh or scene is drawn; - is "
                       "standard input")
          ->type_name("FILE")};
  const auto turn = [&](const char* name, double& degrees, const char* help, double most) {
    of_a_mesh.push_back(add_angle(*command, name, help, {-most, most}, [&degrees](double given, const files::Angle&) {
                          degrees = given;
                        })->default_str(shortest(degrees)));
  };
  turn("--azimuth", mesh_options->direction.azimuth, "of the view of a mesh or scene: from -y towards +x", 360);
  turn("--elevation", mesh_options->direction.elevation, "of the view of a mesh or scene: above the plane of x and y", 90);
  const auto out =
      std::make_shared<OutFolder>(*command, "directory for NAME-PICTURE.svg and .png, and for figure-N-M.svg, .png and .csv");
  out->require();
  command->callback([subject, options, mesh_options, of_a_mesh, what_picture, out] {
    watch_for_interrupt();
    if (options->what == "thesis") {
      if (subject->is_given()) throw Error("--what: expected no subject beside thesis, got one");
      return draw_thesis(*out);
    }
    const std::vector<Description> all = subject->descriptions();
    if (const auto* mesh = std::get_if<MeshRendering>(&all.front().what)) {
      if (what_picture->empty()) return mesh_options->draw(all.front().name, *mesh, *out);
      if (options->what != "energy") throw Error("--what: expected energy for a mesh, got \"" + options->what + "\"");
      return mesh_options->draw_energy(all.front().name, *mesh, *out);
    }
    if (std::holds_alternative<DescribedScene>(all.front().what)) return mesh_options->draw(all.front(), *out);
    for (const CLI::Option* option : of_a_mesh)
      if (!option->empty()) throw Error(option->get_name() + ": expected --mesh or --scene beside it, got another subject");
    const std::vector<Kind> kinds = options->kinds();
    std::vector<PlannedView> views;
    for (const Description& what : all) views.push_back(view_of(what, *options));
    const std::vector<std::string> names = files(views, kinds);
    out->expect_room_for(names);
    files::OutputFolder& folder = out->folder();
    for (const PlannedView& one : views) {
      const SideView view = one.view();
      for (const Kind& kind : kinds) write(kind.draw(view), stem(one.name, kind), folder);
    }
    finish(folder, *out, names);
  });
}

}  // namespace forceshade::apps
