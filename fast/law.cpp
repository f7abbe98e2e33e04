// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/fast/law.h"

#include <algorithm>

#include "forceshade/fast/wide.h"

namespace forceshade::fast {
namespace {

constexpr float kSmallestRadius = 0.1F, kLargestRadius = 1e4F;      // mm
constexpr float kSmallestWidth = 1e-3F;                            // mm
constexpr float kSmallestStiffness = 1e-3F, kLargestStiffness = 1e3F;  // N/mm

std::optional<ParameterError> first_error(LawId id, const Parameters& p) noexcept {
  const auto outside = [](float value, float low, float high) { return !(value >= low && value <= high); };
  if (has_bump_geometry(id)) {
    if (outside(p.radius, kSmallestRadius, kLargestRadius))
      return ParameterError{"radius", "mm", p.radius, kSmallestRadius, kLargestRadius};
    if (outside(p.width, kSmallestWidth, 2 * p.radius))
      return ParameterError{"width", "mm", p.width, kSmallestWidth, 2 * p.radius};
  }
  if (outside(p.stiffness, kSmallestStiffness, kLargestStiffness))
    return ParameterError{"stiffness", "N/mm", p.stiffness, kSmallestStiffness, kLargestStiffness};
  return std::nullopt;
}

// The answer of a ball stage, where it can tell. Results that may be subnormal are left to the wide stage: there a
// binary32's neighbours are still binary64 numbers, but a double-double product may underflow.
template <class N, class Definition>
std::optional<Evaluation> decide(const Definition& law, const Parameters& p,
                                 const typename Definition::template Geometry<N>& geometry, float x, float z,
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
  using N = Wide<Definition::kWideLimbs>;
  return decide<N>(law, p, Definition::template geometry<N>(p), x, z, Stage::wide).value_or(Evaluation{});
}

template <class Definition>
BlockFunction<Definition> block_function(const BlockTable* blocks) noexcept {
  if (blocks == nullptr) return nullptr;
  const BlockTable& table = *blocks;
  if constexpr (std::is_same_v<Definition, Wall>) return table.wall;
  if constexpr (std::is_same_v<Definition, Cylinder>) return table.cylinder;
  if constexpr (std::is_same_v<Definition, BumpCylinder>) return table.bump_cylinder;
  if constexpr (std::is_same_v<Definition, Bump1p>) return table.bump_1p;
  if constexpr (std::is_same_v<Definition, Bump2p>) return table.bump_2p;
  if constexpr (std::is_same_v<Definition, Bump3p>) return table.bump_3p;
  if constexpr (std::is_same_v<Definition, Bump1pShaded>) return table.bump_1p_shaded;
  if constexpr (std::is_same_v<Definition, Bump2pShaded>) return table.bump_2p_shaded;
  if constexpr (std::is_same_v<Definition, Bump3pShaded>) return table.bump_3p_shaded;
}

// Null for the scalar set: the batch call then makes scalar calls.
const BlockTable* blocks(InstructionSet set) noexcept {
  if (!is_available(set)) set = best_instruction_set();
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return &kAvx512Blocks;
  if (set == InstructionSet::avx2) return &kAvx2Blocks;
#endif
  return nullptr;
}

}  // namespace

std::variant<Law, ParameterError> Law::build(LawId id, const Parameters& p) noexcept {
  if (const auto error = first_error(id, p)) return *error;
  switch (id) {
    case LawId::wall: return Law(id, p, Built<Wall>(p));
    case LawId::cylinder: return Law(id, p, Built<Cylinder>(p));
    case LawId::bump_cylinder: return Law(id, p, Built<BumpCylinder>(p));
    case LawId::bump_1p: return Law(id, p, Built<Bump1p>(p));
    case LawId::bump_2p: return Law(id, p, Built<Bump2p>(p));
    case LawId::bump_3p: return Law(id, p, Built<Bump3p>(p));
    case LawId::bump_1p_shaded: return Law(id, p, Built<Bump1pShaded>(p));
    case LawId::bump_2p_shaded: return Law(id, p, Built<Bump2pShaded>(p));
    case LawId::bump_3p_shaded: return Law(id, p, Built<Bump3pShaded>(p));
  }
  return ParameterError{"law", "", static_cast<float>(static_cast<int>(id)), 0, static_cast<float>(kLaws.size() - 1)};
}

template <class Definition>
Evaluation Law::evaluate_by(const Built<Definition>& law, const Eigen::Vector3f& position) const noexcept {
  if (!in_domain(position.x()) || !in_domain(position.y()) || !in_domain(position.z()))
    return {{0, 0, 0}, Status::invalid, Stage::binary64};
  const float x = quantised(position.x());
  const float z = quantised(position.z());
  const FirstStage<double> first = law.definition.first_stage(static_cast<double>(x), static_cast<double>(z));
  if (!first.doubt) {
    if (!first.contact) return {};
    if (!rounding_is_in_doubt<Definition::kErrorBound>(first.x) && !rounding_is_in_doubt<Definition::kErrorBound>(first.z))
      return {{static_cast<float>(first.x) + 0.0F, 0, static_cast<float>(first.z) + 0.0F}, Status::contact, Stage::binary64};
  }
  const auto second = decide<DoubleDouble>(law.definition, parameters_, law.geometry, x, z, Stage::double_double);
  return second ? *second : evaluate_wide(law.definition, parameters_, x, z);
}

Evaluation Law::evaluate(const Eigen::Vector3f& position) const noexcept {
  return std::visit([&](const auto& law) { return evaluate_by(law, position); }, law_);
}

BatchResult Law::force(std::span<const float> x, std::span<const float> z, std::span<float> fx, std::span<float> fz,
                       InstructionSet instructions) const noexcept {
  return std::visit(
      [&]<class Definition>(const Built<Definition>& law) {
        const BlockFunction<Definition> answer_block = block_function<Definition>(blocks(instructions));
        const std::size_t count = std::min(std::min(x.size(), z.size()), std::min(fx.size(), fz.size()));
        BatchResult result;
        for (std::size_t begin = 0; begin < count; begin += kBlock) {
          const std::size_t size = std::min(kBlock, count - begin);
          if (answer_block != nullptr && size == kBlock &&
              answer_block(law.definition, &x[begin], &z[begin], &fx[begin], &fz[begin])) continue;
          for (std::size_t i = begin; i < begin + size; ++i) {
            const Evaluation one = evaluate_by(law, Eigen::Vector3f(x[i], 0, z[i]));
            fx[i] = one.force.x();
            fz[i] = one.force.z();
            result.invalid += one.status == Status::invalid;
          }
        }
        return result;
      },
      law_);
}

}  // namespace forceshade::fast
