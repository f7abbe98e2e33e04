// SPDX-License-Identifier: BSD-3-Clause
#include "reference/consecutive_floats.h"

#include <algorithm>
#include <cmath>

#include "reference/estimates.h"
#include "reference/laws/with_law.h"
#include "reference/numbers/taylor.h"
#include "reference/position.h"

namespace forceshade::reference {
namespace {

constexpr std::size_t kFewest = 16;  // positions worth a Taylor number

// mm, for 2|x| <= w.
template <class N>
N nominal_height(LawId id, const BumpGeometry<N>& g, const N& x) {
  return with_law(id, [&](auto law) { return N(decltype(law)::Surface::height_at(g, x)); });
}

BumpGeometry<Taylor> taylor_geometry(const BumpGeometry<Ball64>& g) {
  return {Taylor(g.R), Taylor(g.w), Taylor(g.K), Taylor(g.d), Taylor(g.h), Taylor(g.w_prime), Taylor(g.h_prime)};
}

// Part of a run: `count` positions, a power of two, none of them 0 and all of one binade.
struct Section {
  std::uint32_t first;
  std::size_t begin, count;  // within the run

  float coordinate(std::size_t i) const { return coordinate_of_run(first, begin + i); }

  // The coordinate as a function of s in [-1, 1]; the i-th one is at place(i, count).
  Taylor variable() const {
    const double low = static_cast<double>(coordinate(0)), high = static_cast<double>(coordinate(count - 1));
    const double reach = (high - low) / static_cast<double>(count - 1) * (static_cast<double>(count) / 2);
    return Taylor::variable((low + high) / 2, reach);
  }

  Section half(std::size_t which) const { return {first, begin + which * (count / 2), count / 2}; }
};

double place(std::size_t i, std::size_t count) {
  return (2 * static_cast<double>(static_cast<int>(i)) + 1 - static_cast<double>(count)) / static_cast<double>(count);
}

// A Taylor number in binary64: at(s) is within `absolute` + 2^-51·|at(s)| of the function.
struct Cubic {
  double high, low, c1, c2, c3, absolute;

  explicit Cubic(const Taylor& t)
      : high(static_cast<double>(t.coefficient(0))),
        low(static_cast<double>(t.coefficient(0) - static_cast<long double>(high))),
        c1(static_cast<double>(t.coefficient(1))),
        c2(static_cast<double>(t.coefficient(2))),
        c3(static_cast<double>(t.coefficient(3))),
        absolute(static_cast<double>(t.rest()) * (1 + 0x1p-50) +
                 0x1p-50 * (std::fabs(low) + std::fabs(c1) + std::fabs(c2) + std::fabs(c3)) + 0x1p-100 * std::fabs(high)) {}

  double at(double s) const { return high + (low + s * (c1 + s * (c2 + s * c3))); }
  double error(double value) const { return absolute + 0x1p-51 * std::fabs(value); }

  // Leaves fewer than one rounding in 2^12 open.
  bool is_sharp() const { return absolute <= 0x1p-38 * std::fabs(high); }
};

// Rounds the cubic's values; true where the error leaves the rounding open.
void round_cubic(const Cubic& cubic, std::size_t count, float* rounded, bool* open) {
  for (std::size_t i = 0; i < count; ++i) {
    const double value = cubic.at(place(i, count));
    const double error = cubic.error(value);
    const auto low = static_cast<float>(value - error), high = static_cast<float>(value + error);
    rounded[i] = low + 0.0F;
    open[i] = open[i] || low != high;
  }
}

class Rounder {
 public:
  Rounder(const Law& law, Along along, float fixed)
      : law_(law), geometry_(taylor_geometry(law.geometry())), along_(along), fixed_(fixed) {}

  RoundedRun round(std::uint32_t first) {
    round({first, 0, kRun});
    return run_;
  }

 private:
  Eigen::Vector3f position(float coordinate) const {
    return along_ == Along::x ? Eigen::Vector3f(coordinate, 0, fixed_) : Eigen::Vector3f(fixed_, 0, coordinate);
  }

  void store(std::size_t i, const Rounded& one) {
    run_.x[i] = one.force.x();
    run_.z[i] = one.force.z();
    run_.status[i] = one.status;
  }

  void round_one(const Section& section, std::size_t i) {
    store(section.begin + i, law_.round_to_binary32(position(section.coordinate(i))));
    ++run_.one_by_one;
  }

  void round(const Section& section) {
    const float nearest = section.coordinate(0), farthest = section.coordinate(section.count - 1);
    // All the same: outside the domain, or read as 0.
    if (!in_domain(nearest) || !in_domain(fixed_) || std::fabs(farthest) < kPositionQuantum) {
      const Rounded one = law_.round_to_binary32(position(nearest));
      for (std::size_t i = 0; i < section.count; ++i) store(section.begin + i, one);
      return;
    }
    if (section.count < kFewest) {
      for (std::size_t i = 0; i < section.count; ++i) round_one(section, i);
      return;
    }
    if (!in_domain(farthest) || !round_together(section)) {
      round(section.half(0));
      round(section.half(1));
    }
  }

