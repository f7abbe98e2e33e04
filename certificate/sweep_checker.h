// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Checks a unit of a sweep, of fast::Law or of a renderer that a test made wrong.

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "certificate/sweep_unit.h"
#include "properties/binary32.h"
#include "properties/field_properties.h"
#include "reference/consecutive_floats.h"

namespace forceshade::properties {

// Renderer: fast::Law, or what evaluates like it.
template <class FastLaw>
class SweepChecker {
 public:
  SweepChecker(const Sweep& sweep, const FastLaw& law, const reference::Law& reference)
      : sweep_(sweep), law_(law), reference_(reference) {}

  Tally check(std::uint32_t unit) {
    unit_ = unit;
    const std::uint32_t begin = unit << kUnitBits;
    for (std::uint32_t first = begin; first - begin < (1U << kUnitBits); first += kRun) {
      // Directions and heights end with the bump: its last run is swept whole.
      const bool is_beside = !(2 * reference::coordinate_of_run(first, 0) <= sweep_.parameters.width);
      if (sweep_.kind == SweepKind::height) {
        if (!is_beside) check_surface(first);
      } else if (sweep_.kind != SweepKind::direction || !is_beside) {
        check_both_signs(first);
      }
    }
    return std::move(tally_);
  }

 private:
  using Along = reference::Along;
  static constexpr std::size_t kRun = reference::kRun;
  static constexpr std::uint32_t kSignBit = 0x80000000U;

  // A run reflected in x = 0, for magnitudes above the quantum: there every law is its own mirror image (docs/laws.md, Edges).
  static reference::RoundedRun mirrored(reference::RoundedRun run) {
    for (float& fx : run.x) fx = 0.0F - fx;  // not -fx: zeros are +0
    return run;
  }

  // Below the quantum, where a vector set leaves all of its block to the scalar call; most binary32 are there.
  static bool is_tiny(const std::array<float, kRun>& run) { return std::fabs(run[0]) < 0x1p-30F; }

  void check_both_signs(std::uint32_t first) {
    const Along along = sweep_.kind == SweepKind::column ? Along::z : Along::x;
    const reference::RoundedRun exact = reference::round_run(reference_, along, sweep_.at, first);
    check_run(along, first, exact);
    const bool is_mirrored = along == Along::x && std::fabs(reference::coordinate_of_run(first, 0)) >= 0x1p-30F;
    check_run(along, first | kSignBit,
              is_mirrored ? mirrored(exact) : reference::round_run(reference_, along, sweep_.at, first | kSignBit));
  }

  void check_run(Along along, std::uint32_t first, const reference::RoundedRun& exact) {
    std::array<float, kRun> fixed, moving;
    fixed.fill(sweep_.at);
    for (std::size_t i = 0; i < kRun; ++i) moving[i] = reference::coordinate_of_run(first, i);
    const auto& x = along == Along::x ? moving : fixed;
    const auto& z = along == Along::x ? fixed : moving;
    for (std::size_t i = 0; i < kRun; ++i) {
      const Eigen::Vector3f position(x[i], 0, z[i]);
      const fast::Evaluation answer = law_.evaluate(position);
      ++tally_.stages[static_cast<std::size_t>(answer.stage)];
      if (!same_bits(answer.force.x(), exact.x[i]) || !same_bits(answer.force.z(), exact.z[i]) ||
          !same_bits(answer.force.y(), 0) || answer.status != exact.status[i])
        mismatch([&] {
          return *difference(position, {answer.force, answer.status}, {{exact.x[i], 0, exact.z[i]}, exact.status[i]});
        });
    }
    if (!is_tiny(moving)) check_vectors(x, z, exact.x, exact.z, kRun);
    tally_.points += kRun;
  }

  // On both sides of the surface: contact below, free above.
  void check_surface(std::uint32_t first) {
    const reference::SurfaceRun surface = reference::surface_run(reference_, first);
    for (const std::uint32_t sign : {0U, kSignBit}) {
      std::array<float, kRun> x{}, fx{}, fz{};
      for (std::size_t i = 0; i < surface.count; ++i) x[i] = reference::coordinate_of_run(first | sign, i);
      for (const auto* z : {&surface.contact, &surface.free}) {
        const Status expected = z == &surface.contact ? Status::contact : Status::free;
        for (std::size_t i = 0; i < surface.count; ++i) {
          const Eigen::Vector3f position(x[i], 0, (*z)[i]);
          const fast::Evaluation answer = law_.evaluate(position);
          ++tally_.stages[static_cast<std::size_t>(answer.stage)];
          if (answer.status != expected)
            mismatch(
                [&] { return "at " + show(position) + " mm: expected " + (expected == Status::free ? "free" : "contact"); });
          fx[i] = answer.force.x();
          fz[i] = answer.force.z();
        }
        if (!is_tiny(x)) check_vectors(x, *z, fx, fz, surface.count);
      }
      tally_.points += surface.count;
    }
  }

  // Every instruction set gives these bits.
  void check_vectors(const std::array<float, kRun>& x, const std::array<float, kRun>& z, const std::array<float, kRun>& fx,
                     const std::array<float, kRun>& fz, std::size_t count) {
    std::array<float, kRun> batch_fx, batch_fz;
    for (const fast::InstructionSet set : fast::kInstructionSets) {
      if (set == fast::InstructionSet::scalar || !fast::is_available(set)) continue;
      law_.force(std::span(x).first(count), std::span(z).first(count), std::span(batch_fx).first(count),
                 std::span(batch_fz).first(count), set);
      for (std::size_t i = 0; i < count; ++i)
        if (!same_bits(fx[i], batch_fx[i]) || !same_bits(fz[i], batch_fz[i]))
          mismatch([&] {
            return "at x = " + show(x[i]) + ", z = " + show(z[i]) + " mm: expected (" + show(fx[i]) + ", " + show(fz[i]) +
                   ") N, the batch call (" + std::string(fast::name_of(set)) + ") gives (" + show(batch_fx[i]) + ", " +
                   show(batch_fz[i]) + ")";
          });
    }
  }

  // words: called for the first few only.
  template <class Words>
  void mismatch(const Words& words) {
    ++tally_.mismatches;
    if (tally_.counterexamples.size() < kCounterexamples)
      tally_.counterexamples.emplace_back(
          unit_, std::string(name_of(sweep_.law)) + ", R = " + show(sweep_.parameters.radius) + " mm, " + words());
  }

  const Sweep& sweep_;
  const FastLaw& law_;
  const reference::Law& reference_;
  std::uint64_t unit_ = 0;
  Tally tally_;
};

}  // namespace forceshade::properties
