// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "apps/command_line.h"

int main(int argc, char** argv) {
  return forceshade::apps::run_command_line({argv + std::min(argc, 1), argv + argc});
}
