// SPDX-License-Identifier: BSD-3-Clause
#include "properties/equivalence.h"

#include "properties/binary32.h"
#include "rendering/breakdown.h"

namespace forceshade::properties {
namespace {

std::string_view word(Status status) {
  return kStatusNames[static_cast<std::size_t>(finished(status))];
}

}  // namespace

std::string not_decided(const Eigen::Vector3f& position, const std::domain_error& error) {
  return "at " + show(position) + " mm the reference does not decide: " + error.what();
}

Violation difference(const Eigen::Vector3f& position, const Rendered& answer, const reference::Rounded& exact) {
  const bool same = same_bits(answer.force.x(), exact.force.x()) && same_bits(answer.force.y(), exact.force.y()) &&
                    same_bits(answer.force.z(), exact.force.z()) && finished(answer.status) == finished(exact.status);
  if (same) return std::nullopt;
  return "at " + show(position) + " mm: expected the force " + show(exact.force) + " N (" + std::string(word(exact.status)) +
         "), got " + show(answer.force) + " N (" + std::string(word(answer.status)) + ")";
}

}  // namespace forceshade::properties
