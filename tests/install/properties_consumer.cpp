// SPDX-License-Identifier: BSD-3-Clause
// Tests walls of a stranger's: one is right, one pulls, one remembers the force before, and one throws.

#include <forceshade/properties.h>

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

namespace {

using namespace forceshade;

properties::ForceAt wall_of(float sign) {
  return [sign](const Eigen::Vector3f& position) -> properties::Rendered {
    // Coordinate by coordinate, because the largest of several is not defined where one is a NaN.
    if (!(position.array().abs() <= 1e4F).all()) return {{0, 0, 0}, Status::invalid};
    // A coordinate below the position quantum, 2^-30 mm, is 0: docs/laws.md.
    if (!(position.z() <= -0x1p-30F)) return {{0, 0, 0}, Status::free};
    return {{0, 0, sign * 0.5F * -position.z()}, Status::contact};
  };
}

// Half of the force before and half of the one that is due: a filter, which the definition of a wall does not have.
properties::ForceAt filtered_wall() {
  return [right = wall_of(1), before = std::make_shared<Eigen::Vector3f>(0, 0, 0)](const Eigen::Vector3f& position) {
    properties::Rendered answer = right(position);
    *before = answer.force = 0.5F * (*before + answer.force);
    return answer;
  };
}

properties::Rendered throwing_wall(const Eigen::Vector3f& position) {
  if (position.z() < -1) throw std::runtime_error("too deep");
  return wall_of(1)(position);
}

// The counterexample of the first property that does not hold; empty where all hold.
std::string failure_of(const properties::ForceAt& wall) {
  std::string failure;
  const auto subject = properties::law_subject(LawId::wall, {.stiffness = 0.5F}, wall);
  for (const properties::PropertyResult& result : properties::run_properties(*subject, 2000, 1)) {
    std::printf("%s: %s\n", result.name.c_str(), result.held ? "holds" : result.counterexample.c_str());
    if (!result.held && failure.empty()) failure = result.counterexample;
  }
  return failure;
}

bool says(const std::string& text, const char* words) {
  return text.find(words) != std::string::npos;
}

}  // namespace

int main() {
  const bool is_right = failure_of(wall_of(1)).empty() && says(failure_of(wall_of(-1)), "expected the force") &&
                        says(failure_of(filtered_wall()), "the renderer gives two answers") &&
                        says(failure_of(throwing_wall), "the renderer throws: too deep");
  return is_right ? 0 : 1;
}
