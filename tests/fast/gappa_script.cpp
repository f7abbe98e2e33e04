// SPDX-License-Identifier: BSD-3-Clause
#include "tests/fast/gappa_script.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>

namespace forceshade::tests {
namespace {

struct Token {
  std::string text;
  int line;
};

// Words, numbers and marks; comments left out, but "#! piece NAME" as two tokens.
std::vector<Token> tokens_of(std::istream& in) {
  static const std::vector<std::string> kMarks{"rnd=", "rel=", "any=", "/\\", "->", "-/", "<="};
  std::vector<Token> tokens;
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    if (text.starts_with("#! piece ")) {
      tokens.push_back({"#! piece", line});
      tokens.push_back({text.substr(9), line});
      continue;
    }
    text = text.substr(0, text.find('#'));
    for (std::size_t i = 0; i < text.size();) {
      std::size_t size = 1;
      const auto is_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.'; };
      if (std::isspace(static_cast<unsigned char>(text[i])) != 0) {
        ++i;
        continue;
      }
      for (const std::string& mark : kMarks)
        if (text.compare(i, mark.size(), mark) == 0 && size == 1) size = mark.size();
      if (size == 1 && is_word(text[i])) {
        while (i + size < text.size() && (is_word(text[i + size]) ||
                                          // the sign of a binary exponent: 1b-10, 0x1p-52
                                          (text[i + size] == '-' && std::isdigit(static_cast<unsigned char>(text[i])) != 0 &&
                                           (text[i + size - 1] == 'b' || text[i + size - 1] == 'p') &&
                                           (text[i + size - 1] == 'p' || text.compare(i, 2, "0x") != 0))))
          ++size;
      }
      tokens.push_back({text.substr(i, size), line});
      i += size;
    }
  }
  return tokens;
}

class Parser {
 public:
  Parser(std::string file, std::vector<Token> tokens) : file_(std::move(file)), tokens_(std::move(tokens)) {}

  bool is_done() const { return next_ == tokens_.size(); }
  bool is(const std::string& text) const { return !is_done() && tokens_[next_].text == text; }
  bool take_if(const std::string& text) {
    const bool found = is(text);
    next_ += found ? 1U : 0U;
    return found;
  }
  std::string take() {
    if (is_done()) fail("more");
    return tokens_[next_++].text;
  }
  void expect(const std::string& text) {
    if (!take_if(text)) fail(text);
  }
  [[noreturn]] void fail(const std::string& expected) const {
    const bool at_end = is_done();
    const Token& found = at_end ? tokens_.back() : tokens_[next_];
    throw std::runtime_error(file_ + ":" + std::to_string(found.line) + ": found " + (at_end ? "the end" : found.text) +
                             ", expected " + expected);
  }

  Syntax relative_error() {
    return binary({"-/"}, [this] { return sum(); });
  }
  Syntax sum() {
    return binary({"+", "-"}, [this] { return product(); });
  }

 private:
  Syntax binary(const std::vector<std::string>& operators, const std::function<Syntax()>& operand) {
    Syntax result = operand();
    for (bool again = true; again;) {
      again = false;
      for (const std::string& mark : operators)
        if (take_if(mark)) {
          Syntax right = operand();
          result = {mark, "", 0, {std::move(result), std::move(right)}};
          again = true;
          break;
        }
    }
    return result;
  }
  Syntax product() {
    return binary({"*", "/"}, [this] { return factor(); });
  }
  Syntax enclosed(const std::string& end, const std::string& operation, double number = 0) {
    Syntax inside = sum();
    expect(end);
    return {operation, "", number, {std::move(inside)}};
  }

  Syntax factor() {
    if (take_if("-")) return {"negate", "", 0, {factor()}};
    if (take_if("(")) return enclosed(")", "()").operands[0];
    if (take_if("|")) {
      Syntax inside = relative_error();
      expect("|");
      return {"absolute", "", 0, {std::move(inside)}};
    }
    const std::string word = take();
    if (std::isdigit(static_cast<unsigned char>(word[0])) != 0) return {"number", word, number(word), {}};
    if (std::isalpha(static_cast<unsigned char>(word[0])) == 0) {
      --next_;
      fail("a number or a name");
    }
    if (word == "float") {
      const double bits = format();
      expect("(");
      return enclosed(")", "round", bits);
    }
    if (!take_if("(")) return {"name", word, 0, {}};
    if (word == "sqrt") return enclosed(")", "sqrt");
    if (word == "rnd") return enclosed(")", "round", 53);
    next_ -= 2;
    fail("sqrt, rnd or float");
  }

