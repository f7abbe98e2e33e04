// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "forceshade/certificate.h"
#include "rendering/breakdown.h"

namespace forceshade::properties {
namespace {

using Names = std::vector<std::string_view>;

std::uint64_t count_in(const Comparison::Counts& counts, std::string_view name) {
  const auto found = counts.find(std::string(name));
  return found == counts.end() ? 0 : found->second;
}

std::string some(std::uint64_t count, const std::string& word) {
  return std::to_string(count) + ' ' + word + (count == 1 ? "" : "s");
}

// The product of wall and bump-1p is exact in binary64. The flat surface of bump-1p-shaded is decided by z alone; what its
// binary64 leaves open is almost always a tie or nearly so, which only a wide number can decide.
Names stages_of(const Identity& identity) {
  const auto& [binary64, double_double, wide] = kStageNames;
  const auto its = law_of(identity);
  if (!its) return {binary64};
  const LawId law = its->law;
  if (law == LawId::wall || law == LawId::bump_1p) return {binary64};
  if (law == LawId::bump_1p_shaded) return {binary64, wide};
  return {kStageNames.begin(), kStageNames.end()};
}

// A subject of another kind is a program's, and so is what renders it.
bool is_of_library(const std::string& kind) {
  return kind == kLawKind || kind == kHeightMapKind || kind == kMeshKind || kind == kSceneKind;
}

// with: "" or the words for the spread.
std::optional<std::string> too_few(const Comparison& found, const std::string& name, const std::string& with,
                                   std::uint64_t least) {
  const auto lacks = [&](const std::string& what, const std::string& needed) {
    return "the certificate has " + what + " for " + name + with + "; driving needs " + needed;
  };
  if (found.points < least) return lacks(some(found.points, "point"), "at least " + std::to_string(least));
  for (const std::string_view aim : kAimNames)
    if (count_in(found.points_by_aim, aim) == 0)
      return lacks("no point of the aim \"" + std::string(aim) + '"', "some of each aim");
  return std::nullopt;
}

// Laws that one command can check, because no two have a parameter in different values.
struct Laws {
  std::string names;
  std::map<std::string, std::string> options;  // with their values

