// SPDX-License-Identifier: BSD-3-Clause
// Compares the emulated AVX-512 batch with single calls: aimed positions of each law, at the thesis's parameters and at random
// ones. Prints how many were compared; exit code 1 where one differs.

#include "fast/simd/batch.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <random>
#include <vector>

#include "fast/evaluate.h"
#include "fast/laws/all.h"
#include "tests/fast/pack_operations.h"

namespace forceshade::tests {
namespace {

constexpr std::size_t kPositions = fast::kBlock;

class Comparison {
 public:
  template <class Definition>
  void run(const Parameters& p, std::type_identity<Definition>) {
    const fast::Built<Definition> law(p);
    const auto answer = static_cast<const fast::BlockOf<Definition>&>(fast::kAvx512Blocks).answer;
    aim(p);
    for (std::size_t i = 0; i < kPositions; i += fast::kStep) {
      float fx[fast::kStep], fz[fast::kStep];
      if (!answer(law.definition, fast::kStep, &x_[i], &z_[i], fx, fz)) continue;
      for (std::size_t lane = 0; lane < fast::kStep; ++lane) {
        const Eigen::Vector3f one = fast::evaluate(law, p, {x_[i + lane], 0, z_[i + lane]}).force;
        ++compared_;
        if (std::memcmp(&one[0], &fx[lane], 4) == 0 && std::memcmp(&one[2], &fz[lane], 4) == 0) continue;
        if (wrong_++ < 10)
          std::printf("%s: x = %a, z = %a: found (%a, %a), expected (%a, %a)\n", __PRETTY_FUNCTION__,
                      static_cast<double>(x_[i + lane]), static_cast<double>(z_[i + lane]), static_cast<double>(fx[lane]),
                      static_cast<double>(fz[lane]), static_cast<double>(one[0]), static_cast<double>(one[2]));
      }
    }
  }
  template <class... Definition>
  void run_all(const Parameters& p, fast::LawList<Definition...>) {
    (run(p, std::type_identity<Definition>()), ...);
  }

  // Nearly all blocks must have been answered.
  bool passed(std::size_t sets, std::size_t laws) const {
    std::printf("%zu positions compared, %zu differ\n", compared_, wrong_);
    return wrong_ == 0 && 2 * compared_ > sets * laws * kPositions;
  }

 private:
  double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }

  // Around the surface of the cylinder and of the plane, at every distance from them.
  void aim(const Parameters& p) {
    const double R = static_cast<double>(p.radius), half = 0.5 * static_cast<double>(p.width),
                 d = std::sqrt((R - half) * (R + half));
    for (std::size_t i = 0; i < kPositions; ++i) {
      const double x = 1.1 * half * (2 * uniform() - 1), height = std::fabs(x) < half ? std::sqrt(R * R - x * x) - d : 0;
      const double distance = R * (uniform() - 0.6) * std::exp2(-12 * uniform());
      x_[i] = static_cast<float>(x);
      z_[i] = static_cast<float>(random_() % 4 == 0 ? distance : height + distance);
    }
  }

  std::mt19937_64 random_{1};
  std::vector<float> x_ = std::vector<float>(kPositions), z_ = x_;
  std::size_t compared_ = 0, wrong_ = 0;
};

int run() {
  if (const char* wrong = wrong_operation_avx512()) {
    std::printf("wrong: %s\n", wrong);
    return 1;
  }
  constexpr std::size_t kSets = 300;
  Comparison comparison;
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(0, 1);
  Parameters p{15.24F, 25.4F, 0.5F};
  for (std::size_t set = 0; set < kSets; ++set) {
    comparison.run_all(p, fast::Laws());
    p.radius = static_cast<float>(0.11 * std::pow(9e4, uniform(random)));
    p.width = p.radius * static_cast<float>(2 * std::exp2(-6 * uniform(random)));
    p.stiffness = static_cast<float>(0.0011 * std::pow(9e5, uniform(random)));
  }
  return comparison.passed(kSets, kLaws.size()) ? 0 : 1;
}

}  // namespace
}  // namespace forceshade::tests

int main() {
  return forceshade::tests::run();
}
