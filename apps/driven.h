// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Whether a certificate covers what is to be driven, and what recordings and summaries say of it.

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "device/servo_loop.h"
#include "recorder/recorder.h"
#include "rendering/identity/identity.h"

namespace forceshade::apps {

// As a run's summary names it, and as a recording does.
nlohmann::ordered_json summary_of(const Identity& identity);
recorder::Metadata metadata_of(const Identity& identity);

// What a device says of itself: model, serial, driver, firmware, as far as it says them.
std::vector<std::pair<std::string, std::string>> words_of(const device::Capabilities& capabilities);

// Of every recording: the build, the device by its name and by its own words, the pace, the settings of supervisor and
// controller.
recorder::Metadata metadata_of_run(const std::string& device, const device::Capabilities& capabilities,
                                   const device::ServoOptions& servo);

// The digest of the certificate's file; none where it does not cover what is to be driven, with the reason why.
struct Certified {
  std::optional<std::string> digest;
  std::string why_not;
};

// An empty name is no file. Throws for a file that is no certificate.
Certified certified(const std::string& file, const Identity& subject);

// What follows from it, said on standard error unless it is covered: false where it may not be driven.
bool may_be_driven(const Certified& certified, bool uncertified);

}  // namespace forceshade::apps
