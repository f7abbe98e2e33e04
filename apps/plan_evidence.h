// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The results in the folder of a plan so far, in words and as a certificate.

#include <cstdint>
#include <string>
#include <vector>

#include "apps/opened_plan.h"

namespace forceshade::apps {

struct Progress {
  std::vector<bool> is_done;  // by unit
  std::uint64_t done = 0;
  std::string missing;  // "units 3 to 7, 9 of 20"; empty where all are done
};

Progress progress_of(const properties::PlanFolder& folder);

// Names on standard error the files whose bytes differ from a result. Returns true if there are any.
bool say_alarms(const properties::PlanFolder& folder);

// From the units that are done; with what the runs know of themselves. Throws CertificateError, naming the file, where a result
// is damaged or of another plan.
properties::Certificate merged_units(const OpenedPlan& opened, const properties::Units& units,
                                     const properties::PlanFolder& folder, const Progress& progress);

}  // namespace forceshade::apps
