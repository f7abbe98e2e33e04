// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Types in place of float, double, bool and 64-bit words which write down, in the language of Coq, what code does with them.
// Where the code branches, it runs again for each way on: the result is the tree of all of them.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "tests/proofs/writing.h"

namespace forceshade::tests {

using Node = std::size_t;

// The decisions of one run of the code, the first of them given.
class Way {
 public:
  explicit Way(std::vector<int> given) : choices_(std::move(given)) { current_ = this; }
  Way(const Way&) = delete;
  Way& operator=(const Way&) = delete;
  ~Way() { current_ = nullptr; }

  static Way& current() { return *current_; }

  // One of as many ways on as the text of a `match` has; the same one where the same is asked again.
  int choose(const std::string& text, Node asked) {
    for (std::size_t i = 0; i < asked_.size(); ++i)
      if (asked_[i].node == asked) return choices_[i];
    if (asked_.size() == choices_.size()) choices_.push_back(0);
    asked_.push_back({text, asked});
    return choices_[asked_.size() - 1];
  }

  // The node that `code` gives, by all ways that begin with these choices.
  static Node tree(const std::function<Node()>& code, const std::vector<int>& given = {}) {
    std::vector<Asked> asked;
    std::vector<int> choices;
    Node result;
    {
      Way way(given);
      result = code();
      asked = way.asked_;
      choices = way.choices_;
    }
    for (std::size_t at = asked.size(); at-- > given.size();) {
      std::vector<Node> operands{asked[at].node, result};
      for (int choice = 1; choice < count(asked[at].text); ++choice) {
        std::vector<int> other(choices.begin(), choices.begin() + static_cast<std::ptrdiff_t>(at));
        other.push_back(choice);
        operands.push_back(tree(code, other));
      }
      if (std::any_of(operands.begin() + 2, operands.end(), [&](Node other) { return other != result; }))
        result = Writing::current().node(asked[at].text, operands);
    }
    return result;
  }

 private:
  struct Asked {
    std::string text;
    Node node;
  };
  static int count(const std::string& text) { return static_cast<int>(std::count(text.begin(), text.end(), '%')) - 1; }

  static inline Way* current_ = nullptr;

  std::vector<int> choices_;
  std::vector<Asked> asked_;
};

// A constant, or a node.
template <class Value>
struct Kept {
  Value value{};
  bool is_constant = true;
  Node node = 0;
};

inline Node written(const std::string& text, const std::vector<Node>& operands = {}) {
  return Writing::current().node(text, operands);
}

class WrittenBool {
 public:
  constexpr WrittenBool(bool value = false) : kept_{value} {}  // NOLINT: as bool has
  static WrittenBool of(Node node) { return WrittenBool(Kept<bool>{false, false, node}); }
  Node node() const { return kept_.is_constant ? written(kept_.value ? "true" : "false") : kept_.node; }

  constexpr explicit operator bool() const {
    return kept_.is_constant ? kept_.value : Way::current().choose("if % then % else %", kept_.node) == 0;
  }
  friend constexpr WrittenBool operator!(const WrittenBool& a) {
    return a.kept_.is_constant ? WrittenBool(!a.kept_.value) : of(written("negb %", {a.kept_.node}));
  }
  friend WrittenBool operator&(const WrittenBool& a, const WrittenBool& b) {
    return of(written("andb % %", {a.node(), b.node()}));
  }
  friend WrittenBool operator|(const WrittenBool& a, const WrittenBool& b) {
    return of(written("orb % %", {a.node(), b.node()}));
  }

 private:
  constexpr explicit WrittenBool(const Kept<bool>& kept) : kept_(kept) {}
  Kept<bool> kept_;
};

// The bits of a number, and arithmetic with them modulo 2^kBits.
template <int kBits>
class WrittenWord {
 public:
  using Value = std::conditional_t<kBits == 32, std::uint32_t, std::uint64_t>;
  constexpr WrittenWord() = default;
  template <class T>
  requires std::is_integral_v<T>
  constexpr WrittenWord(T value) : kept_{static_cast<Value>(value)} {}  // NOLINT: as an integer has
  static WrittenWord of(Node node) {
    WrittenWord result;
    result.kept_ = {0, false, node};
    return result;
  }
  Node node() const { return kept_.is_constant ? written(std::to_string(kept_.value)) : kept_.node; }

