// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/recordings/columns.h"

#include <algorithm>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "files/quantity.h"
#include "forceshade/error.h"
#include "text/joined.h"
#include "text/letters.h"
#include "text/number_text.h"

namespace forceshade::conformance {
namespace {

struct FileUnit {
  std::string_view name, size;  // in mm or N; of a time in s
};
constexpr std::array kTimes{FileUnit{"s", "1"}, FileUnit{"ms", "1e-3"}, FileUnit{"us", "1e-6"}, FileUnit{"ns", "1e-9"}};
constexpr std::array kLengths{FileUnit{"mm", "1"}, FileUnit{"cm", "10"}, FileUnit{"m", "1000"}, FileUnit{"in", "25.4"}};
constexpr std::array kForces{FileUnit{"N", "1"}, FileUnit{"mN", "1e-3"}};
// Endings in small letters that are other units, which are not read.
constexpr std::string_view kOtherTimes = " min µs μs h hr hours minutes seconds micros millis nanos ",
                           kOtherLengths = " um µm μm nm dm km mil mils thou inch inches ft feet ",
                           kOtherForces = " nm kn un µn μn cn dan g grams kg gf kgf lb lbs lbf oz ozf dyn mv newton newtons ";

const FileUnit* find(std::span<const FileUnit> units, std::string_view name) {
  const auto found = std::ranges::find(units, name, &FileUnit::name);
  return found == units.end() ? nullptr : &*found;
}

// The last word of a column's name: of x_mm, "x mm", "x [mm]" and x(mm) it is mm, of t_msec it is ms. Empty where the name is
// one word.
std::string_view last_word(std::string_view name) {
  if (name.ends_with(']') || name.ends_with(')')) name.remove_suffix(1);
  const std::size_t before = name.find_last_of("_ [(");
  std::string_view word = before == std::string_view::npos ? std::string_view() : name.substr(before + 1);
  for (const std::string_view seconds : {"secs", "sec"})
    if (word.ends_with(seconds)) word.remove_suffix(seconds.size() - 1);
  return word;
}

// Takes the unit of these columns, one of `units`, out of the given ones; or that in which each name ends.
files::Decimal unit_of(std::span<const std::string> names, std::span<const FileUnit> units, std::string_view others,
                       std::vector<std::string>& given) {
  const std::string choices = joined(units, ", ", &FileUnit::name);
  std::string unread(others);
  for (const FileUnit& unit : units) unread += small_letters(unit.name) + ' ';
  const auto word = std::ranges::find_if(given, [&](const std::string& name) { return find(units, name) != nullptr; });
  const bool is_given = word != given.end();
  const FileUnit* unit = is_given ? find(units, *word) : nullptr;
  if (is_given) given.erase(word);
  for (const std::string& name : names) {
    const std::string ending(last_word(name)), small = small_letters(ending);
    const FileUnit* const its = find(units, ending);
    const bool is_name = is_given && ending.size() == 1 && ending != small;  // M of a master, S of a slave
    const bool is_other = !ending.empty() && !is_name && unread.find(' ' + small + ' ') != std::string::npos;
    if (its == nullptr && is_given && (!is_other || small == small_letters(unit->name))) continue;
    if (its == nullptr)
      throw Error("--columns: expected one of " + choices + ", because the column " + name +
                  (is_other ? " ends in " + ending : " does not end in its unit"));
    if (unit != nullptr && unit != its)
      throw Error("--columns: the column " + name + " ends in " + ending +
                  (is_given ? "; expected this unit, got " : "; expected the unit ") + std::string(unit->name));
    unit = its;
  }
  return *files::Decimal::of(unit->size);
}

bool is_whole(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

}  // namespace

bool Columns::are_numbered() const {
  return std::ranges::all_of(names, is_whole);
}

Columns columns_of(const std::string& text) {
  const auto refused = [](const std::string& why) {
    return Error("--columns: " + why + "; expected t=NAME,x=NAME,y=NAME,z=NAME,fx=NAME,fy=NAME,fz=NAME");
  };
  Columns columns;
  std::array<std::string, 7> given;
  std::vector<std::string> units;
  for (const std::string& part : text.empty() ? std::vector<std::string>{} : files::at_commas(text)) {
    const std::size_t sign = part.find('=');
    if (sign == std::string::npos) {
      units.push_back(part);
      continue;
    }
    const auto* const what = std::ranges::find(Columns::kWhat, part.substr(0, sign));
    if (sign + 1 == part.size() || what == Columns::kWhat.end()) throw refused("got \"" + part + '"');
    std::string& name = given[static_cast<std::size_t>(what - Columns::kWhat.begin())];
    if (!name.empty()) throw refused(std::string(*what) + " is given twice");
    name = part.substr(sign + 1);
  }
  if (std::ranges::any_of(given, [](const std::string& name) { return !name.empty(); })) {
    for (std::size_t i = 0; i < given.size(); ++i) {
      if (given[i].empty()) throw refused("has no " + std::string(Columns::kWhat[i]));
      for (std::size_t k = 0; k < i; ++k)
        if (given[k] == given[i])
          throw refused(std::string(Columns::kWhat[k]) + " and " + std::string(Columns::kWhat[i]) + " are both " + given[i]);
    }
    columns.names = given;
  }
  if (const std::size_t plus = columns.names[0].find('+'); plus != std::string::npos) {
    columns.nanoseconds = columns.names[0].substr(plus + 1);
    columns.names[0].resize(plus);
    if (plus == 0 || columns.nanoseconds.empty()) throw refused("t: expected SECONDS+NANOSECONDS");
    if (std::ranges::count(columns.names, columns.nanoseconds) > 0)
      throw refused("t: " + columns.nanoseconds + " is named twice");
    const std::string unit(last_word(columns.names[0]));
    if (unit != "s" && find(kTimes, unit) != nullptr)
      throw refused("t: expected SECONDS+NANOSECONDS, and " + columns.names[0] + " is in " + unit);
  }
  const std::span<const std::string> names(columns.names);
  std::vector<std::string> seconds{"s"}, nanoseconds{"ns"};
  const bool are_two = !columns.nanoseconds.empty();
  const files::Decimal time = unit_of(names.first(1), kTimes, kOtherTimes, are_two ? seconds : units);
  columns.power_of_seconds = static_cast<int>(time.exponent());
  if (are_two) unit_of({&columns.nanoseconds, 1}, kTimes, kOtherTimes, nanoseconds);
  columns.millimetres = unit_of(names.subspan(1, 3), kLengths, kOtherLengths, units);
  columns.newtons = unit_of(names.last(3), kForces, kOtherForces, units);
  if (!units.empty())
    throw Error(
        "--columns: expected a unit of time (s, ms, us, ns), of length (mm, cm, m, in) and of force (N, mN), each once; got "
        "\"" +
        units.front() + '"');
  return columns;
}

Eigen::Matrix3d turn_of_frame(const std::string& text) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Zero();
  const std::vector<std::string> axes = files::at_commas(text);
  for (std::size_t i = 0; i < axes.size() && axes.size() == 3; ++i) {
    const bool is_minus = axes[i].starts_with('-');
    const std::string letter = axes[i].substr(is_minus ? 1 : 0);
    if (letter.size() == 1 && letter[0] >= 'x' && letter[0] <= 'z')
      turn(letter[0] - 'x', static_cast<Eigen::Index>(i)) = is_minus ? -1 : 1;
  }
  if ((turn * turn.transpose() - Eigen::Matrix3d::Identity()).norm() != 0)
    throw Error("--frame: expected three different ones of x, y, z, -x, -y and -z, such as x,z,-y, got \"" + text + '"');
  return turn;
}

Eigen::Vector3d offset_of(const std::string& text) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::string> numbers = files::at_commas(text);
  Eigen::Vector3d offset(kNone, kNone, kNone);
  for (std::size_t i = 0; i < 3 && numbers.size() == 3; ++i)
    offset[static_cast<Eigen::Index>(i)] = number_in<double>(numbers[i]).value_or(kNone);
  if (!offset.allFinite()) throw Error("--offset: expected three forces in N, such as 0.12,-0.07,0.31, got \"" + text + '"');
  return offset;
}

}  // namespace forceshade::conformance
