// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One hash per law of a million forces and statuses, the same for every compiler, flag and instruction set. Positions come
// from bits: std::mt19937_64 is specified to the bit, no distribution and nothing of libm is used.

#include <array>
#include <cstdint>
#include <cstdio>
#include <random>
#include <stdexcept>
#include <string>

#include "forceshade/fast.h"

namespace forceshade::tests {

inline std::uint32_t bits_in(float number) {
  return __builtin_bit_cast(std::uint32_t, number);
}

// FNV-1a: enough against accidents, and the program that makes the hashes needs nothing but fast/.
class Hash {
 public:
  void add(std::uint32_t word) {
    for (int byte = 0; byte < 4; ++byte) value_ = (value_ ^ (word >> 8 * byte & 0xFFU)) * 0x100000001B3U;
  }
  void add(float number) { add(bits_in(number)); }
  std::string hex() const {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value_));
    return text;
  }

 private:
  std::uint64_t value_ = 0xCBF29CE484222325U;
};

struct Scene {
  Parameters parameters;
  float step;  // mm: a power of two; 2^23 of them are about the bump's width
};

// The thesis's bump, rational faces that make ties, a half cylinder, the ends of the domain.
inline constexpr std::array<Scene, 7> kScenes{{{{15.24F, 25.4F, 0.5F}, 0x1p-18F},
                                               {{1.25F, 1.5F, 0.7F}, 0x1p-22F},
                                               {{3.125F, 6, 1}, 0x1p-20F},
                                               {{12.7F, 25.4F, 1}, 0x1p-18F},
                                               {{0.1F, 0.2F, 1e-3F}, 0x1p-25F},
                                               {{1e4F, 0.25F, 777.7F}, 0x1p-24F},
                                               {{1e4F, 2e4F, 1e3F}, 0x1p-10F}}};

// Positions come in runs of one kind, so that batches also get runs without one that only the scalar call can answer.
inline constexpr std::size_t kRun = 1024, kRuns = 980;

class Positions {
 public:
  // near the bump; the same with trailing zeros, where ties and exact contact are; every bit pattern; the domain's corners
  float coordinate(std::size_t run, const Scene& scene) {
    const std::uint64_t bits = random_();
    const auto low = static_cast<std::uint32_t>(bits);
    const auto high = static_cast<std::uint32_t>(bits >> 32);
    switch (run % 4) {
      case 0: return near(low, scene);
      case 1: return near(low & ~0U << high % 32, scene);
      case 2: return __builtin_bit_cast(float, low);
      default: return high % 2 == 0 ? near(low, scene) : corner(low, high / 2, scene.parameters);
    }
  }

 private:
  // A multiple of the step, at most 2^23 of them: exact.
  static float near(std::uint32_t bits, const Scene& scene) {
    return static_cast<float>(static_cast<std::int32_t>(bits) >> 8) * scene.step;
  }
  // A special value or a near neighbour of it, of either sign.
  static float corner(std::uint32_t bits, std::uint32_t which, const Parameters& p) {
    const std::array values{0.0F, p.width / 2, p.radius,      p.radius / 2,    0x1p-30F,
                            1e4F, 0x1p-126F,   0x1p-149F * 4, 0x1.fffffcp127F, 1.0F};
    const std::uint32_t value = bits_in(values[which % values.size()]);
    return __builtin_bit_cast(float, (value + bits % 4) ^ (bits & 0x80000000U));  // up to infinity and NaN, all of them
  }

  std::mt19937_64 random_{1995};
};

struct Bits {
  std::string hash;                      // of the force and status of every single call
  std::array<std::size_t, 3> statuses;   // the number of each that was met
  std::size_t nans;                      // components that are NaN
  std::array<std::size_t, 3> different;  // per instruction set: forces of the batch call that are not the single call's
};

// One single call's answer.
inline void note(const fast::Evaluation& answer, Hash& hash, Bits& bits) {
  for (const float component : answer.force) {
    hash.add(component);
    bits.nans += component != component;
  }
  hash.add(static_cast<std::uint32_t>(finished(answer.status)));
  ++bits.statuses[static_cast<std::size_t>(finished(answer.status))];
}

inline Bits bits_of(LawId id) {
  Positions positions;
  Hash hash;
  Bits bits{};
  std::array<float, kRun> x{}, z{}, fx{}, fz{};
  std::array<Eigen::Vector3f, kRun> single;
  for (std::size_t run = 0; run < kRuns; ++run) {
    const Scene& scene = kScenes[run % kScenes.size()];
    const auto built = fast::Law::build(id, scene.parameters);
    if (const auto* error = std::get_if<ParameterError>(&built)) throw std::runtime_error(error->message());
    const auto& law = std::get<fast::Law>(built);
    for (std::size_t i = 0; i < kRun; ++i) {
      x[i] = positions.coordinate(run, scene);
      z[i] = positions.coordinate(run, scene);
      const fast::Evaluation answer = law.evaluate({x[i], 0, z[i]});
      single[i] = answer.force;
      note(answer, hash, bits);
    }
    for (const fast::InstructionSet set : fast::kInstructionSets) {
      if (set == fast::InstructionSet::scalar || !fast::is_available(set)) continue;  // scalar: the batch is single calls
      law.force(x, z, fx, fz, set);
      for (std::size_t i = 0; i < kRun; ++i)
        bits.different[static_cast<std::size_t>(set)] +=
            bits_in(fx[i]) != bits_in(single[i].x()) || bits_in(fz[i]) != bits_in(single[i].z());
    }
  }
  bits.hash = hash.hex();
  return bits;
}

}  // namespace forceshade::tests
