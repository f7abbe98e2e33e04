// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One run of a header's templates on recorded numbers, beside the Gappa script of the same name.

#include <gtest/gtest.h>

#include <set>

#include "tests/fast/gappa_script.h"
#include "tests/fast/recorded_number.h"

namespace forceshade::tests {

// A script, and which of its pieces have been compared with the code.
struct ComparedScript {
  GappaScript script;
  std::set<std::string> compared;

  explicit ComparedScript(const std::string& name) : script(std::string(FORCESHADE_SOURCE_DIR "/fast/") + name + ".g") {}
};

struct RecordedRun {
  ComparedScript& of;
  Expressions expressions;
  Recording recording;
  GappaScript::Bindings bindings;
  std::map<int, double> values;  // of constants, by node

  RecordedRun(ComparedScript& script, bool is_fused) : of(script), recording(expressions, is_fused) {}

  // A position or parameter of the script, with a value to decide comparisons by.
  Recorded input(const std::string& name, double value) { return {value, of.script.value(name, expressions, {})}; }
  // The number that a header holds for the script's `name`: an input, or what the script computes of inputs before it.
  void constant(const std::string& name, double value) {
    const Scaled is = of.script.value(name, expressions, {});
    expressions.name_constant(value, is);
    if (expressions.is_input(is))
      values[is.node] = value;
    else
      EXPECT_EQ(expressions.evaluate(is, values), value) << name;
  }
  void bind(const std::string& name, const Recorded& is) { bindings[name] = is.expression(); }

  Scaled value(const std::string& expression) { return of.script.value(expression, expressions, bindings); }

  void assume_larger(const char* a, const char* b) { expressions.assume_larger(value(a), value(b)); }

  void expect(const std::string& piece, const Recorded& found, std::size_t conclusion = 0) {
    expect(piece, found.expression(), conclusion);
  }
  void expect(const std::string& piece, const Scaled& found, std::size_t conclusion = 0) {
    of.compared.insert(piece);
    const Scaled script = of.script.computed(piece, conclusion, expressions, bindings);
    EXPECT_EQ(expressions.difference(found, script), "") << "piece " << piece << (recording.fuses ? ", fused" : "");
  }
  void expect_value(const std::string& expression, const Scaled& found) {
    EXPECT_EQ(expressions.difference(found, value(expression)), "") << expression << (recording.fuses ? ", fused" : "");
  }
};

}  // namespace forceshade::tests
