// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The truth about every law: its exact force as a guaranteed enclosure, in decimal digits, or rounded to binary32 with proof.

#include <Eigen/Core>
#include <string>
#include <variant>

#include "reference/laws/force.h"
#include "rendering/law.h"

namespace forceshade::reference {

// What it took to be sure of a rounding: the 64-bit filter, MPFI intervals, or CGAL's exact comparison with the tie.
enum class Method { filter, enclosure, exact };

struct Rounded {
  Eigen::Vector3f force{0, 0, 0};  // N, each component the exact one rounded to binary32, ties to even; zeros are +0
  Status status = Status::free;
  Method method = Method::filter;
  float ulps_from_tie = 1;     // of the component nearest to a rounding tie; 0 for a tie, or too close for the filter to decide
  bool is_unfinished = false;  // a god-object used up the moves of one tick, and the force is not that of rest
};

struct DecimalForce {
  std::string x, z;  // N
  Status status;
};

struct DecimalGeometry {
  std::string d, h, w_prime, h_prime;  // mm
  std::string theta;                   // rad
};

// d, h, w′, h′ and θ correctly rounded to `digits` significant decimal digits. Parameters as for Law::build; K is not read.
DecimalGeometry geometry(const Parameters& parameters, unsigned digits);

// Immutable and safe to share between threads; whatever the filter cannot decide is done under one lock.
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

  // The facet a valid position is on and the force there to about 17 digits, for properties that need a size, not a proof.
  struct Estimate {
    Facet facet;
    Force<Ball64> force;
  };
  Estimate estimate(const Eigen::Vector3f& position) const;

  const BumpGeometry<Ball64>& geometry() const { return geometry_; }

 private:
  Law(LawId id, const Parameters& parameters, const BumpGeometry<Ball64>& geometry)
      : id_(id), parameters_(parameters), geometry_(geometry) {}

  LawId id_;
  Parameters parameters_;
  BumpGeometry<Ball64> geometry_;
};

}  // namespace forceshade::reference
