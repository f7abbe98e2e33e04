// SPDX-License-Identifier: BSD-3-Clause
// The reasons why a certificate does not let a renderer be driven.

#include <algorithm>

#include "forceshade/certificate.h"
#include "text/joined.h"

namespace forceshade::properties {
namespace {

std::optional<std::string> other_build(const Build& certified, const Build& build) {
  const auto differs = [](const std::string& what, const std::string& expected, const std::string& got) {
    return "the certificate is for " + what + ": expected " + expected + ", got " + got;
  };
  if (certified.library_digest != build.library_digest)
    return differs("another build of the renderer", "digest " + build.library_digest, certified.library_digest);
  if (certified.compiler != build.compiler) return differs("another compiler", build.compiler, certified.compiler);
  if (certified.flags != build.flags) return differs("other compiler flags", build.flags, certified.flags);
  return std::nullopt;
}

// The single call's own code is that of the widest set too, but for what it leaves to scalar code.
std::optional<std::string> uncovered_set(const Findings& found, const std::string& name, const Build& build) {
  for (const std::string& set : {std::string("scalar"), build.instruction_set})
    if (!found.covers(set) || !found.spread.covers(set)) {
      const std::string covered = joined(found.points_by_instruction_set, ", ", [](const auto& set) { return set.first; });
      return "the certificate does not cover the instruction set that would run here for " + name + ": expected " + set +
             ", got " + (covered.empty() ? "none" : covered);
    }
  return std::nullopt;
}

// The reason why none of these entries, which cover the subject and are not empty, is enough, of the library's renderer rather
// than of another; nothing where one is.
std::optional<std::string> insufficient(std::vector<const SubjectResult*> entries, const Build& build) {
  std::stable_partition(entries.begin(), entries.end(),
                        [](const SubjectResult* entry) { return entry->rendered_by == RenderedBy::library; });
  std::optional<std::string> why;
  for (const SubjectResult* entry : entries) {
    auto one = lacking(*entry);
    if (!one) one = uncovered_set(*entry, entry->name(), build);
    if (!one) return std::nullopt;
    if (!why) why = std::move(one);
  }
  return why;
}

std::optional<std::string> nothing_but_sweeps(const Certificate& certificate) {
  if (!certificate.subjects.empty()) return std::nullopt;
  return "the certificate has sweeps only; driving needs one of points and properties";
}

// The reason why none of the entries of its kind is alike.
std::string another(const Identity& subject, const std::vector<const SubjectResult*>& of_its_kind) {
  if (of_its_kind.empty() || subject.digest.empty())
    return "the certificate does not cover the " + subject.kind + ' ' + subject.name;
  const Identity& its = of_its_kind.front()->identity;
  return "the certificate covers another " + subject.kind + ": expected the digest " + subject.digest + ", got " + its.digest +
         " (" + its.name + ')';
}

}  // namespace

std::optional<std::string> refusal(const Certificate& certificate, const Build& build, const Identity& subject) {
  if (auto other = other_build(certificate.build, build)) return other;
  if (auto sweeps_only = nothing_but_sweeps(certificate)) return sweeps_only;
  // One that failed speaks against the subject, whatever its parameters.
  bool failed = std::any_of(certificate.sweeps.results.begin(), certificate.sweeps.results.end(), [&](const SweepResult& r) {
    return subject.kind == kLawKind && name_of(r.sweep.law) == subject.name && r.mismatches > 0;
  });
  bool own_failed = false;
  std::vector<const SubjectResult*> of_its_kind, alike, same;
  for (const SubjectResult& result : certificate.subjects) {
    if (result.identity.kind != subject.kind) continue;
    of_its_kind.push_back(&result);
    if (!result.identity.is_alike(subject)) continue;
    alike.push_back(&result);
    if (!result.held()) (result.rendered_by == RenderedBy::program ? own_failed : failed) = true;
    if (result.identity.is_same(subject)) same.push_back(&result);
  }
  if (alike.empty()) return another(subject, of_its_kind);
  if (same.empty())
    return "the certificate covers " + alike.back()->name() + " with other parameters: expected " +
           parameters_in_words(subject) + "; got " + parameters_in_words(alike.back()->identity);
  if (failed || own_failed)
    return "the certificate says that " + std::string(failed ? "" : "a program's own renderer of ") + subject.name + " failed";
  return insufficient(same, build);
}

}  // namespace forceshade::properties
