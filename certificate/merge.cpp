// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <functional>
#include <iterator>

#include "forceshade/certify.h"

namespace forceshade::properties {
namespace {

std::string units(std::uint64_t first, std::uint64_t end) {
  return "units " + std::to_string(first) + " to " + std::to_string(end);
}

bool same_sweeps(const Sweeps& a, const Sweeps& b) {
  return std::equal(a.results.begin(), a.results.end(), b.results.begin(), b.results.end(),
                    [](const SweepResult& x, const SweepResult& y) { return x.sweep == y.sweep; });
}

void add(Sweeps& sum, const Sweeps& part) {
  sum.end = sum.next = part.end;
  sum.seconds += part.seconds;
  std::transform(part.stages.begin(), part.stages.end(), sum.stages.begin(), sum.stages.begin(), std::plus<>());
  for (std::size_t i = 0; i < sum.results.size(); ++i) {
    sum.results[i].inputs += part.results[i].inputs;
    sum.results[i].mismatches += part.results[i].mismatches;
  }
  sum.counterexamples.insert(sum.counterexamples.end(), part.counterexamples.begin(), part.counterexamples.end());
}

// Parts sorted by their first unit.
Sweeps joined(const std::vector<CertificateFile>& parts) {
  const CertificateFile* before = &parts.front();
  Sweeps sum = before->certificate.sweeps;
  for (const CertificateFile& part : parts) {
    const Sweeps& sweeps = part.certificate.sweeps;
    if (!same_sweeps(sweeps, sum))
      throw CertificateError(part.name + ": expected the sweeps of " + before->name + ", got others");
    if (!sweeps.is_finished())
      throw CertificateError(part.name + ": expected a finished part; " + units(sweeps.next, sweeps.end) + " are not done");
    if (&part == &parts.front()) continue;
    if (sweeps.first < sum.end)
      throw CertificateError(part.name + ": overlaps " + before->name + " in " +
                             units(sweeps.first, std::min(sum.end, sweeps.end)));
    if (sweeps.first > sum.end)
      throw CertificateError("missing part: " + units(sum.end, sweeps.first) + ", between " + before->name + " and " +
                             part.name);
    add(sum, sweeps);
    before = &part;
  }
  if (sum.first > 0) throw CertificateError("missing part: " + units(0, sum.first) + ", before " + parts.front().name);
  if (sum.end < sum.units())
    throw CertificateError("missing part: " + units(sum.end, sum.units()) + ", after " + parts.back().name);
  return sum;
}

void add(Comparison::Counts& sum, const Comparison::Counts& part) {
  for (const auto& [name, count] : part) sum[name] += count;
}

void add(Comparison& sum, const Comparison& part) {
  // A set whose code one of them did not compare was not compared at every point of the sum.
  Comparison::Counts sets;
  for (const auto& [set, points] : sum.points_by_instruction_set)
    if (const auto its = part.points_by_instruction_set.find(set); its != part.points_by_instruction_set.end())
      sets[set] = points + its->second;
  sum.points_by_instruction_set = std::move(sets);
  sum.points += part.points;
  sum.mismatches += part.mismatches;
  add(sum.points_by_aim, part.points_by_aim);
  add(sum.points_by_stage, part.points_by_stage);
  add(sum.points_by_method, part.points_by_method);
  add(sum.points_by_status, part.points_by_status);
  for (const std::string& words : part.counterexamples)
    if (sum.counterexamples.size() < kCounterexamples) sum.counterexamples.push_back(words);
}

// Each certificate has every property, in the same order.
void add(std::vector<PropertyResult>& sum, const std::vector<PropertyResult>& part) {
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i].cases += part[i].cases;
    if (sum[i].held) sum[i].counterexample = part[i].counterexample;
    sum[i].held = sum[i].held && part[i].held;
  }
}

