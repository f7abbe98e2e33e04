// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The reason why a text is no JSON, in our words and not those of the library that read it.

#include <cstddef>
#include <string>
#include <string_view>

namespace forceshade::files {

// "line 3, column 7: expected JSON, got "}"". byte: the number of bytes that were read, the faulty one included.
std::string json_fault(std::string_view text, std::size_t byte);

}  // namespace forceshade::files
