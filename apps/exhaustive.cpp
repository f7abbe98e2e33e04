// SPDX-License-Identifier: BSD-3-Clause
#include "apps/exhaustive.h"

#include <algorithm>
#include <charconv>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/certificate_files.h"
#include "apps/certify_plan.h"
#include "apps/command.h"
#include "apps/options.h"
#include "apps/progress_line.h"
#include "apps/signals.h"
#include "certificate/build.h"
#include "certificate/report/thesis.h"
#include "files/printable.h"
#include "forceshade/certify.h"
#include "rendering/subjects/read.h"
#include "system/system.h"

namespace forceshade::apps {
namespace {

using properties::Certificate;
using properties::Sweeps;

constexpr double kSecondsBetweenSaves = 5;

struct Shard {
  std::uint64_t k = 0, n = 0;
};

Shard parse_shard(const std::string& text) {
  Shard shard;
  const char* const end = text.data() + text.size();
  const auto k = std::from_chars(text.data(), end, shard.k);
  if (k.ec == std::errc() && k.ptr < end && *k.ptr == '/') {
    const auto n = std::from_chars(k.ptr + 1, end, shard.n);
    if (n.ec == std::errc() && n.ptr == end && shard.k >= 1 && shard.k <= shard.n && shard.n <= 1000000) return shard;
  }
  throw BadInput("--shards: expected k/n with 1 <= k <= n, for example 1/8; got \"" + text + "\"");
}

// The part as far as it is done: the file of an earlier run if there is one.
Certificate begin_or_resume(const std::string& file, const Sweeps& part) {
  const properties::Build build = properties::current_build();
  if (!std::filesystem::exists(file)) return {build, 0, {}, part, system::date(), properties::processor_name()};
  const Certificate earlier = properties::from_json(properties::read_certificate(file), file);
  const auto sweep_of = [](const properties::SweepResult& result) { return result.sweep; };
  const bool same = std::ranges::equal(earlier.sweeps.results, part.results, {}, sweep_of, sweep_of) &&
                    earlier.sweeps.first == part.first && earlier.sweeps.end == part.end;
  if (!(earlier.build == build))
    throw BadInput(file + ": expected a part that this build began, got one of another build; remove it to begin again");
  if (!same)
    throw BadInput(file + ": expected a part of these sweeps, got one of other sweeps; remove it or choose another --out");
  return earlier;
}

double share_done(const Sweeps& sweeps) {
  return static_cast<double>(sweeps.next - sweeps.first) / static_cast<double>(sweeps.end - sweeps.first);
}

// The rate, and the sweep that is being done.
std::string details(const Sweeps& sweeps) {
  const auto& sweep =
      sweeps.results[std::min<std::size_t>(sweeps.next / properties::kUnitsPerSweep, sweeps.results.size() - 1)].sweep;
  char words[160];
  std::snprintf(words, sizeof words, "%.0f M inputs/s  %s %s",
                static_cast<double>(sweeps.inputs()) / std::max(sweeps.seconds, 1e-9) / 1e6, name_of(sweep.law).data(),
                properties::kSweepKinds[static_cast<std::size_t>(sweep.kind)].data());
  return words;
}

// Until it is finished or interrupted; saved from time to time.
void sweep(Certificate& part, unsigned threads, const std::string& file) {
  Sweeps& sweeps = part.sweeps;
  ProgressLine line("sweeps");
  line.draw(share_done(sweeps));
  double saved_at = sweeps.seconds;
  while (!sweeps.is_finished() && !interrupted()) {
    sweeps = properties::continued(sweeps, 8 * threads, threads);
    if (sweeps.seconds - saved_at > kSecondsBetweenSaves) {
      write_file(file, properties::to_json(part));
      saved_at = sweeps.seconds;
    }
    line.draw(share_done(sweeps), details(sweeps));
  }
  part.seconds = sweeps.seconds;
  part.date = system::date();
  write_file(file, properties::to_json(part));
}

}  // namespace

void print_sweeps(const Sweeps& sweeps) {
  for (const properties::SweepTotal& total : properties::totals(sweeps))
    std::printf("%-15s %-9s %4" PRIu64 " sweeps %14" PRIu64 " inputs %" PRIu64 " mismatches\n", name_of(total.law).data(),
                properties::kSweepKinds[static_cast<std::size_t>(total.kind)].data(), total.sweeps, total.inputs,
                total.mismatches);
  for (const std::string& words : sweeps.counterexamples) std::printf("  %s\n", files::printable(words).c_str());
  std::printf("%" PRIu64 " inputs in %.0f s (%.0f M/s), %" PRIu64 " mismatches\n", sweeps.inputs(), sweeps.seconds,
              static_cast<double>(sweeps.inputs()) / std::max(sweeps.seconds, 1e-9) / 1e6, sweeps.mismatches());
}

void ExhaustiveOptions::add_to(CLI::App& command) {
  add_kinds_to(command);
  command.add_option("--shards", shards, "do part k of n, to be joined by 'certify merge'")
      ->type_name("k/n")
      ->needs(command.get_option("--exhaustive"))
      ->capture_default_str();
}

void ExhaustiveOptions::add_kinds_to(CLI::App& command) {
  CLI::Option* flag = command.add_flag("--exhaustive", is_given,
                                       "sweep over every binary32 instead of points and cases; can be stopped and resumed");
  command.add_option("--sweeps", sweeps, "directions, heights (the five radii of the thesis unless --radius is given), lines")
      ->type_name("LIST")
      ->delimiter(',')
      ->check(one_of({"directions", "heights", "lines"}))
      ->needs(flag)
      ->capture_default_str();
}

properties::SweepPlan sweep_plan(const ExhaustiveOptions& options, const subjects::Options& named, bool radius_is_given) {
  for (const std::string_view kind : subjects::kKinds)
    if (kind != "law" && named.has(kind))
      throw BadInput("--exhaustive: expected --law, got --" + std::string(kind) + ", which has too many inputs to sweep");
  properties::SweepPlan plan{{}, {}, {}};
  for (const DescribedLaw& law : subjects::laws_of(named)) {
    plan.laws.push_back(law.law);
    plan.parameters = law.parameters;
  }
  for (const properties::ThesisRadius& radius : properties::kThesisRadii) plan.radii.push_back(radius.mm);
  if (radius_is_given) plan.radii = {plan.parameters.radius};
  const auto is_chosen = [&](const char* kind) { return std::ranges::find(options.sweeps, kind) != options.sweeps.end(); };
  plan.directions = is_chosen("directions");
  plan.heights = is_chosen("heights");
  plan.lines = is_chosen("lines");
  return plan;
}

int run_exhaustive(const ExhaustiveOptions& options, const properties::SweepPlan& plan, unsigned threads,
                   const OutFolder& out) {
  const Shard shard = parse_shard(options.shards);
  const Sweeps all = properties::planned(plan);
  if (all.results.empty()) throw BadInput("--sweeps: expected a kind of sweep that the law has, got none of them");
  if (shard.n > 1) {
    out.make_for_several();
  } else {
    out.expect_room_for(certificate_files());
    out.make();
  }
  const std::string file = std::filesystem::path(out.path()) /
                           ("exhaustive-" + std::to_string(shard.k) + "-of-" + std::to_string(shard.n) + ".json");
  Certificate part = begin_or_resume(file, properties::part_of(all, shard.k, shard.n));
  sweep(part, threads, file);
  const Sweeps& sweeps = part.sweeps;
  if (!sweeps.is_finished()) {
    std::fprintf(stderr, "forceshade: stopped; the same command goes on from %s\n", file.c_str());
    return kInterrupted;
  }
  print_sweeps(sweeps);
  if (sweeps.is_whole()) {
    const int result = write_certificate(part, out.folder());
    std::filesystem::remove(file);  // the certificate has all of it
    return result;
  }
  std::printf("part %s; join the parts with: forceshade certify merge FILE... --out DIR\n", file.c_str());
  return sweeps.mismatches() == 0 ? kHeld : kFailed;
}

void add_merge(CLI::App& certify, int& result) {
  struct Options {
    std::vector<std::string> files;
  };
  const auto options = std::make_shared<Options>();
  CLI::App* command = certify.add_subcommand(
      "merge",
      "Join certificates of points with different seeds, or the parts of an exhaustive run, or both; or the units of a plan");
  command
      ->add_option("files", options->files,
                   "certificate.json of one build, and exhaustive-k-of-n.json of every k; or the folder of a plan")
      ->type_name("FILE")
      ->required();
  const auto out = std::make_shared<OutFolder>(*command, kCertificateFolder);
  out->require();
  command->callback([options, out, &certify, &result] {
    refuse_options_before(certify, "certify merge");
    if (options->files.size() == 1 && std::filesystem::is_directory(options->files.front())) {
      result = merge_plan(options->files.front(), *out);
      return;
    }
    std::vector<properties::CertificateFile> files;
    for (const std::string& name : options->files)
      files.push_back({name, properties::from_json(properties::read_certificate(name), name)});
    const Certificate certificate = properties::merged(std::move(files));
    out->expect_room_for(certificate_files());
    if (!certificate.sweeps.results.empty()) print_sweeps(certificate.sweeps);
    result = write_certificate(certificate, out->folder());
  });
}

}  // namespace forceshade::apps
