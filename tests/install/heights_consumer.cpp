// SPDX-License-Identifier: BSD-3-Clause
// Renders a height map from a file, as a stranger would: heights_consumer SPEC.toml.

#include <forceshade/fast.h>
#include <forceshade/heights.h>

#include <cstdio>

int main(int, char** arguments) {
  using namespace forceshade;
  const heights::Spec spec = heights::read_spec(arguments[1]);
  const auto field = fast::HeightMapField::build(spec.map, spec.mode, 0.5F);
  if (const auto* error = std::get_if<ParameterError>(&field)) return std::puts(error->message().c_str()), 1;
  const Eigen::Vector3f force = std::get<fast::HeightMapField>(field).force({1, 0, -1});
  std::printf("%g %g %g\n", static_cast<double>(force.x()), static_cast<double>(force.y()), static_cast<double>(force.z()));
  return force.z() > 0.4F ? 0 : 1;
}
