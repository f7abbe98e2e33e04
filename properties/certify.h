// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Checks the fast path against the reference at many points, runs the properties, and writes down what was found.

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "forceshade/properties/certificate.h"

namespace forceshade::properties {

struct CertifyOptions {
  std::vector<LawId> laws;
  Parameters parameters;
  std::uint64_t points = 0;  // per law
  int cases = 0;             // per property
  std::uint64_t seed = 0;
  unsigned threads = 1;
};

// done in [0, 1]; called from one thread at a time.
using Progress = std::function<void(LawId law, double done)>;

// The points do not depend on the number of threads. Empty when `stop` was set before the end. The parameters must be in
// every law's domain (fast::Law::build says so). Throws std::runtime_error on a fast::arithmetic_fault(): the threads inherit it.
std::optional<Certificate> certify(const CertifyOptions& options, const Progress& progress, const std::atomic<bool>& stop);

}  // namespace forceshade::properties
