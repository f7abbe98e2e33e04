// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A law with one wrong change: what each generated mutant.cpp registers and mutants_test.cpp wants caught.

#include <functional>
#include <string>
#include <vector>

#include "forceshade/properties/rendered.h"

namespace forceshade::tests {

struct Mutant {
  LawId law;
  std::string change;
  std::function<properties::Renderer(const Parameters&)> build;
};

std::vector<Mutant>& mutants();

struct Registration {
  explicit Registration(Mutant mutant) { mutants().push_back(std::move(mutant)); }
};

}  // namespace forceshade::tests
