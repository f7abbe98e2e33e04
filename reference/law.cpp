// SPDX-License-Identifier: BSD-3-Clause
#include <optional>
#include <type_traits>

#include "forceshade/reference.h"
#include "reference/estimates.h"
#include "reference/laws/slow_geometry.h"
#include "reference/laws/with_law.h"
#include "reference/numbers/decimal.h"
#include "reference/numbers/enclosure192.h"
#include "reference/numbers/tie.h"
#include "reference/position.h"
#include "rendering/control_words.h"

namespace forceshade::reference {

struct LawGeometry {
  BumpGeometry<Ball64> in_64_bits;
  BumpGeometry<Enclosure192> in_192_bits;
};

namespace {

struct Point {
  double x, z;

  explicit Point(const Eigen::Vector3f& position) : x(quantised(position.x())), z(quantised(position.z())) {}
};

// Throws Undecided where N does not decide. facet: is set where N decides it at least, and is believed where it is set.
template <class N>
Force<N> force_at(LawId id, const BumpGeometry<N>& geometry, const Point& point, std::optional<Facet>& facet) {
  return with_law(id, [&](auto law) {
    const N x(point.x), z(point.z);
    if (!facet) facet = law.template facet<N>(geometry, x, z);
    return law.template force<N>(*facet, geometry, x, z);
  });
}

FlatTop flat_top_of(LawId id) {
  return with_law(id, [](auto law) {
    return std::is_same_v<typename decltype(law)::Surface, ThreePolygons> ? FlatTop::needed : FlatTop::not_needed;
  });
}

// The exact facet and force at one point. Not for more than one thread at a time; holds CORE numbers, so it is made and
// destroyed under the lock. They take the longest, and are made where nothing else decides.
class SlowForce {
 public:
  // facet: where a proved enclosure has decided it.
  SlowForce(LawId id, const Parameters& p, const Point& point, std::optional<Facet> facet = std::nullopt)
      : id_(id), parameters_(p), point_(point), top_(flat_top_of(id)) {
    facet_ =
        facet ? *facet
              : with_law(id, [&](auto law) { return law.template facet<Exact>(geometry(), Exact(point.x), Exact(point.z)); });
  }

  Facet facet() const { return facet_; }

  // At the precision in force.
  Force<Enclosure> enclose() const {
    return with_law(id_, [&](auto law) {
      return law.template force<Enclosure>(facet_, enclosing_geometry(parameters_, top_), Enclosure(point_.x),
                                           Enclosure(point_.z));
    });
  }

  Force<Exact> exact() const {
    return with_law(id_,
                    [&](auto law) { return law.template force<Exact>(facet_, geometry(), Exact(point_.x), Exact(point_.z)); });
  }

 private:
  const BumpGeometry<Exact>& geometry() const {
    if (!geometry_) geometry_ = exact_geometry(parameters_, top_);
    return *geometry_;
  }

