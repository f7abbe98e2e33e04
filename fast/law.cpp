// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/fast/law.h"

#include <algorithm>

namespace forceshade::fast {
namespace {

constexpr float kSmallestRadius = 0.1F, kLargestRadius = 1e4F;         // mm
constexpr float kSmallestWidth = 1e-3F;                                // mm
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

const char* arithmetic_fault() noexcept {
  const char* fault = arithmetic_fault_here();
  for (const InstructionSet set : kInstructionSets)
    if (const BlockTable* table = blocks(set); fault == nullptr && table != nullptr) fault = table->arithmetic_fault_here();
  return fault;
}

std::variant<Law, ParameterError> Law::build(LawId id, const Parameters& p) noexcept {
  if (const char* fault = arithmetic_fault()) return ParameterError{fault, "", 1, 0, 0};
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

Evaluation Law::evaluate(const Eigen::Vector3f& position) const noexcept {
  return std::visit([&](const auto& law) { return fast::evaluate(law, parameters_, position); }, law_);
}

BatchResult Law::force(std::span<const float> x, std::span<const float> z, std::span<float> fx, std::span<float> fz,
                       InstructionSet instructions) const noexcept {
  return std::visit(
      [&]<class Definition>(const Built<Definition>& law) {
        const BlockFunction<Definition> answer_block = block_function<Definition>(blocks(instructions));
        const std::size_t count = std::min(std::min(x.size(), z.size()), std::min(fx.size(), fz.size()));
        const auto overwrites = [&](std::span<float> out) { return out.data() == x.data() || out.data() == z.data(); };
        const bool is_in_place = overwrites(fx) || overwrites(fz);
        float kept_x[kBlock], kept_z[kBlock];  // in place: a block writes its answers before it knows whether they hold
        BatchResult result;
        for (std::size_t begin = 0; begin < count; begin += kBlock) {
          const std::size_t size = std::min(kBlock, count - begin);
          const float *at_x = &x[begin], *at_z = &z[begin];
          if (is_in_place) {
            std::copy_n(at_x, size, kept_x);
            std::copy_n(at_z, size, kept_z);
            at_x = kept_x;
            at_z = kept_z;
          }
          if (answer_block != nullptr && size == kBlock && answer_block(law.definition, at_x, at_z, &fx[begin], &fz[begin]))
            continue;
          for (std::size_t i = 0; i < size; ++i) {
            const Evaluation one = fast::evaluate(law, parameters_, Eigen::Vector3f(at_x[i], 0, at_z[i]));
            fx[begin + i] = one.force.x();
            fz[begin + i] = one.force.z();
            result.invalid += one.status == Status::invalid;
          }
        }
        return result;
      },
      law_);
}

}  // namespace forceshade::fast
