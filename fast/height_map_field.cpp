// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "fast/evaluate.h"
#include "fast/heights/all.h"
#include "fast/heights/domain.h"
#include "fast/heights/exact.h"
#include "fast/heights/shape.h"
#include "fast/heights/spline_force.h"
#include "fast/numbers/arithmetic.h"
#include "fast/simd/built.h"
#include "forceshade/fast.h"

namespace forceshade::fast {

using height::Mode;

namespace {

// As height_force, in Ball arithmetic. exact(): an ExactPlace, which is there for what the numbers leave open.
template <class N, class Exact>
std::optional<Evaluation> height_force(const Jet<N>& map, height::Mode mode, double stiffness, double z, Stage stage,
                                       const Exact& exact) noexcept {
  if (!map.decided) return std::nullopt;
  const N gap = map.U - N::exactly(z);
  Sign contact = proved_sign(gap);
  if (contact == Sign::unknown) contact = exact([](const ExactPlace& place) { return place.sign_of_gap(); });
  if (contact == Sign::unknown) return std::nullopt;
  if (contact != Sign::positive) return Evaluation{{0, 0, 0}, Status::free, stage};
  N magnitude = N::exactly(stiffness) * gap;
  if (mode != height::Mode::conservative)
    magnitude = magnitude / square_root(N::exactly(1) + (map.Ux * map.Ux + map.Uy * map.Uy));
  const auto rounded = [&](std::size_t axis, const N& value) {
    return round_to_binary32(approximately(value), [&](double tie) {
      const Sign sign = proved_sign(value - N::exactly(tie));
      return sign != Sign::unknown ? sign : exact([&](const ExactPlace& place) { return place.sign_of_excess(axis, tie); });
    });
  };
  const auto x = rounded(0, -(magnitude * map.Ux)), y = rounded(1, -(magnitude * map.Uy)), fz = rounded(2, magnitude);
  if (!x || !y || !fz) return std::nullopt;
  return Evaluation{{*x, *y, *fz}, Status::contact, stage};
}

constexpr double kLeastSlope = static_cast<double>(kPositionQuantum);

// A correctly rounded slope as the definition has it: 0 where it is tiny.
float without_tiny(float slope) noexcept {
  return std::fabs(static_cast<double>(slope)) < kLeastSlope ? 0.0F : slope + 0.0F;
}

template <class N, class Exact>
std::optional<std::array<float, 2>> rounded_slopes(const Jet<N>& map, const Exact& exact) noexcept {
  if (!map.decided) return std::nullopt;
  const auto rounded = [&](std::size_t axis, const N& slope) -> std::optional<float> {
    const N bound = N::exactly(kLeastSlope / 2);
    if (proved_sign(slope - bound) == Sign::negative && proved_sign(slope + bound) == Sign::positive) return 0.0F;
    const auto nearest = round_to_binary32(approximately(slope), [&](double tie) {
      const Sign sign = proved_sign(slope - N::exactly(tie));
      return sign != Sign::unknown ? sign
                                   : exact([&](const ExactPlace& place) { return place.sign_of_slope_excess(axis, tie); });
    });
    if (!nearest) return std::nullopt;
    return without_tiny(*nearest);
  };
  const auto x = rounded(0, map.Ux), y = rounded(1, map.Uy);
  if (!x || !y) return std::nullopt;
  return std::array{*x, *y};
}

// The first stage: both ends of the enclosure round to the answer.
std::optional<std::array<float, 2>> rounded_slopes(const Jet<DoubleWithError>& map) noexcept {
  if (!map.decided) return std::nullopt;
  const auto rounded = [](const DoubleWithError& slope) -> std::optional<float> {
    if (std::fabs(slope.value) + slope.error < kLeastSlope / 2) return 0.0F;
    const auto nearest = round_to_binary32(slope);
    if (!nearest) return std::nullopt;
    return without_tiny(*nearest);
  };
  const auto x = rounded(map.Ux), y = rounded(map.Uy);
  if (!x || !y) return std::nullopt;
  return std::array{*x, *y};
}

Evaluation evaluation_of(const HeightForce& force) noexcept {
  return {{force.x, force.y, force.z}, force.contact == Sign::positive ? Status::contact : Status::free, Stage::binary64};
}

Sign force_without_vectors(const SplineMap& map, const float* position, float* force) noexcept {
  return spline_force<Quad>(map, position, force);
}

constexpr SplineFunctions kScalarSplineFunctions{&force_without_vectors, [] { return arithmetic_fault_here(); }};

// One at a time. A row of a window fills a vector of AVX2: wider ones have nothing to add.
const SplineFunctions& functions([[maybe_unused]] InstructionSet set) noexcept {
#if FORCESHADE_HAS_VECTOR_SETS
  if (set != InstructionSet::scalar && is_available(InstructionSet::avx2)) return kAvx2SplineFunctions;
#endif
  return kScalarSplineFunctions;
}

// Null where there is nothing faster than one at a time.
const SplineBatchFunctions* batch_functions([[maybe_unused]] InstructionSet set) noexcept {
#if FORCESHADE_HAS_VECTOR_SETS
  if (!is_available(set)) set = best_instruction_set();
  if (set == InstructionSet::avx512) return &kAvx512SplineFunctions;
#endif
  return nullptr;
}

// The faults of every file that takes part in an answer: fast/numbers/arithmetic.h. Functions that several of them compile, the
// linker keeps once.
const char* height_arithmetic_fault() noexcept {
  const InstructionSet best = best_instruction_set();
  for (const char* fault :
       {arithmetic_fault(), ExactPlace::arithmetic_fault(), RootField::arithmetic_fault(), HeightGrid::arithmetic_fault()})
    if (fault != nullptr) return fault;
  if (const char* fault = functions(InstructionSet::scalar).arithmetic_fault_here()) return fault;
  if (const char* fault = functions(best).arithmetic_fault_here()) return fault;
  const SplineBatchFunctions* batch = batch_functions(best);
  return batch != nullptr ? batch->arithmetic_fault_here() : nullptr;
}

struct Part {
  EvaluatedShape shape;
  bool negated;
};

// A part as it is evaluated: a centre quantised, a grid measured.
template <class T>
EvaluatedShape real_time(T shape) {
  if constexpr (requires { shape.x; }) shape.x = quantised(shape.x);
  if constexpr (requires { shape.y; }) shape.y = quantised(shape.y);
  if constexpr (requires { shape.knots; })
    for (height::Knot& knot : shape.knots) knot.x = quantised(knot.x);
  if constexpr (std::is_constructible_v<HeightGrid, T>)
    return HeightGrid(shape);
  else
    return shape;
}

std::vector<Part> real_time(const std::vector<height::Part>& parts) {
  std::vector<Part> all;
  all.reserve(parts.size());
  for (const height::Part& part : parts)
    all.push_back({std::visit([](const auto& shape) { return real_time(shape); }, part.shape), part.negated});
  return all;
}

}  // namespace

// The map as it is evaluated.
class HeightMapField::Inside {
 public:
  Inside(std::vector<Part> parts, std::vector<Part> surface, Mode mode, float stiffness);

