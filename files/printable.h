// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Text from a file as a terminal may show it.

#include <cstddef>
#include <string>
#include <string_view>

namespace forceshade::files {

// Bytes of the UTF-8 character at the front of `text`; 0 if there is none (Unicode 15, table 3-7).
std::size_t character_size(std::string_view text);

// On one line, without what commands a terminal: each byte of a control character (C0, DEL, C1, line and paragraph separators,
// marks that turn the direction of writing) and each byte that is not UTF-8 becomes \xNN, and a line feed \n. All else stays as
// it is.
std::string printable(std::string_view text);

// True if a terminal may show it as it is: printable() changes nothing but line feeds, where there may be some.
bool is_printable(std::string_view text, bool may_have_lines = false);

// A third party's text for a message: the beginning, printable and in quotes.
std::string shown(std::string_view text, std::size_t length = 80);

}  // namespace forceshade::files
