// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fast/expressions.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace forceshade::tests {
namespace {

// value == sign·odd·2^exponent, odd an odd whole number.
struct OddTimesPower {
  double odd;
  int sign, exponent;
};
OddTimesPower odd_times_power(double value) {
  int exponent = 0;
  double odd = std::ldexp(std::frexp(std::fabs(value), &exponent), 53);
  exponent -= 53;
  for (; std::fmod(odd, 2) == 0; odd /= 2) ++exponent;
  return {odd, value < 0 ? -1 : 1, exponent};
}
int bits_of(double odd) {
  return std::ilogb(odd) + 1;
}

}  // namespace

Expressions::Expressions() {
  nodes_.push_back({Kind::zero, false, {}, "0", 0});
  nodes_.push_back({Kind::one, false, {}, "1", 1});
}

int Expressions::add(Node node) {
  std::string key = std::to_string(static_cast<int>(node.kind)) + (node.is_rounded ? "r" : "e") + node.name;
  for (const Scaled& a : node.operands)
    key += ',' + std::to_string(a.node) + ':' + std::to_string(a.sign) + ':' + std::to_string(a.exponent);
  const auto [place, is_new] = known_.emplace(key, static_cast<int>(nodes_.size()));
  if (is_new) nodes_.push_back(std::move(node));
  return place->second;
}

Scaled Expressions::input(const std::string& name, int bits) {
  const Scaled result{add({Kind::input, false, {}, name, bits})};
  if (node(result).bits != bits) throw std::runtime_error(name + ": found two sizes of one input");
  return result;
}

void Expressions::name_constant(double value, const Scaled& expression) {
  if (value == 0 || !std::isfinite(value))
    throw std::runtime_error(text(expression) + ": found " + std::to_string(value) + ", expected a finite value other than 0");
  const auto [odd, sign, exponent] = odd_times_power(value);
  if (odd == 1 || named_.contains(odd))
    throw std::runtime_error(text(expression) + ": expected a value that no other constant has");
  if (bits_of(odd) > node(expression).bits)
    throw std::runtime_error(text(expression) + ": found a value of more bits than the script says");
  named_.emplace(odd, expression.times(sign, -exponent));
}

Scaled Expressions::constant(double value) {
  if (value == 0) return zero();
  const auto [odd, sign, exponent] = odd_times_power(value);
  if (odd == 1) return {kOne, sign, exponent};
  if (const auto named = named_.find(odd); named != named_.end()) return named->second.times(sign, exponent);
  return {add({Kind::constant, false, {}, std::to_string(static_cast<long long>(odd)), bits_of(odd)}), sign, exponent};
}

std::vector<Scaled> Expressions::terms(const Scaled& a) const {
  std::vector<Scaled> all = node(a).operands;
  for (Scaled& one : all) one = one.times(a.sign, a.exponent);
  return all;
}

Scaled Expressions::residual(const Scaled& a) {
  return {add({Kind::residual, false, {{a.node}}, "", 53}), a.sign, a.exponent};
}

// Returns true if from - less is the remainder of a rounded division or root: a - (a/b)·b, a - √a·√a.
bool Expressions::is_remainder(const Scaled& from, const Scaled& less) const {
  if (node(less).kind != Kind::product || node(less).is_rounded) return false;
  const std::vector<Scaled>& factors = node(less).operands;
  for (const auto& [result, other] : {std::pair{factors[0], factors[1]}, std::pair{factors[1], factors[0]}}) {
    const Scaled whole = result.times(less.sign, less.exponent);
    if (is_rounded(whole, Kind::quotient) && node(whole).operands[0].times(whole.sign, whole.exponent) == from &&
        node(whole).operands[1] == other)
      return true;
    if (result == other && is_rounded(result, Kind::root) && node(result).operands[0].times(less.sign, less.exponent) == from)
      return true;
  }
  return false;
}