  // False where the Taylor number cannot decide the facet or is too blurred.
  bool round_together(const Section& section) try {
    const Taylor moving = section.variable();
    const Taylor still(std::fabs(fixed_) < kPositionQuantum ? 0.0 : static_cast<double>(fixed_));
    const Taylor& x = along_ == Along::x ? moving : still;
    const Taylor& z = along_ == Along::x ? still : moving;
    return with_law(law_.id(), [&](auto law) {
      const Facet facet = law.template facet<Taylor>(geometry_, x, z);
      if (facet == Facet::none) return true;  // as the run was made: free, zero
      const Force<Taylor> force = law.template force<Taylor>(facet, geometry_, x, z);
      const Cubic fx(force.x), fz(force.z);
      if (!fx.is_sharp() || !fz.is_sharp()) return false;
      std::array<bool, kRun> open{};
      round_cubic(fx, section.count, &run_.x[section.begin], open.data());
      round_cubic(fz, section.count, &run_.z[section.begin], open.data());
      std::fill_n(&run_.status[section.begin], section.count, Status::contact);
      for (std::size_t i = 0; i < section.count; ++i)
        if (open[i]) round_one(section, i);
      return true;
    });
  } catch (const Undecided&) {
    return false;
  }

  const Law& law_;
  BumpGeometry<Taylor> geometry_;
  Along along_;
  float fixed_;
  RoundedRun run_;
};

// The next position up or down: the next binary32, but nothing between the quantum and 0.
float next(float z, float towards) {
  if (z == 0) return std::copysign(kPositionQuantum, towards);
  const float neighbour = std::nextafter(z, towards);
  return std::fabs(neighbour) < kPositionQuantum ? 0.0F : neighbour;
}

class Surface {
 public:
  explicit Surface(const Law& law) : law_(law), geometry_(taylor_geometry(law.geometry())) {}

  SurfaceRun find(std::uint32_t first) {
    for (std::size_t i = 0; i < kRun && 2 * std::fabs(coordinate_of_run(first, i)) <= law_.parameters().width; ++i)
      ++run_.count;
    const float nearest = coordinate_of_run(first, 0), farthest = coordinate_of_run(first, kRun - 1);
    if (run_.count > 0 && std::fabs(farthest) < kPositionQuantum) {
      find_one(nearest, 0);
      run_.contact.fill(run_.contact[0]);
      run_.free.fill(run_.free[0]);
    } else if (run_.count < kRun) {
      for (std::size_t i = 0; i < run_.count; ++i) find_one(coordinate_of_run(first, i), i);
    } else {
      find({first, 0, kRun});
    }
    return run_;
  }

 private:
  bool is_contact(float x, float z) const { return law_.round_to_binary32({x, 0, z}).status == Status::contact; }

  // From a first guess, by testing positions beside it.
  void find_one(float x, std::size_t i) {
    ++run_.one_by_one;
    const double there = std::fabs(x) < kPositionQuantum ? 0.0 : static_cast<double>(x);
    float z = 0;
    try {
      z = static_cast<float>(nominal_height(law_.id(), law_.geometry(), Ball64(there)).mid());
    } catch (const Undecided&) {
      z = 0;  // on |x| = R
    }
    if (std::fabs(z) < kPositionQuantum) z = 0;
    while (is_contact(x, z)) z = next(z, 1e5F);
    while (!is_contact(x, z)) z = next(z, -1e5F);
    run_.contact[i] = z;
    run_.free[i] = next(z, 1e5F);
  }

  void find(const Section& section) {
    if (section.count < kFewest) {
      for (std::size_t i = 0; i < section.count; ++i) find_one(section.coordinate(i), section.begin + i);
    } else if (!find_together(section)) {
      find(section.half(0));
      find(section.half(1));
    }
  }

  bool find_together(const Section& section) try {
    const Cubic height(nominal_height(law_.id(), geometry_, section.variable()));
    if (!height.is_sharp()) return false;
    std::array<bool, kRun> open{};
    for (std::size_t i = 0; i < section.count; ++i) {
      const double value = height.at(place(i, section.count)), error = height.error(value);
      const auto nearest = static_cast<float>(value);
      const bool above = value - error > static_cast<double>(nearest), below = value + error < static_cast<double>(nearest);
      open[i] = !(above || below) || value < 2 * static_cast<double>(kPositionQuantum);
      // A positive binary32 and its neighbours are consecutive whole numbers.
      const auto bits = std::bit_cast<std::uint32_t>(nearest);
      run_.contact[section.begin + i] = std::bit_cast<float>(above ? bits : bits - 1);
      run_.free[section.begin + i] = std::bit_cast<float>(above ? bits + 1 : bits);
    }
    for (std::size_t i = 0; i < section.count; ++i)
      if (open[i]) find_one(section.coordinate(i), section.begin + i);
    return true;
  } catch (const Undecided&) {
    return false;
  }

  const Law& law_;
  BumpGeometry<Taylor> geometry_;
  SurfaceRun run_;
};

}  // namespace

RoundedRun round_run(const Law& law, Along along, float fixed, std::uint32_t first) {
  return Rounder(law, along, fixed).round(first);
}

SurfaceRun surface_run(const Law& law, std::uint32_t first) {
  return Surface(law).find(first);
}

}  // namespace forceshade::reference
