// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A pointer of Git LFS: the short text that a clone without the files themselves has in place of each.

#include <string_view>

namespace forceshade::files {

// The beginning of such a text, and its name in messages.
inline constexpr std::string_view kLfsBeginning = "version https://git-lfs.github.com/spec/",
                                  kLfsPointer = "a pointer of Git LFS in the place of a file, which 'git lfs pull' fetches";

}  // namespace forceshade::files
