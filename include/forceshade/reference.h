// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The exact side: the force of every law, height map and mesh by its definition, rounded to binary32 with proof, or in decimal
// digits. It shares nothing with the fast path, and is slow. The library is forceshade::reference, of the component
// properties; it needs GMP, MPFR and MPFI, and at building CGAL and Boost.
//
//   const auto law = std::get<reference::Law>(reference::Law::build(LawId::bump_2p, {15.24F, 25.4F, 0.5F}));
//   const reference::Rounded rounded = law.round_to_binary32({3, 0, -0.5F});  // N, at mm
//   const reference::DecimalForce digits = law.decimal({3, 0, -0.5F}, 40);
//   std::printf("%a, that is %s N\n", double{rounded.force.z()}, digits.z.c_str());
//
// Lengths are in mm, forces in N, the stiffness in N/mm. A coordinate below 2^-30 mm in size is read as 0; one beyond 10^4 mm
// or NaN gives Status::invalid and zero force.
//
// Errors: build() returns a ParameterError. Everything here allocates, and may throw std::bad_alloc.
//
// Threads: the objects are immutable and may be shared; a GodObjectSession belongs to one thread at a time.
//
// Not promised: how long an answer takes (a tie may take a second), and what Method says of it.
//
// Source: Morgenbesser and Srinivasan, RLE Technical Report 606 (MIT, 1996), with reference/laws/errata.md; docs/laws.md,
// docs/height-maps.md and docs/god-object.md.

#include <Eigen/Core>
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "forceshade/damping.h"
#include "forceshade/height_map.h"
#include "forceshade/law.h"
#include "forceshade/mesh.h"
#include "forceshade/scene.h"

namespace forceshade::reference {

// The method that made sure of a rounding: the 64-bit filter, MPFI intervals, or CGAL's exact comparison with the tie.
enum class Method { filter, enclosure, exact };

struct Rounded {
  Eigen::Vector3f force{0, 0, 0};  // N, each component the exact one rounded to binary32, ties to even; zeros are +0
  Status status = Status::free;
  Method method = Method::filter;
  float ulps_from_tie = 1;  // of the component nearest to a rounding tie; 0 for a tie, or too close for the filter to decide
  damping::Limits damping = {};  // of what is touched
};

struct DecimalForce {
  std::string x, z;  // N
  Status status;
};

struct DecimalMapForce {
  std::string x, y, z;  // N
  Status status;
};

struct DecimalGeometry {
  std::string d, h, w_prime, h_prime;  // mm
  std::string theta;                   // rad
};

// d, h, w′, h′ and θ correctly rounded to `digits` significant decimal digits. Parameters as for Law::build; K is not read.
DecimalGeometry geometry(const Parameters& parameters, unsigned digits);

class Ball64;  // reference/numbers/ball64.h
namespace meshes {
class Ticks;  // reference/meshes/ticks.h
}  // namespace meshes
template <class N>
struct BumpGeometry;  // reference/laws/bump_geometry.h
struct LawGeometry;   // reference/law.cpp

// A law's exact force. Immutable and safe to share between threads; what 192 bits do not decide is done under one lock.
class Law {
 public:
  // The domain of fast::Law::build, stated on its own.
  static std::variant<Law, ParameterError> build(LawId id, const Parameters& parameters);

  LawId id() const { return id_; }
  const Parameters& parameters() const { return parameters_; }

  // position: mm; a coordinate outside [-1e4, 1e4] or NaN gives zero force and Status::invalid; one below 2^-30 is read as 0.
  Rounded round_to_binary32(const Eigen::Vector3f& position) const;

  // Each component correctly rounded to `digits` significant decimal digits, positional notation.
  DecimalForce decimal(const Eigen::Vector3f& position, unsigned digits) const;

  // The sign of F_x (axis 0) or F_z (axis 2) less a rational number, "-3/4" or "2", exactly. The force is 0 outside the domain.
  int compare(const Eigen::Vector3f& position, std::size_t axis, const std::string& rational) const;

  // For this program's own properties: reference/estimates.h.
  struct Estimate;
  Estimate estimate(const Eigen::Vector3f& position) const;
  const BumpGeometry<Ball64>& geometry() const;

 private:
  Law(LawId id, const Parameters& parameters, std::shared_ptr<const LawGeometry> geometry)
      : id_(id), parameters_(parameters), geometry_(std::move(geometry)) {}

  LawId id_;
  Parameters parameters_;
  std::shared_ptr<const LawGeometry> geometry_;
};

// A height map's exact force. Immutable and safe to share between threads.
class HeightMapField {
 public:
  static std::variant<HeightMapField, ParameterError> build(HeightMap map, height::Mode mode, float stiffness);

  const HeightMap& map() const { return map_; }
  height::Mode mode() const { return mode_; }
  float stiffness() const { return stiffness_; }

  // The same as Law::round_to_binary32: every answer is decided. What enclosures of 768 bits leave open, exact sums decide.
  Rounded round_to_binary32(const Eigen::Vector3f& position) const;

