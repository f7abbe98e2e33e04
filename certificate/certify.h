// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Checks the fast path against the reference at many points, runs the properties, and writes down what was found.

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "certificate/certificate.h"
#include "certificate/evidence.h"
#include "properties/subject.h"

namespace forceshade::properties {

struct CertifyOptions {
  std::vector<std::shared_ptr<const Subject>> subjects;
  std::uint64_t points = points_of_kind(kLawKind);  // per subject; and a quarter as many with drawn parameters
  int cases = static_cast<int>(kCases);             // per property
  std::uint64_t seed = 0;
  unsigned threads = 1;
  // Called before each case of a property with the subject, the property, and the share of it that is done.
  std::function<void(std::string_view subject, const std::string& property, double done)> on_case = {};
};

// done in [0, 1]; called from one thread at a time.
using Progress = std::function<void(std::string_view name, double done)>;

// The points do not depend on the number of threads. Empty when `stop` was set before the end. Throws
// std::runtime_error on a fast::arithmetic_fault(): the threads inherit it.
std::optional<Certificate> certify(const CertifyOptions& options, const Progress& progress, const std::atomic<bool>& stop);

}  // namespace forceshade::properties