  Evaluation evaluate_in_stages(const Eigen::Vector3f& position) const noexcept;
  std::optional<Slopes> slopes(float x, float y, bool is_filtered) const noexcept;
  const SplineMap* spline() const noexcept { return spline_.get(); }

 private:
  template <class N>
  static Jet<N> sum_at(const Place& at, const std::vector<Part>& parts) noexcept;
  template <class N>
  Jet<N> jet_at(const Place& at) const noexcept;
  Evaluation evaluate_wide(const Place& at, double z) const noexcept;
  std::optional<Slopes> slopes_wide(const Place& at) const noexcept;
  void describe(ExactPlace& place) const noexcept;

  std::vector<Part> parts_, surface_;
  Mode mode_;
  double stiffness_;                         // N/mm
  std::shared_ptr<const SplineMap> spline_;  // HeightMapField::spline_
};

template <class N>
FORCESHADE_INLINE Jet<N> HeightMapField::Inside::sum_at(const Place& at, const std::vector<Part>& parts) noexcept {
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
FORCESHADE_INLINE Jet<N> HeightMapField::Inside::jet_at(const Place& at) const noexcept {
  Jet<N> map = sum_at<N>(at, parts_);
  if (mode_ != Mode::force_shaded) return map;
  const Jet<N> surface = surface_.empty() ? flat<N>() : sum_at<N>(at, surface_);
  return {surface.U, map.Ux, map.Uy, map.decided && surface.decided};
}

HeightMapField::Inside::Inside(std::vector<Part> parts, std::vector<Part> surface, Mode mode, float stiffness)
    : parts_(std::move(parts)), surface_(std::move(surface)), mode_(mode), stiffness_(static_cast<double>(stiffness)) {
  const auto* grid = std::get_if<HeightGrid>(&parts_.front().shape);
  if (parts_.size() == 1 && surface_.empty() && !parts_.front().negated && grid != nullptr &&
      grid->interpolant() == height::Interpolant::cubic_spline)
    spline_ = std::make_shared<const SplineMap>(*grid, mode, stiffness_);
}

[[gnu::noinline]] Evaluation HeightMapField::Inside::evaluate_in_stages(const Eigen::Vector3f& position) const noexcept {
  if (!in_domain(position.x()) || !in_domain(position.y()) || !in_domain(position.z()))
    return {{0, 0, 0}, Status::invalid, Stage::binary64};
  const Place at(quantised(position.x()), quantised(position.y()));
  const auto z = static_cast<double>(quantised(position.z()));
  const HeightForce first = height_force(jet_at<DoubleWithError>(at), mode_, stiffness_, z);
  if (first.contact != Sign::unknown) return evaluation_of(first);
  const auto nobody = [](const auto&) { return Sign::unknown; };
  if (const auto second = height_force(jet_at<DoubleDouble>(at), mode_, stiffness_, z, Stage::double_double, nobody))
    return *second;
  return evaluate_wide(at, z);
}

// Kept out of line: with what it calls it takes up to 3 MiB of stack, for one position in many millions.
[[gnu::noinline]] Evaluation HeightMapField::Inside::evaluate_wide(const Place& at, double z) const noexcept {
  std::optional<ExactPlace> place;
  const auto exact = [&](const auto& question) {
    if (!place) describe(place.emplace(at, z, mode_, stiffness_));
    return question(*place);
  };
  if (const auto third = height_force(jet_at<BigFloatBall<32>>(at), mode_, stiffness_, z, Stage::wide, exact)) return *third;
  // Waves that all but cancel: more bits once more.
  return height_force(jet_at<BigFloatBall<128>>(at), mode_, stiffness_, z, Stage::wide, exact).value_or(undecided_evaluation());
}

std::optional<HeightMapField::Slopes> HeightMapField::Inside::slopes(float x, float y, bool is_filtered) const noexcept {
  const Place at(quantised(x), quantised(y));
  if (is_filtered) {
    if (const auto first = rounded_slopes(sum_at<DoubleWithError>(at, parts_))) return Slopes{*first, Stage::binary64};
    const auto nobody = [](const auto&) { return Sign::unknown; };
    if (const auto second = rounded_slopes(sum_at<DoubleDouble>(at, parts_), nobody))
      return Slopes{*second, Stage::double_double};
  }
  return slopes_wide(at);
}

// Kept out of line as evaluate_wide() is.
[[gnu::noinline]] std::optional<HeightMapField::Slopes> HeightMapField::Inside::slopes_wide(const Place& at) const noexcept {
  std::optional<ExactPlace> place;
  const auto exact = [&](const auto& question) {
    if (!place) describe(place.emplace(at, 0, mode_, stiffness_));
    return question(*place);
  };
  auto slopes = rounded_slopes(sum_at<BigFloatBall<32>>(at, parts_), exact);
  if (!slopes) slopes = rounded_slopes(sum_at<BigFloatBall<128>>(at, parts_), exact);
  if (!slopes) return std::nullopt;
  return Slopes{*slopes, Stage::wide};
}

void HeightMapField::Inside::describe(ExactPlace& place) const noexcept {
  const auto add = [&](const std::vector<Part>& parts, bool gap, bool slopes) {
    for (const Part& part : parts) place.add(part.shape, {gap, slopes, part.negated ? -1.0 : 1.0});
  };
  const bool is_shaded = mode_ == Mode::force_shaded;
  add(parts_, !is_shaded, true);
  add(surface_, true, false);
}

HeightMapField::HeightMapField(std::shared_ptr<const Inside> inside) noexcept
    : inside_(std::move(inside)), spline_(inside_->spline()), first_stage_(functions(best_instruction_set()).force) {
  static_assert(kPositive == Sign::positive && kUnknown == Sign::unknown);
}

Evaluation HeightMapField::evaluate_in_stages(const Eigen::Vector3f& position) const noexcept {
  return inside_->evaluate_in_stages(position);
}

std::optional<HeightMapField::Slopes> HeightMapField::slopes(float x, float y, bool is_filtered) const noexcept {
  return inside_->slopes(x, y, is_filtered);
}

BatchResult HeightMapField::force(std::span<const Eigen::Vector3f> positions, std::span<Eigen::Vector3f> to,
                                  InstructionSet instructions) const noexcept {
  const SplineForce first_stage = functions(instructions).force;
  const std::size_t count = std::min(positions.size(), to.size());
  BatchResult result;
  const auto answer_one = [&](std::size_t i) {
    if (spline_ != nullptr && first_stage(*spline_, positions[i].data(), to[i].data()) != Sign::unknown) [[likely]]
      return;
    const Evaluation one = evaluate_in_stages(positions[i]);
    to[i] = one.force;
    result.invalid += one.status == Status::invalid;
  };
  std::size_t next = 0;
  if (const SplineBatchFunctions* batch = batch_functions(instructions); batch != nullptr && spline_ != nullptr)
    for (; next + kSplineBatch <= count; next += kSplineBatch) {
      float forces[3 * kSplineBatch];
      const unsigned known = batch->forces(*spline_, positions[next].data(), forces);
      for (std::size_t i = 0; i < kSplineBatch; ++i)
        if ((known >> i & 1) != 0)
          to[next + i] = Eigen::Vector3f::Map(forces + 3 * i);
        else
          answer_one(next + i);
    }
  for (; next < count; ++next) answer_one(next);
  return result;
}

std::variant<HeightMapField, ParameterError> HeightMapField::build(const HeightMap& map, Mode mode, float stiffness) {
  if (const char* fault = height_arithmetic_fault()) return ParameterError{"arithmetic", "", 0, 0, 0, fault};
  if (const auto error = first_error(map, mode, stiffness)) return *error;
  constexpr std::size_t kRoom = Fraction::kMostBits;
  if (const std::size_t bits = bits_of_exact_numbers(map); bits > kRoom)
    return ParameterError{"size of the sum's exact numbers (fewer parts, or pitches of fewer digits, make it smaller)", "bits",
                          static_cast<float>(bits), 0, static_cast<float>(kRoom)};
  return HeightMapField(std::make_shared<const Inside>(real_time(map.parts), real_time(map.surface), mode, stiffness));
}

}  // namespace forceshade::fast
