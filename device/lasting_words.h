// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The words of a Fault live as long as the program, so that a result can be reported after its device is gone.

#include <array>

namespace forceshade::device {

using LastingWords = std::array<char, 4096>;

// Room for the words of one device's fault; empty.
LastingWords* room_for_words();

}  // namespace forceshade::device
