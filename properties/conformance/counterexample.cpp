// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/counterexample.h"

#include <cmath>

#include "files/printable.h"
#include "text/number_text.h"

namespace forceshade::conformance {
namespace {

std::string literal(float number) {
  if (std::isnan(number)) return "NAN";
  if (std::isinf(number)) return number > 0 ? "INFINITY" : "-INFINITY";
  return hexfloat(static_cast<double>(number)) + 'f';
}

}  // namespace

std::string literal(const Eigen::Vector3f& numbers) {
  return '{' + literal(numbers.x()) + ", " + literal(numbers.y()) + ", " + literal(numbers.z()) + '}';
}

std::string test_to_paste(const Identity& identity, std::span<const Eigen::Vector3f> path,
                          std::span<const std::uint32_t> periods, const Judged& at_its_end) {
  std::string text =
      "// " + files::printable(identity.name + ": " + parameters_in_words(identity)) + "\nconst float path_mm[][3] = {";
  for (std::size_t i = 0; i < path.size(); ++i) text += (i == 0 ? "" : ",\n                             ") + literal(path[i]);
  text += "};  // from no contact\n";
  for (std::size_t i = 0; i < periods.size(); ++i)
    text +=
        (i == 0 ? "const unsigned periods[] = {" : ", ") + std::to_string(periods[i]) + (i + 1 == periods.size() ? "};\n" : "");
  text += "const float force_N[3] = " + literal(at_its_end.exact.force) + ";  // at its end, not " +
          literal(at_its_end.its.force) + '\n';
  return text;
}

}  // namespace forceshade::conformance
