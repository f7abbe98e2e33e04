// SPDX-License-Identifier: BSD-3-Clause
// forceshade recording: what a recording says of itself, whether it is whole and its forces are the exact ones, and its ticks
// for other programs.

#include <boost/multiprecision/gmp.hpp>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/command_check.h"
#include "apps/output_options.h"
#include "apps/progress_line.h"
#include "apps/signals.h"
#include "apps/subject_option.h"
#include "apps/tell.h"
#include "device/damped_work.h"
#include "files/printable.h"
#include "forceshade/checks.h"
#include "forceshade/recording.h"
#include "properties/binary32.h"
#include "run/recorder/settings.h"
#include "run/words.h"

namespace forceshade::apps {
namespace {

struct RecordOptions {
  std::string file, out = "-", json;
};

// No expression templates: what is computed is what is written.
using Exact = boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;

constexpr std::uint64_t kListed = 10;  // forces that differ

nlohmann::ordered_json described(recorder::Recording& recording, const std::vector<std::string>& problems) {
  const auto extent = recording.extent();
  return {{"file", recording.path()},
          {"ended", recording.ended()},
          {"samples", extent.samples},
          {"first_tick", extent.first_tick},
          {"last_tick", extent.last_tick},
          {"missing_ticks", extent.missing},
          {"repeated_samples", extent.repeated},
          {"problems", problems},
          {"metadata_problem", recording.metadata_problem()},
          {"metadata", recording.metadata()}};
}

void print_info(recorder::Recording& recording) {
  const auto extent = recording.extent();
  std::printf("%-20s %" PRIu64 " (ticks %" PRIu64 " to %" PRIu64 ", %" PRIu64 " missing, %" PRIu64 " repeated)\n", "samples",
              extent.samples, extent.first_tick, extent.last_tick, extent.missing, extent.repeated);
  for (const auto& [key, value] : recording.metadata())
    if (key != "samples" && key != "layout")
      std::printf("%-20s %s\n", files::printable(key).c_str(), files::printable(value).c_str());
  if (!recording.ended()) std::printf("%-20s no: cut off, or still being made\n", "ended");
}

// The recording's forces and commands, computed again.
struct Recomputed {
  std::uint64_t samples = 0, contacts = 0, differences = 0;
  CommandCheck commands;
  std::optional<damping::Parameters> damping;
  device::DampedWork<Exact> work{};

