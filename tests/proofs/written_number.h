// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A number that writes down, in the language of Coq, what is done with it: a Real in the sense of fast/numbers/first_stage.h,
// and of the templates of fast/numbers/double_double.h. Since a first stage selects and never branches, one run of it writes
// the whole of it, every case included.

#include <cstddef>
#include <string>
#include <vector>

#include "fast/numbers/first_stage.h"
#include "tests/proofs/writing.h"

namespace forceshade::tests {

class Written {
 public:
  struct Mask {
    std::size_t node = Writing::current().node("false");

    friend Mask operator&(const Mask& a, const Mask& b) { return {Writing::current().node("andb % %", {a.node, b.node})}; }
    friend Mask operator|(const Mask& a, const Mask& b) { return {Writing::current().node("orb % %", {a.node, b.node})}; }
    friend Mask operator!(const Mask& a) { return {Writing::current().node("negb %", {a.node})}; }
  };

  explicit Written(double constant) : Written(Writing::current().constant(constant), {}) {}
  static Written variable(const std::string& name) { return Written(name, {}); }

  std::size_t node() const { return node_; }

  friend Written operator-(const Written& a) { return Written("opp %", {a.node_}); }
  friend Written operator+(const Written& a, const Written& b) { return Written("plus % %", {a.node_, b.node_}); }
  friend Written operator-(const Written& a, const Written& b) { return Written("minus % %", {a.node_, b.node_}); }
  friend Written operator*(const Written& a, const Written& b) { return Written("times % %", {a.node_, b.node_}); }
  friend Written operator/(const Written& a, const Written& b) { return Written("over % %", {a.node_, b.node_}); }
  friend Written absolute(const Written& a) { return Written("absolute %", {a.node_}); }
  friend Written square_root(const Written& a) { return Written("square_root %", {a.node_}); }
  friend Written larger(const Written& a, const Written& b) { return Written("larger % %", {a.node_, b.node_}); }
  friend Written multiply_add(const Written& a, const Written& b, const Written& c) {
    return Written("multiply_add is_fused % % %", {a.node_, b.node_, c.node_});
  }
  friend Written multiply_subtract(const Written& a, const Written& b, const Written& c) {
    return Written("multiply_subtract is_fused % % %", {a.node_, b.node_, c.node_});
  }
  friend Written fused(const Written& a, const Written& b, const Written& c) {
    return Written("fused % % %", {a.node_, b.node_, c.node_});
  }
  friend Written select(const Mask& condition, const Written& yes, const Written& no) {
    return Written("if % then % else %", {condition.node, yes.node_, no.node_});
  }

  friend Mask operator<(const Written& a, const Written& b) { return {Written("is_less % %", {a.node_, b.node_}).node_}; }
  friend Mask operator>(const Written& a, const Written& b) { return b < a; }
  friend Mask operator<=(const Written& a, const Written& b) { return {Written("is_at_most % %", {a.node_, b.node_}).node_}; }
  friend Mask operator==(const Written& a, const Written& b) { return {Written("is_equal % %", {a.node_, b.node_}).node_}; }

 private:
  Written(const std::string& text, const std::vector<std::size_t>& operands) : node_(Writing::current().node(text, operands)) {}

  std::size_t node_;
};

}  // namespace forceshade::tests