// Both are of the same subject, checked by the same build.
void add(SubjectResult& sum, const SubjectResult& part) {
  add(static_cast<Comparison&>(sum), part);
  add(static_cast<Comparison&>(sum.spread), part.spread);
  sum.spread.parameter_sets += part.spread.parameter_sets;
  if (part.closest_call.ulps_from_tie < sum.closest_call.ulps_from_tie) sum.closest_call = part.closest_call;
  add(sum.properties, part.properties);
  sum.unit_directions = sum.unit_directions && part.unit_directions;
  std::vector<std::uint64_t> seeds;
  std::set_union(sum.seeds.begin(), sum.seeds.end(), part.seeds.begin(), part.seeds.end(), std::back_inserter(seeds));
  sum.seeds = std::move(seeds);
  if (sum.subject_file.empty()) sum.subject_file = part.subject_file;
}

// The reason why the two cannot be added up; empty if they can. What does not depend on a seed is the same in both.
std::string contradiction(const SubjectResult& a, const SubjectResult& b) {
  std::vector<std::uint64_t> common;
  std::set_intersection(a.seeds.begin(), a.seeds.end(), b.seeds.begin(), b.seeds.end(), std::back_inserter(common));
  if (!common.empty()) return "another seed than " + std::to_string(common.front()) + ", which gives the same points again";
  if (a.parts != b.parts || a.jumps != b.jumps || a.conservative != b.conservative) return "the same parts and jumps";
  // An energy that is not enclosed has no entry.
  const auto same = [](const LoopEnergy& x, const LoopEnergy& y) {
    return x.depth_mm == y.depth_mm && x.bound_mJ == y.bound_mJ && x.witness_mJ == y.witness_mJ &&
           x.measured_mJ == y.measured_mJ;
  };
  if (!std::equal(a.energy.begin(), a.energy.end(), b.energy.begin(), b.energy.end(), same))
    return "the same energies per loop";
  return "";
}

struct Entry {
  SubjectResult subject;
  std::string file;  // the first that has it
};

std::vector<SubjectResult> joined_subjects(const std::vector<CertificateFile>& files) {
  std::vector<Entry> entries;
  for (const auto& [name, certificate] : files)
    for (const SubjectResult& subject : certificate.subjects) {
      const auto found = std::find_if(entries.begin(), entries.end(),
                                      [&](const Entry& entry) { return entry.subject.identity.is_same(subject.identity); });
      if (found == entries.end()) {
        entries.push_back({subject, name});
        continue;
      }
      if (const std::string expected = contradiction(found->subject, subject); !expected.empty())
        throw CertificateError(name + ": " + subject.name() + ": expected " + expected + "; " + found->file + " has it");
      add(found->subject, subject);
    }
  std::vector<SubjectResult> subjects;
  for (Entry& entry : entries) subjects.push_back(std::move(entry.subject));
  return subjects;
}

}  // namespace

Certificate merged(std::vector<CertificateFile> files) {
  if (files.empty()) throw CertificateError("expected at least one part");
  const CertificateFile first = files.front();
  for (const CertificateFile& file : files)
    if (!(file.certificate.build == first.certificate.build))
      throw CertificateError(file.name + ": expected the build of " + first.name + " (digest " +
                             first.certificate.build.library_digest + ", " + first.certificate.build.instruction_set +
                             "), got another (" + file.certificate.build.library_digest + ", " +
                             file.certificate.build.instruction_set + ")");
  std::vector<CertificateFile> of_sweeps;
  std::copy_if(files.begin(), files.end(), std::back_inserter(of_sweeps),
               [](const CertificateFile& file) { return !file.certificate.sweeps.results.empty(); });
  if (of_sweeps.empty() && files.size() < 2)
    throw CertificateError(first.name + ": expected another certificate to join it to");
  std::stable_sort(of_sweeps.begin(), of_sweeps.end(), [](const CertificateFile& a, const CertificateFile& b) {
    return a.certificate.sweeps.first < b.certificate.sweeps.first;
  });
  Certificate result = first.certificate;
  result.subjects = joined_subjects(files);
  if (!of_sweeps.empty()) result.sweeps = joined(of_sweeps);
  result.seconds = 0;
  for (const CertificateFile& file : files) {
    const Certificate& part = file.certificate;
    result.seconds += part.seconds;
    result.date = std::max(result.date, part.date);
    if (result.processor.find(part.processor) == std::string::npos) result.processor += "; " + part.processor;
  }
  return result;
}

}  // namespace forceshade::properties
