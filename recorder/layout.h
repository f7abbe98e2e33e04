// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the bytes of a recording mean: samples end to end, each the columns below without gaps, little-endian.

#include <array>
#include <bit>
#include <string>

#include "forceshade/device/sample.h"

namespace forceshade::recorder {

using device::Sample;

// In the header of every recording: "FSHR", and the version that a change of the schema or of a sample's bytes raises.
inline constexpr int kApplicationId = 0x46534852;
inline constexpr int kFormatVersion = 2;

static_assert(std::endian::native == std::endian::little, "samples are stored as they are in memory");

struct Column {
  const char* name;
  const char* type;  // as NumPy writes it
};

// In the order of Sample's members.
inline constexpr std::array<Column, 27> kColumns{{
    {"tick", "<u8"},         {"wall_ns", "<i8"},   {"device_t_s", "<f8"}, {"encoder_1", "<i8"},    {"encoder_2", "<i8"},
    {"encoder_3", "<i8"},    {"energy_mJ", "<f8"}, {"compute_ns", "<i8"}, {"wakeup_ns", "<i8"},    {"x_mm", "<f4"},
    {"y_mm", "<f4"},         {"z_mm", "<f4"},      {"law_fx_N", "<f4"},   {"law_fy_N", "<f4"},     {"law_fz_N", "<f4"},
    {"fx_N", "<f4"},         {"fy_N", "<f4"},      {"fz_N", "<f4"},       {"gimbal_1_rad", "<f4"}, {"gimbal_2_rad", "<f4"},
    {"gimbal_3_rad", "<f4"}, {"buttons", "<u2"},   {"limited", "<u2"},    {"status", "|u1"},       {"late", "|u1"},
    {"altered", "|u1"},      {"tripped", "|u1"},
}};

// The columns as a NumPy dtype, [('tick', '<u8'), ...]: in every recording's metadata, and in the header of an NPY file.
inline std::string layout() {
  std::string text = "[";
  for (const Column& column : kColumns) text += std::string("('") + column.name + "', '" + column.type + "'), ";
  return text + "]";
}

}  // namespace forceshade::recorder
