// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Runs the four properties on a renderer with RapidCheck: what `forceshade properties`, certify and the tests call.

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "properties/subject.h"
#include "rendering/results.h"

namespace forceshade::properties {

// Before each case with the property's name, and when the property is finished: the share of it that is done, in [0, 1].
using OnCase = std::function<void(const std::string& property, double done)>;

// Called when a property is finished.
using PropertyDone = std::function<void(const PropertyResult&)>;

// Equivalence, continuity, unit normals, passivity, each on `cases` generated cases (passivity, whose case is a whole loop, on
// a tenth of them, and on the subject's fixed loops), then the subject's further properties. The same seed gives the same
// cases. Where a renderer is random, keeps state that its definition does not have, or throws, the words of equivalence say
// that. Throws std::invalid_argument for fewer cases than one, which would hold of whatever is checked. Once `stop` is set,
// nothing is checked any more, and what is returned says nothing. Not for two threads at once: RapidCheck is not.
std::vector<PropertyResult> run_properties(const Subject& subject, int cases, std::uint64_t seed,
                                           const PropertyDone& done = nullptr, const OnCase& on_case = nullptr,
                                           const std::atomic<bool>* stop = nullptr);

// One property of one's own: `property` draws its case with RapidCheck's operator* and says what is violated. What it throws is
// a violation, too. Where a case that failed holds when it is tried again, the words say so.
PropertyResult run_property(const std::string& name, int cases, std::uint64_t seed, const std::function<Violation()>& property);

}  // namespace forceshade::properties
