// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The numbers of a height map U(x, y). Their meanings, units and domains: docs/height-maps.md.
//
//   HeightMap bump;
//   bump.parts.push_back({height::Gaussian{.height = 3, .sigma = 5}});                     // mm
//   bump.parts.push_back({height::Grating{.height = 0.1F, .wave_x = 2}, true});            // less a grating along x
//   const std::string_view how = height::name_of(height::Mode::force_shaded);         // "height-map-shaded"
//
// Lengths are in mm, slopes in mm/mm. fast::HeightMapField of fast.h renders it, reference::HeightMapField of reference.h
// defines the force, heights.h reads one from a file. Whether the numbers are in their domains is looked at when either is
// built. All of these are values, which threads may share while none changes them. Nothing here allocates but the vectors'
// copies, or throws but std::bad_alloc.
//
// Not promised: the order of the kinds in Shape; more of them may come in a new version (docs/versions.md).

#if __cplusplus < 202002L
#error "forceshade is in C++20: expected -std=c++20 or later"
#endif

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace forceshade::height {

// The meaning of a number of a map, for drawing maps at random. A chord is shorter than twice the radius.
enum class Meaning { centre, height, slope, wave, reach, radius, chord };

// A number of a kind under its key in a file, whose ending is the unit. One that is not required may be left out, and is 0.
template <class Kind>
struct Number {
  std::string_view key;
  float Kind::*member;
  Meaning meaning;
  bool is_required = false;
};

// (x, y): the centre, mm.
struct Plane {
  float slope_x = 0, slope_y = 0;  // mm/mm
  float height = 0;                // mm, above the origin

  static constexpr std::string_view kName = "plane";
  static constexpr std::array<Number<Plane>, 3> numbers() {
    return {{{"slope_x", &Plane::slope_x, Meaning::slope},
             {"slope_y", &Plane::slope_y, Meaning::slope},
             {"height_mm", &Plane::height, Meaning::height}}};
  }
};
struct Cone {
  float x = 0, y = 0;
  float height = 0, radius = 0;  // mm: at the apex, of the rim

  static constexpr std::string_view kName = "cone";
  static constexpr std::array<Number<Cone>, 4> numbers() {
    return {{{"x_mm", &Cone::x, Meaning::centre},
             {"y_mm", &Cone::y, Meaning::centre},
             {"height_mm", &Cone::height, Meaning::height, true},
             {"radius_mm", &Cone::radius, Meaning::reach, true}}};
  }
};
struct CylinderCap {
  float x = 0;                  // the axis is parallel to y
  float radius = 0, width = 0;  // mm: of the cylinder, of the chord on the plane

  static constexpr std::string_view kName = "cylinder-cap";
  static constexpr std::array<Number<CylinderCap>, 3> numbers() {
    return {{{"x_mm", &CylinderCap::x, Meaning::centre},
             {"radius_mm", &CylinderCap::radius, Meaning::radius, true},
             {"width_mm", &CylinderCap::width, Meaning::chord, true}}};
  }
};
struct SphereCap {
  float x = 0, y = 0;
  float radius = 0, width = 0;  // mm: of the sphere, of the circle on the plane (its diameter)

  static constexpr std::string_view kName = "sphere-cap";
  static constexpr std::array<Number<SphereCap>, 4> numbers() {
    return {{{"x_mm", &SphereCap::x, Meaning::centre},
             {"y_mm", &SphereCap::y, Meaning::centre},
             {"radius_mm", &SphereCap::radius, Meaning::radius, true},
             {"width_mm", &SphereCap::width, Meaning::chord, true}}};
  }
};
struct Gaussian {
  float x = 0, y = 0;
  float height = 0, sigma = 0;  // mm

  static constexpr std::string_view kName = "gaussian";
  static constexpr std::array<Number<Gaussian>, 4> numbers() {
    return {{{"x_mm", &Gaussian::x, Meaning::centre},
             {"y_mm", &Gaussian::y, Meaning::centre},
             {"height_mm", &Gaussian::height, Meaning::height, true},
             {"sigma_mm", &Gaussian::sigma, Meaning::reach, true}}};
  }
};
struct Grating {
  float height = 0;              // mm: from the mean to a crest
  float wave_x = 0, wave_y = 0;  // rad/mm
  float phase = 0;               // rad

  static constexpr std::string_view kName = "grating";
  static constexpr std::array<Number<Grating>, 4> numbers() {
    return {{{"height_mm", &Grating::height, Meaning::height, true},
             {"wave_x_rad_per_mm", &Grating::wave_x, Meaning::wave},
             {"wave_y_rad_per_mm", &Grating::wave_y, Meaning::wave},
             {"phase_rad", &Grating::phase, Meaning::wave}}};
  }
};

// Straight lines from knot to knot, level beyond the first and the last; the same for every y.
struct Knot {
  float x = 0, height = 0;  // mm
};
struct Polygons {
  std::vector<Knot> knots;  // by x

  static constexpr std::string_view kName = "polygons";
};

enum class Interpolant { bilinear, cubic_spline };
enum class Edge { clamp, tile };

// A sampled map. `values` are heights for Interpolant::bilinear, spline coefficients for cubic_spline; row by row from the
// smallest y, each row from the smallest x. Sample (i, j) lies at ((i - (columns - 1)/2)·pitch, (j - (rows - 1)/2)·pitch).
struct Grid {
  std::uint32_t columns = 0, rows = 0;
  float pitch = 0;  // mm
  Edge edge = Edge::clamp;
  Interpolant interpolant = Interpolant::cubic_spline;
  std::vector<float> values;  // mm

  static constexpr std::string_view kName = "grid";
};

using Shape = std::variant<Plane, Cone, CylinderCap, SphereCap, Gaussian, Grating, Polygons, std::shared_ptr<const Grid>>;

// Knots and samples are no fixed list of numbers.
template <class Kind>
concept HasNumbers = requires {
  Kind::numbers();
};

// The kind of a shape of the variant: a grid is held by a pointer.
template <class T>
struct KindOf {
  using type = T;
};
template <class T>
struct KindOf<std::shared_ptr<const T>> {
  using type = T;
};

inline constexpr std::size_t kKinds = std::variant_size_v<Shape>;

// make(std::type_identity<Kind>()) for the kind of this index in the variant.
template <class Make>
Shape make_shape(std::size_t index, const Make& make) {
  return [&]<std::size_t... kIndex>(std::index_sequence<kIndex...>) {
    Shape shape;
    const auto make_one = [&]<class T>(std::type_identity<T>) {
      shape = make(std::type_identity<typename KindOf<T>::type>());
      return true;
    };
    static_cast<void>(((kIndex == index && make_one(std::type_identity<std::variant_alternative_t<kIndex, Shape>>())) || ...));
    return shape;
  }
  (std::make_index_sequence<kKinds>());
}

// A shape of the kind of this index: value(number) for each of its numbers, in their order. The kinds whose numbers are no
// fixed list are polygons() and grid().
template <class Value, class MakePolygons, class MakeGrid>
Shape shape_of_kind(std::size_t index, const Value& value, const MakePolygons& polygons, const MakeGrid& grid) {
  return make_shape(index, [&]<class Kind>(std::type_identity<Kind>) -> Shape {
    if constexpr (HasNumbers<Kind>) {
      Kind one;
      for (const Number<Kind>& number : Kind::numbers()) one.*number.member = value(number);
      return one;
    } else if constexpr (std::is_same_v<Kind, Polygons>) {
      return polygons();
    } else {
      static_assert(std::is_same_v<Kind, Grid>);
      return grid();
    }
  });
}

// The names of the kinds, by index.
inline constexpr std::array<std::string_view, kKinds> kKindNames = []<std::size_t... kIndex>(std::index_sequence<kIndex...>) {
  return std::array<std::string_view, kKinds>{KindOf<std::variant_alternative_t<kIndex, Shape>>::type::kName...};
}
(std::make_index_sequence<kKinds>());

struct Part {
  Shape shape;
  bool negated = false;  // a dent for a bump
};

// The way in which a map becomes a force field (docs/height-maps.md).
enum class Mode { true_height, force_shaded, conservative };

struct ModeName {
  Mode mode;
  std::string_view name;
};

inline constexpr std::array<ModeName, 3> kModes{{
    {Mode::true_height, "height-map"},
    {Mode::force_shaded, "height-map-shaded"},
    {Mode::conservative, "height-map-conservative"},
}};

constexpr std::string_view name_of(Mode mode) {
  return kModes[static_cast<std::size_t>(mode)].name;
}

}  // namespace forceshade::height

namespace forceshade {

// The sum of its parts.
struct HeightMap {
  std::vector<height::Part> parts;
  std::vector<height::Part> surface{};  // from which a force-shaded map's depth is measured, a sum too; empty: the flat plane
};

}  // namespace forceshade
