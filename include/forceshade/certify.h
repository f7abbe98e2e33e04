// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Makes certificates: checks a renderer against the exact definition at many points, runs the properties, and writes down what
// was found. The library is forceshade::certify, of the component properties.
//
//   const auto wall = std::shared_ptr(properties::law_subject(LawId::wall, {.stiffness = 0.5F}));  // N/mm
//   const std::atomic<bool> stop = false;
//   const auto certificate = properties::certify({.subjects = {wall}, .points = 10000}, [](auto, double) {}, stop);
//   if (certificate) std::puts(properties::to_json(*certificate).c_str());
//
// Errors: a failed check is a result, Certificate::held(); under a fast::arithmetic_fault() certify() throws
// std::runtime_error. assessed() of certificate.h tells if a certificate is too little for driving.
//
// Threads: certify() uses as many threads as its options say. `stop` may be set by any thread or a signal handler.
//
// Not promised: how long it takes; the seconds are in the certificate. The same seed gives the same points and cases.

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "forceshade/certificate.h"
#include "forceshade/properties.h"

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

// Exhaustive sweeps.

// All sweeps of one law and kind together.
struct SweepTotal {
  LawId law;
  SweepKind kind;
  std::vector<float> radii;  // mm; none for the wall
  std::uint64_t sweeps = 0, inputs = 0, mismatches = 0;
};
std::vector<SweepTotal> totals(const Sweeps& sweeps);

// The kinds to sweep; line and column go together.
struct SweepPlan {
  std::vector<LawId> laws;
  Parameters parameters;     // width and stiffness of all, radius of lines and columns
  std::vector<float> radii;  // mm: of directions and heights
  bool directions = true, heights = true, lines = true;
};

// Throws std::invalid_argument naming the parameter if one is outside the domain of one of the laws.
Sweeps planned(const SweepPlan& plan);

// Part k of n of them, nothing done yet (1 <= k <= n).
Sweeps part_of(Sweeps sweeps, std::uint64_t k, std::uint64_t n);

// Does the next `count` units, or as many as are left. Any number of threads gives the same result but for the seconds.
Sweeps continued(Sweeps sweeps, std::uint64_t count, unsigned threads);

// Certificates made on one machine after the other or on many, joined into one.

struct CertificateFile {
  std::string name;
  Certificate certificate;
};

// At least two certificates in any order, or parts of one exhaustive run, or both. Entries of one subject are added up: their
// seeds differ, so their points do. The parts of the run make up the whole of it. Throws CertificateError, naming the files, if
// builds or lists of sweeps differ, if a part is missing, unfinished or overlaps another, or if two entries of a subject have a
// seed in common or contradict each other.
Certificate merged(std::vector<CertificateFile> files);

}  // namespace forceshade::properties
