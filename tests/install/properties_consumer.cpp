// SPDX-License-Identifier: BSD-3-Clause
// Tests two walls of a stranger's: one is right, and one pulls.

#include <forceshade/properties/law_subject.h>
#include <forceshade/properties/run.h>

#include <cstdio>

namespace {

bool holds(float sign) {
  using namespace forceshade;
  const auto law = reference::Law::build(LawId::wall, {.stiffness = 0.5F});
  const auto wall = [sign](const Eigen::Vector3f& position) -> properties::Rendered {
    // Coordinate by coordinate, because the largest of several is not defined where one is a NaN.
    if (!(position.array().abs() <= 1e4F).all()) return {{0, 0, 0}, Status::invalid};
    // A coordinate below the position quantum, 2^-30 mm, is 0: docs/laws.md.
    if (!(position.z() <= -0x1p-30F)) return {{0, 0, 0}, Status::free};
    return {{0, 0, sign * 0.5F * -position.z()}, Status::contact};
  };
  bool all = true;
  const properties::LawSubject subject(properties::RenderedLaw{std::get<reference::Law>(law), wall});
  for (const properties::PropertyResult& result : properties::run_properties(subject, 2000, 1)) {
    std::printf("%s: %s\n", result.name.c_str(), result.held ? "holds" : result.counterexample.c_str());
    all = all && result.held;
  }
  return all;
}

}  // namespace

int main() {
  return holds(1) && !holds(-1) ? 0 : 1;
}
