// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Definitions of the C interface of the exact side for tests.

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>

#include "forceshade/law.h"
#include "forceshade_reference.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::tests {

inline std::string shortest(float number) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.9g", static_cast<double>(number));
  return text.data();
}

inline std::string law_file(const std::string& law, const Parameters& its) {
  const std::string shape = "radius = \"" + shortest(its.radius) + "mm\"\nwidth = \"" + shortest(its.width) + "mm\"\n";
  return "law = \"" + law + "\"\n" + (law == "wall" ? "" : shape) + "stiffness = \"" + shortest(its.stiffness) + "N/mm\"\n";
}

inline forceshade_reference parsed(const std::string& text, const std::string& file = "subject.toml") {
  forceshade_reference made{};
  EXPECT_EQ(forceshade_reference_parse(text.data(), text.size(), file.c_str(), &made), FORCESHADE_OK)
      << forceshade_reference_message();
  return made;
}

inline const std::string kBump = law_file("bump-2p", {15.24F, 25.4F, 0.5F});

// A mesh beside its subject file.
inline std::string write_tetrahedron(const TemporaryDirectory& folder) {
  folder.write("tetrahedron.off", "OFF\n4 4 0\n0 0 0\n9 0 0\n0 9 0\n0 0 9\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  return folder.write("tetrahedron.toml", "mesh = \"tetrahedron.off\"\nunit = \"mm\"\nstiffness = \"0.5N/mm\"\n");
}

}  // namespace forceshade::tests
