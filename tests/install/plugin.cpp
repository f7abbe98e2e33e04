// SPDX-License-Identifier: BSD-3-Clause
// A plugin as a game engine or a module of Python has it: a shared object with the libraries in it.

#include <forceshade/fast.h>

// The force at depth 1 mm in a wall of 0.5 N/mm, N.
extern "C" [[gnu::visibility("default")]] float plugin_force() {
  const auto built =
      forceshade::fast::Law::build(forceshade::LawId::wall, {.radius = 15.24F, .width = 25.4F, .stiffness = 0.5F});
  const auto* law = std::get_if<forceshade::fast::Law>(&built);
  return law == nullptr ? -1 : law->force({0, 0, -1}).z();
}
