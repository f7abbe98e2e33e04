// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The columns of a recording: their names, units and axes.

#include <Eigen/Core>
#include <array>
#include <string>

#include "files/decimal.h"

namespace forceshade::conformance {

// The columns that hold the numbers. `forceshade recording export` writes these names.
struct Columns {
  static constexpr std::array<const char*, 7> kWhat{"t", "x", "y", "z", "fx", "fy", "fz"};
  std::array<std::string, 7> names{"t_s", "x_mm", "y_mm", "z_mm", "fx_N", "fy_N", "fz_N"};
  std::string nanoseconds = "";                 // the column of whole ns beside names[0] of whole seconds; empty for none
  int power_of_seconds = 0;                     // the power of ten that one of the file's unit is in s
  files::Decimal millimetres = 1, newtons = 1;  // one of the file's unit

  // True if the columns are called by their numbers, since the file has no header.
  bool are_numbered() const;
};

// text: "t=time_s,x=px,y=py,z=pz,fx=f1,fy=f2,fz=f3", or no names, for those of `forceshade recording export`; and units,
// "m,mN", of what columns whose names do not end in their unit hold, as px_m and "px [m]" do. t=secs+nsecs names two columns,
// whole seconds and whole ns. Throws Error, also for a unit that is not known.
Columns columns_of(const std::string& text);

// The turn of the recording's axes into those of the scene: "x,z,-y" says that its first axis is the scene's x, its second the
// scene's z, its third the scene's -y. Throws Error.
Eigen::Matrix3d turn_of_frame(const std::string& text);

// The force sensor's reading of no force, in N: "0.12,-0.07,0.31". Throws Error.
Eigen::Vector3d offset_of(const std::string& text);

}  // namespace forceshade::conformance
