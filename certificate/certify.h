// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Checks the fast path against the reference at many points, runs the properties, and writes down what was found.

#include <atomic>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "forceshade/certificate/certificate.h"
#include "forceshade/certificate/evidence.h"
#include "forceshade/properties/calls.h"

namespace forceshade::properties {

// A height map, and what its file is called.
struct NamedHeightMap {
  std::string file;
  HeightMap map;
  height::Rendering rendering;
};

struct CertifyOptions {
  std::vector<LawId> laws;
  Parameters parameters;
  std::uint64_t points = kPointsOfALaw;  // per law; and a quarter as many with drawn parameters
  int cases = static_cast<int>(kCases);  // per property
  std::uint64_t seed = 0;
  unsigned threads = 1;
  std::vector<NamedHeightMap> height_maps = {};  // with the stiffness of `parameters`
  MakeCalls calls = calls_of_the_fast_path();    // what is compared with the reference
  // Called before each case of a property with the subject, the property, and the share of it that is done.
  std::function<void(std::string_view subject, const std::string& property, double done)> on_case = {};
};

// done in [0, 1]; called from one thread at a time.
using Progress = std::function<void(std::string_view name, double done)>;

// The points do not depend on the number of threads. Empty when `stop` was set before the end. The parameters must be in every
// law's and map's domain (build() of fast::Law and fast::HeightMapField says so). Throws std::runtime_error on a
// fast::arithmetic_fault(): the threads inherit it.
std::optional<Certificate> certify(const CertifyOptions& options, const Progress& progress, const std::atomic<bool>& stop);

}  // namespace forceshade::properties
