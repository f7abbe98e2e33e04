// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The real-time renderer: every component of every force is the exact force rounded to binary32 (nearest, ties to even).

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>

#include "fast/evaluate.h"
#include "fast/instruction_set.h"
#include "fast/simd/batch.h"
#include "rendering/law.h"

namespace forceshade::fast {

struct BatchResult {
  std::size_t invalid = 0;  // how many positions were outside the domain; their force is zero
};

// Builds in at most 2 µs, evaluates without allocation, lock or exception; copyable, immutable, safe to share between threads.
class Law {
 public:
  // R in [0.1, 1e4] mm, w in [1e-3, 2R] mm, K in [1e-3, 1e3] N/mm; the wall reads K alone.
  // Under an arithmetic_fault() nothing is built: the error states the fault.
  static std::variant<Law, ParameterError> build(LawId id, const Parameters& parameters) noexcept;

  LawId id() const noexcept { return id_; }
  const Parameters& parameters() const noexcept { return parameters_; }

  // position: mm, each coordinate in [-1e4, 1e4]; a coordinate below 2^-30 mm in size is read as 0.
  //
  // Here and in all calls below the calling thread must round to nearest and keep subnormals. build() looks at its own thread;
  // a mode set later, or on another thread (fesetround, flush to zero, a library that does either), makes answers wrong, and
  // nothing in them shows it. A caller that runs beside code that is not its own looks with arithmetic_fault() on the calling
  // thread first, as servo_loop (device/servo_loop.h) does at every tick.
  Evaluation evaluate(const Eigen::Vector3f& position) const noexcept;
  Eigen::Vector3f force(const Eigen::Vector3f& position) const noexcept { return evaluate(position).force; }

  // fx[i], fz[i] = force at (x[i], 0, z[i]), bit for bit what evaluate() gives, whatever the instruction set.
  // As many as the shortest span has. An output may begin where an input begins, which it then takes the place of; any other
  // overlap is not allowed. An instruction set this machine lacks falls back to the best it has.
  BatchResult force(std::span<const float> x, std::span<const float> z, std::span<float> fx, std::span<float> fz,
                    InstructionSet instructions = best_instruction_set()) const noexcept;

 private:
  template <class... Definition>
  static std::variant<Built<Definition>...> any_of(LawList<Definition...>);
  using AnyLaw = decltype(any_of(Laws()));

  // Nothing where there is no such law.
  template <class... Definition>
  static std::optional<Law> built(LawId id, const Parameters& parameters, LawList<Definition...>) noexcept;

  Law(LawId id, const Parameters& parameters, AnyLaw law) noexcept : id_(id), parameters_(parameters), law_(law) {}

  LawId id_;
  Parameters parameters_;
  AnyLaw law_;
};

// What the arithmetic of this library, or of this thread's floating-point mode, does otherwise than IEEE 754 rounding to
// nearest, as a noun; null if nothing was found. Every answer given under it would be unproved.
const char* arithmetic_fault() noexcept;

// SHA-256, in hex, of the compiled objects of this library: what a certificate is bound to.
const char* library_digest() noexcept;

}  // namespace forceshade::fast
