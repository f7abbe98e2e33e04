// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the servo loop did, tick by tick, and how it is written down.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "forceshade/device/device.h"
#include "forceshade/vocabulary/law.h"

namespace forceshade::device {

struct Tick {
  std::size_t number = 0;
  std::int64_t wall_ns = 0;  // since the loop started, when the position had been read
  Reading reading;
  Eigen::Vector3f force{0, 0, 0};  // N, as commanded
  std::optional<Status> status;    // none: the zero force that ends a run
  std::int64_t compute_ns = 0;     // from position read to force commanded
};

// Writes tick,t_s,device_t_s,x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,status,compute_us with every number in the shortest form that
// reads back the same; status is free, contact, invalid or end. Throws csv::OutputError, and then leaves no file.
void write_record(std::span<const Tick> record, const std::string& path);

}  // namespace forceshade::device
