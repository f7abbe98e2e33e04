// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A plan of certify as the commands open it: its folder, its subjects and its units.

#include <memory>
#include <string>

#include "certificate/plan.h"
#include "certificate/plan_folder.h"
#include "rendering/subjects/options.h"

namespace forceshade::apps {

struct OpenedPlan {
  properties::Plan plan;
  std::string digest;
  subjects::Options named;  // empty for a plan of sweeps
  properties::CertifyOptions what;
  properties::Sweeps sweeps;

  properties::Work work() const { return {what, sweeps}; }
};

// Makes the subjects of a plan, or its sweeps, from its words. Throws BadInput, also where a subject is no longer what was
// planned.
OpenedPlan built(properties::Plan plan, std::string digest);

// Reads the plan of a folder. works: refuses a machine that has another widest instruction set too. Throws BadInput.
OpenedPlan opened(const std::string& folder, bool works);

// The options of a subject as the plan keeps them: files with their folders, because workers begin elsewhere.
std::vector<std::pair<std::string, std::string>> planned_words(const subjects::Options& named);

}  // namespace forceshade::apps
