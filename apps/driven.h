// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is rendered on a device, a law or a height map, and whether a certificate covers it.

#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "forceshade/certificate/build.h"
#include "forceshade/certificate/certificate.h"
#include "forceshade/fast/renderer.h"
#include "forceshade/heights/spec.h"
#include "forceshade/recorder/recorder.h"
#include "forceshade/vocabulary/law.h"

namespace forceshade::apps {

struct Driven {
  fast::Renderer renderer;
  // Why this certificate does not cover it with this build; nothing where it does.
  std::function<std::optional<std::string>(const properties::Certificate&, const properties::Build&)> refusal;
  nlohmann::ordered_json summary;  // as a run's summary names it
  recorder::Metadata metadata;     // as a recording names it
};

// Throw BadInput for parameters outside the domain.
Driven driven(LawId law, const Parameters& parameters);
Driven driven(const std::string& name, const heights::Spec& spec, float stiffness);

// The digest of the certificate's file; none where it does not cover what is to be driven, with the reason why.
struct Certified {
  std::optional<std::string> digest;
  std::string why_not;
};

// An empty name is no file. Throws for a file that is no certificate.
Certified certified(const std::string& file, const Driven& what);

// What follows from it, said on standard error unless it is covered: false where it may not be driven.
bool may_be_driven(const Certified& certified, bool uncertified);

}  // namespace forceshade::apps
