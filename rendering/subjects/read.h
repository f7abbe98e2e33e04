// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Options, a text or a file into what is to be rendered: the same words mean the same as on the command line.
//
//   const Description bump = subjects::read_one(subjects::options_of_file("bump.toml"));
//   const Description map = subjects::read_one({{"height-map", "leather.toml"}, {"stiffness", "0.5N/mm"}});
//   const Rendering rendering = std::get<Rendering>(rendering_of(bump));
//
// Everything that is refused is a BadInput, which says the file, the line, what was expected and what was got.

#include <vector>

#include "forceshade/checks.h"
#include "forceshade/description.h"
#include "rendering/subjects/file.h"
#include "rendering/subjects/options.h"

namespace forceshade::subjects {

// One, or as many laws as the options name; every one of them can be built. The monitor follows the check of a mesh. Throws
// BadInput and Interrupted.
std::vector<Description> read(const Options& options, const Monitor& monitor = {});

// The same where one law is expected.
Description read_one(const Options& options, const Monitor& monitor = {});

// K in N/mm, and the other parameters of the laws. Throw BadInput.
float stiffness_of(const Options& options);
std::vector<DescribedLaw> laws_of(const Options& options);

}  // namespace forceshade::subjects
