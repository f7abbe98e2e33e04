// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Runs the four properties on a renderer with RapidCheck: what `forceshade properties`, certify and the tests call.

#include <cstdint>
#include <vector>

#include "forceshade/properties/certificate.h"
#include "forceshade/properties/subject.h"

namespace forceshade::properties {

// Equivalence, continuity, unit normals, passivity, each on `cases` generated cases (passivity, whose case is a whole
// loop, on a tenth of them, and on the law's witness loops). The same seed gives the same cases. Not for two threads at
// once: RapidCheck is not.
std::vector<PropertyResult> run_properties(const Subject& subject, int cases, std::uint64_t seed);

// The depths, in mm, at which a law's witness loop is walked.
std::vector<float> witness_depths(const Subject& subject);

}  // namespace forceshade::properties
