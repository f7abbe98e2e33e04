// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The devices that DHD drives, and what is assumed of each: the vendor's library has no function for its limits.

namespace forceshade::device::dhd {

struct Model {
  int type;  // as dhdGetSystemType() has it
  const char* name;
  float reach;             // mm, from the middle of the workspace
  float peak, continuous;  // N
  int buttons;
};

inline constexpr int kFalcon = 60;

// Null: a type of which nothing is known here.
const Model* model_of(int type) noexcept;

}  // namespace forceshade::device::dhd
