// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The lines of docs/command-device.md: nothing here starts a program.

#include <Eigen/Core>
#include <limits>
#include <string>

#include "device/frames/framed_device.h"

namespace forceshade::device::command {

inline constexpr const char* kWhose = "program";  // its name in messages

struct Hello {
  FramedDescription description;
  bool paces = false;  // it answers at the frames of its device, and not at once
};

// Throws files::ProcessFailed for a line that is no hello of this version, with the key and what was expected.
Hello hello_of(const std::string& line);

// Without the end of the line.
std::string line_of(const Eigen::Vector3d& force);
inline constexpr const char* kEnd = R"({"end":true})";

// Reads the answers of a program, in turn.
class Answers {
 public:
  // buttons: how many the device has, at most 16.
  explicit Answers(int buttons) : buttons_(buttons) {}

  // Throws files::ProcessFailed for what is no answer, and where its time is not after that of the answer before: its position
  // is then an old one.
  FrameState state_of(const std::string& line);

 private:
  int buttons_;
  double last_ = -std::numeric_limits<double>::infinity();  // s
};

}  // namespace forceshade::device::command