  friend constexpr WrittenWord operator+(const WrittenWord& a, const WrittenWord& b) {
    return both(a, b) ? WrittenWord(a.kept_.value + b.kept_.value) : modulo("Z.add", a, b);
  }
  friend constexpr WrittenWord operator-(const WrittenWord& a, const WrittenWord& b) {
    return both(a, b) ? WrittenWord(a.kept_.value - b.kept_.value) : modulo("Z.sub", a, b);
  }
  friend WrittenWord operator&(const WrittenWord& a, const WrittenWord& b) {
    return of(written("Z.land % %", {a.node(), b.node()}));
  }
  friend WrittenBool operator<=(const WrittenWord& a, const WrittenWord& b) {
    return WrittenBool::of(written("Z.leb % %", {a.node(), b.node()}));
  }
  friend WrittenBool operator>=(const WrittenWord& a, const WrittenWord& b) { return b <= a; }
  friend WrittenBool operator==(const WrittenWord& a, const WrittenWord& b) {
    return WrittenBool::of(written("Z.eqb % %", {a.node(), b.node()}));
  }

 private:
  static constexpr bool both(const WrittenWord& a, const WrittenWord& b) { return a.kept_.is_constant && b.kept_.is_constant; }
  static WrittenWord modulo(const std::string& text, const WrittenWord& a, const WrittenWord& b) {
    return of(written("Z.modulo (" + text + " % %) (2 ^ " + std::to_string(kBits) + ")", {a.node(), b.node()}));
  }
  Kept<Value> kept_;
};

// A number of binary32 or binary64.
template <int kBits>
class WrittenFloat {
  static constexpr bool kShort = kBits == 32;

 public:
  using Value = std::conditional_t<kShort, float, double>;
  constexpr WrittenFloat() = default;
  template <class T>
  requires std::is_arithmetic_v<T>
  constexpr WrittenFloat(T value) : kept_{static_cast<Value>(value)} {}  // NOLINT: as float and double have
  template <int kOther>
  requires(kOther != kBits) constexpr explicit(kShort)
      WrittenFloat(const WrittenFloat<kOther>& other)  // NOLINT: as float and double have
      : kept_{static_cast<Value>(other.kept_.value), other.kept_.is_constant,
              other.kept_.is_constant ? 0 : written(kShort ? "to32 %" : "to64 %", {other.kept_.node})} {}
  static WrittenFloat of(Node node) {
    WrittenFloat result;
    result.kept_ = {0, false, node};
    return result;
  }
  Node node() const { return kept_.is_constant ? written(constant_text()) : kept_.node; }
  constexpr bool is_constant() const { return kept_.is_constant; }
  constexpr Value value() const { return kept_.value; }
  constexpr explicit operator int() const {
    return kept_.is_constant ? static_cast<int>(kept_.value) : throw "expected a constant";
  }

  friend constexpr WrittenFloat operator-(const WrittenFloat& a) {
    return a.is_constant() ? WrittenFloat(-a.value()) : of(written(kShort ? "b32_opp %" : "opp %", {a.node()}));
  }
  friend constexpr WrittenFloat operator+(const WrittenFloat& a, const WrittenFloat& b) {
    return both(a, b) ? WrittenFloat(a.value() + b.value())
                      : of(written(kShort ? "b32_plus mode_NE % %" : "plus % %", {a.node(), b.node()}));
  }
  friend constexpr WrittenFloat operator-(const WrittenFloat& a, const WrittenFloat& b) {
    return both(a, b) ? WrittenFloat(a.value() - b.value())
                      : of(written(kShort ? "b32_minus mode_NE % %" : "minus % %", {a.node(), b.node()}));
  }
  friend constexpr WrittenFloat operator*(const WrittenFloat& a, const WrittenFloat& b) {
    return both(a, b) ? WrittenFloat(a.value() * b.value())
                      : of(written(kShort ? "b32_mult mode_NE % %" : "times % %", {a.node(), b.node()}));
  }
  friend constexpr WrittenFloat operator/(const WrittenFloat& a, const WrittenFloat& b) {
    return both(a, b) ? WrittenFloat(a.value() / b.value())
                      : of(written(kShort ? "b32_div mode_NE % %" : "over % %", {a.node(), b.node()}));
  }
  WrittenFloat& operator+=(const WrittenFloat& other) { return *this = *this + other; }
  WrittenFloat& operator-=(const WrittenFloat& other) { return *this = *this - other; }
  WrittenFloat& operator*=(const WrittenFloat& other) { return *this = *this * other; }
  friend constexpr WrittenBool operator<(const WrittenFloat& a, const WrittenFloat& b) {
    return both(a, b) ? WrittenBool(a.value() < b.value()) : compared("is_less", a, b);
  }
  friend constexpr WrittenBool operator<=(const WrittenFloat& a, const WrittenFloat& b) {
    return both(a, b) ? WrittenBool(a.value() <= b.value()) : compared("is_at_most", a, b);
  }
  friend constexpr WrittenBool operator==(const WrittenFloat& a, const WrittenFloat& b) {
    return both(a, b) ? WrittenBool(a.value() == b.value()) : compared("is_equal", a, b);
  }
  friend constexpr WrittenBool operator>(const WrittenFloat& a, const WrittenFloat& b) { return b < a; }
  friend constexpr WrittenBool operator>=(const WrittenFloat& a, const WrittenFloat& b) { return b <= a; }
  friend constexpr WrittenBool operator!=(const WrittenFloat& a, const WrittenFloat& b) { return !(a == b); }

