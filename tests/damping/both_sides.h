// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Both sides of damping, which must answer alike in every bit.

#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <string>

#include "forceshade/fast.h"
#include "forceshade/reference.h"

namespace forceshade::tests {

inline std::string shown(const Eigen::Vector3f& a) {
  std::string text;
  for (int i = 0; i < 3; ++i) {
    char number[32];
    std::snprintf(number, sizeof number, "%s%a", i > 0 ? ", " : "", static_cast<double>(a(i)));
    text += number;
  }
  return text;
}
inline bool same_bits(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::memcmp(a.data(), b.data(), 3 * sizeof(float)) == 0;
}

struct DampingOfBothSides {
  fast::Damping fast;
  reference::Damping reference;

  explicit DampingOfBothSides(const damping::Parameters& p)
      : fast(std::get<fast::Damping>(fast::Damping::build(p))),
        reference(std::get<reference::Damping>(reference::Damping::build(p))) {}

  void resume(const damping::State& state) {
    fast.resume(state);
    reference.resume(state);
  }

  // The answer of both to a spring's force.
  fast::Evaluation tick(const Eigen::Vector3f& position, std::uint32_t periods, const Eigen::Vector3f& spring,
                        Status status = Status::contact, const damping::Limits& limits = {}) {
    reference::Rounded exact;
    exact.force = spring;
    exact.status = status;
    exact.damping = limits;
    exact = reference.tick(position, periods, exact);
    const fast::Evaluation found = fast.tick(position, periods, {spring, status, fast::Stage::binary64, limits});
    const damping::State state = fast.state();
    EXPECT_TRUE(same_bits(found.force, exact.force) && found.status == exact.status && state == reference.state())
        << "at " << shown(position) << " mm, after " << periods << " periods, spring " << shown(spring) << " N, velocity "
        << shown(Eigen::Vector3f(reference.state().velocity.data())) << " mm/s: expected " << shown(exact.force) << ", got "
        << shown(found.force) << " N";
    return found;
  }
};

}  // namespace forceshade::tests
