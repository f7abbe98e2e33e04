// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Runs the four properties on a renderer with RapidCheck: what `forceshade properties`, certify and the tests call.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "forceshade/properties/subject.h"
#include "forceshade/vocabulary/results.h"

namespace forceshade::properties {

// Called before each case with the property's name, and the share of the property that is done, in [0, 1].
using OnCase = std::function<void(const std::string& property, double done)>;

// Equivalence, continuity, unit normals, passivity, each on `cases` generated cases (passivity, whose case is a whole
// loop, on a tenth of them, and on the law's witness loops). The same seed gives the same cases. Not for two threads at
// once: RapidCheck is not.
std::vector<PropertyResult> run_properties(const Subject& subject, int cases, std::uint64_t seed, const OnCase& on_case = {});

// The same of a height map, without witness loops. Where the map has a grid, a fifth follows: "cell lines", whether its
// gradient is continuous across them. A certificate does not ask for that one: a bilinear map is what it is.
std::vector<PropertyResult> run_properties(const HeightSubject& subject, int cases, std::uint64_t seed,
                                           const OnCase& on_case = {});

// One property of one's own: `property` draws its case with RapidCheck's operator* and says what is violated.
PropertyResult run_property(const std::string& name, int cases, std::uint64_t seed, const std::function<Violation()>& property);

// The depths, in mm, at which a law's witness loop is walked.
std::vector<float> witness_depths(const Subject& subject);

}  // namespace forceshade::properties
