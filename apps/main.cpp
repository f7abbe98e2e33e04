// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "apps/command_line.h"
#include "rendering/control_words.h"

int main(int argc, char** argv) {
  // A library that was loaded with this program, or WSL 1, may have left long double with 53 bits.
  const forceshade::ExactArithmetic with_all_bits;
  return forceshade::apps::run_command_line({argv + std::min(argc, 1), argv + argc});
}
