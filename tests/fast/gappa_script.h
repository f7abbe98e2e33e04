// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The definitions and propositions of a Gappa script, as far as the scripts of fast/ use the language: what each name stands
// for, as an expression to compare with what the header of the same name does.

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/fast/expressions.h"

namespace forceshade::tests {

// An expression or relation as it stands in a script. A name has no operands; "round" has what it rounds.
struct Syntax {
  std::string operation;  // "name", "number", "+", "-", "*", "/", "-/", "negate", "sqrt", "absolute", "round"
  std::string name;
  double number = 0;  // of a number; of "round" the bits
  std::vector<Syntax> operands;
};

class GappaScript {
 public:
  struct Relation {
    std::string is;  // "in", "=", "<="
    Syntax left, right;
    double low = 0, high = 0;  // of "in"
  };
  struct Piece {
    std::string name;
    std::vector<Relation> hypotheses;
    std::vector<Syntax> conclusions;
  };

  // Throws std::runtime_error with file, line and what was expected for what is not of the scripts' language.
  explicit GappaScript(const std::filesystem::path& file);

  const std::vector<Piece>& pieces() const { return pieces_; }
  const Piece& piece(const std::string& name) const;

  // Names that stand for something other than the script's definition of them.
  using Bindings = std::map<std::string, Scaled>;

  // An expression in the script's own language over its definitions.
  Scaled value(const std::string& expression, Expressions& expressions, const Bindings& bindings) const;
  // The computed number whose error the piece's i-th conclusion bounds: it stands before "-" or "-/".
  Scaled computed(const std::string& piece, std::size_t i, Expressions& expressions, const Bindings& bindings) const;
  // The ends of a piece's hypothesis on a name, or on its size: "x in [low, high]", "|y| in [low, high]".
  std::pair<double, double> interval(const std::string& piece, const std::string& name) const;
  // The names that a piece's hypotheses give a value ("A1 = -1 / 2"), and the rounded numbers beside them ("a1").
  Bindings constants(const std::string& piece, Expressions& expressions) const;

 private:
  struct Definition {
    Syntax body;
    bool rounds_each_operation = false;  // "rnd=", and "rel=", which has one
  };

  Scaled value(const Syntax& of, bool rounds_each, Expressions& expressions, const Bindings& bindings) const;
  Scaled of_name(const std::string& name, Expressions& expressions, const Bindings& bindings) const;

  std::string file_;
  std::map<std::string, Definition> definitions_;
  std::vector<Piece> pieces_;
};

}  // namespace forceshade::tests
