// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The layout of the bytes of a recording: samples end to end, each the columns below without gaps, little-endian.

#include <array>
#include <bit>
#include <cstddef>
#include <string>
#include <string_view>

#include "forceshade/servo_loop.h"

namespace forceshade::recorder {

using device::Sample;

// The header of every recording has "FSHR", and the version that a change of the schema, of a sample's bytes or of the
// metadata raises. Format 4 has more columns behind those of format 3, which is format 2 with a digest of the metadata; format
// 5 is that of a damped run, which a reader of format 4 would misread; no other is read.
inline constexpr int kApplicationId = 0x46534852;
inline constexpr int kFormatOfDamping = 5, kFormatVersion = 4, kFormatOfFewerColumns = 3, kFormatWithoutDigest = 2;

// The key that the metadata of a damped run have.
inline constexpr const char* kDampingKey = "damping_rate_hz";

// The tables as SQLite keeps them, word for word: a file with any other table, a view or a trigger is no recording.
inline constexpr std::array<std::string_view, 2> kTables{
    "CREATE TABLE metadata(key TEXT PRIMARY KEY, value TEXT NOT NULL)",
    "CREATE TABLE chunk(id INTEGER PRIMARY KEY, first_tick INTEGER NOT NULL, last_tick INTEGER NOT NULL,"
    "                   samples INTEGER NOT NULL, sha256 BLOB NOT NULL, data BLOB NOT NULL)"};

// The most samples in one row of the table of chunks: half a megabyte, when a backlog is written.
inline constexpr std::size_t kLongestChunk = 4096;

// The key under which the digest of all other metadata stands.
inline constexpr const char* kDigestKey = "metadata_sha256";

static_assert(std::endian::native == std::endian::little, "samples are stored as they are in memory");

struct Column {
  const char* name;
  const char* type;  // as NumPy writes it
};

// The columns, in the order of Sample's members.
inline constexpr std::array<Column, 37> kColumns{{
    {"tick", "<u8"},
    {"wall_ns", "<i8"},
    {"device_t_s", "<f8"},
    {"encoder_1", "<i8"},
    {"encoder_2", "<i8"},
    {"encoder_3", "<i8"},
    {"energy_mJ", "<f8"},
    {"compute_ns", "<i8"},
    {"wakeup_ns", "<i8"},
    {"x_mm", "<f4"},
    {"y_mm", "<f4"},
    {"z_mm", "<f4"},
    {"law_fx_N", "<f4"},
    {"law_fy_N", "<f4"},
    {"law_fz_N", "<f4"},
    {"fx_N", "<f4"},
    {"fy_N", "<f4"},
    {"fz_N", "<f4"},
    {"gimbal_1_rad", "<f4"},
    {"gimbal_2_rad", "<f4"},
    {"gimbal_3_rad", "<f4"},
    {"buttons", "<u2"},
    {"limited", "<u2"},
    {"status", "|u1"},
    {"late", "|u1"},
    {"altered", "|u1"},
    {"tripped", "|u1"},
    {"shown", "<u8"},
    {"sent_work_mJ", "<f8"},
    {"sent_acted_fx_N", "<f4"},
    {"sent_acted_fy_N", "<f4"},
    {"sent_acted_fz_N", "<f4"},
    {"sent_acting_fx_N", "<f4"},
    {"sent_acting_fy_N", "<f4"},
    {"sent_acting_fz_N", "<f4"},
    {"temperature", "<f4"},
    {"device_state", "<u4"},
}};

// The first columns, which a sample before format 4 has, and their bytes.
inline constexpr std::size_t kFewerColumns = 27, kFewerBytes = 128;

// The columns as a NumPy dtype, [('tick', '<u8'), ...]: in every recording's metadata, and in the header of an NPY file.
inline std::string layout(std::size_t columns = kColumns.size()) {
  std::string text = "[";
  for (std::size_t i = 0; i < columns; ++i) text += std::string("('") + kColumns[i].name + "', '" + kColumns[i].type + "'), ";
  return text + "]";
}

}  // namespace forceshade::recorder
