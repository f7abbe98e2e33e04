// SPDX-License-Identifier: BSD-3-Clause
#include "run/words.h"

#include <algorithm>

#include "certificate/build.h"
#include "files/csv.h"
#include "run/recorder/settings.h"

namespace forceshade::run {

std::string key_of_kind(const Identity& identity) {
  std::string key = identity.kind;
  std::replace(key.begin(), key.end(), ' ', '_');
  return key;
}

recorder::Metadata metadata_of(const Identity& identity) {
  recorder::Metadata metadata{{key_of_kind(identity), identity.name}};
  if (!identity.digest.empty()) metadata["digest"] = identity.digest;
  for (const auto& [key, value] : identity.parameters) metadata[key] = forceshade::text_of(value);
  return metadata;
}

std::vector<std::pair<std::string, std::string>> words_of(const device::Capabilities& capabilities) {
  std::vector<std::pair<std::string, std::string>> known;
  for (const auto& [what, words] : {std::pair<const char*, std::string_view>{"model", capabilities.model},
                                    {"serial", capabilities.serial},
                                    {"driver", capabilities.driver},
                                    {"firmware", capabilities.firmware},
                                    {"forces", capabilities.forces}})
    if (!words.empty()) known.emplace_back(what, words);
  return known;
}

recorder::Metadata metadata_of_run(const std::string& device, const device::Capabilities& capabilities,
                                   const device::ServoOptions& servo) {
  const properties::Build build = properties::current_build();
  recorder::Metadata metadata{{"library_digest", build.library_digest},
                              {"version", build.version},
                              {"revision", build.revision},
                              {"compiler", build.compiler},
                              {"flags", build.flags},
                              {"instruction_set", build.instruction_set},
                              {"device", device},
                              {"paced", servo.paced ? "yes" : "no"}};
  for (const auto& [what, words] : words_of(capabilities)) metadata["device_" + what] = words;
  metadata.merge(recorder::metadata_of(device::safety_settings(capabilities, servo)));
  metadata.merge(recorder::metadata_of(servo.damping_at_rate()));
  return metadata;
}

std::string words_of(const damping::Parameters& damping) {
  std::string words;
  if (damping.damping > 0)
    words += shortest(damping.damping) + " N s/mm along the force, up to " + shortest(damping.most) + " times it; ";
  if (damping.drag > 0) words += "drag of " + shortest(damping.drag) + " N s/mm, full at " + shortest(damping.full_at) + " N; ";
  return words + "share " + shortest(damping.share) + " at " + shortest(damping.rate) + " Hz";
}

std::string origin_words(const device::Placement& placement) {
  const Eigen::Vector3f& origin = placement.origin();
  return shortest(origin.x()) + ',' + shortest(origin.y()) + ',' + shortest(origin.z());
}

std::string axes_words(const device::Placement& placement) {
  std::string words;
  for (std::size_t i = 0; i < 3; ++i) {
    if (i > 0) words += ',';
    words += placement.is_against(i) ? '-' : '+';
    words += static_cast<char>('x' + placement.axis(i));
  }
  return words;
}

}  // namespace forceshade::run
