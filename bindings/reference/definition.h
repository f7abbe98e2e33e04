// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The exact definition of a subject, of whichever kind, as the bindings for other languages call it.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "forceshade.h"
#include "forceshade/description.h"
#include "forceshade/law.h"
#include "forceshade/reference.h"

namespace forceshade::exact {

inline constexpr unsigned kMostDigits = 10000;

// The three components (N) in decimal digits, and what the position is.
struct Decimals {
  std::array<std::string, 3> force;
  forceshade_status status;
};

// The force (N), rounded once, and what the position is.
struct Answer {
  Eigen::Vector3f force;
  forceshade_status status;
};

// Immutable and safe to share between threads.
class Definition {
 public:
  static std::variant<Definition, ParameterError> build(const Description& description);

  // As that of a mesh does. decimals() and compare() are for the others.
  bool depends_on_the_path() const { return std::holds_alternative<reference::GodObject>(what_); }

  // 1 <= digits <= kMostDigits.
  Decimals decimals(const Eigen::Vector3f& position, unsigned digits) const;

  // The sign of a component (axis 0 to 2) less a rational number, which rational_of() of rational.h gave.
  int compare(const Eigen::Vector3f& position, std::size_t axis, const std::string& rational) const;

  // One answer after the other, of a mesh along a path from its beginning. The definition outlives it.
  std::function<Answer(const Eigen::Vector3f& position)> along_a_path() const;

 private:
  using What = std::variant<reference::Law, reference::HeightMapField, reference::GodObject>;
  explicit Definition(What what) : what_(std::move(what)) {}

  What what_;
};

// The position with this index.
Eigen::Vector3f position_of(const forceshade_batch& batch, std::size_t index);

// Writes the answers of a checked batch to where it has room for them; the number of positions that are invalid.
std::size_t fill(const forceshade_batch& batch, const std::function<Answer(const Eigen::Vector3f& position)>& answer);

// The geometry of a bump with these parameters (mm), or the one that is outside its domain.
std::variant<reference::DecimalGeometry, ParameterError> geometry(float radius, float width, unsigned digits);

}  // namespace forceshade::exact
