// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Names the kind of a file that was given where another kind is expected.

#include <string>
#include <string_view>

namespace forceshade::files {

// "a PNG picture", "a recording (SQLite)" and so on by how the bytes begin, kBinaryFile where they hold a zero byte; empty for
// what may be a text.
std::string binary_kind(std::string_view bytes);

// The names of these kinds in messages.
inline constexpr std::string_view kCsvFile = "a CSV file", kJsonFile = "a JSON file", kTomlFile = "a TOML file",
                                  kXmlFile = "an XML or HTML file", kBinaryFile = "a binary file";

// One of these but the last, or "an empty file", by how the text begins, whatever is wrong further on; empty for
// another text.
std::string text_kind(std::string_view text);

// Any of these, "a text" where nothing more is known.
std::string kind_of_file(std::string_view bytes);

bool is_folder(const std::string& path);
bool is_named_pipe(const std::string& path);  // not what a shell makes for <(...)

// The byte order mark that some editors write in front of a text in UTF-8.
inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// The beginning of a pointer of Git LFS, the short text that a clone without the files themselves has in place of each, and its
// name in messages.
inline constexpr std::string_view kLfsBeginning = "version https://git-lfs.github.com/spec/",
                                  kLfsPointer = "a pointer of Git LFS in the place of a file, which 'git lfs pull' fetches";

}  // namespace forceshade::files
