// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The head of an NPY file, the format of numpy.load: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <string>
#include <string_view>

namespace forceshade::files {

// NPY 1.0 for a structured array of one dimension: the bytes of `rows` records follow it, without anything between them.
// layout: the dtype of a record as Python writes it, [('x_mm', '<f4'), ...]; at most 65 000 bytes.
std::string npy_header(std::string_view layout, std::uint64_t rows);

// Whether a file is meant to be an array, by how its name ends: .npy, in small or in capital letters.
inline bool is_named_npy(std::string_view path) {
  constexpr std::string_view kEnding = ".npy";
  return path.size() >= kEnding.size() && std::ranges::equal(path.substr(path.size() - kEnding.size()), kEnding,
                                                             [](unsigned char a, char b) { return std::tolower(a) == b; });
}

}  // namespace forceshade::files
