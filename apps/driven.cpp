// SPDX-License-Identifier: BSD-3-Clause
#include "apps/driven.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "certificate/build.h"
#include "certificate/certificate.h"
#include "files/printable.h"
#include "recorder/settings.h"
#include "rendering/identity/digest.h"
#include "rendering/identity/identity_json.h"

namespace forceshade::apps {

namespace {

// "height_map": names the kind in JSON and in a recording.
std::string key_of_kind(const Identity& identity) {
  std::string key = identity.kind;
  std::replace(key.begin(), key.end(), ' ', '_');
  return key;
}

}  // namespace

nlohmann::ordered_json summary_of(const Identity& identity) {
  nlohmann::ordered_json json{{key_of_kind(identity), identity.name}};
  if (!identity.digest.empty()) json["digest"] = identity.digest;
  json["parameters"] = parameters_json(identity);
  return json;
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
                                    {"firmware", capabilities.firmware}})
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
  return metadata;
}

Certified certified(const std::string& file, const Identity& subject) {
  if (file.empty())
    return {std::nullopt, "no certificate was given; expected --certificate FILE, as written by 'forceshade certify'"};
  const std::string text = properties::read_certificate(file);
  const properties::Certificate certificate = properties::from_json(text, file);
  if (const auto refused = refusal(certificate, properties::current_build(), subject))
    return {std::nullopt, file + ": " + *refused};
  Digest digest;
  digest.text(text);
  return {digest.hex(), ""};
}

bool may_be_driven(const Certified& certified, bool uncertified) {
  if (certified.digest) return true;
  const std::string why = files::printable(certified.why_not);
  if (uncertified)
    std::fprintf(stderr, "*** DRIVING UNCERTIFIED, because of --uncertified: %s ***\n", why.c_str());
  else
    std::fprintf(stderr, "forceshade: refused to drive: %s\n", why.c_str());
  return uncertified;
}

}  // namespace forceshade::apps
