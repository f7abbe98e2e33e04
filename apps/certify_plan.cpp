// SPDX-License-Identifier: BSD-3-Clause
#include "apps/certify_plan.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "apps/certificate_files.h"
#include "apps/command.h"
#include "apps/exhaustive.h"
#include "apps/opened_plan.h"
#include "apps/options.h"
#include "apps/plan_evidence.h"
#include "apps/progress_line.h"
#include "apps/signals.h"
#include "apps/subject_option.h"
#include "certificate/build.h"
#include "certificate/unit_result.h"
#include "certificate/worker.h"
#include "files/printable.h"
#include "rendering/identity/digest.h"
#include "system/system.h"

namespace forceshade::apps {
namespace {

using properties::PlanFolder;
using properties::Units;

constexpr const char* kPlanFolderWords = "folder of a plan, made by 'certify plan'";

Units units_of(const OpenedPlan& opened) {
  return {opened.work().items(), opened.plan.parts_of_a_unit};
}

struct PlanOptions {
  std::uint64_t points = 0, cases = properties::kCases, seed = 1, units = 1000, lease = 300;
  ExhaustiveOptions exhaustive;
  std::string folder;
};

int plan(const PlanOptions& options, const SubjectOption& subject, bool radius_is_given) {
  properties::Plan plan;
  plan.lease = options.lease;
  if (options.exhaustive.is_given) {
    plan.sweeps = sweep_plan(options.exhaustive, subject.options(), radius_is_given);
  } else {
    plan.subject = planned_words(subject.options());
    plan.points = 1;  // until the kind is known
    plan.cases = options.cases;
    plan.seed = options.seed;
  }
  OpenedPlan opened = built(plan, "");
  if (!plan.has_sweeps()) {
    opened.plan.points = opened.what.points =
        options.points > 0 ? options.points : properties::points_of_kind(opened.what.subjects.front()->identity().kind);
    for (const auto& each : opened.what.subjects) opened.plan.identities.push_back(properties::identity_line(each->identity()));
  }
  const std::vector<properties::Item> items = opened.work().items();
  if (items.empty()) throw BadInput("--sweeps: expected a kind of sweep that the law has, got none of them");
  opened.plan.parts_of_a_unit = properties::parts_for_units(items, options.units);
  const std::string text = properties::to_json(opened.plan);
  PlanFolder::create(options.folder, text);
  std::printf("%" PRIu64
              " units of work in %s\nplan %s\nto work on it, with any number of processes: forceshade certify work %s\n",
              Units(items, opened.plan.parts_of_a_unit).count(), options.folder.c_str(), digest_of_text(text).c_str(),
              options.folder.c_str());
  return kHeld;
}

std::string host() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? files::printable(name.data()) : "unknown";
}

// The run's facts about itself, which merge reads and which are no part of the evidence.
void write_run(const OpenedPlan& opened, const std::filesystem::path& file, const properties::Worked& worked, double seconds) {
  const nlohmann::ordered_json run{
      {"plan", opened.digest}, {"date", system::date()}, {"processor", properties::processor_name()},
      {"host", host()},        {"seconds", seconds},     {"units", worked.units}};
  write_file(file, run.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

struct WorkOptions {
  std::string folder;
  unsigned threads = std::max(1U, std::thread::hardware_concurrency());
  bool does_not_wait = false;
};

int work(const WorkOptions& options) {
  watch_for_interrupt();
  if (const char* fault = fast::arithmetic_fault()) throw BadInput(std::string("nothing can be certified: ") + fault);
  const OpenedPlan opened = apps::opened(options.folder, true);
  const Units units = units_of(opened);
  const PlanFolder folder(options.folder, units.count());
  const std::uint64_t done = progress_of(folder).done;
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  auto written = start;
  const auto seconds = [&](Clock::time_point end) { return std::chrono::duration<double>(end - start).count(); };
  const auto lease = static_cast<double>(opened.plan.lease);
  properties::Claims claims(folder, lease, host() + " process " + std::to_string(::getpid()));
  const std::filesystem::path run = folder.path() / "runs" / (claims.token() + ".json");
  const auto all = static_cast<double>(units.count());
  std::optional<ProgressLine> line("units");
  line->draw(static_cast<double>(done) / all);
  const properties::Work its = opened.work();
  const properties::Worked worked = properties::work_through(
      folder, claims, {options.threads, lease, !options.does_not_wait},
      [&](std::uint64_t number) -> std::string {
        const properties::Unit unit = units.at(number);
        const properties::Found found = its.found(units.items()[unit.item], unit.first, unit.end, interrupted());
        return interrupted() ? "" : properties::text_of_unit(opened.digest, number, units, found);
      },
      [&](const properties::Worked& so_far) {
        line->draw(std::min(1.0, static_cast<double>(done + so_far.units) / all));
        if (const auto now = Clock::now(); seconds(now) - seconds(written) > 10) {
          write_run(opened, run, so_far, seconds(now) * options.threads);
          written = now;
        }
      },
      interrupted());
  line.reset();
  if (worked.units > 0) write_run(opened, run, worked, seconds(Clock::now()) * options.threads);
  if (worked.alarms > 0)
    std::fprintf(stderr,
                 "forceshade: ALARM: %" PRIu64
                 " units have another result already; both are kept, 'certify status' names them\n",
                 worked.alarms);
  if (interrupted()) {
    std::fprintf(stderr, "forceshade: interrupted after %" PRIu64 " units; the same command goes on\n", worked.units);
    return kInterrupted;
  }
  std::printf("%" PRIu64 " units done here; the plan is %s\n", worked.units,
              worked.is_complete ? "complete" : "not complete, the other units are taken");
  return worked.alarms > 0 ? kFailed : kHeld;
}

int status(const std::string& path) {
  const OpenedPlan opened = apps::opened(path, false);
  const PlanFolder folder(path, units_of(opened).count());
  const Progress progress = progress_of(folder);
  std::uint64_t taken = 0, expired = 0;
  for (const auto& [unit, age] : folder.claims()) ++(age < static_cast<double>(opened.plan.lease) ? taken : expired);
  std::printf("plan %s\n%" PRIu64 " of %" PRIu64 " units done, %" PRIu64 " taken, %" PRIu64 " with a lease that ran out\n",
              opened.digest.c_str(), progress.done, folder.units(), taken, expired);
  if (!progress.missing.empty()) std::printf("missing: %s\n", progress.missing.c_str());
  const bool has_alarms = say_alarms(folder);
  return progress.missing.empty() && !has_alarms ? kHeld : kFailed;
}

}  // namespace

int merge_plan(const std::string& path, const OutFolder& out) {
  const OpenedPlan opened = apps::opened(path, false);
  const Units units = units_of(opened);
  const PlanFolder folder(path, units.count());
  if (say_alarms(folder)) return kFailed;
  const std::string evidence = std::filesystem::path(out.path()) / "evidence.json";
  out.expect_room_for(certificate_files());
  const Progress progress = progress_of(folder);
  const properties::Certificate certificate = merged_units(opened, units, folder, progress);
  if (!certificate.sweeps.results.empty()) print_sweeps(certificate.sweeps);
  if (progress.missing.empty()) return write_certificate(certificate, out.folder());
  out.make();
  write_file(evidence, properties::evidence_of(certificate, progress.missing));
  std::printf("incomplete: %" PRIu64 " of %" PRIu64 " units are done, so there is no certificate yet; what they found: %s\n",
              progress.done, folder.units(), evidence.c_str());
  return kFailed;
}

void add_plan(CLI::App& certify, int& result) {
  const auto options = std::make_shared<PlanOptions>();
  CLI::App* command = certify.add_subcommand(
      "plan", "Divide what certify does into units of work, which any number of processes and machines do");
  const auto subject = std::make_shared<SubjectOption>(*command, subjects::Laws::several);
  command->option_defaults()->group(kEvidenceGroup);
  CLI::Option* points = add_whole(*command, "--points", "points per law, height map or mesh, as for certify",
                                  {1, 1000000000000}, [options](std::uint64_t given) { options->points = given; });
  CLI::Option* cases = add_whole(*command, "--cases", options->cases, "cases per property (passivity: a tenth)", kCases);
  CLI::Option* seed = add_whole(*command, "--seed", options->seed, "seed of points and cases", kSeeds);
  options->exhaustive.add_kinds_to(*command);
  for (CLI::Option* of_points : {points, cases, seed}) command->get_option("--exhaustive")->excludes(of_points);
  command->option_defaults()->group(kOtherGroup);
  add_whole(*command, "--units", options->units, "about how many units to divide it into", {1, 1000000});
  add_whole(*command, "--lease", options->lease,
            "seconds after which others take the units of a process that gives no sign of life", {1, 86400});
  command->add_option("--out", options->folder, "folder for the plan, new, on a file system that all machines share")
      ->type_name("DIR")
      ->required()
      ->group(kOutputGroup);
  command->callback([options, subject, command, &certify, &result] {
    refuse_options_before(certify, "certify plan");
    result = plan(*options, *subject, command->count("--radius") > 0);
  });
}

void add_work(CLI::App& certify, int& result) {
  const auto options = std::make_shared<WorkOptions>();
  CLI::App* command = certify.add_subcommand("work", "Do units of a plan until all are done, beside any number of others");
  command->add_option("folder", options->folder, kPlanFolderWords)->type_name("DIR")->required();
  add_whole(*command, "--threads", options->threads, "threads, each with a unit of its own", {1, 1024});
  command->add_flag("--no-wait", options->does_not_wait, "end when every unit that is left is taken by others");
  command->callback([options, &certify, &result] {
    refuse_options_before(certify, "certify work");
    result = work(*options);
  });
}

void add_status(CLI::App& certify, int& result) {
  const auto folder = std::make_shared<std::string>();
  CLI::App* command = certify.add_subcommand("status", "Say how many units of a plan are done, and whether two results differ");
  command->add_option("folder", *folder, kPlanFolderWords)->type_name("DIR")->required();
  command->callback([folder, &certify, &result] {
    refuse_options_before(certify, "certify status");
    result = status(*folder);
  });
}

}  // namespace forceshade::apps
