// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The residuals that the fit minimises: the forces of a recording less those of a renderer, as a function of the recording's
// place, the stiffness, and the reading of no force.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "forceshade/renderer.h"
#include "properties/conformance/recordings/path.h"
#include "properties/conformance/recordings/recording.h"

namespace forceshade::conformance {

// The numbers that are fitted beside the stiffness and the shift.
struct Unknowns {
  bool turns = true, offset = true, lag = true;

  int count() const { return 4 + (turns ? 3 : 0) + (offset ? 3 : 0) + (lag ? 1 : 0); }
};

// The names of the numbers of a fit, in their order; and the change of each that changes the forces by about themselves, which
// are of the size `force` (N). lever: mm.
std::vector<std::string> names_of(const Unknowns& unknowns);
Eigen::VectorXd units_of(const Unknowns& unknowns, double lever, double force);

// The scales in which the numbers of a fit are measured.
struct Scale {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // mm, of the recording's samples in contact
  double lever = 0;                                  // mm, from there to the farthest of them
  double speed = 1;                                  // mm/s, that is usual
};

// The numbers of a fit, from a first placement on: ln of the factor on the stiffness; a turn about the scene's x, y and z
// through the middle, in lever arms (mm at the distance `lever`); a shift along them (mm); what the offset changes by (N); what
// the lag changes by, as the way (mm) at the usual speed. Those that are known are left out.
class Misfit {
 public:
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  // most: N; a larger residual is shortened to it, so that a sample that nothing explains, or that lies on the wrong side of a
  // jump, counts no more than this. renderer, path and samples are to outlive this.
  Misfit(const Renderer& renderer, const RecordedPath& path, const std::vector<Measured>& samples, const Placement& first,
         const Scale& scale, const Unknowns& unknowns, double most)
      : renderer_(renderer), path_(path), samples_(samples), first_(first), scale_(scale), unknowns_(unknowns), most_(most) {}

  int inputs() const { return unknowns_.count(); }
  int values() const { return static_cast<int>(3 * samples_.size()); }

  // As Eigen's Levenberg-Marquardt calls them: the residuals (N), and their derivatives, by differences where they are of the
  // renderer, which has none; zero where the residual is shortened. They return 0.
  int operator()(const InputType& numbers, ValueType& residuals) const;
  int df(const InputType& numbers, JacobianType& derivatives) const;

  Placement placement(const InputType& numbers) const;
  static double factor(const InputType& numbers);

 private:
  // The residuals before any is shortened. forces: those rendered at the placement of these numbers.
  ValueType whole(const InputType& numbers, const ValueType& forces) const;
  ValueType whole(const InputType& numbers) const;
  Eigen::Index shift_at() const { return unknowns_.turns ? 4 : 1; }

  const Renderer& renderer_;
  const RecordedPath& path_;
  const std::vector<Measured>& samples_;
  Placement first_;
  Scale scale_;
  Unknowns unknowns_;
  double most_;
};

// The forces of the renderer at the positions of a path, in the axes of the recording.
Eigen::VectorXd rendered_forces(const Renderer& renderer, const RecordedPath& path, const std::vector<Measured>& samples,
                                const Placement& placement);

// The number of samples that have no force, and get none by a shift of this distance (mm) along an axis.
std::size_t clearly_free(const Renderer& renderer, const RecordedPath& path, const std::vector<Measured>& samples,
                         const Placement& placement, double distance);

}  // namespace forceshade::conformance
