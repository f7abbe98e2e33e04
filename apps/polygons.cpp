// SPDX-License-Identifier: BSD-3-Clause
// forceshade polygons: how many polygons a bump needs by the theta-critical hypothesis, and figure 5-5 of the thesis as a
// table.

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "forceshade/apps/command.h"
#include "forceshade/properties/thesis.h"
#include "forceshade/reference/theta_critical.h"

namespace forceshade::apps {
namespace {

constexpr unsigned kDigits = 6;

// The five radii of the thesis's experiments, on its bump's width.
void print_figure_5_5() {
  std::printf("degrees that each polygon subtends, w = 1000 mil (thesis, figure 5-5)\n");
  std::printf("%10s %14s %14s %14s\n", "R, mil", "one polygon", "two polygons", "three polygons");
  for (const auto& [mil, mm] : properties::kThesisRadii) {
    const Parameters bump{mm, properties::kThesisWidth, 1};
    std::printf("%10d", mil);
    for (const unsigned polygons : {1U, 2U, 3U})
      std::printf(" %14s", reference::subtended_degrees(bump, polygons, kDigits).c_str());
    std::printf("\n");
  }
}

}  // namespace

void add_polygons(CLI::App& app, int&) {
  struct Options {
    std::string json;
    double theta_critical = 0;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("polygons", "How many shaded polygons a bump needs, each to subtend less than theta-critical");
  const auto bump_options = std::make_shared<BumpOptions>(*command);
  command->add_option("--theta-critical", options->theta_critical, "degrees")
      ->type_name("DEG")
      ->check(CLI::Range(reference::kLeastThetaCritical, 180.0))
      ->required();
  command->add_option("--json", options->json, "the answer for programs, - for standard output")->type_name("FILE");
  command->callback([options, bump_options] {
    const Parameters bump = bump_options->bump();
    const unsigned polygons = reference::polygons_needed(bump, options->theta_critical);
    const std::string all = reference::subtended_degrees(bump, 1, kDigits);
    const std::string each = reference::subtended_degrees(bump, polygons, kDigits);
    if (!options->json.empty())
      write_file(options->json, nlohmann::ordered_json{{"radius_mm", static_cast<double>(bump.radius)},
                                                       {"width_mm", static_cast<double>(bump.width)},
                                                       {"theta_critical_deg", options->theta_critical},
                                                       {"subtended_deg", all},
                                                       {"polygons", polygons},
                                                       {"subtended_each_deg", each}}
                                        .dump() +
                                    "\n");
    if (options->json == "-") return;
    std::printf("%u polygon%s: the bump subtends %s degrees, each of %s %s\n\n", polygons, polygons == 1 ? "" : "s",
                all.c_str(), polygons == 1 ? "one" : "them", each.c_str());
    print_figure_5_5();
  });
}

}  // namespace forceshade::apps
