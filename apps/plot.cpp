// SPDX-License-Identifier: BSD-3-Clause
// forceshade plot: pictures of a law, a height map or a mesh, and figures of the thesis drawn again.

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>

#include "apps/command.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/signals.h"
#include "apps/standard_input.h"
#include "apps/subject_option.h"
#include "files/csv.h"
#include "files/output_folder.h"
#include "files/quantity.h"
#include "files/suggestion.h"
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
  std::string picture;  // one of kKinds, "thesis" or a file; empty: all of kKinds, or the mesh alone
  Section section;

  // Throws Error where none has the name.
  std::vector<Kind> kinds() const {
    std::vector<Kind> chosen;
    std::vector<std::string> names{"thesis"};
    for (const Kind& kind : kKinds) {
      names.emplace_back(kind.name);
      if (picture.empty() || picture == kind.name) chosen.push_back(kind);
    }
    if (chosen.empty())
      throw Error("plot: expected one of force, directions, geometry, energy, thesis; got \"" + picture + '"' +
                  files::suggestion(picture, names));
    return chosen;
  }

  properties::Range range() const {
    const auto check = [](const char* what, float got, float low, float high) {
      if (!(got >= low && got <= high)) throw Error("--section: " + ParameterError{what, "mm", got, low, high}.message());
    };
    if (section.along != 'x') throw Error("--section: expected a range on x, got one on y");
    check("y", section.at, -9999, 9999);
    check("the beginning", section.from, -9999, 9999);
    check("the end", section.to, section.from + 0.01F, 9999);
    return {section.at, section.from, section.to};
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

void draw(const std::vector<PlannedView>& views, const std::vector<Kind>& kinds, const OutFolder& out) {
  const std::vector<std::string> names = files(views, kinds);
  out.expect_room_for(names);
  files::OutputFolder& folder = out.folder();
  for (const PlannedView& one : views) {
    const SideView view = one.view();
    for (const Kind& kind : kinds) write(kind.draw(view), stem(one.name, kind), folder);
  }
  finish(folder, out, names);
}

// The fast path's ticks at the positions of a CSV, in their order; "-" is standard input.
std::vector<Ticked> path_of(const std::string& input, fast::TickSession& session) {
  InputFile positions(input);
  constexpr std::size_t kReset = 3;
  files::Reader rows(positions.stream(), positions.name(), {"x_mm", "y_mm", "z_mm"}, {"reset"});
  std::vector<Ticked> path;
  while (rows.next()) {
    if (interrupted()) throw Interrupted("no picture was drawn");
    const std::array<float, 3> position{rows.binary32(0), rows.binary32(1), rows.binary32(2)};
    if (rows.has(kReset) && rows.text(kReset) != "0" && !(path.empty() && rows.text(kReset) == "1"))
      throw rows.unexpected(kReset, "0, because a picture has one path");
    path.push_back({position, session.tick(position)});
  }
  return path;
}

// The meshes of a scene, each where it is in the first tick.
mesh::TriangleMesh first_tick_of(const std::string& title, const DescribedScene& scene) {
  mesh::TriangleMesh all;
  for (const auto& [name, what, motion] : scene.objects) {
    const auto* its = std::get_if<MeshRendering>(&what.what);
    if (its == nullptr) throw Error(title + ": expected meshes alone in the picture of a scene, got the object " + name);
    const auto before = static_cast<std::uint32_t>(all.vertices.size());
    const std::vector<mesh::Vertex> vertices = mesh::placed(its->mesh().vertices, motion.at(0));
    all.vertices.insert(all.vertices.end(), vertices.begin(), vertices.end());
    for (const auto& [a, b, c] : its->mesh().triangles) all.triangles.push_back({before + a, before + b, before + c});
  }
  return all;
}

struct MeshPlot {
  properties::ViewDirection direction;

  void draw(const std::string& title, const MeshRendering& rendering, const std::string& picture, const OutFolder& out) const {
    if (picture.empty()) return draw(title, "-mesh", rendering.mesh(), {}, "", out);
    if (picture == "energy") return draw_energy(title, rendering, out);
    if (std::ranges::find(kKinds, picture, [](const Kind& kind) { return std::string(kind.name); }) != kKinds.end())
      throw Error("plot: expected energy or a file of positions for a mesh, got \"" + picture + '"');
    draw_path(title, rendering, path_of(picture, *properties::fast_god_object(rendering)(rendering.stiffness)), out);
  }

  // In its first tick.
  void draw(const std::string& title, const DescribedScene& scene, const std::string& picture, const OutFolder& out) const {
    if (!picture.empty()) throw Error("plot: expected " + title + " alone, whose objects move, got \"" + picture + '"');
    draw(title, "-mesh", first_tick_of(title, scene), {}, "; the first tick", out);
  }

 private:
  // Coloured by what the shading can give to the hand.
  void draw_energy(const std::string& title, const MeshRendering& rendering, const OutFolder& out) const {
    if (const std::string why = properties::why_no_energy_bound(rendering); !why.empty()) throw Error(title + ": " + why);
    std::vector<double> rates = properties::largest_turns(rendering).of_triangle;
    for (double& rate : rates) rate *= static_cast<double>(rendering.stiffness);
    const std::string words = "; K = " + shortest(rendering.stiffness) + " N/mm; mJ for each mm of path 1 mm deep, at most";
    draw(title, "-energy", rendering.mesh(), {}, words, out, rates);
  }

  void draw_path(const std::string& title, const MeshRendering& rendering, const std::vector<Ticked>& path,
                 const OutFolder& out) const {
    std::string words;
    if (!path.empty())
      words = "; K = " + shortest(rendering.stiffness) + " N/mm, shading " + std::string(name_of(rendering.shading)) +
              ", sides " + std::string(name_of(rendering.sides));
    const auto unfinished =
        std::ranges::count_if(path, [](const Ticked& one) { return one.tick.status == Status::unfinished; });
    if (unfinished > 0) words += "; " + std::to_string(unfinished) + " of " + std::to_string(path.size()) + " ticks unfinished";
    draw(title, "-mesh", rendering.mesh(), path, words, out);
  }

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
  const auto of_mesh = std::make_shared<MeshPlot>();
  command
      ->add_option(
          "picture", options->picture,
          "force, directions, geometry or energy; default: these four. Of a mesh: energy, the most that its shading can "
          "give to the hand, or FILE.csv, positions (x_mm, y_mm, z_mm) whose path on it is drawn, - for standard input. "
          "thesis: its figures, of no subject")
      ->type_name("PICTURE");
  add_section(*command, options->section, "of a height map, which is drawn, along x")->needs("--height-map");
  const auto turn = [of_mesh](const std::string& text) {
    const std::vector<std::string> angles = files::at_commas(text);
    if (angles.size() != 2) throw Error("--view: expected two angles such as 30,25, got \"" + text + '"');
    of_mesh->direction = {parse_angle("--view", angles[0], {-360, 360}), parse_angle("--view", angles[1], {-90, 90})};
  };
  const CLI::Option* view =
      command
          ->add_option_function<std::string>(
              "--view", turn, "of a mesh or scene: the angle from -y towards +x, and that above the plane of x and y")
          ->type_name("AZIMUTH,ELEVATION")
          ->default_str("30,25");
  const auto out =
      std::make_shared<OutFolder>(*command, "directory for NAME-PICTURE.svg and .png, and for figure-N-M.svg, .png and .csv");
  out->require();
  command->callback([subject, options, of_mesh, view, out] {
    watch_for_interrupt();
    if (options->picture == "thesis") {
      if (subject->is_given()) throw Error("plot: expected no subject beside thesis, got one");
      return draw_thesis(*out);
    }
    const std::vector<Description> all = subject->descriptions();
    const Description& first = all.front();
    const auto draw_views = [&](const std::vector<PlannedView>& views) {
      if (!view->empty()) throw Error("--view: expected --mesh or --scene beside it, got another subject");
      draw(views, options->kinds(), *out);
    };
    first.visit(
        [&](const DescribedLaw&) {
          std::vector<PlannedView> views;
          for (const Description& one : all) views.push_back(view_of_law(std::get<DescribedLaw>(one.what)));
          draw_views(views);
        },
        [&](const DescribedHeightMap& map) { draw_views({view_of_height_map(first.name, map, options->range())}); },
        [&](const auto& mesh) { of_mesh->draw(first.name, mesh, options->picture, *out); });
  });
}

}  // namespace forceshade::apps
