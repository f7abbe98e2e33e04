// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <iterator>

#include "forceshade/certify.h"

namespace forceshade::properties {
namespace {

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
      const auto found = std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) {
        return entry.subject.identity.is_same(subject.identity) && entry.subject.rendered_by == subject.rendered_by;
      });
      if (found == entries.end()) {
        entries.push_back({subject, name});
        continue;
      }
      if (const std::string expected = contradiction(found->subject, subject); !expected.empty())
        throw Error(name + ": " + subject.name() + ": expected " + expected + "; " + found->file + " has it");
      add(found->subject, subject);
    }
  std::vector<SubjectResult> subjects;
  for (Entry& entry : entries) subjects.push_back(std::move(entry.subject));
  return subjects;
}

// Those of the one file that has some.
Sweeps sweeps_of(const std::vector<CertificateFile>& files) {
  const CertificateFile* found = nullptr;
  for (const CertificateFile& file : files) {
    const Sweeps& sweeps = file.certificate.sweeps;
    if (sweeps.results.empty()) continue;
    if (found != nullptr) throw Error(file.name + ": expected no sweeps; " + found->name + " has them");
    if (!sweeps.is_whole()) throw Error(file.name + ": expected whole sweeps, got a part of them");
    found = &file;
  }
  return found == nullptr ? Sweeps{} : found->certificate.sweeps;
}

}  // namespace

Certificate merged(std::vector<CertificateFile> files) {
  if (files.empty()) throw Error("expected at least one certificate");
  const CertificateFile first = files.front();
  for (const CertificateFile& file : files)
    if (!(file.certificate.build == first.certificate.build))
      throw Error(file.name + ": expected the build of " + first.name + " (digest " + first.certificate.build.library_digest +
                  ", " + first.certificate.build.instruction_set + "), got another (" + file.certificate.build.library_digest +
                  ", " + file.certificate.build.instruction_set + ")");
  if (files.size() < 2) throw Error(first.name + ": expected another certificate to join it to");
  Certificate result = first.certificate;
  result.subjects = joined_subjects(files);
  result.sweeps = sweeps_of(files);
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
