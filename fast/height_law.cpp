// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/fast/height_law.h"

#include "forceshade/fast/arithmetic.h"
#include "forceshade/fast/height_cap.h"
#include "forceshade/fast/height_cone.h"
#include "forceshade/fast/height_domain.h"
#include "forceshade/fast/height_force.h"
#include "forceshade/fast/height_gaussian.h"
#include "forceshade/fast/height_grating.h"
#include "forceshade/fast/height_plane.h"
#include "forceshade/fast/height_spline.h"

namespace forceshade::fast {

using height::Rendering;

template <class N>
FORCESHADE_INLINE Jet<N> HeightLaw::jet_at(const Place& at) const noexcept {
  const auto jet_of = [&](const Part& part) {
    const Jet<N> one = std::visit([&](const auto& shape) { return jet<N>(shape, at); }, part.shape);
    return part.negated ? -one : one;
  };
  Jet<N> map = jet_of(parts_.front());
  for (std::size_t i = 1; i < parts_.size(); ++i) map = map + jet_of(parts_[i]);
  return map;
}

Evaluation evaluation_of(const HeightForce& force) noexcept {
  return {{force.x, force.y, force.z}, force.contact == Sign::positive ? Status::contact : Status::free, Stage::binary64};
}

[[gnu::noinline]] Evaluation HeightLaw::evaluate_in_stages(const Place& at, double z) const noexcept {
  const HeightForce first = height_force(jet_at<Tracked>(at), rendering_, stiffness_, z);
  if (first.contact != Sign::unknown) return evaluation_of(first);
  if (const auto second = height_force(jet_at<DoubleDouble>(at), rendering_, stiffness_, z, Stage::double_double))
    return *second;
  return height_force(jet_at<Wide<32>>(at), rendering_, stiffness_, z, Stage::wide).value_or(Evaluation{});
}

Evaluation HeightLaw::evaluate(const Eigen::Vector3f& position) const noexcept {
  if (!in_domain(position.x()) || !in_domain(position.y()) || !in_domain(position.z()))
    return {{0, 0, 0}, Status::invalid, Stage::binary64};
  const Place at(quantised(position.x()), quantised(position.y()));
  const auto z = static_cast<double>(quantised(position.z()));
  if (const auto* spline = only_spline()) {
    const SplineValues jet(*spline, at);
    const HeightForce first = height_force(jet.U, jet.Ux, jet.Uy, sure_, rendering_, stiffness_, z);
    if (first.contact != Sign::unknown) [[likely]]
      return evaluation_of(first);
  }
  return evaluate_in_stages(at, z);
}

// A part as it is evaluated: a centre quantised, a grid measured.
template <class T>
HeightLaw::Shape HeightLaw::real_time(T shape) noexcept {
  if constexpr (requires { shape.x; }) shape.x = quantised(shape.x);
  if constexpr (requires { shape.y; }) shape.y = quantised(shape.y);
  if constexpr (std::is_constructible_v<HeightGrid, T>)
    return HeightGrid(shape);
  else
    return shape;
}

HeightLaw::HeightLaw(std::vector<Part> parts, Rendering rendering, float stiffness) noexcept
    : parts_(std::move(parts)), rendering_(rendering), stiffness_(static_cast<double>(stiffness)) {
  const auto* grid = std::get_if<HeightGrid>(&parts_.front().shape);
  is_only_spline_ = parts_.size() == 1 && !parts_.front().negated && grid != nullptr &&
                    grid->interpolant() == height::Interpolant::cubic_spline;
  if (!is_only_spline_) return;
  const SplineErrors error(*grid, grid->largest_value(), grid->largest_step_along(), grid->largest_step_across());
  sure_ = {0x1p36 * error.U, 0x1p36 * error.Ux, 0x1p36 * error.Uy};
}

std::variant<HeightLaw, ParameterError> HeightLaw::build(const HeightMap& map, Rendering rendering, float stiffness) {
  if (const char* fault = arithmetic_fault_here()) return ParameterError{fault, "", 1, 0, 0};
  if (const auto error = first_error(map, stiffness)) return *error;
  std::vector<Part> parts;
  for (const height::Part& part : map.parts)
    parts.push_back({std::visit([](const auto& shape) { return real_time(shape); }, part.shape), part.negated});
  return HeightLaw(std::move(parts), rendering, stiffness);
}

}  // namespace forceshade::fast
