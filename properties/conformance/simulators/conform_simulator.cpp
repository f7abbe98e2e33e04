// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/simulators/conform_simulator.h"

#include <algorithm>

#include "properties/conformance/judgement_text.h"
#include "properties/conformance/simulators/invariants_of_steps.h"

namespace forceshade::conformance::simulators {
namespace {

using Reports = SimulatorCapabilities::Reports;

Invariant held_in_each_step(const StepInvariant& its, Bench& bench, const Monitor& monitor) {
  Finding finding(its.name);
  for (const Course& course : its.courses) {
    monitor.at(0);
    const Run& run = bench.run(course);
    const bool reports_nothing = its.is_of_reports && run.simulator.reports == Reports::nothing;
    if (run.refusal || reports_nothing) {
      finding.skip(run.refusal.value_or("it reports no contacts"));
      continue;
    }
    finding.count();
    for (std::size_t k = its.from == StepInvariant::From::settled ? course.settled() : 1; k < run.states.size(); ++k)
      finding.look(its.felt(run, k), course.scene.name, k);
  }
  return finding.invariant();
}

Invariant held_in_runs(const RunInvariant& its, Bench& bench, const Monitor& monitor, bool is_hostile) {
  Finding finding(its.name);
  for (const Course& course : its.courses) {
    monitor.at(0);
    try {
      its.look(bench, course, finding);
    } catch (const files::ProcessFailed& failure) {
      if (!is_hostile) throw;
      finding.violated(failure.what());
    }
  }
  return finding.invariant();
}

}  // namespace

bool SimulatorConformance::held() const {
  const auto is_violated = [](const Invariant& each) { return each.violation.has_value(); };
  const auto is_held = [](const Invariant& each) { return !each.violation && !each.not_applicable; };
  return !failure && std::ranges::none_of(invariants, is_violated) && std::ranges::any_of(invariants, is_held);
}

std::string words_of(const SimulatorConformance& found) {
  const SimulatorCapabilities& its = found.simulator;
  std::string words;
  if (!its.name.empty())
    words = its.name + (its.version.empty() ? "" : ' ' + its.version) + ", a simulator" +
            (its.settings.empty() ? "" : ": " + its.settings) + '\n';
  for (const Invariant& invariant : found.invariants) words += words_of(invariant);
  if (found.failure) words += "FAILED: " + *found.failure + '\n';
  return words;
}

nlohmann::ordered_json json_of(const SimulatorConformance& found, const std::string& version, const std::string& command) {
  nlohmann::ordered_json json{{"schema", kSimulatorSchema},
                              {"forceshade", version},
                              {"command", command},
                              {"held", found.held()},
                              {"simulator", {{"name", found.simulator.name}, {"version", found.simulator.version}}},
                              {"capabilities", found.simulator.declared},
                              {"invariants", nlohmann::ordered_json::array()}};
  if (found.failure) json["failure"] = *found.failure;
  for (const Invariant& invariant : found.invariants) json["invariants"].push_back(json_of(invariant));
  return json;
}

SimulatorConformance conform_simulator(const OpenSimulator& open, const Monitor& monitor) {
  SimulatorConformance found;
  Bench bench(open);
  const std::vector<StepInvariant> steps = step_invariants();
  const std::vector<RunInvariant> pairs = comparisons(), hostile = hostile_inputs();
  const double all = static_cast<double>(steps.size() + pairs.size() + hostile.size());
  const auto add = [&](const Invariant& invariant) {
    found.invariants.push_back(invariant);
    monitor.at(static_cast<double>(found.invariants.size()) / all);
  };
  try {
    found.simulator = bench.run(all_courses().front()).simulator;
    for (const StepInvariant& each : steps) add(held_in_each_step(each, bench, monitor));
    for (const RunInvariant& each : pairs) add(held_in_runs(each, bench, monitor, false));
    for (const RunInvariant& each : hostile) add(held_in_runs(each, bench, monitor, true));
  } catch (const files::ProcessFailed& failure) {
    found.failure = failure.what();
  }
  return found;
}

}  // namespace forceshade::conformance::simulators