Scaled Expressions::sum(const Scaled& a, const Scaled& b) {
  if (is_zero(a)) return b;
  if (is_zero(b)) return a;
  if (a == -b) return zero();
  if (a == b) return a.times(1, 1);
  for (const auto& [whole, part] : {std::pair{a, b}, std::pair{b, a}}) {
    const Scaled exact{node(part).exact, part.sign, part.exponent};
    if (node(part).exact >= 0 && exact == -whole) return -residual(part);
    if (node(part).kind == Kind::residual && node(part).operands[0].times(part.sign, part.exponent) == whole)
      return {node(whole).exact, whole.sign, whole.exponent};
  }
  const Scaled &first = a.node <= b.node ? a : b, &second = a.node <= b.node ? b : a;
  const Scaled of_first = second.times(first.sign, -first.exponent);
  const int bits = is_remainder(a, -b) || is_remainder(b, -a) ? 53 : kMany;
  return {add({Kind::sum, false, {{first.node}, of_first}, "", bits}), first.sign, first.exponent};
}

Scaled Expressions::product(const Scaled& a, const Scaled& b) {
  if (is_zero(a) || is_zero(b)) return zero();
  if (a.node == kOne) return b.times(a.sign, a.exponent);
  if (b.node == kOne) return a.times(b.sign, b.exponent);
  const int bits = std::min(node(a).bits + node(b).bits, kMany);
  return {add({Kind::product, false, {{std::min(a.node, b.node)}, {std::max(a.node, b.node)}}, "", bits}), a.sign * b.sign,
          a.exponent + b.exponent};
}

Scaled Expressions::quotient(const Scaled& a, const Scaled& b) {
  if (is_zero(b)) throw std::runtime_error("found a division by 0");
  if (is_zero(a)) return zero();
  if (b.node == kOne) return a.times(b.sign, -b.exponent);
  return {add({Kind::quotient, false, {{a.node}, {b.node}}, "", kMany}), a.sign * b.sign, a.exponent - b.exponent};
}

Scaled Expressions::square_root(const Scaled& a) {
  if (a.sign < 0) throw std::runtime_error("found the root of a negative number");
  const int odd = a.exponent & 1;
  if (is_zero(a) || (a.node == kOne && odd == 0)) return {a.node, 1, a.exponent / 2};
  return {add({Kind::root, false, {{a.node, 1, odd}}, "", kMany}), 1, (a.exponent - odd) / 2};
}

// Dekker: with s = a + q rounded and |a| >= |q|, (a - s) + q, each rounded, is the residual of s.
Scaled Expressions::residual_of_sum(const Scaled& a, const Scaled& b) {
  for (const auto& [difference, q] : {std::pair{a, b}, std::pair{b, a}}) {
    if (!is_rounded(difference, Kind::sum)) continue;
    const std::vector<Scaled> parts = terms(difference);
    for (const auto& [from, less] : {std::pair{parts[0], parts[1]}, std::pair{parts[1], parts[0]}}) {
      const Scaled s = -less;
      if (!is_rounded(s, Kind::sum) || !larger_.contains({from.node, q.node})) continue;
      const std::vector<Scaled> added = terms(s);
      if ((added[0] == from && added[1] == q) || (added[1] == from && added[0] == q)) return residual(s);
    }
  }
  return zero();
}

// With q = a/b and p = q·b rounded, and e the residual of p: (a - p) - e, each rounded, is a - q·b.
Scaled Expressions::remainder_of_quotient(const Scaled& a, const Scaled& b) {
  for (const auto& [difference, e] : {std::pair{a, b}, std::pair{b, a}}) {
    if (!is_rounded(difference, Kind::sum) || node(e).kind != Kind::residual) continue;
    const Scaled p = node(e).operands[0].times(-e.sign, e.exponent);
    if (!is_rounded(p, Kind::product)) continue;
    const Scaled exact{node(p).exact, p.sign, p.exponent};
    const std::vector<Scaled> parts = terms(difference);
    for (const auto& [from, less] : {std::pair{parts[0], parts[1]}, std::pair{parts[1], parts[0]}})
      if (less == -p && is_remainder(from, exact)) return sum(from, -exact);
  }
  return zero();
}

