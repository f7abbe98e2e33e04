// SPDX-License-Identifier: BSD-3-Clause
// forceshade certify plan, work and merge: certificates of many processes.

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>
#include <thread>

#include "apps/certificate_files.h"
#include "apps/command.h"
#include "apps/options.h"
#include "apps/output_options.h"
#include "apps/progress_line.h"
#include "apps/signals.h"
#include "apps/subject_option.h"
#include "apps/tell.h"
#include "files/printable.h"
#include "forceshade/certify.h"
#include "report/thesis_figures.h"

namespace forceshade::apps {
namespace {

constexpr const char* kPlanFolderWords = "folder of a plan, made by 'certify plan'";

// The sweeps of these kinds of the laws that the options name.
properties::SweepPlan sweep_plan(const std::vector<std::string>& kinds, const subjects::Options& named) {
  for (const std::string_view kind : subjects::kKinds)
    if (kind != "law" && named.has(kind))
      throw Error("--exhaustive: expected --law, got --" + std::string(kind) + ", which has too many inputs to sweep");
  const auto is_chosen = [&](const char* kind) { return std::ranges::find(kinds, kind) != kinds.end(); };
  properties::SweepPlan plan{{}, {}, {}, is_chosen("directions"), is_chosen("heights"), is_chosen("lines")};
  for (const DescribedLaw& law : subjects::laws_of(named)) {
    plan.laws.push_back(law.law);
    plan.parameters = law.parameters;
  }
  for (const properties::ThesisRadius& radius : properties::kThesisRadii) plan.radii.push_back(radius.mm);
  if (named.has("radius")) plan.radii = {plan.parameters.radius};
  return plan;
}

int work(const std::string& folder, properties::PlanWorker worker) {
  watch_for_interrupt();
  properties::Worked worked;
  {
    ProgressLine line("units");
    worker.progress = [&](double done) { line.draw(done); };
    worked = properties::work_on_plan(folder, worker, interrupted());
  }
  if (worked.alarms > 0)
    tell("ALARM: " + std::to_string(worked.alarms) +
         " units have another result already; both are kept, 'certify merge' names them");
  if (interrupted()) {
    tell("interrupted after " + std::to_string(worked.units) + " units; the same command goes on");
    return kInterrupted;
  }
  std::printf("%" PRIu64 " units done here; the plan is %s\n", worked.units,
              worked.is_complete ? "complete" : "not complete, the other units are taken");
  return worked.alarms > 0 ? kFailed : kHeld;
}

void print_sweeps(const properties::Sweeps& sweeps) {
  if (sweeps.results.empty()) return;
  for (const properties::SweepTotal& total : properties::totals(sweeps))
    std::printf("%-15s %-9s %4" PRIu64 " sweeps %14" PRIu64 " inputs %" PRIu64 " mismatches\n", name_of(total.law).data(),
                properties::kSweepKinds[static_cast<std::size_t>(total.kind)].data(), total.sweeps, total.inputs,
                total.mismatches);
  for (const std::string& words : sweeps.counterexamples) std::printf("  %s\n", files::printable(words).c_str());
  std::printf("%" PRIu64 " inputs in %.0f s (%.0f M/s), %" PRIu64 " mismatches\n", sweeps.inputs(), sweeps.seconds,
              static_cast<double>(sweeps.inputs()) / std::max(sweeps.seconds, 1e-9) / 1e6, sweeps.mismatches());
}

int merge(const std::vector<std::string>& words, const OutFolder& out) {
  const std::string& folder = words.front();
  std::error_code ignored;
  const bool is_file = std::filesystem::is_regular_file(folder, ignored);
  if (is_file || words.size() > 1)
    throw Error("certify merge: expected the folder of one plan, got " + files::printable(is_file ? folder : words[1]) +
                "; points of several processes are a plan: forceshade certify plan --points N --out PLAN");
  const bool is_asked = out.path().empty();  // only how far it is
  const properties::MergedPlan merged = is_asked ? properties::MergedPlan{properties::state_of_plan(folder, interrupted()), {}}
                                                 : properties::merged_plan(folder, interrupted());
  const properties::PlanState& state = merged.state;
  std::printf("plan %s\n%" PRIu64 " of %" PRIu64 " units done, %" PRIu64 " taken, %" PRIu64 " with a lease that ran out\n",
              state.digest.c_str(), state.done, state.units, state.taken, state.expired);
  if (!state.missing.empty()) std::printf("missing: %s\n", state.missing.c_str());
  for (const std::string& file : state.alarms)
    tell("ALARM: " + file + " differs from the result of the same unit beside it; one machine computes wrongly");
  if (!state.alarms.empty()) return kFailed;
  if (is_asked) return state.missing.empty() ? kHeld : kFailed;
  out.expect_room_for(certificate_files());
  print_sweeps(merged.certificate.sweeps);
  if (state.missing.empty()) return write_certificate(merged.certificate, out.folder());
  const std::string evidence = std::filesystem::path(out.path()) / "evidence.json";
  out.make();
  write_file(evidence, properties::evidence_of(merged.certificate, state.missing));
  std::printf("incomplete, so there is no certificate yet; what the units found: %s\n", evidence.c_str());
  return kFailed;
}

}  // namespace

void add_certify_plan(CLI::App& certify, int& result) {
  struct Options {
    properties::PlanRequest request;
    std::vector<std::string> sweeps;
    std::string folder;
  };
  const auto options = std::make_shared<Options>();
  properties::PlanRequest& request = options->request;
  CLI::App* command = certify.add_subcommand(
      "plan", "Divide what certify does into units of work, which any number of processes and machines do");
  const auto subject = std::make_shared<SubjectOption>(*command, subjects::Laws::several);
  command->option_defaults()->group(kEvidenceGroup);
  CLI::Option* points = add_whole(*command, "--points", "points per law, height map or mesh, as for certify",
                                  {1, 1000000000000}, [options](std::uint64_t given) { options->request.points = given; });
  CLI::Option* cases = add_whole(*command, "--cases", request.cases, "cases per property (passivity: a tenth)", kCases);
  CLI::Option* seed = add_whole(*command, "--seed", request.seed, "seed of points and cases", kSeeds);
  CLI::Option* exhaustive =
      command
          ->add_option("--exhaustive", options->sweeps,
                       "sweep over every binary32 instead of points and cases: directions, heights (the five radii of the "
                       "thesis unless --radius is given), lines")
          ->type_name("[LIST]")
          ->expected(0, 3)
          ->delimiter(',')
          ->default_str("directions,heights,lines")
          ->check(one_of({"directions", "heights", "lines"}));
  for (CLI::Option* of_points : {points, cases, seed}) exhaustive->excludes(of_points);
  command->option_defaults()->group(kOtherGroup);
  add_whole(*command, "--units", request.units, "about how many units to divide it into", {1, 1000000});
  add_whole(*command, "--lease", request.lease,
            "seconds after which others take the units of a process that gives no sign of life", {1, 86400});
  command->add_option("--out", options->folder, "folder for the plan, new, on a file system that all machines share")
      ->type_name("DIR")
      ->required()
      ->group(kOutputGroup);
  command->callback([options, subject, exhaustive, &result] {
    const subjects::Options named = subject->options();
    if (!exhaustive->empty())
      options->request.sweeps = sweep_plan(options->sweeps, named);
    else
      for (const subjects::Option& option : named) options->request.subject.emplace_back(option.key, option.value);
    const properties::PlanState made = properties::make_plan(options->folder, options->request, interrupted());
    std::printf("%" PRIu64
                " units of work in %s\nplan %s\nto work on it, with any number of processes: forceshade certify work %s\n",
                made.units, options->folder.c_str(), made.digest.c_str(), options->folder.c_str());
    result = kHeld;
  });
}

void add_certify_work(CLI::App& certify, int& result) {
  struct Options {
    std::string folder;
    unsigned threads = std::max(1U, std::thread::hardware_concurrency());
    bool does_not_wait = false;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = certify.add_subcommand("work", "Do units of a plan until all are done, beside any number of others");
  command->add_option("folder", options->folder, kPlanFolderWords)->type_name("DIR")->required();
  add_whole(*command, "--threads", options->threads, "threads, each with a unit of its own", {1, 1024});
  command->add_flag("--no-wait", options->does_not_wait, "end when every unit that is left is taken by others");
  command->callback([options, &result] { result = work(options->folder, {options->threads, !options->does_not_wait}); });
}

void add_certify_merge(CLI::App& certify, int& result) {
  const auto words = std::make_shared<std::vector<std::string>>();
  CLI::App* command = certify.add_subcommand("merge", "Join the units of a plan; without --out, say how far the plan is");
  command->add_option("folder", *words, kPlanFolderWords)->type_name("DIR")->required();
  const auto out = std::make_shared<OutFolder>(*command, kCertificateFolder);
  command->callback([words, out, &result] { result = merge(*words, *out); });
}

}  // namespace forceshade::apps
