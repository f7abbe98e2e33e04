// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A subject in words: a subject file, whose keys are the options of the command line, into what is to be rendered
// (docs/subjects.md). The library is forceshade::subjects, of the component subjects.
//
//   const Description map = subjects::read_file("leather.toml");
//   const Description bump = subjects::read_text("law = \"bump-2p\"\nradius = \"600mil\"\nstiffness = \"0.5N/mm\"\n",
//   "bump.toml"); const auto built = rendering_of(bump);  // of renderer.h
//
// A number without a unit is in mm, or in N/mm.
//
// Errors: Error for a file that cannot be read, an unknown key, a value of a wrong type or out of its domain, and a
// height map or mesh that cannot be rendered; it says the file, the line, what was expected and what was got. Interrupted where
// the monitor is stopped.
//
// Threads: nothing is kept between calls.
//
// Not promised: how long a mesh takes, which is checked as a whole; the monitor follows it.

#include <filesystem>
#include <string>

#include "forceshade/checks.h"
#include "forceshade/description.h"

namespace forceshade::subjects {

// The subject of a file. Files that it names lie beside it.
Description read_file(const std::filesystem::path& file, const Monitor& monitor = {});

// The same of a text. file: what messages call it; the files that the text names lie beside it.
Description read_text(const std::string& text, const std::filesystem::path& file, const Monitor& monitor = {});

}  // namespace forceshade::subjects
