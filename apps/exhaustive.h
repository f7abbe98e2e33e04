// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// certify --exhaustive and certify merge.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "apps/output_options.h"
#include "forceshade/certify.h"

namespace forceshade::apps {

struct ExhaustiveOptions {
  bool is_given = false;
  std::vector<std::string> sweeps{"directions", "heights", "lines"};
  std::string shards = "1/1";

  void add_to(CLI::App& command);
};

// Sweeps, or goes on where a stopped run of the same part left off. Returns the exit code.
int run_exhaustive(const ExhaustiveOptions& options, properties::SweepPlan plan, unsigned threads, const OutFolder& out);

void add_merge(CLI::App& certify, int& result);

}  // namespace forceshade::apps
