// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The head of an NPY file, the format of numpy.load: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html

#include <cstdint>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "forceshade/error.h"
#include "text/letters.h"

namespace forceshade::files {

// NPY 1.0 for a structured array of one dimension: the bytes of `rows` records follow it, without anything between them.
// layout: the dtype of a record as Python writes it, [('x_mm', '<f4'), ...]; at most 65 000 bytes.
std::string npy_header(std::string_view layout, std::uint64_t rows);

struct NpyHead {
  std::string type;  // as NumPy writes it: <f4, or the list of a record's fields, [('x_mm', '<f4'), ('y_mm', '<f4')]
  bool is_by_column = false;
  std::string shape_text;  // the text between the brackets: "3, 4"
  std::vector<std::uint64_t> shape;
};

// Reads the head of a file of version 1 to 3, so that its numbers follow. Throws Error, in words that go on
// after the file's name: "has no NPY header".
NpyHead read_npy_head(std::istream& in);

// True if the file's name ends as that of an array: .npy, in small or in capital letters.
inline bool is_named_npy(std::string_view path) {
  constexpr std::string_view kEnding = ".npy";
  return path.size() >= kEnding.size() && small_letters(path.substr(path.size() - kEnding.size())) == kEnding;
}

}  // namespace forceshade::files
