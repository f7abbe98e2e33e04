// SPDX-License-Identifier: BSD-3-Clause
// Plans as the library and the command use them: made, worked on, and merged.

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "certificate/build.h"
#include "certificate/plan.h"
#include "certificate/plan_folder.h"
#include "certificate/worker.h"
#include "files/output_file.h"
#include "files/printable.h"
#include "forceshade/certify.h"
#include "rendering/identity/digest.h"
#include "subjects/read.h"
#include "system/system.h"

namespace forceshade::properties {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostRanges = 10;
constexpr double kSecondsBetweenNotes = 10;

// A plan with its subjects, or its sweeps, made of its words.
struct OpenedPlan {
  Plan plan;
  std::string digest = {};
  subjects::Options named = {};  // empty for a plan of sweeps
  CertifyOptions what = {};
  Sweeps sweeps = {};

  DividedWork work() const { return {what, sweeps}; }
  Units units() const { return {work().items(), plan.parts_of_a_unit}; }
};

// Throws Error, also where a subject is no longer the one that was planned.
OpenedPlan built(Plan plan, const std::string& digest, const std::atomic<bool>& stop) {
  OpenedPlan opened{std::move(plan), digest};
  const Plan& its = opened.plan;
  if (its.has_sweeps()) {
    opened.sweeps = planned(its.sweeps);
    return opened;
  }
  for (const auto& [key, value] : its.subject) opened.named.add({key, value});
  opened.what.points = its.points;
  opened.what.cases = static_cast<int>(its.cases);
  opened.what.seed = its.seed;
  for (const Description& one : subjects::read(opened.named, Monitor([](double) {}, stop)))
    opened.what.subjects.push_back(subject_of(one));
  for (std::size_t i = 0; i < opened.what.subjects.size() && !its.identities.empty(); ++i) {
    const std::string line = identity_line(opened.what.subjects[i]->identity());
    if (i >= its.identities.size() || its.identities[i] != line)
      throw Error("the subject is no longer the one that was planned: expected " +
                  (i < its.identities.size() ? its.identities[i] : "none") + ", got " + line);
  }
  return opened;
}

// works: refuses a machine that has another widest instruction set, too.
OpenedPlan opened(const std::string& folder, bool works, const std::atomic<bool>& stop) {
  const std::string file = fs::path(folder) / "plan.json", text = read_certificate(file);
  Plan plan = plan_from_json(text, file);
  Build here = current_build();
  if (!works) here.instruction_set = plan.build.instruction_set;
  if (const std::string why = refusal_of_build(plan, here); !why.empty()) throw Error(file + ": " + why);
  return built(std::move(plan), digest_of_text(text), stop);
}

// True for each unit that is done.
std::vector<bool> done_in(const PlanFolder& folder) {
  std::vector<bool> all;
  for (std::uint64_t i = 0; i < folder.folders(); ++i) {
    const std::vector<bool> done = folder.done(i);
    all.insert(all.end(), done.begin(), done.end());
  }
  return all;
}

std::string words_of_missing(const std::vector<bool>& is_done) {
  std::string words;
  std::size_t ranges = 0;
  for (std::size_t i = 0; i < is_done.size(); ++i) {
    if (is_done[i]) continue;
    const std::size_t first = i;
    while (i + 1 < is_done.size() && !is_done[i + 1]) ++i;
    if (++ranges > kMostRanges) continue;
    words += (ranges == 1 ? "units " : ", ") + std::to_string(first) + (i > first ? " to " + std::to_string(i) : "");
  }
  if (ranges > kMostRanges) words += " and more";
  return ranges == 0 ? "" : words + " of " + std::to_string(is_done.size());
}

PlanState state_of(const OpenedPlan& opened, const PlanFolder& folder, const std::vector<bool>& is_done) {
  PlanState state{opened.digest, folder.units()};
  state.done = static_cast<std::uint64_t>(std::ranges::count(is_done, true));
  for (const auto& [unit, age] : folder.claims())
    ++(age < static_cast<double>(opened.plan.lease) ? state.taken : state.expired);
  state.missing = words_of_missing(is_done);
  for (const fs::path& file : folder.alarms()) state.alarms.push_back(file);
  return state;
}

std::string host() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? files::printable(name.data()) : "unknown";
}

