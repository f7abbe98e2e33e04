// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <new>
#include <type_traits>
#include <variant>

#include "fast/evaluate.h"
#include "fast/laws/all.h"
#include "fast/simd/batch.h"
#include "fast/simd/built.h"
#include "forceshade/fast.h"

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
  return static_cast<const BlockOf<Definition>*>(blocks)->answer;
}

// Null for the scalar set: the batch call then makes scalar calls.
const BlockTable* blocks(InstructionSet set) noexcept {
  if (!is_available(set)) set = best_instruction_set();
#if FORCESHADE_HAS_VECTOR_SETS
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

// The definition of the one law that it is.
struct Law::Inside {
  template <class... Definition>
  static std::variant<Built<Definition>...> any_of(LawList<Definition...>);
  decltype(any_of(Laws())) law;

  // Law::evaluate of a law that One is the definition of.
  template <class One>
  static Evaluation evaluate(const Law& law, const Eigen::Vector3f& position) noexcept {
    return fast::evaluate(*std::get_if<One>(&law.inside().law), law.parameters_, position);
  }

  // Nothing where there is no such law.
  template <class... Definition>
  static std::optional<Inside> built(LawId id, const Parameters& parameters, LawList<Definition...>) noexcept {
    std::optional<Inside> inside;
    std::size_t index = 0;
    const auto try_one = [&]<class One>(std::type_identity<One>) {
      if (static_cast<std::size_t>(id) == index++) inside = Inside{Built<One>(parameters)};
    };
    (try_one(std::type_identity<Definition>()), ...);
    return inside;
  }
};

// A definition is trivially copyable: a copy of its bytes is a copy of it.
Law::Law(LawId id, const Parameters& parameters, const Inside& inside) noexcept
    : id_(id),
      parameters_(parameters),
      evaluate_(std::visit([]<class One>(const One&) { return &Inside::evaluate<One>; }, inside.law)) {
  static_assert(sizeof(Inside) <= sizeof inside_ && alignof(Inside) <= 8 && std::is_trivially_copyable_v<Inside>,
                "the buffer in include/forceshade/fast.h has room for the largest law's definition");
  ::new (inside_.data()) Inside(inside);
}

const Law::Inside& Law::inside() const noexcept {
  return *std::launder(reinterpret_cast<const Inside*>(inside_.data()));
}

std::variant<Law, ParameterError> Law::build(LawId id, const Parameters& p) noexcept {
  if (const char* fault = arithmetic_fault()) return ParameterError{"arithmetic", "", 0, 0, 0, fault};
  if (const auto error = first_error(id, p)) return *error;
  if (const auto inside = Inside::built(id, p, Laws())) return Law(id, p, *inside);
  return ParameterError{"law", "", static_cast<float>(static_cast<int>(id)), 0, static_cast<float>(kLaws.size() - 1)};
}

namespace {

// Answers `count` positions, a block at a time where together(begin, size) does that, whose size is a multiple of kStep. Where
// it does not, because a position is invalid or in doubt, a step at a time; and of a step where it does not, each by single(i).
template <class Together, class Single>
void answer_all(std::size_t count, const Together& together, const Single& single) noexcept {
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    const std::size_t end = std::min(count, begin + kBlock), whole = end - (end - begin) % kStep;
    std::size_t done = whole > begin && together(begin, whole - begin) ? whole : begin;
    while (done < end) {
      const std::size_t step = std::min(end, done + kStep);
      if (done < whole && together(done, kStep)) done = step;
      for (; done < step; ++done) single(done);
    }
  }
}

}  // namespace

BatchResult Law::force(std::span<const float> x, std::span<const float> z, std::span<float> fx, std::span<float> fz,
                       InstructionSet instructions) const noexcept {
  return std::visit(
      [&]<class Definition>(const Built<Definition>& law) {
        const BlockFunction<Definition> answer_block = block_function<Definition>(blocks(instructions));
        const std::size_t count = std::min(std::min(x.size(), z.size()), std::min(fx.size(), fz.size()));
        const auto overwrites = [&](std::span<float> out) { return out.data() == x.data() || out.data() == z.data(); };
        const bool is_in_place = overwrites(fx) || overwrites(fz);
        float kept_fx[kBlock], kept_fz[kBlock];  // in place: a block writes its answers before it is decided whether they hold
        BatchResult result;
        const auto together = [&](std::size_t begin, std::size_t size) {
          float *const to_fx = is_in_place ? kept_fx : &fx[begin], *const to_fz = is_in_place ? kept_fz : &fz[begin];
          if (answer_block == nullptr || !answer_block(law.definition, size, &x[begin], &z[begin], to_fx, to_fz)) return false;
          if (is_in_place) {
            std::copy_n(kept_fx, size, &fx[begin]);
            std::copy_n(kept_fz, size, &fz[begin]);
          }
          return true;
        };
        answer_all(count, together, [&](std::size_t i) {
          const Evaluation one = fast::evaluate(law, parameters_, Eigen::Vector3f(x[i], 0, z[i]));
          fx[i] = one.force.x();
          fz[i] = one.force.z();
          result.invalid += one.status == Status::invalid;
        });
        return result;
      },
      inside().law);
}

BatchResult Law::force(std::span<const Eigen::Vector3f> positions, std::span<Eigen::Vector3f> forces,
                       InstructionSet instructions) const noexcept {
  static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float), "positions one after the other are rows of three floats");
  return std::visit(
      [&]<class Definition>(const Built<Definition>& law) {
        const BlockTable* const table = blocks(instructions);
        const BlockFunction<Definition> answer_block = block_function<Definition>(table);
        alignas(64) float x[kBlock], z[kBlock], fx[kBlock], fz[kBlock];
        BatchResult result;
        const auto together = [&](std::size_t begin, std::size_t size) {
          if (table == nullptr || !table->take_rows_apart(positions[begin].data(), size, x, z) ||
              !answer_block(law.definition, size, x, z, fx, fz))
            return false;
          table->put_rows_together(fx, fz, size, forces[begin].data());
          return true;
        };
        answer_all(std::min(positions.size(), forces.size()), together, [&](std::size_t i) {
          const Evaluation one = fast::evaluate(law, parameters_, positions[i]);
          forces[i] = one.force;
          result.invalid += one.status == Status::invalid;
        });
        return result;
      },
      inside().law);
}

}  // namespace forceshade::fast
