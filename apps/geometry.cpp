// SPDX-License-Identifier: BSD-3-Clause
// forceshade geometry: d, h, w', h' and theta of a bump, in any number of correctly rounded digits.

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/subject_option.h"
#include "forceshade/reference.h"

namespace forceshade::apps {
namespace {

struct GeometryOptions {
  unsigned digits = 30;
  std::string json;
};

void run(const GeometryOptions& options, const Parameters& bump) {
  const reference::DecimalGeometry g = reference::geometry(bump, options.digits);
  if (!options.json.empty())
    write_file(options.json,
               nlohmann::ordered_json{
                   {"d_mm", g.d}, {"h_mm", g.h}, {"w_prime_mm", g.w_prime}, {"h_prime_mm", g.h_prime}, {"theta_rad", g.theta}}
                       .dump() +
                   "\n");
  if (options.json == "-") return;
  std::printf("d      %s mm\nh      %s mm\nw'     %s mm\nh'     %s mm\ntheta  %s rad\n", g.d.c_str(), g.h.c_str(),
              g.w_prime.c_str(), g.h_prime.c_str(), g.theta.c_str());
}

}  // namespace

void add_geometry(CLI::App& app, int&) {
  const auto options = std::make_shared<GeometryOptions>();
  CLI::App* command = app.add_subcommand("geometry", "Print the geometry of a bump, correctly rounded");
  const auto bump = std::make_shared<BumpOptions>(*command);
  add_whole(*command, "--digits", options->digits, "significant decimal digits", kDigits);
  add_json(*command, options->json, "the same");
  command->callback([options, bump] { run(*options, bump->bump()); });
}

}  // namespace forceshade::apps
