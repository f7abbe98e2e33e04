// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/build.h"

#include <fstream>

#include "build_options.h"  // made by CMake when it configures
#include "files/printable.h"
#include "forceshade/fast.h"
#include "revision.h"  // made by cmake/revision.cmake at every build

namespace forceshade::properties {

Build current_build() {
  return {FORCESHADE_VERSION,
          FORCESHADE_REVISION,
          FORCESHADE_COMPILER,
          FORCESHADE_FLAGS,
          std::string(fast::name_of(fast::best_instruction_set())),
          fast::library_digest()};
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (const std::size_t colon = line.find(": "); line.starts_with("model name") && colon != std::string::npos)
      return files::printable(line.substr(colon + 2));
  return "unknown";
}

}  // namespace forceshade::properties
