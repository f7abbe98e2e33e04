// SPDX-License-Identifier: BSD-3-Clause
// Why a certificate does not let a renderer be driven.

#include <algorithm>

#include "forceshade/certificate/certificate.h"
#include "forceshade/certificate/evidence.h"
#include "forceshade/vocabulary/number_text.h"

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
      std::string covered;
      for (const auto& [one, points] : found.points_by_instruction_set) covered += (covered.empty() ? "" : ", ") + one;
      return "the certificate does not cover the instruction set that would run here for " + name + ": expected " + set +
             ", got " + (covered.empty() ? "none" : covered);
    }
  return std::nullopt;
}

// Of entries that are for what is to be driven, not empty: nothing where one of them is enough.
template <class Result>
std::optional<std::string> insufficient(const std::vector<const Result*>& entries, const Build& build) {
  std::optional<std::string> why;
  for (const Result* entry : entries) {
    auto one = lacking(*entry);
    if (!one) one = uncovered_set(*entry, entry->name(), build);
    if (!one) return std::nullopt;
    if (!why) why = std::move(one);
  }
  return why;
}

std::optional<std::string> nothing_but_sweeps(const Certificate& certificate) {
  if (certificate.has_points()) return std::nullopt;
  return "the certificate has sweeps only; driving needs one of points and properties too, which 'forceshade certify merge' "
         "joins "
         "to them";
}

std::string words_of(LawId law, const Parameters& p) {
  const std::string bump =
      has_bump_geometry(law) ? "radius " + shortest(p.radius) + " mm, width " + shortest(p.width) + " mm, " : "";
  return bump + "stiffness " + shortest(p.stiffness) + " N/mm";
}

bool same_parameters(LawId law, const Parameters& a, const Parameters& b) {
  return a.stiffness == b.stiffness && (!has_bump_geometry(law) || (a.radius == b.radius && a.width == b.width));
}

}  // namespace

std::optional<std::string> refusal(const Certificate& certificate, const Build& build, LawId law,
                                   const Parameters& parameters) {
  const std::string name(name_of(law));
  if (auto other = other_build(certificate.build, build)) return other;
  if (auto sweeps_only = nothing_but_sweeps(certificate)) return sweeps_only;
  // One that failed speaks against the law, whatever its parameters.
  bool failed = std::any_of(certificate.sweeps.results.begin(), certificate.sweeps.results.end(),
                            [&](const SweepResult& r) { return r.sweep.law == law && r.mismatches > 0; });
  std::vector<const LawResult*> entries;
  const LawResult* other = nullptr;
  for (const LawResult& result : certificate.laws) {
    if (result.law != law) continue;
    failed = failed || !result.held();
    if (same_parameters(law, result.parameters, parameters))
      entries.push_back(&result);
    else
      other = &result;
  }
  if (entries.empty() && other == nullptr) return "the certificate does not cover the law " + name;
  if (entries.empty())
    return "the certificate covers " + name + " with other parameters: expected " + words_of(law, parameters) + "; got " +
           words_of(law, other->parameters);
  if (failed) return "the certificate says that " + name + " failed";
  return insufficient(entries, build);
}

std::optional<std::string> refusal(const Certificate& certificate, const Build& build, const HeightIdentity& map) {
  if (auto other = other_build(certificate.build, build)) return other;
  if (auto sweeps_only = nothing_but_sweeps(certificate)) return sweeps_only;
  if (certificate.height_maps.empty()) return "the certificate covers no height map";
  // The one that is most alike says best what differs.
  const auto likeness = [&](const HeightMapResult& covered) {
    const HeightIdentity& its = covered.identity;
    return 4 * (its.map_digest == map.map_digest) + 2 * (its.rendering == map.rendering) + (its.stiffness == map.stiffness);
  };
  const auto covered = std::max_element(certificate.height_maps.begin(), certificate.height_maps.end(),
                                        [&](const auto& a, const auto& b) { return likeness(a) < likeness(b); });
  const HeightIdentity& its = covered->identity;
  const auto differs = [](const std::string& what, const std::string& expected, const std::string& got) {
    return "the certificate covers a height map with another " + what + ": expected " + expected + ", got " + got;
  };
  if (its.map_digest != map.map_digest)
    return differs("shape", "map digest " + map.map_digest, its.map_digest + " (" + covered->file + ')');
  if (its.rendering != map.rendering)
    return differs("rendering", std::string(name_of(map.rendering)), std::string(name_of(its.rendering)));
  if (its.stiffness != map.stiffness)
    return differs("stiffness", shortest(map.stiffness) + " N/mm", shortest(its.stiffness) + " N/mm");
  std::vector<const HeightMapResult*> entries;
  for (const HeightMapResult& result : certificate.height_maps) {
    if (result.identity.map_digest != map.map_digest) continue;
    if (!result.held()) return "the certificate says that the height map " + result.file + " failed";
    if (result.identity == map) entries.push_back(&result);
  }
  return insufficient(entries, build);
}

}  // namespace forceshade::properties
