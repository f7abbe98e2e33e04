// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/recordings/misfit.h"

#include <Eigen/Geometry>
#include <cmath>

namespace forceshade::conformance {

Eigen::VectorXd rendered_forces(const Renderer& renderer, const std::vector<Measured>& samples, const Placement& placement) {
  Eigen::VectorXd forces(3 * static_cast<Eigen::Index>(samples.size()));
  const auto session = renderer.open();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Eigen::Vector3d there = placement.turn * samples[i].position + placement.shift;
    forces.segment<3>(3 * static_cast<Eigen::Index>(i)) =
        placement.turn.transpose() * session->step(there.cast<float>()).force.cast<double>();
  }
  return forces;
}

double Misfit::factor(const InputType& numbers) {
  return std::exp(numbers[0]);
}

Placement Misfit::placement(const InputType& numbers) const {
  Placement placement = first_;
  if (has_turns_) {
    const Eigen::Vector3d turn = numbers.segment<3>(1) / lever_;
    if (const double angle = turn.norm(); angle > 0) placement.turn = Eigen::AngleAxisd(angle, turn / angle) * first_.turn;
  }
  // The middle stays where it is but for the shift.
  placement.shift = first_.turn * middle_ + first_.shift + numbers.tail<3>() - placement.turn * middle_;
  return placement;
}

int Misfit::operator()(const InputType& numbers, ValueType& residuals) const {
  residuals = factor(numbers) * rendered_forces(renderer_, samples_, placement(numbers));
  for (std::size_t i = 0; i < samples_.size(); ++i) residuals.segment<3>(3 * static_cast<Eigen::Index>(i)) -= samples_[i].force;
  return 0;
}

// 0.01 mm is more than a thousand times what a position within 100 mm is rounded by to binary32.
int Misfit::df(const InputType& numbers, JacobianType& derivatives) const {
  constexpr double kStep = 1e-2;
  derivatives.resize(values(), inputs());
  for (Eigen::Index i = 0; i < numbers.size(); ++i) {
    InputType more = numbers, less = numbers;
    more[i] += kStep;
    less[i] -= kStep;
    ValueType above, below;
    (*this)(more, above);
    (*this)(less, below);
    derivatives.col(i) = (above - below) / (2 * kStep);
  }
  return 0;
}

}  // namespace forceshade::conformance
