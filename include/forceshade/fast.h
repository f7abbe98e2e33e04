// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The real-time renderers of laws, height maps and meshes: each component of each force is the exact force rounded to
// binary32, to nearest, ties to even. They need the library forceshade::fast, which needs Eigen alone.
//
//   const auto built = fast::Law::build(LawId::bump_2p, {.radius = 15.24F, .width = 25.4F, .stiffness = 0.5F});
//   if (const auto* error = std::get_if<ParameterError>(&built)) throw std::invalid_argument(error->message());
//   const auto& law = std::get<fast::Law>(built);
//   const Eigen::Vector3f force = law.force({3, 0, -0.5F});  // N, at mm
//
// Units: mm, N, N/mm. Positions and forces are in the frame of docs/laws.md: x right, y into the page, z up. A coordinate
// below 2^-30 mm in size is read as 0; one beyond 10^4 mm or NaN gives Status::invalid and zero force.
//
// Errors: build() returns a ParameterError; nothing else fails, and nothing here throws but std::bad_alloc where it says that
// it allocates.
//
// Threads: a renderer is immutable and may be shared; a session belongs to one thread at a time. Every evaluation is without
// allocation, lock or exception. The calling thread must round to nearest and keep subnormals. build() looks at its own
// thread. Changing the floating-point mode later or on another thread (fesetround, flush to zero, a library that does either)
// makes answers wrong, and nothing in them shows it. A caller beside third-party code calls arithmetic_fault() on the
// calling thread first, as run_servo_loop() does.
//
// Not promised: the layout of the classes, the time of a call, and which stage decides (both are measured in docs/speed.md).
//
// Source: Morgenbesser and Srinivasan, RLE Technical Report 606 (MIT, 1996); the proofs: docs/proofs.md.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "forceshade/damping.h"
#include "forceshade/height_map.h"
#include "forceshade/law.h"
#include "forceshade/mesh.h"
#include "forceshade/scene.h"
#include "forceshade/session.h"

namespace forceshade::fast {

// The vector instructions of a batch call: all give the same bits, they differ in speed alone.
enum class InstructionSet { scalar, avx2, avx512 };

inline constexpr std::array kInstructionSets{InstructionSet::scalar, InstructionSet::avx2, InstructionSet::avx512};

std::string_view name_of(InstructionSet set) noexcept;
std::optional<InstructionSet> instruction_set_named(std::string_view name) noexcept;

// True if this processor and operating system run it.
bool is_available(InstructionSet set) noexcept;

// The widest available one, found once at the first call.
InstructionSet best_instruction_set() noexcept;

// The fault of the arithmetic of this library, or of this thread's floating-point mode, against IEEE 754 rounding to
// nearest, as a noun; null if nothing was found. Every answer given under it would be unproved.
const char* arithmetic_fault() noexcept;

// SHA-256, in hex, of the compiled objects of this library: what a certificate is bound to.
const char* library_digest() noexcept;

struct BatchResult {
  std::size_t invalid = 0;  // positions outside the domain; their force is zero
};

// One of the nine laws. Trivially copyable; builds in at most 2 µs.
class Law {
 public:
  // R in [0.1, 1e4] mm, w in [1e-3, 2R] mm, K in [1e-3, 1e3] N/mm; the wall reads K alone.
  // Under an arithmetic_fault() nothing is built: the error states the fault.
  static std::variant<Law, ParameterError> build(LawId id, const Parameters& parameters) noexcept;

  LawId id() const noexcept { return id_; }
  const Parameters& parameters() const noexcept { return parameters_; }

  Evaluation evaluate(const Eigen::Vector3f& position) const noexcept { return evaluate_(*this, position); }
  Eigen::Vector3f force(const Eigen::Vector3f& position) const noexcept { return evaluate(position).force; }

  // fx[i], fz[i] = force at (x[i], 0, z[i]), bit for bit what evaluate() gives, whatever the instruction set.
  // As many as the shortest span has. An output may begin where an input begins, which it then takes the place of; any other
  // overlap is not allowed. An instruction set this machine lacks falls back to the best it has.
  BatchResult force(std::span<const float> x, std::span<const float> z, std::span<float> fx, std::span<float> fz,
                    InstructionSet instructions = best_instruction_set()) const noexcept;