 public:
  // float<ieee_64, ne> and its like: the bits of a significand.
  double format() {
    expect("<");
    const std::string kind = take();
    double bits = 0;
    if (kind == "ieee_64") {
      bits = 53;
    } else if (kind == "ieee_32") {
      bits = 24;
    } else {
      bits = number(kind);
      for (const char* part : {",", "-", "1074"}) expect(part);
    }
    for (const char* part : {",", "ne", ">"}) expect(part);
    return bits;
  }

 private:
  double number(const std::string& word) const {
    const std::size_t b = word.starts_with("0x") ? std::string::npos : word.find('b');
    char* end = nullptr;
    const double value = std::strtod(word.substr(0, b).c_str(), &end);
    if (*end != 0) fail("a number, not " + word);
    return b == std::string::npos ? value : std::ldexp(value, std::stoi(word.substr(b + 1)));
  }

  std::string file_;
  std::vector<Token> tokens_;
  std::size_t next_ = 0;
};

// A number written as a quotient, as "-1 / 6".
double number_of(const Syntax& s) {
  if (s.operation == "number") return s.number;
  if (s.operation == "negate") return -number_of(s.operands[0]);
  if (s.operation == "/") return number_of(s.operands[0]) / number_of(s.operands[1]);
  throw std::runtime_error("found " + s.operation + ", expected a number or a quotient of numbers");
}

// "p + low", or "zt", which is an operation by itself.
bool is_one_operation(const Syntax& s) {
  return s.operation == "name" || std::all_of(s.operands.begin(), s.operands.end(), [](const Syntax& operand) {
           return operand.operation == "name" || operand.operation == "number";
         });
}

GappaScript::Piece proposition(Parser& in, const std::string& name) {
  GappaScript::Piece piece{name, {}, {}};
  in.expect("{");
  for (bool is_conclusion = false; !in.is("}");) {
    Syntax left = in.relative_error();
    if (in.take_if("in")) {
      if (in.take_if("?")) {
        if (!is_conclusion) in.fail("an interval, for this is a hypothesis");
        piece.conclusions.push_back(left);
      } else {
        in.expect("[");
        const double low = number_of(in.sum());
        in.expect(",");
        const double high = number_of(in.sum());
        in.expect("]");
        piece.hypotheses.push_back({"in", left, {}, low, high});
      }
    } else if (in.take_if("=")) {
      piece.hypotheses.push_back({"=", left, in.sum()});
    } else {
      in.expect("<=");
      piece.hypotheses.push_back({"<=", left, in.sum()});
    }
    if (in.take_if("->")) {
      is_conclusion = true;
    } else if (!in.is("}")) {
      in.expect("/\\");
    }
  }
  in.expect("}");
  if (piece.conclusions.empty()) in.fail("a conclusion of piece " + name);
  return piece;
}

}  // namespace

GappaScript::GappaScript(const std::filesystem::path& file) : file_(file.filename()) {
  std::ifstream text(file);
  if (!text) throw std::runtime_error(file.string() + ": cannot be read");
  Parser in(file_, tokens_of(text));
  while (!in.is_done()) {
    if (in.take_if("@")) {
      for (const char* part : {"rnd", "=", "float"}) in.expect(part);
      if (in.format() != 53) in.fail("rnd to be rounding to binary64");
      in.expect(";");
    } else if (in.take_if("#! piece")) {
      const std::string name = in.take();
      pieces_.push_back(proposition(in, name));
      // Rewritings and hints help Gappa; the proofs' tests check them.
      while (!in.is_done() && !in.is("#! piece")) in.take();
    } else {
      const std::string name = in.take();
      // Definitions of each kind are explained in tests/fast/gappa_pieces.sh.
      const bool is_relative = in.take_if("rel="), rounds = is_relative || in.take_if("rnd=");
      if (!rounds && !in.take_if("any=")) in.expect("=");
      Syntax body = in.sum();
      if (is_relative && !is_one_operation(body)) in.fail("one operation on names or numbers before this");
      if (!definitions_.emplace(name, Definition{std::move(body), rounds}).second) in.fail("one definition of " + name);
      in.expect(";");
    }
  }
}

const GappaScript::Piece& GappaScript::piece(const std::string& name) const {
  for (const Piece& one : pieces_)
    if (one.name == name) return one;
  throw std::runtime_error(file_ + ": expected a piece " + name);
}

