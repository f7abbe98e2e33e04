// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One hash per kind of height map and rendering, of forces and statuses: as tests/fast/same_bits.h for laws, and by its means.

#include "forceshade/fast.h"
#include "tests/fast/same_bits.h"
#include "tests/height_maps/height_scenes.h"

namespace forceshade::tests {

// Positions of one map, in runs of one kind; as Positions, and at the map's edges and surface.
class HeightPositions {
 public:
  HeightPositions(const HeightScene& scene, const fast::HeightMapField& law) : scene_(scene), law_(law) {}

  Eigen::Vector3f next(std::size_t run) {
    const float x = coordinate(run), y = coordinate(run);
    const std::uint64_t bits = random_();
    return {x, y, bits % 16 == 0 ? highest_contact(x, y, bits >> 32) : coordinate(run)};
  }

 private:
  float coordinate(std::size_t run) {
    const std::uint64_t bits = random_();
    const auto low = static_cast<std::uint32_t>(bits);
    const auto high = static_cast<std::uint32_t>(bits >> 32);
    const auto near = [&](std::uint32_t from) {
      return static_cast<float>(static_cast<std::int32_t>(from) >> 8) * scene_.step;
    };
    if (run % 3 == 0) return near(low);
    if (run % 3 == 1) return near(low & ~0U << high % 32);
    switch (high % 4) {
      case 0: return __builtin_bit_cast(float, low);
      case 1: return near(low);
      default: return __builtin_bit_cast(float, bits_in(scene_.edges[high / 4 % scene_.edges.size()]) + low % 4 - (low >> 31));
    }
  }

  // The largest z in contact there, or a near neighbour; by bisection over the bits of positive or of negative numbers.
  float highest_contact(float x, float y, std::uint64_t bits) const {
    const auto touches = [&](std::uint32_t z) {
      return law_.evaluate({x, y, __builtin_bit_cast(float, z)}).status == Status::contact;
    };
    const std::uint32_t sign = touches(0) ? 0 : 0x80000000U;
    std::uint32_t low = 0, high = bits_in(1e4F);
    while (high - low > 1) {
      const std::uint32_t middle = (low + high) / 2;
      (touches(middle | sign) == (sign == 0) ? low : high) = middle;
    }
    return __builtin_bit_cast(float, (low + static_cast<std::uint32_t>(bits % 3)) | sign);
  }

  const HeightScene& scene_;
  const fast::HeightMapField& law_;
  std::mt19937_64 random_{1995};
};

inline constexpr std::size_t kHeightRun = 52, kHeightRuns = 6;  // a run: whole batches and a rest

inline Bits bits_of(const HeightScene& scene, height::Mode mode) {
  const auto built = fast::HeightMapField::build(scene.map, mode, 0.7F);
  if (const auto* error = std::get_if<ParameterError>(&built)) throw std::runtime_error(error->message());
  const auto& law = std::get<fast::HeightMapField>(built);
  HeightPositions positions(scene, law);
  Hash hash;
  Bits bits{};
  for (std::size_t run = 0; run < kHeightRuns; ++run) {
    std::array<Eigen::Vector3f, kHeightRun> at, single, batch;
    for (std::size_t i = 0; i < kHeightRun; ++i) {
      at[i] = positions.next(run);
      const fast::Evaluation answer = law.evaluate(at[i]);
      single[i] = answer.force;
      note(answer, hash, bits);
    }
    for (const fast::InstructionSet set : fast::kInstructionSets) {
      if (!fast::is_available(set)) continue;
      law.force(at, batch, set);
      for (std::size_t i = 0; i < kHeightRun; ++i)
        for (int axis = 0; axis < 3; ++axis)
          bits.different[static_cast<std::size_t>(set)] += bits_in(batch[i][axis]) != bits_in(single[i][axis]);
    }
  }
  bits.hash = hash.hex();
  return bits;
}

// Its name in tests/golden/hashes.txt.
inline std::string name_of(const HeightScene& scene, height::Mode mode) {
  return std::string(height::name_of(mode)) + "/" + scene.name;
}

}  // namespace forceshade::tests
