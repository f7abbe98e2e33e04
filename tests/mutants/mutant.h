// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A law with one wrong change: what each generated mutant.cpp registers, for mutants_test.cpp to catch. There are more than a
// hundred of those files, so nothing of reference/ or properties/ is included here.

#include <Eigen/Core>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "forceshade/law.h"

namespace forceshade::tests {

struct MutantAnswer {
  Eigen::Vector3f force;  // N
  Status status;
};
using MutantLaw = std::function<MutantAnswer(const Eigen::Vector3f& position)>;

struct Mutant {
  LawId law;
  std::string change;
  std::function<MutantLaw(const Parameters&)> build;
};

std::vector<Mutant>& mutants();

struct Registration {
  explicit Registration(Mutant mutant) { mutants().push_back(std::move(mutant)); }
};

}  // namespace forceshade::tests
