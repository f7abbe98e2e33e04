// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A recording of another system: times, positions of the hand and the forces on it, as they were measured.

#include <Eigen/Core>
#include <boost/multiprecision/cpp_int.hpp>
#include <cstddef>
#include <istream>
#include <string>
#include <vector>

#include "properties/conformance/recordings/columns.h"

namespace forceshade::conformance {

struct Measured {
  double time = 0;                  // s, from the first sample on
  Eigen::Vector3d position, force;  // mm, N; the force may be no number
  std::size_t line = 0;             // of the file
  double interval = 0;              // s, from the sample before; rounded once, as the time is
};

struct Measurements {
  std::string file;  // its name in messages
  std::vector<Measured> samples;

  // "theirs.csv:12".
  std::string place(std::size_t sample) const;
};

// A row that has "end" in a column "status", as `forceshade recording export` writes it, is the end of a run and no sample.
// Throws Error, which names the file, the line, the value and what was expected, also for a file of fewer than
// two samples.
Measurements read_measurements(std::istream& in, const std::string& file, const Columns& columns);

// The place of a recording in the subject's scene: there, p is at turn·p + shift, and a force F is turn·(F - offset), at the
// position that the hand had before the lag.
struct Placement {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();   // mm
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // N, along the axes of the recording: what a sensor reads of no force
  double lag = 0;                                    // s, by which a force comes after its position
};

// Without the samples whose position before the lag is not in the recording.
Measurements placed(const Measurements& measured, const Placement& placement);

// A time as a file writes it, so that a difference of two is rounded once: ns since 1970 have 19 digits, binary64 has 16.

class ExactTime {
 public:
  ExactTime() = default;

  // text: a number as files::Reader reads it, and value: what it read, which is finite. Of a hexfloat, and of a decimal with
  // very many digits, the shortest decimal of the value stands for it.
  ExactTime(const std::string& text, double value);

  // The binary64 number nearest to the difference in s. power: of ten, that one of the file's unit is in s.
  double seconds_since(const ExactTime& other, int power) const;

 private:
  boost::multiprecision::cpp_int digits_;  // times ten to the power of exponent_
  int exponent_ = 0;
};

}  // namespace forceshade::conformance
