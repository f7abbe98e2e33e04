// SPDX-License-Identifier: BSD-3-Clause
// forceshade laws: ids, parameters and domains of the laws; the geometry of a bump in any number of correctly rounded digits;
// how many polygons a bump needs by the theta-critical hypothesis, with figure 5-5 of the thesis as a table.

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/subject_option.h"
#include "files/quantity.h"
#include "forceshade/reference.h"
#include "reference/theta_critical.h"
#include "report/thesis_figures.h"

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
  std::string json;
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

}  // namespace

void add_laws(CLI::App& app, int&) {
  const auto options = std::make_shared<LawsOptions>();
  CLI::App* command =
      app.add_subcommand("laws", "List the force laws; or print the geometry of a bump, or count the polygons that it needs");
  const auto bump = std::make_shared<BumpOptions>(*command);
  CLI::Option* digits = add_whole(*command, "--digits", options->digits, "significant decimal digits of the geometry", kDigits);
  CLI::Option* critical =
      add_angle(*command, "--theta-critical", "count the polygons, each of which turns by less than this",
                {reference::kLeastThetaCritical, 180}, [options](double degrees, const files::Angle& exact) {
                  options->theta_critical = {exact.number.fraction(), exact.is_radians};
                  options->theta_critical_degrees = degrees;
                });
  critical->excludes(digits);
  CLI::Option* json = add_json(*command, options->json, "the geometry or the polygons");
  command->callback([options, bump, digits, critical, json] {
    if (!critical->empty()) return print_polygons(*options, bump->bump());
    if (bump->is_given() || !digits->empty() || !json->empty()) return print_geometry(*options, bump->bump());
    print_laws();
  });
}

}  // namespace forceshade::apps
