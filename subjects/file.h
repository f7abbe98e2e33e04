// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Subject files (docs/subjects.md): TOML whose keys are the options that name a law, height map, mesh or scene.

#include <filesystem>
#include <string>
#include <vector>

#include "subjects/options.h"

namespace forceshade::subjects {

// Each with its name "bump.toml: line 3: radius". Files that a subject's file names lie beside it. Throws Error: a file that
// cannot be read or is no TOML, an unknown key, a value of a wrong type, or none of kKinds; with file, line and what was
// expected. Whether the values can be used is for read() to say.
Options options_of_file(const std::filesystem::path& file);

// The same of a text. file: its name in messages; the files that the text names lie in its folder.
Options options_of_text(const std::string& text, const std::filesystem::path& file);

// The texts of subject files, one for each law or one: every option that holds, given or not; a file is named without its
// folder. Throws Error.
std::vector<std::string> written_files(const Options& options);

// The options of a mesh, scene or height map as a shell reads them, every one that holds, files with their folders; empty for
// laws.
std::string written_for_shell(const Options& options);

}  // namespace forceshade::subjects