  LawId id_;
  Parameters parameters_;
  Point point_;
  FlatTop top_;
  mutable std::optional<BumpGeometry<Exact>> geometry_;
  Facet facet_;
};

// answer(facet, force) in the first of the numbers of 64 and of 192 bits that decide all of it, else slowly(force), under the
// lock.
template <class Answer, class Slowly>
auto first_decided(const Law& law, const LawGeometry& geometry, const Point& point, const Answer& answer,
                   const Slowly& slowly) {
  std::optional<Facet> facet;
  try {
    return answer(facet, force_at(law.id(), geometry.in_64_bits, point, facet));
  } catch (const Undecided&) {
  }
  try {
    return answer(facet, force_at(law.id(), geometry.in_192_bits, point, facet));
  } catch (const Undecided&) {
  }
  const std::lock_guard lock(exact_arithmetic);
  return slowly(SlowForce(law.id(), law.parameters(), point, facet));
}

// By an enclosure of 768 bits; what that leaves open the exact numbers decide.
Rounded round_slowly(const SlowForce& force) {
  if (force.facet() == Facet::none) return {{0, 0, 0}, Status::free, Method::exact};
  set_precision(768);
  const Force<Enclosure> enclosed = force.enclose();
  const RoundedEnds x(enclosed.x), z(enclosed.z);
  return {{x.decided([&](double tie) { return (force.exact().x - Exact(tie)).sign(); }), 0,
           z.decided([&](double tie) { return (force.exact().z - Exact(tie)).sign(); })},
          Status::contact,
          x.agree() && z.agree() ? Method::enclosure : Method::exact,
          0};
}

std::optional<ParameterError> first_error(LawId id, const Parameters& p) {
  const auto check = [](const char* name, const char* unit, float value, float low, float high) {
    return value >= low && value <= high ? std::nullopt : std::optional(ParameterError{name, unit, value, low, high});
  };
  if (has_bump_geometry(id)) {
    if (const auto error = check("radius", "mm", p.radius, 0.1F, 10000.0F)) return error;
    if (const auto error = check("width", "mm", p.width, 0.001F, 2 * p.radius)) return error;
  }
  return check("stiffness", "N/mm", p.stiffness, 0.001F, 1000.0F);
}

}  // namespace

void set_precision(unsigned bits) {
  // Boost counts decimal digits and rounds up to bits again.
  const unsigned digits = static_cast<unsigned>(static_cast<unsigned long>(bits) * 301 / 1000) + 1;
  Enclosure::default_precision(digits);
  Multiprecision::default_precision(digits);
}

DecimalGeometry geometry(const Parameters& p, unsigned digits) {
  const ExactArithmetic with_all_bits;
  const std::lock_guard lock(exact_arithmetic);
  const BumpGeometry<Exact> exact = exact_geometry(p);
  const auto member = [&](Enclosure BumpGeometry<Enclosure>::*enclosed, Exact BumpGeometry<Exact>::*value) {
    return correctly_rounded(
        digits, [&] { return enclosing_geometry(p).*enclosed; },
        [&](const CORE::BigRat& q) { return (exact.*value - Exact(q)).sign(); });
  };
  using E = BumpGeometry<Enclosure>;
  using X = BumpGeometry<Exact>;
  // θ is a rational multiple of π or transcendental: it never ties.
  return {member(&E::d, &X::d), member(&E::h, &X::h), member(&E::w_prime, &X::w_prime), member(&E::h_prime, &X::h_prime),
          correctly_rounded(
              digits, [&] { return enclosing_theta(p); }, [](const CORE::BigRat&) { return 1; })};
}

std::variant<Law, ParameterError> Law::build(LawId id, const Parameters& p) {
  const ExactArithmetic with_all_bits;
  if (const auto error = first_error(id, p)) return *error;
  Parameters used = p;
  if (!has_bump_geometry(id)) used.radius = used.width = 1;  // never looked at
  const std::lock_guard lock(exact_arithmetic);
  set_precision(512);
  const BumpGeometry<Enclosure> geometry = enclosing_geometry(used);
  return Law(id, used,
             std::make_shared<const LawGeometry>(
                 LawGeometry{converted(geometry, to_64_bits<Enclosure>),
                             converted(geometry, [](const Enclosure& value) { return Enclosure192(value); })}));
}

const BumpGeometry<Ball64>& Law::geometry() const {
  return geometry_->in_64_bits;
}

Rounded Law::round_to_binary32(const Eigen::Vector3f& position) const {
  const ExactArithmetic with_all_bits;
  if (!in_domain(position)) return {{0, 0, 0}, Status::invalid, Method::filter};
  const auto rounded = []<class N>(const std::optional<Facet>& facet, const Force<N>& force) -> Rounded {
    constexpr bool is_filter = std::is_same_v<N, Ball64>;
    constexpr Method method = is_filter ? Method::filter : Method::enclosure;
    if (facet == Facet::none) return {{0, 0, 0}, Status::free, method};
    const float x = force.x.round(), z = force.z.round();
    const auto ulps = [&] { return std::min(ulps_from_tie(to_64_bits(force.x), x), ulps_from_tie(to_64_bits(force.z), z)); };
    return {{x, 0, z}, Status::contact, method, is_filter ? ulps() : 0};
  };
  return first_decided(*this, *geometry_, Point(position), rounded, round_slowly);
}

DecimalForce Law::decimal(const Eigen::Vector3f& position, unsigned digits) const {
  const ExactArithmetic with_all_bits;
  if (!in_domain(position)) return {"0", "0", Status::invalid};
  const std::lock_guard lock(exact_arithmetic);
  const SlowForce force(id_, parameters_, Point(position));
  if (force.facet() == Facet::none) return {"0", "0", Status::free};
  const auto component = [&](Enclosure Force<Enclosure>::*enclosed, Exact Force<Exact>::*exact) -> std::string {
    return correctly_rounded(
        digits, [&] { return force.enclose().*enclosed; },
        [&](const CORE::BigRat& q) { return (force.exact().*exact - Exact(q)).sign(); });
  };
  return {component(&Force<Enclosure>::x, &Force<Exact>::x), component(&Force<Enclosure>::z, &Force<Exact>::z),
          Status::contact};
}

int Law::compare(const Eigen::Vector3f& position, std::size_t axis, const std::string& rational) const {
  const ExactArithmetic with_all_bits;
  const std::lock_guard lock(exact_arithmetic);
  const Exact other{CORE::BigRat(rational)};
  if (!in_domain(position)) return (Exact(0) - other).sign();
  const SlowForce force(id_, parameters_, Point(position));
  if (force.facet() == Facet::none) return (Exact(0) - other).sign();
  const Force<Exact> exact = force.exact();
  return ((axis == 0 ? exact.x : exact.z) - other).sign();
}

Law::Estimate Law::estimate(const Eigen::Vector3f& position) const {
  const ExactArithmetic with_all_bits;
  const auto estimated = [](const std::optional<Facet>& facet, const auto& force) -> Estimate {
    return {*facet, {to_64_bits(force.x), to_64_bits(force.z), to_64_bits(force.magnitude)}};
  };
  return first_decided(*this, *geometry_, Point(position), estimated, [&](const SlowForce& slow) {
    set_precision(256);
    return estimated(slow.facet(), slow.enclose());
  });
}

}  // namespace forceshade::reference