  bool held() const { return differences == 0 && commands.differences() == 0; }
  nlohmann::ordered_json json() const {
    nlohmann::ordered_json json{{"ticks", samples},
                                {"in_contact", contacts},
                                {"forces_that_differ", differences},
                                {"commands_that_differ", commands.differences()}};
    if (damping)
      json["damping"] = {{"spring_mJ", static_cast<double>(work.spring)},
                         {"damper_mJ", static_cast<double>(work.damper)},
                         {"sampling_mJ", static_cast<double>(work.sampling)},
                         {"most_given_mJ", work.most(*damping)}};
    return json;
  }
  void print() const {
    std::printf("computed again: %" PRIu64 " ticks, %" PRIu64 " in contact, %" PRIu64 " differ\n", samples, contacts,
                differences);
    if (!commands.why_not().empty())
      std::printf("commands: not computed: %s\n", commands.why_not().c_str());
    else
      std::printf("commands: %" PRIu64 " ticks, %" PRIu64 " changed by supervisor or controller, %" PRIu64 " differ\n",
                  commands.ticks(), commands.changed(), commands.differences());
    if (!damping) return;
    std::printf("damping: %s\n", run::words_of(*damping).c_str());
    std::printf("the renderer's force gave %.9g mJ by its spring, %.9g by the damper, %.9g by its sampling, exactly",
                static_cast<double>(work.spring), static_cast<double>(work.damper), static_cast<double>(work.sampling));
    if (const double most = work.most(*damping); !std::isnan(most))
      std::printf("; damping can give %.9g mJ at most along this path", most);
    std::printf("\n");
  }
};

// Throws Error where something else was recorded. damping: off where none was named.
void expect_recorded(const recorder::Recording& recording, const Identity& identity, const damping::Described& damping) {
  if (recording.metadata().contains("self_intersections"))
    throw Error(recording.path() +
                ": was recorded with --self-intersecting, by another rule than that of docs/soups.md; "
                "expected the version of forceshade that it names");
  recorder::Metadata all = run::metadata_of(identity);
  if (!damping.parameters.is_off()) {
    const auto recorded = recorder::damping_in(recording.metadata(), recording.path());
    if (!recorded) throw Error(recording.path() + ": the run had no damping; expected that of the subject");
    all.merge(recorder::metadata_of(damping.at(static_cast<double>(recorded->rate))));
  }
  for (const auto& [key, expected] : all) {
    const auto found = recording.metadata().find(key);
    if (found == recording.metadata().end() || found->second != expected)
      throw Error(recording.path() + ": " + key + " is " +
                  (found == recording.metadata().end() ? "not recorded" : found->second) + "; expected " + expected);
  }
}

// Computes the forces again from the recorded positions by the definition.
Recomputed recompute(recorder::Recording& recording, const properties::Subject& subject) {
  watch_for_interrupt();
  ProgressLine line(subject.identity().name);
  const auto reference = subject.open_reference();
  const std::uint64_t all = recording.extent().samples;
  Recomputed its{.commands = CommandCheck(recording), .damping = recorder::damping_in(recording.metadata(), recording.path())};
  std::optional<reference::Damping> damping;
  if (its.damping) damping = std::get<reference::Damping>(reference::Damping::build(*its.damping));
  recording.for_each_chunk([&](std::span<const device::Sample> chunk) {
    if (interrupted()) throw Interrupted(recording.path() + " was not computed to its end");
    for (const device::Sample& sample : chunk) {
      if (sample.status == device::Sample::kEnd) continue;  // the law was not evaluated
      ++its.samples;
      if (!its.commands.is_same(sample) && its.commands.differences() <= kListed)
        tell("tick " + std::to_string(sample.tick) + ": the command is not what supervisor and controller make of the force");
      const Eigen::Vector3f position(sample.position.data());
      const reference::Rounded spring = reference->step(position);
      const reference::Rounded exact = damping ? damping->tick(position, sample.periods(), spring) : spring;
      if (damping) {
        std::optional<device::DampedTick> tick;
        if (exact.status != Status::invalid) tick = {position, spring.force, exact.force, damping->state().velocity};
        its.work.add(tick, sample.periods(), its.damping->rate);
      }
      const auto& [fx, fy, fz] = sample.law_force;
      const bool is_same =
          finished(exact.status) == finished(sample.law_status()) && (exact.force.array() == Eigen::Array3f(fx, fy, fz)).all();
      its.contacts += finished(exact.status) == Status::contact ? 1 : 0;
      if (is_same || ++its.differences > kListed) continue;
      tell("tick " + std::to_string(sample.tick) + ": recorded " + properties::show(Eigen::Vector3f(fx, fy, fz)) +
           " N, expected " + properties::show(exact.force) + " N");
    }
    line.draw(static_cast<double>(its.samples) / static_cast<double>(std::max<std::uint64_t>(all, 1)));
  });
  return its;
}

int check(const RecordOptions& options, const SubjectOption& option) {
  recorder::Recording recording(options.file);
  std::shared_ptr<const properties::Subject> subject;
  if (option.is_given()) {
    const Description described = option.description();
    subject = properties::subject_of(described);
    expect_recorded(recording, subject->identity(), described.damping);
  }
  const std::vector<std::string> problems = problems_of(recording);
  for (const std::string& problem : problems) tell(problem);
  const bool is_printed = options.json != "-", is_whole = problems.empty();
  if (is_printed) print_info(recording);
  if (is_printed && is_whole)
    std::printf("whole: %" PRIu64 " samples, every tick and every checksum%s\n", recording.extent().samples,
                recording.has_digest() ? ", and the metadata"
                                       : "; format 2 has no checksum of the metadata: that the law, its parameters, the "
                                         "certificate and the device are those of the run cannot be verified");
  std::optional<Recomputed> recomputed;
  if (is_whole && subject) recomputed = recompute(recording, *subject);
  if (recomputed && is_printed) recomputed->print();
  if (!options.json.empty()) {
    auto json = described(recording, problems);
    if (recomputed) json["computed_again"] = recomputed->json();
    write_json(options.json, json);
  }
  return is_whole && (!recomputed || recomputed->held()) ? kHeld : kFailed;
}

int write(const RecordOptions& options) {
  recorder::Recording recording(options.file);
  export_table(recording, options.out);
  if (!recording.ended()) tell(options.file + ": the recording has no end: cut off, or still being made");
  return kHeld;
}

}  // namespace

void add_recording(CLI::App& app, int& result) {
  CLI::App* command = app.add_subcommand("recording", "Check and export what drive recorded");
  command->require_subcommand(1);
  const auto add = [&](const char* name, const char* help) {
    const auto options = std::make_shared<RecordOptions>();
    CLI::App* verb = command->add_subcommand(name, help);
    verb->add_option("file", options->file, "a recording, FILE.fsr")->type_name("FILE")->required();
    return std::pair(verb, options);
  };
  const auto [check_verb, check_options] =
      add("check",
          "Print the subject, the device and the settings of a recording, and check that it is whole: 0 if so, 1 if cut off, "
          "damaged or with ticks missing. With a subject: that every force is the exact one, rounded, and every command what "
          "supervisor and controller make of it");
  const auto subject = std::make_shared<SubjectOption>(*check_verb, subjects::Laws::one, true);
  add_json(*check_verb, check_options->json, "the same");
  check_verb->callback([options = check_options, subject, &result] { result = check(*options, *subject); });
  const auto [export_verb, export_options] = add("export", "The ticks for other programs");
  add_output(*export_verb, "--out", export_options->out,
             "FILE.npy, a structured array for numpy.load; else its CSV, - for standard output", {".csv", ".npy"})
      ->capture_default_str();
  export_verb->callback([options = export_options, &result] { result = write(*options); });
}

}  // namespace forceshade::apps
