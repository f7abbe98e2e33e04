// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A case in which a renderer is wrong, as a test that one can paste.

#include <Eigen/Core>
#include <span>
#include <string>

#include "forceshade/identity.h"
#include "properties/conformance/judge.h"

namespace forceshade::conformance {

// {0x1.8p+1f, 0x0p+0f, -0x1p-1f}, as C and C++ read it.
std::string literal(const Eigen::Vector3f& numbers);

// Lines of C, each ended: the path from no contact, the periods before each position if there are any, and the force at its
// end.
std::string test_to_paste(const Identity& identity, std::span<const Eigen::Vector3f> path,
                          std::span<const std::uint32_t> periods, const Judged& at_its_end);

}  // namespace forceshade::conformance
