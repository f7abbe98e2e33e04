// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The hard cases of height maps, tests/height_<scene>.cases: inputs whose force lies nearest to a rounding tie, that binary64
// rounds wrongly, or whose contact is closest, found by tests/hard_cases/search_heights.cpp on the maps of height_scenes.h.

#include <Eigen/Core>
#include <istream>
#include <string>
#include <variant>
#include <vector>

#include "fast/heights/all.h"
#include "fast/heights/force.h"
#include "fast/heights/shape.h"
#include "fast/heights/spline.h"
#include "forceshade/law.h"
#include "tests/height_maps/height_scenes.h"

namespace forceshade::tests {

struct HeightCase {
  height::Mode mode;
  float stiffness;           // N/mm
  Eigen::Vector3f position;  // mm
  Eigen::Vector3f force;     // N, as the reference gives it
  Status status;
  std::string closest;  // closeness() there
  std::string why;
  std::string place;  // file and line
};

std::string case_file(const HeightScene& scene);  // from the root of the sources

// Throws Error, which names file and line, where the file is malformed or has no cases.
std::vector<HeightCase> height_cases(const HeightScene& scene);
std::vector<HeightCase> read_height_cases(std::istream& in, const std::string& file);

// A scene's gap, slopes and force in any Ball arithmetic: what fast::HeightMapField computes, with every number in view.
class Balls {
 public:
  explicit Balls(const HeightScene& scene) : parts_(real_time(scene.map.parts)), surface_(real_time(scene.map.surface)) {}

  template <class N>
  struct Answer {
    N gap, Ux, Uy;           // mm, mm/mm
    std::array<N, 3> force;  // N; where the gap is positive
    bool decided;
  };
  // The answer for coordinates that are quantised.
  template <class N>
  Answer<N> at(const Eigen::Vector3f& position, height::Mode mode, double K) const {
    const fast::Place place(position.x(), position.y());
    const fast::Jet<N> map = sum<N>(parts_, place);
    const bool is_shaded = mode == height::Mode::force_shaded;
    const fast::Jet<N> surface = is_shaded ? sum<N>(surface_, place) : map;
    const N gap = surface.U - N::exactly(static_cast<double>(position.z()));
    N M = N::exactly(K) * gap;
    if (mode != height::Mode::conservative) M = M / square_root(N::exactly(1) + (map.Ux * map.Ux + map.Uy * map.Uy));
    return {gap, map.Ux, map.Uy, {-(M * map.Ux), -(M * map.Uy), M}, map.decided && surface.decided};
  }

 private:
  struct Part {
    fast::EvaluatedShape shape;
    bool negated;
  };

  static std::vector<Part> real_time(const std::vector<height::Part>& parts) {
    std::vector<Part> all;
    for (const height::Part& part : parts)
      all.push_back({std::visit(
                         []<class T>(const T& shape) -> fast::EvaluatedShape {
                           if constexpr (std::is_constructible_v<fast::HeightGrid, T>)
                             return fast::HeightGrid(shape);
                           else
                             return shape;
                         },
                         part.shape),
                     part.negated});
    return all;
  }
  template <class N>
  static fast::Jet<N> sum(const std::vector<Part>& parts, const fast::Place& at) {
    fast::Jet<N> total = fast::flat<N>();
    for (const Part& part : parts) {
      const fast::Jet<N> one = std::visit([&](const auto& shape) { return fast::jet<N>(shape, at); }, part.shape);
      total = total + (part.negated ? -one : one);
    }
    return total;
  }

  std::vector<Part> parts_, surface_;
};

// The closeness, by 2048 bits: of a position in contact, of the component nearest to a tie, relative to its size, "x
// 2^-71.3", or "y 0" for a tie; where `of_gap`, the penetration in mm, "gap 2^-44.0", "gap -2^-44.0" or "gap 0".
std::string closeness(const Balls& balls, const HeightCase& one, bool of_gap);
bool is_about_gap(const HeightCase& one);  // by its `why`

}  // namespace forceshade::tests
