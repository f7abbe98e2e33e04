// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The parts that the figures of a certificate share: a law with all that a picture of it needs, and where to sample it.

#include <initializer_list>
#include <string>
#include <vector>

#include "forceshade/certificate.h"
#include "forceshade/fast.h"
#include "forceshade/reference.h"
#include "properties/law_claims.h"
#include "report/plot_text.h"

namespace forceshade::properties {

struct Drawn {
  LawId id;
  Parameters parameters;
  Findings findings;  // of a certificate; else none
  fast::Law law;
  reference::Law reference;
  LawClaims shape;

  // Throws Error if the parameters are outside the law's domain.
  Drawn(LawId id, const Parameters& parameters, Findings findings = {});

  std::string name() const { return std::string(name_of(id)); }
  // Half of the width shown, mm: the bump and a little of the plane beside it.
  double reach() const;
  double surface(double x) const { return static_cast<double>(shape.surface(static_cast<long double>(x))); }
};

// Each law of the certificate, as it was first certified.
std::vector<Drawn> drawn(const Certificate& certificate);

bool contains(const std::vector<Drawn>& laws, std::initializer_list<LawId> ids);

// Panels are compared by eye only if they share their axes, and can share them only if the laws are of one size.
bool are_one_size(const std::vector<Drawn>& laws);

struct Heights {
  double low, high;  // mm
};

// The heights that a map over x and z shows of the law: the surface and some way into it.
Heights heights(const Drawn& drawn);

struct Sample {
  float x;
  bool after_jump;  // the force may have jumped since the one before
};

// Evenly spaced, and close to both sides of every line on which the force jumps.
std::vector<Sample> across(const Drawn& drawn);

}  // namespace forceshade::properties
