// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/recordings/misfit.h"

#include <Eigen/Geometry>
#include <cmath>

namespace forceshade::conformance {

Eigen::VectorXd rendered_forces(const Renderer& renderer, const RecordedPath& path, const std::vector<Measured>& samples,
                                const Placement& placement) {
  Eigen::VectorXd forces(3 * static_cast<Eigen::Index>(samples.size()));
  const auto session = renderer.open();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Eigen::Vector3d there = placement.turn * path.position(samples[i], placement.lag) + placement.shift;
    forces.segment<3>(3 * static_cast<Eigen::Index>(i)) =
        placement.turn.transpose() * session->step(there.cast<float>()).force.cast<double>();
  }
  return forces;
}

std::size_t clearly_free(const Renderer& renderer, const RecordedPath& path, const std::vector<Measured>& samples,
                         const Placement& placement, double distance) {
  Eigen::VectorXd most = rendered_forces(renderer, path, samples, placement).cwiseAbs();
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    for (const double by : {-distance, distance}) {
      Placement shifted = placement;
      shifted.shift[axis] += by;
      most = most.cwiseMax(rendered_forces(renderer, path, samples, shifted).cwiseAbs());
    }
  std::size_t count = 0;
  for (Eigen::Index i = 0; i < most.size(); i += 3)
    if (most.segment<3>(i).isZero(0)) ++count;
  return count;
}

std::vector<std::string> names_of(const Unknowns& unknowns) {
  std::vector<std::string> names{"the stiffness"};
  const auto add = [&](const std::string& what) {
    for (const char axis : {'x', 'y', 'z'}) names.push_back(what + axis);
  };
  if (unknowns.turns) add("a turn about ");
  add("a shift along ");
  if (unknowns.offset) add("an offset of the force along the recording's ");
  if (unknowns.lag) names.emplace_back("a lag of the force");
  return names;
}

Eigen::VectorXd units_of(const Unknowns& unknowns, double lever, double force) {
  Eigen::VectorXd units = Eigen::VectorXd::Constant(unknowns.count(), lever);
  units[0] = 1;
  if (unknowns.offset) units.segment<3>(unknowns.turns ? 7 : 4).setConstant(force);
  return units;
}

double Misfit::factor(const InputType& numbers) {
  return std::exp(numbers[0]);
}

Placement Misfit::placement(const InputType& numbers) const {
  Placement placement = first_;
  if (unknowns_.turns) {
    const Eigen::Vector3d turn = numbers.segment<3>(1) / scale_.lever;
    if (const double angle = turn.norm(); angle > 0) placement.turn = Eigen::AngleAxisd(angle, turn / angle) * first_.turn;
  }
  // The middle stays where it is but for the shift.
  placement.shift =
      first_.turn * scale_.middle + first_.shift + numbers.segment<3>(shift_at()) - placement.turn * scale_.middle;
  if (unknowns_.offset) placement.offset += numbers.segment<3>(shift_at() + 3);
  if (unknowns_.lag) placement.lag += numbers[inputs() - 1] / scale_.speed;
  return placement;
}

Misfit::ValueType Misfit::whole(const InputType& numbers, const ValueType& forces) const {
  const Placement at = placement(numbers);
  ValueType residuals = factor(numbers) * forces;
  for (std::size_t i = 0; i < samples_.size(); ++i)
    residuals.segment<3>(3 * static_cast<Eigen::Index>(i)) += at.offset - samples_[i].force;
  return residuals;
}

Misfit::ValueType Misfit::whole(const InputType& numbers) const {
  return whole(numbers, rendered_forces(renderer_, path_, samples_, placement(numbers)));
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
  const ValueType forces = rendered_forces(renderer_, path_, samples_, placement(numbers)), here = whole(numbers, forces);
  const Eigen::Index offset_at = unknowns_.offset ? shift_at() + 3 : numbers.size();
  for (Eigen::Index i = 0; i < numbers.size(); ++i) {
    if (i >= offset_at && i < offset_at + 3) {
      for (Eigen::Index sample = 0; sample < here.size(); sample += 3)
        if (here.segment<3>(sample).norm() <= most_) derivatives(sample + i - offset_at, i) = 1;
      continue;
    }
    InputType more = numbers, less = numbers;
    more[i] += kStep;
    less[i] -= kStep;
    const bool is_placement = i > 0;  // the first number is a factor of the same forces
    const ValueType above = (is_placement ? whole(more) : whole(more, forces)) - here,
                    below = here - (is_placement ? whole(less) : whole(less, forces));
    for (Eigen::Index sample = 0; sample < here.size(); sample += 3) {
      if (here.segment<3>(sample).norm() > most_) continue;
      const ValueType& one = above.segment<3>(sample).squaredNorm() < below.segment<3>(sample).squaredNorm() ? above : below;
      derivatives.col(i).segment<3>(sample) = one.segment<3>(sample) / kStep;
    }
  }
  return 0;
}

}  // namespace forceshade::conformance
