// SPDX-License-Identifier: BSD-3-Clause
#include "apps/tolerance_option.h"

#include "apps/command.h"
#include "apps/options.h"

namespace forceshade::apps {

CLI::Option* add_tolerance(CLI::App& command, std::string& value) {
  return command
      .add_option(
          "--tolerance", value,
          "the largest distance of a force from the exact one: \"4 ulp\" in each component, \"1e-6 N\", \"0.1 %\"; default: "
          "correctly rounded")
      ->type_name("TOLERANCE")
      ->group(kEvidenceGroup)
      ->default_str(value);
}

conformance::Tolerance parse_tolerance(const std::string& text) {
  const auto tolerance = conformance::tolerance_of(text);
  if (!tolerance)
    throw BadInput(
        "--tolerance: expected a number with ulp (a whole one), N or %, such as \"4 ulp\", \"1e-6 N\" or \"0.1 %\", got \"" +
        text + '"');
  return *tolerance;
}

}  // namespace forceshade::apps
