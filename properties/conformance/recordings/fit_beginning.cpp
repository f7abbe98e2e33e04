// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/recordings/fit_beginning.h"

#include "properties/conformance/recordings/misfit.h"

namespace forceshade::conformance {

Samples thinned(const Samples& samples, std::size_t most) {
  const std::size_t step = (samples.size() + most - 1) / most;
  Samples some;
  for (std::size_t i = 0; i < samples.size(); i += step) some.push_back(samples[i]);
  return some;
}

std::vector<Spot> spots_of(const properties::Subject& subject, float stiffness, std::uint64_t seed) {
  constexpr std::size_t kPlaces = 64;
  const auto positions = subject.positions(seed);
  const auto session = subject.renderer().open();
  std::vector<Spot> spots;
  for (int i = 0; i < 100000 && spots.size() < kPlaces; ++i) {
    const properties::Aimed aimed = positions->next();
    const fast::Evaluation answer = session->step(aimed.position);
    const bool is_near = aimed.aim == properties::Aim::volume || aimed.aim == properties::Aim::surface;
    if (!is_near || finished(answer.status) != Status::contact || !(answer.force.norm() > 0)) continue;
    const Eigen::Vector3d force = answer.force.cast<double>();
    spots.push_back({aimed.position.cast<double>() + force / static_cast<double>(stiffness), force.normalized()});
  }
  return spots;
}

Beginning tried(const Renderer& renderer, const RecordedPath& path, const Samples& samples, const Placement& placement) {
  const Eigen::VectorXd forces = rendered_forces(renderer, path, samples, placement);
  double both = 0, measured = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Eigen::Vector3d force = samples[i].force - placement.offset;
    both += force.dot(forces.segment<3>(3 * static_cast<Eigen::Index>(i)));
    measured += force.squaredNorm();
  }
  const double size = forces.squaredNorm();
  if (!(size > 0)) return {placement};
  return {placement, both / size, 1 - both * both / (size * measured)};
}

double usual_speed_of(const Measurements& measured) {
  const double seconds = measured.samples.back().time - measured.samples.front().time;
  double way = 0;
  for (std::size_t i = 1; i < measured.samples.size(); ++i)
    way += (measured.samples[i].position - measured.samples[i - 1].position).norm();
  return way > 0 && seconds > 0 ? way / seconds : 1;
}

}  // namespace forceshade::conformance