 private:
  template <int>
  friend class WrittenFloat;
  static constexpr bool both(const WrittenFloat& a, const WrittenFloat& b) { return a.is_constant() && b.is_constant(); }
  static WrittenBool compared(const std::string& name, const WrittenFloat& a, const WrittenFloat& b) {
    return WrittenBool::of(written(name + (kShort ? "32 % %" : " % %"), {a.node(), b.node()}));
  }
  std::string constant_text() const;
  Kept<Value> kept_;
};
using Written32 = WrittenFloat<32>;
using Written64 = WrittenFloat<64>;

// As definitions of proofs/ write them: those of binary32 have names, whole numbers and powers of two texts of their own.
template <int kBits>
std::string WrittenFloat<kBits>::constant_text() const {
  const double value = static_cast<double>(kept_.value);
  if (value == 0 && !std::signbit(value)) return kShort ? "zero32" : "zero64";
  if (kShort && (value == 2 || value == 1e4 || value == 0x1p-30))
    return value == 2 ? "two32" : value == 1e4 ? "ten_thousand" : "quantum";
  if (!kShort && (value == 1 + 0x1p-40 || value == 1 - 0x1p-50)) return value > 1 ? "slack" : "almost_one";
  if (value == std::numeric_limits<double>::infinity() && !kShort) return "(B754_infinity 53 1024 false)";
  if (kShort || value == 0 || !std::isfinite(value))
    throw std::runtime_error("found a constant without a text: " + std::to_string(value));
  if (value == std::floor(value) && std::fabs(value) < 0x1p53)
    return "(whole (" + std::to_string(static_cast<std::int64_t>(value)) + "))";
  int exponent = 0;
  double significand = std::frexp(value, &exponent);
  for (; significand != std::floor(significand); --exponent) significand *= 2;
  const std::string power = " (" + std::to_string(exponent) + "))";
  return significand == 1 ? "(two_to" + power
                          : "(constant (" + std::to_string(static_cast<std::int64_t>(significand)) + ")" + power;
}

inline Written32 absolute_of(const Written32& a) {
  return Written32::of(written("b32_abs %", {a.node()}));
}
inline Written64 absolute_of(const Written64& a) {
  return Written64::of(written("absolute %", {a.node()}));
}
inline Written64 root_of(const Written64& a) {
  return Written64::of(written("square_root %", {a.node()}));
}
constexpr WrittenWord<32> bits_of(const Written32& a) {
  return a.is_constant() ? WrittenWord<32>(std::bit_cast<std::uint32_t>(a.value()))
                         : WrittenWord<32>::of(written("bits_of_b32 %", {a.node()}));
}
constexpr WrittenWord<64> bits_of(const Written64& a) {
  return a.is_constant() ? WrittenWord<64>(std::bit_cast<std::uint64_t>(a.value()))
                         : WrittenWord<64>::of(written("bits_of_b64 %", {a.node()}));
}

}  // namespace forceshade::tests

// Functions of the standard library, of these types.
namespace std {
using WrittenWord64 = forceshade::tests::WrittenWord<64>;
using WrittenWord32 = forceshade::tests::WrittenWord<32>;
inline forceshade::tests::Written32 nextafter(const forceshade::tests::Written32& a,
                                              const forceshade::tests::Written32& towards) {
  if (!std::isinf(towards.value())) throw std::runtime_error("expected a neighbour on the way to infinity");
  return forceshade::tests::Written32::of(
      forceshade::tests::written(towards.value() > 0 ? "next_above %" : "next_below %", {a.node()}));
}
inline forceshade::tests::Written64 fma(const forceshade::tests::Written64& a, const forceshade::tests::Written64& b,
                                        const forceshade::tests::Written64& c) {
  return forceshade::tests::Written64::of(forceshade::tests::written("fused % % %", {a.node(), b.node(), c.node()}));
}
inline forceshade::tests::Written64 fabs(const forceshade::tests::Written64& a) {
  return absolute_of(a);
}
inline forceshade::tests::Written64 sqrt(const forceshade::tests::Written64& a) {
  return root_of(a);
}
// Rounded as the product by the power of two is.
inline forceshade::tests::Written64 ldexp(const forceshade::tests::Written64& a, int k) {
  return std::exp2(k) * a;
}
}  // namespace std
