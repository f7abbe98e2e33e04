// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a file is that was given where a text is expected.

#include <string>
#include <string_view>

namespace forceshade::files {

// "a PNG picture", "a recording (SQLite)" and so on by how the bytes begin, "a binary file" where they hold a zero byte; empty
// for what may be a text.
std::string binary_kind(std::string_view bytes);

}  // namespace forceshade::files
