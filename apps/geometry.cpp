// SPDX-License-Identifier: BSD-3-Clause
// forceshade geometry: d, h, w', h' and theta of a bump, in any number of correctly rounded digits.

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "forceshade/apps/command.h"
#include "forceshade/apps/length.h"
#include "forceshade/reference/law.h"

namespace forceshade::apps {

void add_geometry(CLI::App& app, int&) {
  struct Options {
    std::string radius, width;
    unsigned digits = 30;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("geometry", "Print the geometry of a bump as JSON, correctly rounded");
  command->add_option("--radius", options->radius, "R: mm, or with a unit (mm, mil, in, cm, m)")
      ->type_name("VALUE")
      ->required();
  command->add_option("--width", options->width, "w: mm, or with a unit")->type_name("VALUE")->required();
  command->add_option("--digits", options->digits, "significant decimal digits")
      ->type_name("N")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->callback([options] {
    const Parameters p{parse_length("--radius", options->radius), parse_length("--width", options->width), 1};
    const auto law = reference::Law::build(LawId::bump_cylinder, p);
    if (const auto* error = std::get_if<ParameterError>(&law)) throw BadInput("--" + error->message());
    const reference::DecimalGeometry g = reference::geometry(p, options->digits);
    std::cout << nlohmann::ordered_json{{"d_mm", g.d},
                                        {"h_mm", g.h},
                                        {"w_prime_mm", g.w_prime},
                                        {"h_prime_mm", g.h_prime},
                                        {"theta_rad", g.theta}}
                     .dump()
              << '\n';
  });
}

}  // namespace forceshade::apps
