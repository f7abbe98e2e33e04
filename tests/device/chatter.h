// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Chatter: a force that goes to and fro from tick to tick, which a hand feels as a buzz. Counted where one component of the
// force changed by more than 0.02 N three times in a row, with alternating signs, while the law's own force was smooth.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace forceshade::tests {

// One force, tick by tick.
class Alternation {
 public:
  static constexpr float kFelt = 0.02F;  // N

  // Returns true if the last three changes alternate by more than kFelt along an axis; `size` is the smallest of the three.
  bool next(const Eigen::Vector3f& force) {
    changes_ = {changes_[1], changes_[2], Eigen::Vector3f(force - last_)};
    last_ = force;
    size = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float a = changes_[0][axis], b = changes_[1][axis], c = changes_[2][axis];
      if (a * b < 0 && b * c < 0) size = std::max(size, std::min({std::fabs(a), std::fabs(b), std::fabs(c)}));
    }
    return size > kFelt;
  }

  float size = 0;  // N

 private:
  Eigen::Vector3f last_{0, 0, 0};
  std::array<Eigen::Vector3f, 3> changes_{Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(0, 0, 0)};
};

struct Chatter {
  // `of_law` is what the force was made from. It is smooth where it did not alternate, and no change differed from the one
  // before by more than kSmooth: over these three changes and the one before, for a sample of latency.
  static constexpr float kSmooth = 0.1F;  // N: twice what a count of 0.03 mm along each axis makes at 0.5 N/mm

  void next(const Eigen::Vector3f& force, const Eigen::Vector3f& of_law) {
    const Eigen::Vector3f change = of_law - last_;
    const bool jumped = (change - change_).norm() > kSmooth, alternated = law_.next(of_law), alternates = force_.next(force);
    last_ = of_law;
    change_ = change;
    smooth_ = jumped || alternated ? 0 : smooth_ + 1;
    if (smooth_ < 4) return;
    ticks += alternates;
    worst = std::max(worst, force_.size);
  }

  std::size_t ticks = 0;
  float worst = 0;  // N: the largest alternation, be it felt or not

 private:
  Alternation force_, law_;
  Eigen::Vector3f last_{0, 0, 0}, change_{0, 0, 0};
  int smooth_ = 0;  // ticks
};

}  // namespace forceshade::tests
