// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A definition in the language of Coq, made of what was done with numbers.

#include <cmath>
#include <cstddef>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace forceshade::tests {

// A text with its lines broken at spaces before they are too long.
inline std::string wrapped(std::string text) {
  constexpr std::size_t kLongest = 138;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin), space = text.rfind(' ', begin + kLongest);
    if (end == std::string::npos || end - begin <= kLongest || space <= begin) {
      begin = end == std::string::npos ? text.size() : end + 1;
    } else {
      text.replace(space, 1, "\n    ");
      begin = space + 1;
    }
  }
  return text;
}

// One definition while it is being written; one at a time.
class Writing {
 public:
  Writing() { current_ = this; }
  Writing(const Writing&) = delete;
  Writing& operator=(const Writing&) = delete;
  ~Writing() { current_ = nullptr; }

  static Writing& current() { return *current_; }

  // From now on the constants ±value·2^k are written with this text. Beside these, only powers of two may occur.
  void name(double value, std::string text) { named_.emplace_back(value, std::move(text)); }
  std::string constant(double value) const;

  // An operation, each % in its text an operand, or without one a variable or constant. One met again is the one known already.
  std::size_t node(const std::string& text, const std::vector<std::size_t>& operands = {}) {
    const auto [entry, is_new] = known_.try_emplace({text, operands}, nodes_.size());
    if (is_new) nodes_.push_back({text, operands, ""});
    return entry->second;
  }

  // The node's name, after the lines of what it needs have been written: in an order that no compiler chooses.
  const std::string& write(std::size_t index);
  const std::string& lines() const { return lines_; }
  // The node's whole text, without lines: for what stands behind a `fun`.
  std::string text(std::size_t index) const;

 private:
  struct Node {
    std::string text;
    std::vector<std::size_t> operands;
    std::string name;
  };

  static inline Writing* current_ = nullptr;

  std::vector<std::pair<double, std::string>> named_;
  std::vector<Node> nodes_;
  std::map<std::pair<std::string, std::vector<std::size_t>>, std::size_t> known_;
  int lines_written_ = 0;
  std::string lines_;
};

inline const std::string& Writing::write(std::size_t index) {
  Node& node = nodes_[index];
  if (!node.name.empty()) return node.name;
  if (node.operands.empty()) return node.name = node.text;
  std::string line;
  std::size_t next = 0;
  for (const char c : node.text) {
    if (c == '%') {
      line += write(node.operands[next++]);
    } else {
      line += c;
    }
  }
  node.name = "t" + std::to_string(++lines_written_);
  lines_ += "  let " + node.name + " := " + line + " in\n";
  return node.name;
}

inline std::string Writing::text(std::size_t index) const {
  const Node& node = nodes_[index];
  std::string whole;
  std::size_t next = 0;
  for (const char c : node.text) whole += c == '%' ? text(node.operands[next++]) : std::string(1, c);
  return node.operands.empty() ? whole : "(" + whole + ")";
}

inline std::string Writing::constant(double value) const {
  if (value == 0) {
    if (std::signbit(value)) throw std::runtime_error("expected no constant that is -0");
    return "zero64";
  }
  int exponent = 0;
  for (const auto& [known, text] : named_) {
    const double quotient = std::fabs(value) / std::fabs(known);
    if (std::frexp(quotient, &exponent) != 0.5 || quotient * std::fabs(known) != std::fabs(value)) continue;
    const std::string size = exponent == 1 ? text : "(times (two_to (" + std::to_string(exponent - 1) + ")) " + text + ")";
    return std::signbit(value) == std::signbit(known) ? size : "(opp " + size + ")";
  }
  if (std::frexp(value, &exponent) == 0.5) return "(two_to (" + std::to_string(exponent - 1) + "))";
  throw std::runtime_error("expected a power of two, or a constant that the law holds times one, not " + std::to_string(value));
}

}  // namespace forceshade::tests
