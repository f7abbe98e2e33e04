// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The real-time renderer of height maps: a force at the surface's own depth, or at the plane's, along the map's normal.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "fast/evaluate.h"
#include "fast/heights/shape.h"
#include "fast/heights/spline_force.h"
#include "fast/law.h"
#include "rendering/height_map.h"
#include "rendering/law.h"

namespace forceshade::fast {

class ExactPlace;

// Evaluates without allocation, lock or exception; immutable, safe to share between threads. A grid is shared, not copied.
class HeightMapField {
 public:
  // Domains: docs/height-maps.md. Looks at every value of a grid, and allocates. Under an arithmetic fault
  // (fast/numbers/arithmetic.h) nothing is built.
  static std::variant<HeightMapField, ParameterError> build(const HeightMap& map, height::Rendering rendering, float stiffness);

  // Each component is the exact force rounded to binary32; as Law::evaluate, also in what it takes of the calling thread's
  // rounding mode. The last stage takes up to 3 MiB of stack. Should its numbers not decide (docs/height-map-ties.md says for
  // which identities that could be), Status::invalid and no force.
  Evaluation evaluate(const Eigen::Vector3f& position) const noexcept {
    Evaluation answer;  // one object, built where the caller needs it: a copy would wait for what was just written
    if (spline_ != nullptr) {
      const Sign contact = first_stage_(*spline_, position.data(), answer.force.data());
      answer.status = contact == Sign::positive ? Status::contact : Status::free;
      if (contact != Sign::unknown) [[likely]]
        return answer;
    }
    answer = evaluate_in_stages(position);
    return answer;
  }
  Eigen::Vector3f force(const Eigen::Vector3f& position) const noexcept { return evaluate(position).force; }

  // U_x and U_y, mm/mm, and the stage that decided them.
  struct Slopes {
    std::array<float, 2> values;
    Stage stage;
  };
  // At a place of the domain, mm: each slope the binary32 nearest to the exact one, and 0 below 2^-30 in size. Nothing where
  // evaluate() could not decide either. As evaluate() in all else. is_filtered: for tests; false leaves all to the last stage.
  std::optional<Slopes> slopes(float x, float y, bool is_filtered = true) const noexcept;

  // to[i] = force at positions[i], bit for bit what evaluate() gives, whatever the instruction set; as many as the shorter span
  // has. `to` may begin where `positions` begins, and then takes their place; any other overlap is not allowed. An instruction
  // set this machine lacks falls back to the best it has. Vectors speed up a map that is one B-spline.
  BatchResult force(std::span<const Eigen::Vector3f> positions, std::span<Eigen::Vector3f> to,
                    InstructionSet instructions = best_instruction_set()) const noexcept;

 private:
  struct Part {
    EvaluatedShape shape;
    bool negated;
  };

  template <class T>
  static EvaluatedShape real_time(T shape);
  static std::vector<Part> real_time(const std::vector<height::Part>& parts);
  HeightMapField(std::vector<Part> parts, std::vector<Part> surface, height::Rendering rendering, float stiffness);

  template <class N>
  static Jet<N> sum_at(const Place& at, const std::vector<Part>& parts) noexcept;
  template <class N>
  Jet<N> jet_at(const Place& at) const noexcept;
  Evaluation evaluate_in_stages(const Eigen::Vector3f& position) const noexcept;
  Evaluation evaluate_wide(const Place& at, double z) const noexcept;
  std::optional<Slopes> slopes_wide(const Place& at) const noexcept;
  void describe(ExactPlace& place) const noexcept;

  std::vector<Part> parts_, surface_;
  height::Rendering rendering_;
  double stiffness_;         // N/mm
  SplineForce first_stage_;  // the best of this machine
  // The map once more if it is one B-spline and no more, the case with a path of its own; null for any other.
  std::shared_ptr<const SplineMap> spline_;
};

}  // namespace forceshade::fast
