// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The headers of a single call, compiled with types that write down what is done with them (tests/proofs/written_code.h) in
// place of float, double, bool and unsigned words, and with terms in place of the balls that laws compute with. Nothing of the
// library can be linked to it.

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fast/numbers/inline.h"
#include "forceshade/session.h"
#include "tests/proofs/written_code.h"

namespace forceshade {
struct WrittenParameters {
  tests::Written32 radius, width, stiffness;
};
}  // namespace forceshade
namespace Eigen {
struct WrittenVector {
  std::array<forceshade::tests::Written32, 3> numbers;
  forceshade::tests::Written32 x() const { return numbers[0]; }
  forceshade::tests::Written32 y() const { return numbers[1]; }
  forceshade::tests::Written32 z() const { return numbers[2]; }
};
}  // namespace Eigen
namespace forceshade::fast {
struct WrittenEvaluation {
  Eigen::WrittenVector force{};
  Status status = Status::free;
  Stage stage = Stage::binary64;
};
}  // namespace forceshade::fast

// Numbers of the later stages: terms of a ball N (proofs/code/Balls.v). kLimbs tells the second stage from the third.
namespace forceshade::fast {
enum class Sign;
}
namespace forceshade::tests {

const char* const kSigns = "match % with is_negative => % | is_zero => % | is_positive => % | is_unknown => % end";
inline fast::Sign sign_by(Node node) {
  return static_cast<fast::Sign>(Way::current().choose(kSigns, node));
}

template <std::size_t kLimbs>
class Ball {
 public:
  static const int kNewtonSteps;
  static inline std::string in = "N";

  Written64 hi, lo;

  static Ball of(Node node) { return Ball(node); }
  static Ball exactly(const Written64& value) { return made("exactly_in", {value.node()}); }
  Node node() const { return node_; }
  static constexpr bool kNamesNewton = kLimbs < 3;  // newton_root() is a term

  Ball operator-() const { return made("minus_in", {node_}); }
  friend Ball operator+(const Ball& a, const Ball& b) { return made("sum_in", {a.node_, b.node_}); }
  friend Ball operator-(const Ball& a, const Ball& b) { return a + (-b); }
  friend Ball operator*(const Ball& a, const Ball& b) { return made("product_in", {a.node_, b.node_}); }
  friend Ball operator/(const Ball& a, const Ball& b) { return made("quotient_in", {a.node_, b.node_}); }
  friend Ball square_root(const Ball& a) { return made("root_in", {a.node_}); }
  friend fast::Sign sign(const Ball& a) { return sign_by(written("sign_in " + in + " %", {a.node_})); }
  friend Ball truncated(const Ball& a, std::int64_t bits) {
    return made("truncated_in", {a.node_}, " (" + std::to_string(bits) + ")");
  }
  friend Ball widened(const Ball& a, int k) { return made("widened_in", {a.node_}, " (" + std::to_string(k) + ")"); }
  friend Written64 approximately(const Ball& a) { return Written64::of(written("approximation_in " + in + " %", {a.node_})); }
  // The search for the nearest number of binary32, which is recorded by itself.
  friend std::optional<Written32> round_to_binary32(const Ball& a) {
    const Node found = written("nearest_in " + in + " %", {a.node_});
    if (!WrittenBool::of(written("is_given %", {found}))) return std::nullopt;
    return Written32::of(written("given %", {found}));
  }

 private:
  explicit Ball(Node node)
      : hi(Written64::of(written("hi %", {node}))), lo(Written64::of(written("lo %", {node}))), node_(node) {}
  static Ball made(const std::string& name, const std::vector<Node>& operands, const std::string& rest = "") {
    std::string text = name + " " + in;
    for (std::size_t i = 0; i < operands.size(); ++i) text += " %";
    return Ball(written(text + rest, operands));
  }
  Node node_;
};

}  // namespace forceshade::tests
namespace forceshade::fast {
using DoubleDouble = tests::Ball<0>;
template <std::size_t kLimbs>
using BigFloatBall = tests::Ball<kLimbs>;
}  // namespace forceshade::fast

