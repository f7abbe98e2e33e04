// SPDX-License-Identifier: BSD-3-Clause
// forceshade geometry: d, h, w', h' and theta of a bump, in any number of correctly rounded digits.

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "forceshade/apps/command.h"
#include "forceshade/apps/options.h"
#include "forceshade/reference/law.h"

namespace forceshade::apps {

void add_geometry(CLI::App& app, int&) {
  const auto digits = std::make_shared<unsigned>(30);
  CLI::App* command = app.add_subcommand("geometry", "Print the geometry of a bump as JSON, correctly rounded");
  const auto options = std::make_shared<BumpOptions>(*command);
  add_whole(*command, "--digits", *digits, "significant decimal digits", kDigits);
  command->callback([options, digits] {
    const reference::DecimalGeometry g = reference::geometry(options->bump(), *digits);
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