  bool take(const Identity& law) {
    std::map<std::string, std::string> all = options;
    for (const auto& [key, option] :
         {std::pair{"radius_mm", "--radius"}, {"width_mm", "--width"}, {"stiffness_N_per_mm", "--stiffness"}})
      if (const IdentityValue* value = law.parameter(key);
          value && all.emplace(option, text_of(*value)).first->second != text_of(*value))
        return false;
    options = std::move(all);
    names += (names.empty() ? "" : ",") + law.name;
    return true;
  }
};

// The command line, or several, that check these subjects as much as drive needs. A subject with entries of several renderers
// is checked once.
std::string command_that_gathers(const std::vector<const SubjectResult*>& subjects) {
  std::vector<Laws> groups;
  std::vector<std::pair<std::string, std::string>> subjects_by_options;  // with the kind
  for (auto subject = subjects.begin(); subject != subjects.end(); ++subject) {
    const Identity& identity = (*subject)->identity;
    const std::string& its_options = (*subject)->options;
    if (std::any_of(subjects.begin(), subject, [&](auto* earlier) { return earlier->identity.is_same(identity); })) continue;
    if (identity.kind == kLawKind) {
      if (std::none_of(groups.begin(), groups.end(), [&](Laws& group) { return group.take(identity); }))
        groups.emplace_back().take(identity);
    } else {
      subjects_by_options.emplace_back(its_options.empty() ? "with the same " + identity.kind + " and" : its_options,
                                       identity.kind);
    }
  }
  for (const Laws& group : groups) {
    std::string options = "--law " + group.names;
    for (const char* option : {"--radius", "--width", "--stiffness"})
      if (const auto found = group.options.find(option); found != group.options.end())
        options += std::string(" ") + option + ' ' + found->second;
    subjects_by_options.emplace_back(options, kLawKind);
  }
  std::string commands;
  int folder = 1;
  for (const auto& [options, kind] : subjects_by_options) {
    commands += (commands.empty() ? "" : " && ") + ("forceshade certify " + options) + " --points " +
                std::to_string(points_of_kind(kind)) + " --cases " + std::to_string(kCases) + " --out DIR" +
                (folder == 1 ? "" : std::to_string(folder));
    ++folder;
  }
  return commands;
}

// One sufficient entry of a subject is enough for `drive`, so nothing is missing in the others.
bool has_sufficient_entry(const Certificate& certificate, const Identity& identity) {
  return std::any_of(certificate.subjects.begin(), certificate.subjects.end(), [&](const SubjectResult& entry) {
    return entry.identity.is_same(identity) && assessed(entry).standing == Standing::sufficient;
  });
}

}  // namespace

Assessment assessed(const SubjectResult& subject) {
  if (!subject.held()) return {Standing::failed};
  if (auto lacks = lacking(subject)) return {Standing::insufficient, *lacks, command_that_gathers({&subject})};
  return {Standing::sufficient};
}

Assessment assessed(const Certificate& certificate) {
  const Sweeps& sweeps = certificate.sweeps;
  const bool is_empty = certificate.subjects.empty() && sweeps.results.empty();
  if (is_empty || sweeps.mismatches() > 0) return {Standing::failed};
  Assessment worst{Standing::sufficient};
  if (certificate.subjects.empty())
    worst = {Standing::insufficient, "the certificate has sweeps only; driving needs points and properties too",
             "forceshade certify --law ID --out DIR"};
  if (!sweeps.results.empty() && !sweeps.is_whole())
    worst = {Standing::insufficient,
             "the sweeps are not complete: units " + std::to_string(sweeps.first) + " to " + std::to_string(sweeps.next) +
                 " of " + std::to_string(sweeps.units()) + " are done",
             "forceshade certify work PLAN, and then forceshade certify merge PLAN --out DIR"};
  std::vector<const SubjectResult*> insufficient;
  std::string lacks;
  for (const SubjectResult& subject : certificate.subjects) {
    const Assessment one = assessed(subject);
    if (one.standing == Standing::failed) return one;
    if (one.standing == Standing::sufficient || has_sufficient_entry(certificate, subject.identity)) continue;
    insufficient.push_back(&subject);
    lacks += (lacks.empty() ? "" : "; and ") + one.lacks;
  }
  if (insufficient.empty() || worst.standing == Standing::insufficient) return worst;
  return {Standing::insufficient, lacks, command_that_gathers(insufficient)};
}

std::optional<std::string> lacking(const SubjectResult& found) {
  const std::string& name = found.name();
  if (is_of_library(found.identity.kind) && found.rendered_by != RenderedBy::library)
    return "the certificate " +
           std::string(found.rendered_by == RenderedBy::program ? "is of a program's own renderer"
                                                                : "does not say whose renderer was compared") +
           " for " + name + "; driving needs one of the library's, as 'forceshade certify' makes it";
  const std::uint64_t least = points_of_kind(found.identity.kind);
  if (auto words = too_few(found, name, "", least)) return words;
  if (auto words = too_few(found.spread, name, " with other parameters", spread_points(least))) return words;
  const auto lacks = [&](const std::string& what, const std::string& needed) {
    return "the certificate has " + what + " for " + name + "; driving needs " + needed;
  };
  for (const std::string_view stage : stages_of(found.identity))
    if (count_in(found.points_by_stage, stage) + count_in(found.spread.points_by_stage, stage) == 0)
      return lacks("no point that the stage \"" + std::string(stage) + "\" decided", "some of each stage");
  for (const std::string_view status : kStatusNames)
    if (count_in(found.points_by_status, status) + count_in(found.spread.points_by_status, status) == 0)
      return lacks("no point of the status \"" + std::string(status) + '"', "some of each status");
  for (const PropertyResult& property : found.properties)
    if (const std::uint64_t needed = cases_of(property.name, kCases); property.cases < needed)
      return lacks(some(property.cases, "case") + " of " + property.name, "at least " + std::to_string(needed));
  return std::nullopt;
}

}  // namespace forceshade::properties
