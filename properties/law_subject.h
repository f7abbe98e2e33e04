// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A law as a subject.

#include "properties/field_subject.h"

namespace forceshade::properties {

Renderer fast_law(LawId law, const Parameters& parameters);

class LawSubject final : public FieldSubject<reference::Law, LawClaims> {
 public:
  // Each throws std::invalid_argument for parameters outside the law's domain.
  LawSubject(LawId law, const Parameters& parameters) : LawSubject(law, parameters, &fast_law, true) {}
  LawSubject(LawId law, const Parameters& parameters, RenderLaw render, bool is_rendered_by_library = false);
  // Any renderer of a law; drawn parameters are rendered by the fast path.
  explicit LawSubject(const RenderedLaw& rendered);

  std::unique_ptr<Positions> positions(std::uint64_t seed) const override;
  Violation check_continuity(Chooser& choose) const override;
  std::vector<std::function<Violation()>> fixed_loops() const override;
  Expected expected() const override;
  std::vector<LoopEnergy> energies(const Monitor& monitor) const override;
  DrawnSubject with_drawn_parameters(std::uint64_t seed) const override;
  std::uint64_t points_of_a_set(std::uint64_t) const override { return 1024; }

 private:
  RenderLaw render_;
};

// The depths, in mm, at which a law's witness loop is walked.
std::vector<float> witness_depths(const reference::Law& law);

}  // namespace forceshade::properties
