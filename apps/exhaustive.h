// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// certify --exhaustive and certify merge.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "apps/output_options.h"
#include "forceshade/certify.h"
#include "rendering/subjects/options.h"

namespace forceshade::apps {

struct ExhaustiveOptions {
  bool is_given = false;
  std::vector<std::string> sweeps{"directions", "heights", "lines"};
  std::string shards = "1/1";

  void add_to(CLI::App& command);
  void add_kinds_to(CLI::App& command);  // without --shards
};

// The sweeps that these options and the law's name. Throws BadInput.
properties::SweepPlan sweep_plan(const ExhaustiveOptions& options, const subjects::Options& named, bool radius_is_given);

void print_sweeps(const properties::Sweeps& sweeps);

// Sweeps, or goes on where a stopped run of the same part left off. Returns the exit code.
int run_exhaustive(const ExhaustiveOptions& options, const properties::SweepPlan& plan, unsigned threads, const OutFolder& out);

void add_merge(CLI::App& certify, int& result);

}  // namespace forceshade::apps
