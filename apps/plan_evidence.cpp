// SPDX-License-Identifier: BSD-3-Clause
#include "apps/plan_evidence.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "certificate/build.h"
#include "certificate/unit_result.h"
#include "files/printable.h"
#include "rendering/subjects/file.h"
#include "system/system.h"

namespace forceshade::apps {
namespace {

constexpr std::size_t kMostRanges = 10;

// The runs are no evidence: one that cannot be read is left out.
void add_runs(properties::Certificate& certificate, const OpenedPlan& opened, const std::filesystem::path& folder) {
  std::set<std::string> processors;
  std::error_code missing;
  for (std::filesystem::directory_iterator entry(folder, missing), end; !missing && entry != end; entry.increment(missing)) {
    std::ifstream stream(entry->path());
    const nlohmann::json run = nlohmann::json::parse(stream, nullptr, false);
    if (!run.is_object() || run.value("plan", "") != opened.digest) continue;
    if (!run["seconds"].is_number() || !run["date"].is_string() || !run["processor"].is_string()) continue;
    certificate.seconds += run["seconds"].get<double>();
    certificate.date = std::max(certificate.date, run["date"].get<std::string>());
    processors.insert(run["processor"].get<std::string>());
  }
  for (const std::string& name : processors)
    certificate.processor += (certificate.processor.empty() ? "" : "; ") + files::printable(name);
  if (certificate.date.empty()) certificate.date = system::date();
}

}  // namespace

Progress progress_of(const properties::PlanFolder& folder) {
  Progress progress;
  for (std::uint64_t i = 0; i < folder.folders(); ++i) {
    const std::vector<bool> done = folder.done(i);
    progress.is_done.insert(progress.is_done.end(), done.begin(), done.end());
  }
  progress.done = static_cast<std::uint64_t>(std::count(progress.is_done.begin(), progress.is_done.end(), true));
  std::size_t ranges = 0;
  for (std::size_t i = 0; i < progress.is_done.size(); ++i) {
    if (progress.is_done[i]) continue;
    const std::size_t first = i;
    while (i + 1 < progress.is_done.size() && !progress.is_done[i + 1]) ++i;
    if (++ranges > kMostRanges) continue;
    progress.missing += (ranges == 1 ? "units " : ", ") + std::to_string(first) + (i > first ? " to " + std::to_string(i) : "");
  }
  if (ranges > kMostRanges) progress.missing += " and more";
  if (ranges > 0) progress.missing += " of " + std::to_string(progress.is_done.size());
  return progress;
}

bool say_alarms(const properties::PlanFolder& folder) {
  const std::vector<std::filesystem::path> alarms = folder.alarms();
  for (const std::filesystem::path& file : alarms)
    std::fprintf(stderr,
                 "forceshade: ALARM: %s differs from the result of the same unit beside it; one machine computes wrongly\n",
                 files::printable(file.string()).c_str());
  return !alarms.empty();
}

properties::Certificate merged_units(const OpenedPlan& opened, const properties::Units& units,
                                     const properties::PlanFolder& folder, const Progress& progress) {
  std::vector<properties::Found> found(units.items().size());
  std::vector<std::uint64_t> parts(found.size());
  properties::Sweeps sweeps = opened.sweeps;
  bool is_gapless = true;
  for (std::uint64_t number = 0; number < units.count(); ++number) {
    is_gapless = is_gapless && progress.is_done[number];
    if (!progress.is_done[number]) continue;
    const properties::Unit unit = units.at(number);
    found[unit.item].add(
        properties::unit_from_text(folder.kept(number), opened.digest, number, units, folder.result_file(number)));
    parts[unit.item] += unit.end - unit.first;
    if (is_gapless && units.items()[unit.item].kind == properties::ItemKind::sweep) sweeps.next += unit.end - unit.first;
  }
  properties::Certificate certificate = properties::assembled(opened.what, std::move(sweeps), units, found, parts);
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

}  // namespace forceshade::apps
