// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a fit makes small: the forces of a recording less those of a renderer, as a function of where the recording lies and of
// how stiff it is.

#include <Eigen/Core>
#include <vector>

#include "forceshade/renderer.h"
#include "properties/conformance/recordings/recording.h"

namespace forceshade::conformance {

// The seven numbers of a fit, from a first placement on: ln of the factor on the stiffness; a turn about the scene's x, y and
// z through the middle, in lever arms (mm at the distance `lever`); a shift along them (mm). A fit of a known turn has no
// turns.
class Misfit {
 public:
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  // middle, lever: mm, of the recording's samples in contact. most: N; a larger residual is shortened to it, so that a sample
  // that nothing explains, or that lies on the wrong side of a jump, counts no more than this.
  Misfit(const Renderer& renderer, std::vector<Measured> samples, const Placement& first, const Eigen::Vector3d& middle,
         double lever, bool has_turns, double most)
      : renderer_(renderer),
        samples_(std::move(samples)),
        first_(first),
        middle_(middle),
        lever_(lever),
        has_turns_(has_turns),
        most_(most) {}

  int inputs() const { return has_turns_ ? 7 : 4; }
  int values() const { return static_cast<int>(3 * samples_.size()); }
  bool has_turns() const { return has_turns_; }
  const std::vector<Measured>& samples() const { return samples_; }

  // As Eigen's Levenberg-Marquardt calls them: the residuals (N), and their derivatives by differences, since the renderer
  // has none; zero where the residual is shortened. They return 0.
  int operator()(const InputType& numbers, ValueType& residuals) const;
  int df(const InputType& numbers, JacobianType& derivatives) const;

  Placement placement(const InputType& numbers) const;
  static double factor(const InputType& numbers);

 private:
  ValueType whole(const InputType& numbers) const;  // the residuals before any is shortened

  const Renderer& renderer_;
  std::vector<Measured> samples_;
  Placement first_;
  Eigen::Vector3d middle_;
  double lever_;
  bool has_turns_;
  double most_;
};

// The forces of the renderer at the positions of a path, in the axes of the recording.
Eigen::VectorXd rendered_forces(const Renderer& renderer, const std::vector<Measured>& samples, const Placement& placement);

}  // namespace forceshade::conformance