  // forces[i] = force at positions[i], in the same way; as many as the shorter span has. `forces` may begin where `positions`
  // begins, and then takes their place; any other overlap is not allowed.
  BatchResult force(std::span<const Eigen::Vector3f> positions, std::span<Eigen::Vector3f> forces,
                    InstructionSet instructions = best_instruction_set()) const noexcept;

 private:
  struct Inside;
  Law(LawId id, const Parameters& parameters, const Inside& inside) noexcept;
  const Inside& inside() const noexcept;

  LawId id_;
  Parameters parameters_;
  Evaluation (*evaluate_)(const Law& law, const Eigen::Vector3f& position) noexcept;  // that of the law's definition
  alignas(8) std::array<std::byte, 232> inside_;  // the law's definition with its parameters: fast/law.cpp
};

struct SplineMap;  // fast/heights/spline_force.h
enum class Sign;   // fast/numbers/ball.h

// A height map: a force at the surface's own depth, or at the plane's, along the map's normal. Copies share the map, and its
// grids are those of the HeightMap, not copies.
class HeightMapField {
 public:
  // Domains: docs/height-maps.md. Looks at every value of a grid, and allocates. Under an arithmetic_fault() nothing is built.
  static std::variant<HeightMapField, ParameterError> build(const HeightMap& map, height::Mode mode, float stiffness);