// The run's facts about itself, which merged_plan() reads and which are no part of the evidence.
void write_run(const OpenedPlan& opened, const fs::path& file, const Worked& worked, double seconds) {
  const nlohmann::ordered_json run{{"plan", opened.digest}, {"date", system::date()}, {"processor", processor_name()},
                                   {"host", host()},        {"seconds", seconds},     {"units", worked.units}};
  files::write_file(file, run.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

// The runs are no evidence: one that cannot be read is left out.
void add_runs(Certificate& certificate, const OpenedPlan& opened, const fs::path& folder) {
  std::set<std::string> processors;
  std::error_code missing;
  for (fs::directory_iterator entry(folder, missing), end; !missing && entry != end; entry.increment(missing)) {
    if (!entry->is_regular_file(missing)) continue;
    std::ifstream stream(entry->path());
    nlohmann::json run = nlohmann::json::parse(stream, nullptr, false);
    if (!run.is_object() || run["plan"] != opened.digest) continue;
    if (!run["seconds"].is_number() || !run["date"].is_string() || !run["processor"].is_string()) continue;
    certificate.seconds += run["seconds"].get<double>();
    certificate.date = std::max(certificate.date, run["date"].get<std::string>());
    processors.insert(run["processor"].get<std::string>());
  }
  for (const std::string& name : processors)
    certificate.processor += (certificate.processor.empty() ? "" : "; ") + files::printable(name);
  if (certificate.date.empty()) certificate.date = system::date();
}

Certificate merged_units(const OpenedPlan& opened, const Units& units, const PlanFolder& folder,
                         const std::vector<bool>& is_done) {
  std::vector<Found> found(units.items().size());
  std::vector<std::uint64_t> parts(found.size());
  Sweeps sweeps = opened.sweeps;
  bool is_gapless = true;
  for (std::uint64_t number = 0; number < units.count(); ++number) {
    is_gapless = is_gapless && is_done[number];
    if (!is_done[number]) continue;
    const Unit unit = units.at(number);
    found[unit.item].add(unit_from_text(folder.kept(number), opened.digest, number, units, folder.result_file(number)));
    parts[unit.item] += unit.end - unit.first;
    if (is_gapless && units.items()[unit.item].kind == ItemKind::sweep) sweeps.next += unit.end - unit.first;
  }
  Certificate certificate = assembled(opened.what, std::move(sweeps), units, found, parts);
  certificate.build = opened.plan.build;
  if (!opened.plan.has_sweeps()) {
    const std::vector<std::string> files = subjects::written_files(opened.named);
    for (std::size_t i = 0; i < files.size(); ++i) {
      certificate.subjects[i].subject_file = files[i];
      certificate.subjects[i].options = subjects::written_for_shell(opened.named);
    }
  }
  add_runs(certificate, opened, folder.path() / "runs");
  certificate.sweeps.seconds = certificate.sweeps.results.empty() ? 0 : certificate.seconds;
  return certificate;
}

}  // namespace

PlanState make_plan(const std::string& folder, const PlanRequest& request, const std::atomic<bool>& stop) {
  Plan plan;
  plan.lease = request.lease;
  if (request.subject.empty()) {
    plan.sweeps = request.sweeps;
  } else {
    // With their folders, because workers begin elsewhere.
    const auto absolute = [](const std::string& file) { return fs::absolute(file).lexically_normal().string(); };
    for (const auto& [key, value] : request.subject)
      plan.subject.emplace_back(key, subjects::with_file_placed(key, value, absolute));
    plan.points = 1;  // until the kind is known
    plan.cases = request.cases;
    plan.seed = request.seed;
  }
  OpenedPlan opened = built(plan, "", stop);
  if (!plan.has_sweeps()) {
    const auto& all = opened.what.subjects;
    opened.plan.points = opened.what.points =
        request.points > 0 ? request.points : points_of_kind(all.front()->identity().kind);
    for (const auto& each : all) opened.plan.identities.push_back(identity_line(each->identity()));
  }
  const std::vector<Item> items = opened.work().items();
  if (items.empty()) throw Error("--exhaustive: expected a kind of sweep that the law has, got none of them");
  opened.plan.parts_of_a_unit = parts_for_units(items, request.units);
  const std::string text = to_json(opened.plan);
  PlanFolder::create(folder, text);
  return {digest_of_text(text), opened.units().count()};
}

PlanState state_of_plan(const std::string& folder, const std::atomic<bool>& stop) {
  const OpenedPlan plan = opened(folder, false, stop);
  const PlanFolder its(folder, plan.units().count());
  return state_of(plan, its, done_in(its));
}

Worked work_on_plan(const std::string& path, const PlanWorker& worker, const std::atomic<bool>& stop) {
  if (const char* fault = fast::arithmetic_fault()) throw Error(std::string("nothing can be certified: ") + fault);
  const OpenedPlan plan = opened(path, true, stop);
  const Units units = plan.units();
  const PlanFolder folder(path, units.count());
  const std::vector<bool> is_done = done_in(folder);
  const auto done = std::ranges::count(is_done, true);
  const auto draw = [&](std::uint64_t more) {
    if (worker.progress)
      worker.progress(
          std::min(1.0, (static_cast<double>(done) + static_cast<double>(more)) / static_cast<double>(units.count())));
  };
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  auto written = start;
  const auto seconds = [&](Clock::time_point end) { return std::chrono::duration<double>(end - start).count(); };
  const auto lease = static_cast<double>(plan.plan.lease);
  Claims claims(folder, lease, host() + " process " + std::to_string(::getpid()));
  const fs::path run = folder.path() / "runs" / (claims.token() + ".json");
  draw(0);
  const DividedWork its = plan.work();
  const Worked worked = work_through(
      folder, claims, {worker.threads, lease, worker.waits},
      [&](std::uint64_t number) -> std::string {
        const Unit unit = units.at(number);
        const Found found = its.found(units.items()[unit.item], unit.first, unit.end, stop);
        return stop ? "" : text_of_unit(plan.digest, number, units, found);
      },
      [&](const Worked& so_far) {
        draw(so_far.units);
        if (const auto now = Clock::now(); seconds(now) - seconds(written) > kSecondsBetweenNotes) {
          write_run(plan, run, so_far, seconds(now) * worker.threads);
          written = now;
        }
      },
      stop);
  if (worked.units > 0) write_run(plan, run, worked, seconds(Clock::now()) * worker.threads);
  return worked;
}

MergedPlan merged_plan(const std::string& path, const std::atomic<bool>& stop) {
  const OpenedPlan plan = opened(path, false, stop);
  const Units units = plan.units();
  const PlanFolder folder(path, units.count());
  const std::vector<bool> is_done = done_in(folder);
  PlanState state = state_of(plan, folder, is_done);
  if (!state.alarms.empty()) return {std::move(state), {}};
  return {std::move(state), merged_units(plan, units, folder, is_done)};
}

}  // namespace forceshade::properties
