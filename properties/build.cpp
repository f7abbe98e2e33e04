// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/properties/build.h"

#include "build_options.h"  // made by CMake when it configures
#include "forceshade/fast/instruction_set.h"
#include "forceshade/fast/law.h"
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

}  // namespace forceshade::properties