Scaled Expressions::rounded(const Scaled& a) {
  if (node(a).bits <= 53 || node(a).is_rounded) return a;
  if (node(a).kind == Kind::sum) {
    const std::vector<Scaled> parts = terms(a);
    if (const Scaled found = residual_of_sum(parts[0], parts[1]); !is_zero(found)) return found;
    if (const Scaled found = remainder_of_quotient(parts[0], parts[1]); !is_zero(found)) return found;
  }
  Node copy = node(a);
  copy.is_rounded = true;
  copy.bits = 53;
  copy.exact = a.node;
  return {add(std::move(copy)), a.sign, a.exponent};
}

Scaled Expressions::fused(const Scaled& a, const Scaled& b, const Scaled& c) {
  const Scaled exact = product(a, b);
  return rounded(sum(products_always_round ? rounded(exact) : exact, c));
}

void Expressions::assume_binary64(const Scaled& a) {
  nodes_[static_cast<std::size_t>(a.node)].bits = 53;
}

double Expressions::evaluate(const Scaled& a, const std::map<int, double>& inputs) const {
  const auto operand = [&](std::size_t i) { return evaluate(node(a).operands[i], inputs); };
  const double scale = std::ldexp(a.sign, a.exponent);
  if (const auto input = inputs.find(a.node); input != inputs.end()) return scale * input->second;
  if (!node(a).is_rounded) throw std::runtime_error(text(a) + ": expected a rounded operation on inputs");
  switch (node(a).kind) {
    case Kind::sum: return scale * (operand(0) + operand(1));
    case Kind::product: return scale * (operand(0) * operand(1));
    case Kind::quotient: return scale * (operand(0) / operand(1));
    case Kind::root: return scale * std::sqrt(operand(0));
    default: throw std::runtime_error(text(a) + ": expected a sum, product, quotient or root");
  }
}

std::string Expressions::text(const Scaled& a, int depth) const {
  if (depth == 0) return "...";
  const Node& n = node(a);
  const auto operand = [&](std::size_t i) { return text(n.operands[i], depth - 1); };
  const auto operands = [&](const char* operation) {
    return std::string("(").append(operand(0)).append(operation).append(operand(1)).append(")");
  };
  const auto function = [&](const char* name) { return std::string(name).append("(").append(operand(0)).append(")"); };
  std::string inside = n.name;
  switch (n.kind) {
    case Kind::sum: inside = operands(" + "); break;
    case Kind::product: inside = operands(" * "); break;
    case Kind::quotient: inside = operands(" / "); break;
    case Kind::root: inside = function("sqrt"); break;
    case Kind::residual: inside = function("residual"); break;
    default: break;
  }
  std::string result(a.sign < 0 ? "-" : "");
  result.append(n.is_rounded ? "rnd(" : "").append(inside).append(n.is_rounded ? ")" : "");
  if (a.exponent != 0) result.append("*1b").append(std::to_string(a.exponent));
  return result;
}

std::string Expressions::difference(const Scaled& found, const Scaled& expected) const {
  if (found == expected) return "";
  const Node &f = node(found), &e = node(expected);
  const bool is_same_operation = f.kind == e.kind && f.is_rounded == e.is_rounded && f.operands.size() == e.operands.size() &&
                                 found.sign == expected.sign && found.exponent == expected.exponent;
  std::vector<std::size_t> differing;
  for (std::size_t i = 0; is_same_operation && i < f.operands.size(); ++i)
    if (f.operands[i] != e.operands[i]) differing.push_back(i);
  if (differing.size() == 1) return difference(f.operands[differing[0]], e.operands[differing[0]]);
  return "the header computes\n    " + text(found) + "\n  where the script has\n    " + text(expected);
}

}  // namespace forceshade::tests
