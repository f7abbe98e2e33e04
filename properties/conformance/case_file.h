// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Files of positions, and of positions with the forces that a foreign program gave for them: CSV, or NPY by the ending of the
// name. Columns or fields: x_mm, y_mm, z_mm; fx_N, fy_N, fz_N; reset, 1 where a path begins and else 0; aim, a
// word; periods, those since the row before.

#include <cstdint>
#include <functional>
#include <istream>
#include <ostream>
#include <string>

#include "forceshade/properties.h"
#include "properties/conformance/judge.h"

namespace forceshade::conformance {

// Writes so many positions of the subject, in paths. is_npy: a structured array of x_mm, y_mm and z_mm as binary32, reset as an
// unsigned byte, aim as 12 bytes of text, and periods as four bytes. has_damping: as of Strokes, with the periods. Throws
// Interrupted.
void write_positions(std::ostream& out, bool is_npy, const properties::Subject& subject, std::uint64_t count,
                     std::uint64_t seed, bool has_damping = false, const Monitor& monitor = {});

// Calls each() for one case after the other. An NPY file is an array of records with these fields, all binary32 but reset, aim
// and periods, or an array (n, 6) of binary32 numbers: a position and its force in each row. Where no reset is known, all cases
// are one path, and where no periods are, each is 1. Throws Error, which names the file, the line or row, and what was
// expected, also for a file without cases.
void read_cases(std::istream& in, const std::string& file, const std::function<void(const Case&)>& each);

}  // namespace forceshade::conformance
