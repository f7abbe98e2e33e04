// SPDX-License-Identifier: BSD-3-Clause
// Why a certificate does not let a renderer be driven.

#include <algorithm>

#include "forceshade/properties/certificate.h"
#include "forceshade/properties/html.h"

namespace forceshade::properties {
namespace {

std::optional<std::string> other_build(const Certificate& certificate, const Build& build) {
  if (certificate.build.library_digest == build.library_digest) return std::nullopt;
  return "the certificate is for another build of the renderer: expected digest " + build.library_digest + ", got " +
         certificate.build.library_digest;
}

std::string words_of(LawId law, const Parameters& p) {
  const std::string bump =
      has_bump_geometry(law) ? "radius " + shortest(p.radius) + " mm, width " + shortest(p.width) + " mm, " : "";
  return bump + "stiffness " + shortest(p.stiffness) + " N/mm";
}

}  // namespace

std::optional<std::string> refusal(const Certificate& certificate, const Build& build, LawId law,
                                   const Parameters& parameters) {
  const std::string name(name_of(law));
  if (auto other = other_build(certificate, build)) return other;
  const auto same_law = [&](const LawResult& result) { return result.law == law; };
  const auto same_parameters = [&](const LawResult& result) {
    return result.parameters.stiffness == parameters.stiffness &&
           (!has_bump_geometry(law) ||
            (result.parameters.radius == parameters.radius && result.parameters.width == parameters.width));
  };
  if (std::none_of(certificate.laws.begin(), certificate.laws.end(), same_law))
    return "the certificate does not cover the law " + name;
  const auto covered = std::find_if(certificate.laws.begin(), certificate.laws.end(),
                                    [&](const LawResult& result) { return same_law(result) && same_parameters(result); });
  if (covered == certificate.laws.end())
    return "the certificate covers " + name + " with other parameters: expected " + words_of(law, parameters) + "; got " +
           words_of(law, std::find_if(certificate.laws.begin(), certificate.laws.end(), same_law)->parameters);
  const bool sweep_failed = std::any_of(certificate.sweeps.results.begin(), certificate.sweeps.results.end(),
                                        [&](const SweepResult& r) { return r.sweep.law == law && r.mismatches > 0; });
  if (!covered->held() || sweep_failed) return "the certificate says that " + name + " failed";
  return std::nullopt;
}

std::optional<std::string> refusal(const Certificate& certificate, const Build& build, const HeightIdentity& map) {
  if (auto other = other_build(certificate, build)) return other;
  if (certificate.height_maps.empty()) return "the certificate covers no height map";
  // The one that is most alike tells best what differs.
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
  if (!covered->held()) return "the certificate says that the height map " + covered->file + " failed";
  return std::nullopt;
}

}  // namespace forceshade::properties
