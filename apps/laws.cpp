// SPDX-License-Identifier: BSD-3-Clause
// forceshade laws: ids, parameters and domains of the laws; the geometry of a bump in any number of correctly rounded digits;
// how many polygons a bump needs by the theta-critical hypothesis, with figure 5-5 of the thesis as a table; or how many the
// section y = 0 of a height map needs, and those polygons as a height map.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/subject_option.h"
#include "files/quantity.h"
#include "forceshade/heights.h"
#include "forceshade/reference.h"
#include "reference/profile.h"
#include "reference/theta_critical.h"
#include "report/thesis_figures.h"
#include "subjects/height_map.h"

namespace forceshade::apps {
namespace {

constexpr unsigned kDigitsOfDegrees = 6;

// The five radii of the thesis's experiments, on its bump's width.
void print_figure_5_5() {
  std::printf("degrees that each polygon subtends, w = 1000 mil (thesis, figure 5-5)\n");
  std::printf("%10s %14s %14s %14s\n", "R, mil", "one polygon", "two polygons", "three polygons");
  for (const auto& [mil, mm] : properties::kThesisRadii) {
    const Parameters bump{mm, properties::kThesisWidth, 1};
    std::printf("%10d", mil);
    for (const unsigned polygons : {1U, 2U, 3U})
      std::printf(" %14s", reference::subtended_degrees(bump, polygons, kDigitsOfDegrees).c_str());
    std::printf("\n");
  }
}

struct LawsOptions {
  unsigned digits = 30;
  std::string json, height_map, out;
  Section section;
  reference::RationalAngle theta_critical = 0;
  double theta_critical_degrees = 0;  // nearest
};

void print_laws() {
  for (const LawName& law : kLaws) {
    std::cout << law.name << '\n';
    if (has_bump_geometry(law.id)) {
      std::cout << "  --radius     R  0.1 to 1e4 mm\n"
                   "  --width      w  1e-3 mm to 2R\n";
    }
    std::cout << "  --stiffness  K  1e-3 to 1e3 N/mm\n";
  }
  std::cout << "positions: x, y, z from -1e4 to 1e4 mm; a coordinate below 2^-30 mm in size is read as 0\n";
}

// d, h, w', h' and theta, correctly rounded.
void print_geometry(const LawsOptions& options, const Parameters& bump) {
  const reference::DecimalGeometry g = reference::geometry(bump, options.digits);
  write_json(options.json,
             {{"d_mm", g.d}, {"h_mm", g.h}, {"w_prime_mm", g.w_prime}, {"h_prime_mm", g.h_prime}, {"theta_rad", g.theta}}, -1);
  if (options.json == "-") return;
  std::printf("d      %s mm\nh      %s mm\nw'     %s mm\nh'     %s mm\ntheta  %s rad\n", g.d.c_str(), g.h.c_str(),
              g.w_prime.c_str(), g.h_prime.c_str(), g.theta.c_str());
}

void print_polygons(const LawsOptions& options, const Parameters& bump) {
  const unsigned polygons = reference::polygons_needed(bump, options.theta_critical);
  const std::string all = reference::subtended_degrees(bump, 1, kDigitsOfDegrees);
  const std::string each = reference::subtended_degrees(bump, polygons, kDigitsOfDegrees);
  write_json(options.json,
             {{"radius_mm", static_cast<double>(bump.radius)},
              {"width_mm", static_cast<double>(bump.width)},
              {"theta_critical_deg", options.theta_critical_degrees},
              {"subtended_deg", all},
              {"polygons", polygons},
              {"subtended_each_deg", each}},
             -1);
  if (options.json == "-") return;
  std::printf("%u polygon%s: the bump subtends %s degrees", polygons, polygons == 1 ? "" : "s", all.c_str());
  std::printf(polygons == 1 ? "\n" : ", each of them %s\n", each.c_str());
  const auto is_its_radius = [&](const properties::ThesisRadius& thesis) { return thesis.mm == bump.radius; };
  if (bump.width != properties::kThesisWidth || std::ranges::none_of(properties::kThesisRadii, is_its_radius)) return;
  std::printf("\n");
  print_figure_5_5();
}

// Every piece between knots that were rounded to binary32 still turns by less than theta-critical, surely.
bool turns_little(const HeightMap& map, const std::vector<height::Knot>& knots,
                  const reference::RationalAngle& theta_critical) {
  for (std::size_t i = 1; i < knots.size(); ++i)
    if (reference::Profile(map.parts, knots[i - 1].x, knots[i].x).polygons_needed(theta_critical).polygons > 1) return false;
  return true;
}

void print_polygons_of_map(const LawsOptions& options) {
  if (!options.json.empty() && options.json == options.out)
    throw Error("--json and --out: expected two files, got \"" + options.json + "\" for both");
  const Section& its = options.section;
  if (its.along != 'x' || its.at != 0) throw Error("--section: expected a range on x at y = 0, got another line");
  const HeightMap map{heights::read_spec(options.height_map).map.parts};
  subjects::expect_valid(options.height_map, {map, height::Mode::force_shaded});
  try {
    const reference::Profile profile(map.parts, its.from, its.to);
    const auto [polygons, is_fewest] = profile.polygons_needed(options.theta_critical);
    const double turning = profile.most_turning();
    write_json(options.json,
               {{"height_map", options.height_map},
                {"theta_critical_deg", options.theta_critical_degrees},
                {"turning_deg", turning},
                {"polygons", polygons},
                {"surely_fewest", is_fewest},
                {"turning_each_deg", turning / polygons}},
               -1);
    if (options.json != "-")
      std::printf(polygons == 1 ? "%u polygon%s: the normal turns by %.6g degrees\n"
                                : "%u polygons%s: the normal turns by %.6g degrees, over each of them by %.6g\n",
                  polygons, is_fewest ? "" : " (or one fewer, which misses by less than 1e-18 degrees or nothing)", turning,
                  turning / polygons);
    if (options.out.empty()) return;
    auto knots = profile.knots(polygons);
    if (!turns_little(map, knots, options.theta_critical)) knots = profile.knots(polygons + 1);
    const auto shaded =
        reference::HeightMapField::build({map.parts, {{height::Polygons{knots}}}}, height::Mode::force_shaded, 1);
    if (const auto* error = std::get_if<ParameterError>(&shaded)) throw Error(options.out + ": " + error->message());
    write_file(options.out,
               heights::shading_polygons(options.height_map, knots, std::filesystem::absolute(options.out).parent_path()));
  } catch (const std::invalid_argument& error) {
    throw Error(options.height_map + ": " + error.what());
  }
}

}  // namespace

void add_laws(CLI::App& app, int&) {
  const auto options = std::make_shared<LawsOptions>();
  CLI::App* command = app.add_subcommand(
      "laws", "List the force laws; or print the geometry of a bump, or count the polygons that a bump or profile needs");
  const auto bump = std::make_shared<BumpOptions>(*command);
  CLI::Option* digits = add_whole(*command, "--digits", options->digits, "significant decimal digits of the geometry", kDigits);
  CLI::Option* critical =
      add_angle(*command, "--theta-critical", "count the polygons, each of which turns by less than this",
                {reference::kLeastThetaCritical, 180}, [options](double degrees, const files::Angle& exact) {
                  options->theta_critical = {exact.number.fraction(), exact.is_radians};
                  options->theta_critical_degrees = degrees;
                });
  critical->excludes(digits);
  CLI::Option* map = command->add_option("--height-map", options->height_map, "instead of a bump: the section y = 0 of a map");
  map->type_name("SPEC")->needs(critical);
  bump->allow_instead(map);
  add_section(*command, options->section, "of the map: x from where to where, at y = 0")->needs(map);
  add_output(*command, "--out", options->out,
             "the map that shades its polygons, a TOML file for --height-map of other commands", {".toml"})
      ->needs(map);
  CLI::Option* json = add_json(*command, options->json, "the geometry or the polygons");
  command->callback([options, bump, digits, critical, map, json] {
    if (!map->empty()) return print_polygons_of_map(*options);
    if (!critical->empty()) return print_polygons(*options, bump->bump());
    if (bump->is_given() || !digits->empty() || !json->empty()) return print_geometry(*options, bump->bump());
    print_laws();
  });
}

}  // namespace forceshade::apps