Scaled GappaScript::of_name(const std::string& name, Expressions& expressions, const Bindings& bindings) const {
  if (const auto bound = bindings.find(name); bound != bindings.end()) return bound->second;
  const auto defined = definitions_.find(name);
  if (defined == definitions_.end()) throw std::runtime_error(file_ + ": " + name + " is neither defined nor bound");
  const auto& [body, rounds] = defined->second;
  // "K = float<ieee_32, ne>(K_)", "t = t_": an input.
  const Syntax& inside = body.operation == "round" ? body.operands[0] : body;
  if (inside.operation == "name" && !definitions_.contains(inside.name))
    return expressions.input(name, body.operation == "round" ? static_cast<int>(body.number) : 53);
  const Scaled is = value(body, rounds, expressions, bindings);
  return rounds ? expressions.rounded(is) : is;  // "zt_rounded rel= zt"
}

Scaled GappaScript::value(const Syntax& of, bool rounds_each, Expressions& expressions, const Bindings& bindings) const {
  const auto operand = [&](std::size_t i) { return value(of.operands[i], rounds_each, expressions, bindings); };
  const auto operated = [&](const Scaled& exact) { return rounds_each ? expressions.rounded(exact) : exact; };
  if (of.operation == "name") return of_name(of.name, expressions, bindings);
  if (of.operation == "number") return expressions.constant(of.number);
  if (of.operation == "negate") return -operand(0);
  if (of.operation == "round") {
    if (of.number != 53) throw std::runtime_error(file_ + ": found a rounding to other than 53 bits within an expression");
    return expressions.rounded(operand(0));
  }
  if (of.operation == "+") return operated(expressions.sum(operand(0), operand(1)));
  if (of.operation == "-") return operated(expressions.sum(operand(0), -operand(1)));
  if (of.operation == "*") return operated(expressions.product(operand(0), operand(1)));
  if (of.operation == "/") return operated(expressions.quotient(operand(0), operand(1)));
  if (of.operation == "sqrt") return operated(expressions.square_root(operand(0)));
  throw std::runtime_error(file_ + ": found " + of.operation + " within a computed expression");
}

Scaled GappaScript::value(const std::string& expression, Expressions& expressions, const Bindings& bindings) const {
  std::istringstream text(expression);
  Parser in(expression, tokens_of(text));
  const Syntax parsed = in.sum();
  if (!in.is_done()) in.fail("the end");
  return value(parsed, false, expressions, bindings);
}

Scaled GappaScript::computed(const std::string& piece_name, std::size_t i, Expressions& expressions,
                             const Bindings& bindings) const {
  const Syntax* of = &piece(piece_name).conclusions.at(i);
  double divisor = 1;
  if (of->operation == "/") {
    if (of->operands[1].operation == "number") divisor = of->operands[1].number;
    of = &of->operands[0];
  }
  if (of->operation != "-" && of->operation != "-/")
    throw std::runtime_error(file_ + ": piece " + piece_name + ": expected an error, a difference from a true number");
  return expressions.quotient(value(of->operands[0], false, expressions, bindings), expressions.constant(divisor));
}

std::pair<double, double> GappaScript::interval(const std::string& piece_name, const std::string& name) const {
  for (const Relation& one : piece(piece_name).hypotheses) {
    const Syntax& of = one.left.operation == "absolute" ? one.left.operands[0] : one.left;
    if (one.is == "in" && of.operation == "name" && of.name == name) return {one.low, one.high};
  }
  throw std::runtime_error(file_ + ": piece " + piece_name + ": expected a hypothesis on " + name);
}

GappaScript::Bindings GappaScript::constants(const std::string& piece_name, Expressions& expressions) const {
  Bindings found;
  for (const Relation& one : piece(piece_name).hypotheses)
    if (one.is == "=" && one.left.operation == "name" && one.right.operation != "name")
      found[one.left.name] = expressions.constant(number_of(one.right));
  for (const Relation& one : piece(piece_name).hypotheses) {
    if (one.is == "=" && one.right.operation == "name") found[one.left.name] = found.at(one.right.name);
    // |a0 -/ A0| <= 1b-53: the binary64 number nearest to A0.
    if (one.is != "<=" || one.left.operation != "absolute") continue;
    const Syntax& error = one.left.operands[0];
    if (error.operation != "-/" || !found.contains(error.operands[1].name)) continue;
    if (number_of(one.right) != 0x1p-53) throw std::runtime_error(file_ + ": expected a constant rounded once");
    found[error.operands[0].name] = found.at(error.operands[1].name);
  }
  return found;
}

}  // namespace forceshade::tests
