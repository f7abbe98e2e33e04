// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is rendered on a device, and whether a certificate covers it.

#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "device/servo_loop.h"
#include "fast/session.h"
#include "properties/subject.h"
#include "recorder/recorder.h"

namespace forceshade::apps {

struct Driven {
  std::unique_ptr<fast::Session> session;
  properties::Identity identity;

  explicit Driven(const properties::Subject& subject) : session(subject.calls().open()), identity(subject.identity()) {}
};

// As a run's summary names it, and as a recording does.
nlohmann::ordered_json summary_of(const properties::Identity& identity);
recorder::Metadata metadata_of(const properties::Identity& identity);

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
Certified certified(const std::string& file, const properties::Identity& subject);

// What follows from it, said on standard error unless it is covered: false where it may not be driven.
bool may_be_driven(const Certified& certified, bool uncertified);

}  // namespace forceshade::apps
