// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The operations of binary64 as expressions in one canonical form: what a header does and what its Gappa script states
// are equal here exactly if they are the same operations on the same operands, rounded at the same places.
//
// The form leaves open only what changes no bit of a result: the order of the two operands of a sum or product; signs and
// powers of two, which move out of every operation; sums with 0, products with 1; the rounding of a product whose factors
// have 53 bits at most together. All this but for underflow, which the scripts' domains exclude. Beyond it there are three
// theorems, applied where their pattern is met: a rounding error found by subtraction is exact (Dekker for sums of which the
// larger term is known, by fma for products), and so is the remainder of a quotient or root.

#include <map>
#include <set>
#include <string>
#include <vector>

namespace forceshade::tests {

// sign·2^exponent times the value of a node.
struct Scaled {
  int node = 0;
  int sign = 1;
  int exponent = 0;

  friend bool operator==(const Scaled&, const Scaled&) = default;
  Scaled operator-() const { return {node, -sign, exponent}; }
  Scaled times(int other_sign, int power) const { return {node, sign * other_sign, exponent + power}; }
};

class Expressions {
 public:
  Expressions();

  // On: every product of a fused operation is rounded too. For scripts that charge one rounding to the product and one to the
  // sum, which covers both.
  bool products_always_round = false;

  Scaled zero() const { return {kZero}; }
  // A number of at most `bits` bits.
  Scaled input(const std::string& name, int bits);
  bool is_input(const Scaled& a) const { return node(a).kind == Kind::input; }
  // From now on constants that are this one times a power of two are this expression.
  void name_constant(double value, const Scaled& expression);
  Scaled constant(double value);

  // Without rounding.
  Scaled sum(const Scaled& a, const Scaled& b);
  Scaled product(const Scaled& a, const Scaled& b);
  Scaled quotient(const Scaled& a, const Scaled& b);
  Scaled square_root(const Scaled& a);
  Scaled rounded(const Scaled& a);
  // The product and the sum of one fused operation.
  Scaled fused(const Scaled& a, const Scaled& b, const Scaled& c);

  // `a` is a binary64 number, and rounding it does nothing: for a script that argues so.
  void assume_binary64(const Scaled& a);
  // Dekker's condition holds for their sum and difference: `a` is not below `b` in size. Argued in docs/proofs.md.
  void assume_larger(const Scaled& a, const Scaled& b) { larger_.insert({a.node, b.node}); }

  // The value of an expression of rounded operations, given the inputs' values by node.
  double evaluate(const Scaled& a, const std::map<int, double>& inputs) const;

  // Leaves out what lies more than `depth` operations deep: shared parts would be written again and again.
  std::string text(const Scaled& a, int depth = 8) const;
  // The innermost place where two expressions differ; empty where they are equal.
  std::string difference(const Scaled& found, const Scaled& expected) const;

 private:
  enum class Kind { zero, one, input, constant, sum, product, quotient, root, residual };
  static constexpr int kZero = 0, kOne = 1, kMany = 1 << 20;

  struct Node {
    Kind kind;
    bool is_rounded;
    std::vector<Scaled> operands;
    std::string name;
    int bits;        // of a significand that holds every value
    int exact = -1;  // of a rounded node: what it rounds
  };

  int add(Node node);
  const Node& node(const Scaled& a) const { return nodes_[static_cast<std::size_t>(a.node)]; }
  bool is_zero(const Scaled& a) const { return a.node == kZero; }
  // The operands of a sum or of what it is times a power of two.
  std::vector<Scaled> terms(const Scaled& a) const;
  bool is_rounded(const Scaled& a, Kind kind) const { return node(a).kind == kind && node(a).is_rounded; }
  // The part of `a` that rounding took away.
  Scaled residual(const Scaled& a);
  bool is_remainder(const Scaled& from, const Scaled& less) const;
  // The theorems: the exact value of the rounded sum of two terms, if they know it; else zero's node.
  Scaled residual_of_sum(const Scaled& a, const Scaled& b);
  Scaled remainder_of_quotient(const Scaled& a, const Scaled& b);

  std::vector<Node> nodes_;
  std::map<std::string, int> known_;
  std::map<double, Scaled> named_;  // by odd significand
  std::set<std::pair<int, int>> larger_;
};

}  // namespace forceshade::tests
