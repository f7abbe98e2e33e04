// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Suggests a word for a misspelt one.

#include <string>
#include <string_view>
#include <vector>

namespace forceshade::files {

// The one of the words that is most like `word`, which equals none of them (Levenshtein's distance, but near is also what
// begins with the word, and x_mm for center_x_mm); empty where none is like it.
std::string nearest(std::string_view word, const std::vector<std::string>& words);

// "; the nearest is WORD", to stand behind what was got; empty where none is like it, or where the word is one of them, in a
// place where it is not expected.
std::string suggestion(std::string_view word, const std::vector<std::string>& words);

}  // namespace forceshade::files
