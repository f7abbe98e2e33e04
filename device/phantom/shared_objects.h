// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Looks at a library's file without loading it, so that none of its code runs.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace forceshade::device {

// The file that the system's loader would take for this name: the name itself if it has a slash, else of that name in
// LD_LIBRARY_PATH, in the loader's cache, or in the system's folders. Only one for this kind of processor.
std::optional<std::filesystem::path> file_of_library(const std::string& name);

// The names of missing libraries, its own or those of a library that it needs, and missing versions of those that are there,
// each once, as `ldd` prints them. None where ldd could not find out.
std::optional<std::vector<std::string>> missing_dependencies(const std::filesystem::path& file);

// The Debian package, or the vendor's, that has this library; empty where it is not known.
std::string package_of(const std::string& library);

}  // namespace forceshade::device
