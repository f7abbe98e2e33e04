// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Options into what is to be rendered; the public header forceshade/subjects.h does it with files and texts.
//
//   const Description map = subjects::read_one({{"height-map", "leather.toml"}, {"stiffness", "0.5N/mm"}});

#include <vector>

#include "forceshade/checks.h"
#include "forceshade/description.h"
#include "subjects/file.h"
#include "subjects/options.h"

namespace forceshade::subjects {

// One, or as many laws as the options name; every one of them can be built. The monitor follows the check of a mesh. Throws
// Error and Interrupted.
std::vector<Description> read(const Options& options, const Monitor& monitor = {});

// The same where one law is expected.
Description read_one(const Options& options, const Monitor& monitor = {});

// K in N/mm, and the other parameters of the laws. Throw Error.
float stiffness_of(const Options& options);
std::vector<DescribedLaw> laws_of(const Options& options);

}  // namespace forceshade::subjects
