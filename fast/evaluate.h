// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Answers one position: binary64 first, double-double where that is in doubt, wide numbers where even those are.

#include <Eigen/Core>

#include "fast/domain.h"
#include "fast/laws/outcome.h"
#include "fast/numbers/big_float_ball.h"
#include "fast/numbers/first_stage.h"
#include "forceshade/session.h"

namespace forceshade::fast {

// BigFloatBall numbers always decide (fast/numbers/big_float_ball.h). Should they not: no force, and a status on which a loop
// stops.
inline Evaluation undecided_evaluation() noexcept {
  return {{0, 0, 0}, Status::invalid, Stage::wide};
}

// A law's definition with what building it yields: the geometry in double-double, kept for the second stage.
template <class Definition>
struct Built {
  typename Definition::template Geometry<DoubleDouble> geometry;
  Definition definition;

  explicit Built(const Parameters& p) noexcept
      : geometry(Definition::template geometry<DoubleDouble>(p)), definition(p, geometry) {}

  // As a definition's exact() takes it.
  auto kept_geometry() const noexcept {
    return [this]() -> const auto& {
      return geometry;
    };
  }
};

// The geometry in wide numbers, as a definition's exact() takes it.
template <class Definition>
auto wide_geometry(const Parameters& p) noexcept {
  return [&p] { return Definition::template geometry<BigFloatBall<Definition::kWideLimbs>>(p); };
}

// The answer of a ball stage, where it can decide.
template <class N, class Definition, class GeometryOf>
std::optional<Evaluation> decide(const Definition& law, const Parameters& p, const GeometryOf& geometry, float x, float z,
                                 Stage stage) noexcept {
  const Outcome<N> outcome = law.template exact<N>(p, geometry, x, z);
  if (outcome.contact == Sign::unknown) return std::nullopt;
  if (outcome.contact != Sign::positive) return Evaluation{{0, 0, 0}, Status::free, stage};
  const std::optional<float> fx = round_to_binary32(outcome.x);
  const std::optional<float> fz = round_to_binary32(outcome.z);
  if (!fx || !fz) return std::nullopt;
  return Evaluation{{*fx, 0, *fz}, Status::contact, stage};
}

// Kept out of line: it is reached for about one position in ten million, and its stack frame is large.
template <class Definition>
[[gnu::noinline]] Evaluation evaluate_wide(const Definition& law, const Parameters& p, float x, float z) noexcept {
  using N = BigFloatBall<Definition::kWideLimbs>;
  return decide<N>(law, p, wide_geometry<Definition>(p), x, z, Stage::wide).value_or(undecided_evaluation());
}

// p: those the law was built from.
template <class Definition>
Evaluation evaluate(const Built<Definition>& law, const Parameters& p, const Eigen::Vector3f& position) noexcept {
  if (!in_domain(position.x()) || !in_domain(position.y()) || !in_domain(position.z()))
    return {{0, 0, 0}, Status::invalid, Stage::binary64};
  const float x = quantised(position.x());
  const float z = quantised(position.z());
  const FirstStage<double> first = law.definition.first_stage(static_cast<double>(x), static_cast<double>(z));
  if (!first.doubt) {
    if (!first.contact) return {};
    constexpr int kWindow = doubt_window(Definition::kErrorBound);
    if (!rounding_is_in_doubt<kWindow>(first.x) && !rounding_is_in_doubt<kWindow>(first.z))
      return {{static_cast<float>(first.x) + 0.0F, 0, static_cast<float>(first.z) + 0.0F}, Status::contact, Stage::binary64};
  }
  const auto second = decide<DoubleDouble>(law.definition, p, law.kept_geometry(), x, z, Stage::double_double);
  return second ? *second : evaluate_wide(law.definition, p, x, z);
}

}  // namespace forceshade::fast
