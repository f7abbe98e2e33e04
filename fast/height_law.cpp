// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/fast/height_law.h"

#include <algorithm>

#include "forceshade/fast/arithmetic.h"
#include "forceshade/fast/height_batch.h"
#include "forceshade/fast/height_cap.h"
#include "forceshade/fast/height_cone.h"
#include "forceshade/fast/height_domain.h"
#include "forceshade/fast/height_force.h"
#include "forceshade/fast/height_gaussian.h"
#include "forceshade/fast/height_grating.h"
#include "forceshade/fast/height_plane.h"
#include "forceshade/fast/height_polygons.h"
#include "forceshade/fast/height_spline.h"

namespace forceshade::fast {

using height::Rendering;

namespace {

// As height_force, in Ball arithmetic.
template <class N>
std::optional<Evaluation> height_force(const Jet<N>& map, height::Rendering rendering, double stiffness, double z,
                                       Stage stage) noexcept {
  if (!map.decided) return std::nullopt;
  const N gap = map.U - N::exactly(z);
  const Sign contact = sign(gap);
  if (contact == Sign::unknown) return std::nullopt;
  if (contact != Sign::positive) return Evaluation{{0, 0, 0}, Status::free, stage};
  N magnitude = N::exactly(stiffness) * gap;
  if (rendering != height::Rendering::conservative)
    magnitude = magnitude / square_root(N::exactly(1) + (map.Ux * map.Ux + map.Uy * map.Uy));
  const auto x = round_to_binary32(-(magnitude * map.Ux)), y = round_to_binary32(-(magnitude * map.Uy)),
             fz = round_to_binary32(magnitude);
  if (!x || !y || !fz) return std::nullopt;
  return Evaluation{{*x, *y, *fz}, Status::contact, stage};
}

Evaluation evaluation_of(const HeightForce& force) noexcept {
  return {{force.x, force.y, force.z}, force.contact == Sign::positive ? Status::contact : Status::free, Stage::binary64};
}

// Null for the scalar set: the batch call then makes scalar calls.
const HeightBlocks* blocks(InstructionSet set) noexcept {
  if (!is_available(set)) set = best_instruction_set();
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return &kAvx512HeightBlocks;
  if (set == InstructionSet::avx2) return &kAvx2HeightBlocks;
#endif
  return nullptr;
}

// Each file asks for itself: fast/arithmetic.h.
const char* height_arithmetic_fault() noexcept {
  const char* fault = arithmetic_fault_here();
  for (const InstructionSet set : kInstructionSets)
    if (const HeightBlocks* table = blocks(set); fault == nullptr && table != nullptr) fault = table->arithmetic_fault_here();
  return fault;
}

}  // namespace

template <class N>
FORCESHADE_INLINE Jet<N> HeightLaw::sum_at(const Place& at, const std::vector<Part>& parts) noexcept {
  const auto jet_of = [&](const Part& part) {
    const Jet<N> one = std::visit([&](const auto& shape) { return jet<N>(shape, at); }, part.shape);
    return part.negated ? -one : one;
  };
  Jet<N> map = jet_of(parts.front());
  for (std::size_t i = 1; i < parts.size(); ++i) map = map + jet_of(parts[i]);
  return map;
}

// The map's gradient, with the height that the depth is measured from.
template <class N>
FORCESHADE_INLINE Jet<N> HeightLaw::jet_at(const Place& at) const noexcept {
  Jet<N> map = sum_at<N>(at, parts_);
  if (rendering_ != Rendering::force_shaded) return map;
  const Jet<N> surface = surface_.empty() ? flat<N>() : sum_at<N>(at, surface_);
  return {surface.U, map.Ux, map.Uy, map.decided && surface.decided};
}

[[gnu::noinline]] Evaluation HeightLaw::evaluate_in_stages(const Place& at, double z) const noexcept {
  const HeightForce first = height_force(jet_at<Tracked>(at), rendering_, stiffness_, z);
  if (first.contact != Sign::unknown) return evaluation_of(first);
  if (const auto second = height_force(jet_at<DoubleDouble>(at), rendering_, stiffness_, z, Stage::double_double))
    return *second;
  return height_force(jet_at<Wide<32>>(at), rendering_, stiffness_, z, Stage::wide).value_or(undecided_evaluation());
}

FORCESHADE_INLINE Evaluation HeightLaw::evaluate_with(const HeightBlocks* vectors,
                                                      const Eigen::Vector3f& position) const noexcept {
  const HeightGrid* spline = only_spline();
  if (vectors != nullptr && spline != nullptr) {
    const HeightForce first =
        vectors->answer_one(*spline, sure_, rendering_, stiffness_, position.x(), position.y(), position.z());
    if (first.contact != Sign::unknown) [[likely]]
      return evaluation_of(first);
  }
  if (!in_domain(position.x()) || !in_domain(position.y()) || !in_domain(position.z()))
    return {{0, 0, 0}, Status::invalid, Stage::binary64};
  const Place at(quantised(position.x()), quantised(position.y()));
  const auto z = static_cast<double>(quantised(position.z()));
  if (spline != nullptr) {
    const SplineValues jet(*spline, at);
    if (vectors == nullptr) {
      const HeightForce first = height_force(jet.U, jet.Ux, jet.Uy, sure_, rendering_, stiffness_, z);
      if (first.contact != Sign::unknown) [[likely]]
        return evaluation_of(first);
    }
    // Nearly all that is left is settled by the map's own errors where sure_ asks for too much.
    const Tracked U = rendering_ == Rendering::force_shaded ? Tracked::exactly(0) : Tracked{jet.U, 0x1p-36 * sure_.gap};
    const HeightForce bounded =
        height_force({U, {jet.Ux, 0x1p-36 * sure_.Ux}, {jet.Uy, 0x1p-36 * sure_.Uy}}, rendering_, stiffness_, z);
    if (bounded.contact != Sign::unknown) return evaluation_of(bounded);
  }
  return evaluate_in_stages(at, z);
}

Evaluation HeightLaw::evaluate(const Eigen::Vector3f& position) const noexcept {
  return evaluate_with(vectors_, position);
}

BatchResult HeightLaw::force(std::span<const Eigen::Vector3f> positions, std::span<Eigen::Vector3f> to,
                             InstructionSet instructions) const noexcept {
  const std::size_t count = std::min(positions.size(), to.size());
  const HeightGrid* spline = only_spline();
  const HeightBlocks* vectors = blocks(instructions);
  BatchResult result;
  for (std::size_t begin = 0; begin < count; begin += kHeightBlock) {
    const std::size_t size = std::min(kHeightBlock, count - begin);
    HeightAnswers answers;
    const bool in_block = vectors != nullptr && spline != nullptr && size == kHeightBlock;
    if (in_block) {
      HeightBlock block;
      for (std::size_t i = 0; i < size; ++i) {
        block.x[i] = positions[begin + i].x();
        block.y[i] = positions[begin + i].y();
        block.z[i] = positions[begin + i].z();
      }
      vectors->answer(*spline, sure_, rendering_, stiffness_, block, answers);
    }
    for (std::size_t i = 0; i < size; ++i) {
      if (in_block && answers.is_sure[i]) {
        to[begin + i] = {answers.x[i], answers.y[i], answers.z[i]};
        continue;
      }
      const Evaluation one = evaluate_with(vectors, positions[begin + i]);
      to[begin + i] = one.force;
      result.invalid += one.status == Status::invalid;
    }
  }
  return result;
}

// A part as it is evaluated: a centre quantised, a grid measured.
template <class T>
HeightLaw::Shape HeightLaw::real_time(T shape) {
  if constexpr (requires { shape.x; }) shape.x = quantised(shape.x);
  if constexpr (requires { shape.y; }) shape.y = quantised(shape.y);
  if constexpr (requires { shape.knots; })
    for (height::Knot& knot : shape.knots) knot.x = quantised(knot.x);
  if constexpr (std::is_constructible_v<HeightGrid, T>)
    return HeightGrid(shape);
  else
    return shape;
}

std::vector<HeightLaw::Part> HeightLaw::real_time(const std::vector<height::Part>& parts) {
  std::vector<Part> all;
  for (const height::Part& part : parts)
    all.push_back({std::visit([](const auto& shape) { return real_time(shape); }, part.shape), part.negated});
  return all;
}

HeightLaw::HeightLaw(std::vector<Part> parts, std::vector<Part> surface, Rendering rendering, float stiffness) noexcept
    : parts_(std::move(parts)),
      surface_(std::move(surface)),
      rendering_(rendering),
      stiffness_(static_cast<double>(stiffness)),
      vectors_(blocks(best_instruction_set())) {
  const auto* grid = std::get_if<HeightGrid>(&parts_.front().shape);
  is_only_spline_ = parts_.size() == 1 && surface_.empty() && !parts_.front().negated && grid != nullptr &&
                    grid->interpolant() == height::Interpolant::cubic_spline;
  if (!is_only_spline_) return;
  const SplineErrors error(*grid, grid->largest_value(), grid->largest_step_along(), grid->largest_step_across());
  sure_ = {0x1p36 * error.U, 0x1p36 * error.Ux, 0x1p36 * error.Uy};
}

std::variant<HeightLaw, ParameterError> HeightLaw::build(const HeightMap& map, Rendering rendering, float stiffness) {
  if (const char* fault = height_arithmetic_fault()) return ParameterError{fault, "", 1, 0, 0};
  if (const auto error = first_error(map, rendering, stiffness)) return *error;
  return HeightLaw(real_time(map.parts), real_time(map.surface), rendering, stiffness);
}

}  // namespace forceshade::fast