  // The last stage takes up to 3 MiB of stack. Should its numbers not decide (fast/heights/ties.md says for which identities
  // that could be), Status::invalid and no force.
  Evaluation evaluate(const Eigen::Vector3f& position) const noexcept {
    Evaluation answer;  // one object, built where the caller needs it: a copy would wait for what was just written
    if (spline_ != nullptr) {
      const Sign contact = first_stage_(*spline_, position.data(), answer.force.data());
      answer.status = contact == kPositive ? Status::contact : Status::free;
      if (contact != kUnknown) [[likely]]
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
  static constexpr Sign kPositive{2}, kUnknown{3};

  class Inside;
  explicit HeightMapField(std::shared_ptr<const Inside> inside) noexcept;
  Evaluation evaluate_in_stages(const Eigen::Vector3f& position) const noexcept;

  std::shared_ptr<const Inside> inside_;
  // The map once more if it is one B-spline and no more, the case with a path of its own; null for any other. Of inside_.
  const SplineMap* spline_;
  Sign (*first_stage_)(const SplineMap& map, const float* position, float* force) noexcept;  // the best of this machine
};

// Converts a tick to the Evaluation that the session's caller sees.
inline Evaluation evaluation_of(const mesh::Tick& tick, Stage stage) noexcept {
  if (finished(tick.status) != Status::contact) return {{0, 0, 0}, tick.status, stage};
  return {Eigen::Vector3f(tick.force.data()), tick.status, stage, tick.damping};
}

// A god-object as a servo loop drives it, which also gives the whole tick for comparisons and records.
class TickSession : public Session {
 public:
  // position: mm, the next one of the path. Without allocation, lock or exception.
  virtual mesh::Tick tick(const std::array<float, 3>& position) noexcept = 0;
  // The arithmetic that decided the last tick: the last stage of all its decisions.
  virtual Stage stage() const noexcept = 0;
  // Goes on from a state of this mesh, as a tick gave it. A state that is not one of this mesh counts as none.
  virtual void resume(const mesh::GodObject& state) noexcept = 0;

  Evaluation step(const Eigen::Vector3f& position) noexcept final {
    const mesh::Tick its = tick({position.x(), position.y(), position.z()});
    return evaluation_of(its, stage());
  }
};

class Mesh;  // fast/meshes/mesh.h
namespace soups {
class Soup;  // fast/soups/soup.h
}  // namespace soups

// The god-object on a mesh, also on one that is not regular: state, moves and force equal the exact definition in every bit
// (docs/god-object.md, docs/soups.md). Copies share the mesh.
class GodObject {
 public:
  // Refused with the reason: a stiffness outside [10^-3, 10^3] N/mm, normals and textures outside the domains of docs/meshes.md
  // or not one for each corner where the shading or the contact rule uses them, a texture's height map that HeightMapField
  // refuses, more than 2^26 triangles, and anything under an arithmetic_fault(). Allocates.
  static std::variant<GodObject, ParameterError> build(const MeshRendering& rendering);

  // On the same mesh. stiffness: N/mm, in [10^-3, 10^3].
  std::variant<GodObject, ParameterError> with_stiffness(float stiffness) const;

  // At the beginning of a path. Allocates.
  std::unique_ptr<TickSession> open() const;

  // One tick from a state, as a session that goes on from it gives it, for callers that keep many states themselves. position:
  // mm. Where the god-object is free it takes longer than a session, which keeps its distance from the mesh. Without
  // allocation, lock or exception, and from several threads at once; on a mesh that is not regular it opens a session, and so
  // allocates.
  mesh::Tick tick(const mesh::GodObject& state, const std::array<float, 3>& position) const noexcept;

 private:
  GodObject(std::shared_ptr<const Mesh> mesh, std::shared_ptr<const soups::Soup> soup, float stiffness, mesh::Shading shading,
            mesh::Contact contact) noexcept
      : mesh_(std::move(mesh)), soup_(std::move(soup)), stiffness_(stiffness), shading_(shading), contact_(contact) {}

  std::shared_ptr<const Mesh> mesh_;         // of a regular one
  std::shared_ptr<const soups::Soup> soup_;  // of any other
  float stiffness_;
  mesh::Shading shading_;
  mesh::Contact contact_;
};

// One path of the hand through objects that are placed anew in every step (docs/scenes.md): the force is the sum of theirs,
// turned into the world's axes, each component correctly rounded.
class SceneSession {
 public:
  // Each object at the beginning of its path. Refused with the reason: another number of them than 1 to scene::kMostObjects,
  // and anything under an arithmetic_fault(). Allocates.
  static std::variant<SceneSession, ParameterError> build(std::vector<std::unique_ptr<Session>> objects);

  // position: mm, in the world; poses: one for each object, in their order. Invalid, without a force: a position, a pose, or
  // where an object sees the hand, that is outside the domain; and another number of poses. Without allocation, lock or
  // exception.
  Evaluation step(const Eigen::Vector3f& position, std::span<const scene::Pose> poses) noexcept;

  std::size_t size() const noexcept { return objects_.size(); }
  // An object's answer to the last step, in its own axes.
  const Evaluation& of(std::size_t object) const noexcept { return answers_[object]; }

 private:
  explicit SceneSession(std::vector<std::unique_ptr<Session>> objects)
      : objects_(std::move(objects)), answers_(objects_.size()) {}

  std::vector<std::unique_ptr<Session>> objects_;
  std::vector<Evaluation> answers_;
};

// The stage behind a renderer of any kind that gives its forces damping (docs/damping.md), along one path of the hand. The
// damped force of each tick is the exact one, each component correctly rounded.
class Damping {
 public:
  // Refused with the reason: a parameter outside its range (damping.h), and anything under an arithmetic_fault().
  static std::variant<Damping, ParameterError> build(const damping::Parameters& parameters) noexcept;

  const damping::Parameters& parameters() const noexcept { return parameters_; }

  // The renderer's answer with the damped force. position: mm, the next one of the path, at which the renderer gave `spring`.
  // periods: those since the tick before; 0 answers the same reading of the device again, and leaves the state as it is.
  // Invalid, without a force: a position outside the domain, and an invalid answer of the renderer. Without allocation, lock or
  // exception.
  Evaluation tick(const Eigen::Vector3f& position, std::uint32_t periods, const Evaluation& spring) noexcept;

  // At the beginning of a path, and after a pause.
  void reset() noexcept { resume({}); }

  damping::State state() const noexcept;
  // Goes on from a state, as state() gave it. A state that no tick gives counts as that of the beginning.
  void resume(const damping::State& state) noexcept;

 private:
  // In binary64, as the first stage takes them.
  struct Numbers {
    double keep, gain;  // 1 - α and αr
    double damping, most, drag;
    double per_square;  // 1/F₀²
    bool is_short;      // α is a power of two
    bool has_drag;
  };

  static constexpr std::uint32_t kNoPosition = 18;  // more than the 17 periods after which there is no velocity

  explicit Damping(const damping::Parameters& parameters) noexcept;

  // Does what tick() leaves: late ticks, invalid ones, and velocities of which binary64 is not sure.
  Evaluation rare_tick(const Eigen::Vector3f& position, std::uint32_t periods, const Evaluation& spring) noexcept;

  damping::Parameters parameters_;
  Numbers numbers_;
  alignas(16) std::array<double, 4> position_{}, velocity_{};  // the fourth is 0
  std::uint32_t periods_ = kNoPosition;
};

}  // namespace forceshade::fast