  // As of Law; axis 0 to 2. Below 10^-5000 the digits are in scientific notation, 1.25e-6000. Throws
  // std::domain_error where the terms of a sum cancel in more than a million digits.
  DecimalMapForce decimal(const Eigen::Vector3f& position, unsigned digits) const;
  int compare(const Eigen::Vector3f& position, std::size_t axis, const std::string& rational) const;

  // U_x and U_y at a place of the plane within the domain, mm: each the binary32 nearest to the exact one, ties to even, and 0
  // below 2^-30 in size.
  std::array<float, 2> slopes(float x, float y) const;

  // For this program's own properties: reference/estimates.h.
  struct Estimate;
  Estimate estimate(const Eigen::Vector3f& position) const;

 private:
  HeightMapField(HeightMap map, height::Mode mode, float stiffness)
      : map_(std::move(map)), mode_(mode), stiffness_(stiffness) {}

  HeightMap map_;
  height::Mode mode_;
  float stiffness_;
};

// The god-object on a mesh, also on one that is not regular (docs/soups.md): every decision the sign of an integer, the force
// rounded once to binary32. Immutable and safe to share between threads; copies share the mesh.
class GodObject {
 public:
  static constexpr unsigned kMostMoves = 256;  // in a tick

  // Refused with the reason: a stiffness, normals or a texture outside the domains of docs/meshes.md, and a texture's height
  // map that HeightMapField does.
  static std::variant<GodObject, ParameterError> build(const MeshRendering& rendering);

  // The effect of a position in mm on a state of this mesh. An invalid position gives no force and leaves the state as it
  // is. 1 <= most_moves; with fewer than kMostMoves, more ticks are unfinished.
  mesh::Tick step(const mesh::GodObject& before, const std::array<float, 3>& position, unsigned most_moves = kMostMoves) const;

  // The exact force of that step, each component correctly rounded to `digits` significant decimal digits, as of
  // HeightMapField; that of an unfinished tick is of status contact.
  DecimalMapForce decimal(const mesh::GodObject& before, const std::array<float, 3>& position, unsigned digits) const;

 private:
  explicit GodObject(std::shared_ptr<const meshes::Ticks> ticks) : ticks_(std::move(ticks)) {}

  std::shared_ptr<const meshes::Ticks> ticks_;
};

// A god-object that follows positions in order.
class GodObjectSession {
 public:
  explicit GodObjectSession(GodObject god_object, const mesh::GodObject& state = {})
      : god_object_(std::move(god_object)), state_(state) {}

  mesh::Tick step(const std::array<float, 3>& position) {
    const mesh::Tick tick = god_object_.step(state_, position);
    last_ = {state_, position};
    state_ = tick.after;
    return tick;
  }
  // The exact force of the last step; of a free position where there was none.
  DecimalMapForce decimal(unsigned digits) const { return god_object_.decimal(last_.first, last_.second, digits); }
  const mesh::GodObject& state() const { return state_; }

 private:
  GodObject god_object_;
  mesh::GodObject state_;
  std::pair<mesh::GodObject, std::array<float, 3>> last_;  // the state before the last step, and its position
};

// The position of the world as an object sees it, mm: each coordinate of Rᵀ(p - translation) rounded once to binary32, ties to
// even; 0 below 2^-30 mm in size. Nothing where the pose or the position is invalid.
std::optional<Eigen::Vector3f> seen_from(const scene::Pose& pose, const Eigen::Vector3f& position);

// Objects that are placed anew in every step (docs/scenes.md): the sum of their forces, which are binary32 numbers, is exact
// and is rounded once.
class SceneSession {
 public:
  // Answers an object's next position, in its axes: Law::round_to_binary32() or a GodObjectSession, for instance.
  using Object = std::function<Rounded(const Eigen::Vector3f& position)>;

  // objects: 1 to scene::kMostObjects. Throws std::invalid_argument for another number.
  explicit SceneSession(std::vector<Object> objects);

  // poses: one for each object, in their order; another number of them is an invalid step.
  Rounded step(const Eigen::Vector3f& position, std::span<const scene::Pose> poses);

 private:
  std::vector<Object> objects_;
};

// The stage behind a renderer of any kind that gives its forces damping (docs/damping.md), along one path of the hand.
class Damping {
 public:
  // The ranges of fast::Damping::build, stated on their own.
  static std::variant<Damping, ParameterError> build(const damping::Parameters& parameters);

  const damping::Parameters& parameters() const { return parameters_; }

  // The renderer's answer with the damped force, which is the exact one rounded. position: mm; periods: those since the tick
  // before, 0 where the state is to stay as it is. The method is that of the renderer.
  Rounded tick(const Eigen::Vector3f& position, std::uint32_t periods, const Rounded& spring);

  void reset() { state_ = {}; }
  const damping::State& state() const { return state_; }
  // A state that no tick gives counts as that of the beginning.
  void resume(const damping::State& state);

 private:
  explicit Damping(const damping::Parameters& parameters) : parameters_(parameters) {}
  void move_to(const Eigen::Vector3f& position);

  damping::Parameters parameters_;
  damping::State state_;
};

}  // namespace forceshade::reference