#define float ::forceshade::tests::Written32
#define double ::forceshade::tests::Written64
#define bool ::forceshade::tests::WrittenBool
#define uint64_t WrittenWord64
#define uint32_t WrittenWord32
#define __builtin_fabs absolute_of
#define __builtin_fabsf absolute_of
#define __builtin_sqrt root_of
#define __builtin_bit_cast(type, value) bits_of(value)
#define noexcept
#define Vector3f WrittenVector
#define Parameters WrittenParameters
#define Evaluation WrittenEvaluation

// A function that is recorded by itself has another name here, and is a term for those that call it.
#define DoubleDouble WholeDoubleDouble
#include "fast/numbers/double_double.h"
#undef DoubleDouble
namespace forceshade::tests {
// The term that templates get which call it.
inline fast::Terms<Written64> two_sum(const Written64& a, const Written64& b) {
  const Node both = written("two_sum % %", {a.node(), b.node()});
  return {Written64::of(written("fst %", {both})), Written64::of(written("snd %", {both}))};
}
}  // namespace forceshade::tests
#define in_domain whole_in_domain
#define quantised whole_quantised
#include "fast/domain.h"
#undef in_domain
#undef quantised
#define rounding_is_in_doubt whole_rounding_is_in_doubt
#include "fast/numbers/first_stage.h"
#undef rounding_is_in_doubt

namespace forceshade::fast {
inline int exact_sign(const std::array<double, 8>& terms) {
  std::vector<std::size_t> nodes;
  for (const double& term : terms) nodes.push_back(term.node());
  const std::size_t sign = tests::written("Z.compare (exact_sign [%; %; %; %; %; %; %; %]) 0", nodes);
  return tests::Way::current().choose("match % with Lt => % | Eq => % | Gt => % end", sign) - 1;
}
template <class N, class F, class Derivative>
requires(N::kNamesNewton) N newton_root(double start, int steps, const F& f, const Derivative& derivative) {
  const N y = N::of(tests::written("y"));
  const auto function = [](const N& value) { return " (fun y => " + tests::Writing::current().text(value.node()) + ")"; };
  return N::of(tests::written("newton_root_by_" + std::to_string(steps) + function(f(y)) + function(derivative(y)) + " %",
                              {start.node()}));
}
inline float largest_on_top(float radius, float width, const DoubleDouble& half_top) {
  return float ::of(tests::written("largest_on_top % % %", {radius.node(), width.node(), half_top.node()}));
}
}  // namespace forceshade::fast
#define largest_on_top whole_largest_on_top
#include "fast/laws/top_edge.h"
#undef largest_on_top

namespace forceshade::fast {
inline bool in_domain(float coordinate) {
  return bool ::of(tests::written("in_domain %", {coordinate.node()}));
}
inline float quantised(float coordinate) {
  return float ::of(tests::written("quantised %", {coordinate.node()}));
}
template <int kWindow>
bool rounding_is_in_doubt(double value) {
  static_assert(kWindow == doubt_window(0x1p-50), "that of the law in print_evaluate()");
  return bool ::of(tests::written("in_doubt window (bits_of_b64 %)", {value.node()}));
}
}  // namespace forceshade::fast
#undef float
#undef double
#undef bool
#undef uint64_t
#undef uint32_t
#define BigFloatBall WholeBigFloatBall
#include "fast/numbers/big_float_ball.h"
#undef BigFloatBall
#define float ::forceshade::tests::Written32
#define double ::forceshade::tests::Written64
#define bool ::forceshade::tests::WrittenBool
#define uint64_t WrittenWord64
#define uint32_t WrittenWord32
#include "fast/evaluate.h"
#include "fast/laws/all.h"
#include "tests/proofs/members.h"

namespace forceshade::fast {
// Newton's method is recorded by itself, with two kinds of balls; laws have its result.
template <>
inline tests::Ball<0> sine_of_third<tests::Ball<0>>(float, float) {
  return tests::Ball<0>::of(tests::written("t"));
}
}  // namespace forceshade::fast

#undef float
#undef double
#undef bool
#undef noexcept
#undef Parameters

template <std::size_t kLimbs>
const int forceshade::tests::Ball<kLimbs>::kNewtonSteps =
    kLimbs <= 1 ? fast::WholeDoubleDouble::kNewtonSteps : fast::WholeBigFloatBall<4>::kNewtonSteps;
