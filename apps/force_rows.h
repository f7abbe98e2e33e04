// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Forces for the positions of a CSV, row by row, as CSV or NPY.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <istream>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>

namespace forceshade::apps {

// The numbers are those of an NPY file. The first four are those of a recording, where `end` is the zero force that ends a run.
enum class RowStatus : std::uint8_t { free, contact, invalid, end, unfinished, undecided };
inline constexpr std::array<std::string_view, 6> kRowStatusNames{"free", "contact",    "invalid",
                                                                 "end",  "unfinished", "undecided"};

// unfinished: a god-object used up the moves or looks of one tick, and the force is not that of rest.
struct AnsweredRow {
  Eigen::Vector3f force{0, 0, 0};  // N
  RowStatus status = RowStatus::free;
  // Digits of the force that a CSV has in place of the shortest form.
  std::optional<std::array<std::string, 3>> decimal;
};

// answer throws std::domain_error for a position that it cannot answer. begin: before the first position of another path.
struct Answer {
  std::function<AnsweredRow(const Eigen::Vector3f&)> answer;
  std::function<void()> begin = [] {};
};

// npy: a structured array of one dimension, x_mm, y_mm, z_mm, fx_N, fy_N, fz_N as binary32 and status as an unsigned byte.
enum class RowFormat { csv, npy };

struct RowCount {
  std::size_t rows = 0, unanswered = 0;
};

// A row for each row of `in`, which messages call `file`, and which begins another path where a column `reset` has a 1. One
// that cannot be answered gets nan for its force and the status "undecided", and a line on `complaints` that names its line. An
// NPY file is kept in memory, 25 bytes a row, until its number of rows is known. Throws Error for a row that cannot be read,
// and Interrupted.
RowCount answer_rows(std::istream& in, const std::string& file, RowFormat format, std::ostream& out, std::ostream& complaints,
                     const Answer& answer);

}  // namespace forceshade::apps
