// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The head of an NPY file, the format of numpy.load: https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html

#include <cstdint>
#include <string>
#include <string_view>

namespace forceshade::csv {

// NPY 1.0 for a structured array of one dimension: the bytes of `rows` records follow it, without anything between them.
// layout: the dtype of a record as Python writes it, [('x_mm', '<f4'), ...]; at most 65 000 bytes.
std::string npy_header(std::string_view layout, std::uint64_t rows);

}  // namespace forceshade::csv
