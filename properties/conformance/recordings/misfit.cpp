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

Misfit::ValueType Misfit::whole(const InputType& numbers) const {
  ValueType residuals = factor(numbers) * rendered_forces(renderer_, samples_, placement(numbers));
  for (std::size_t i = 0; i < samples_.size(); ++i) residuals.segment<3>(3 * static_cast<Eigen::Index>(i)) -= samples_[i].force;
  return residuals;
}

int Misfit::operator()(const InputType& numbers, ValueType& residuals) const {
  residuals = whole(numbers);
  for (Eigen::Index sample = 0; sample < residuals.size(); sample += 3)
    if (const double size = residuals.segment<3>(sample).norm(); size > most_) residuals.segment<3>(sample) *= most_ / size;
  return 0;
}

// 0.01 mm is more than a thousand times what a position within 100 mm is rounded by to binary32. Where the force jumps within
// this step of a sample, the difference on that side is the jump and no derivative. So the smaller difference of both sides is
// taken, which is that of the face on which the sample lies.
int Misfit::df(const InputType& numbers, JacobianType& derivatives) const {
  constexpr double kStep = 1e-2;
  derivatives.setZero(values(), inputs());
  const ValueType here = whole(numbers);
  for (Eigen::Index i = 0; i < numbers.size(); ++i) {
    InputType more = numbers, less = numbers;
    more[i] += kStep;
    less[i] -= kStep;
    const ValueType above = whole(more) - here, below = here - whole(less);
    for (Eigen::Index sample = 0; sample < here.size(); sample += 3) {
      if (here.segment<3>(sample).norm() > most_) continue;
      const ValueType& one = above.segment<3>(sample).squaredNorm() < below.segment<3>(sample).squaredNorm() ? above : below;
      derivatives.col(i).segment<3>(sample) = one.segment<3>(sample) / kStep;
    }
  }
  return 0;
}

}  // namespace forceshade::conformance
