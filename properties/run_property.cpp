// SPDX-License-Identifier: BSD-3-Clause
// Draws the cases of a property, and makes the first one that fails simpler.

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "forceshade/properties.h"
#include "properties/rendered.h"
#include "properties/split_mix.h"
#include "properties/words_of_violation.h"
#include "rendering/control_words.h"

namespace forceshade::properties {
namespace {

// One of a generator's values: the one that it draws with the seed, and from there on so many steps to simpler ones, each by
// its place in the list. It means something to any generator, so that what a property draws may depend on what it drew before.
struct Choice {
  std::uint64_t seed;
  std::vector<std::size_t> steps;
};

// A property on one case: on these choices, and on new ones where it draws more.
class Case final : private Chooser {
 public:
  Case(const Property& property, std::uint64_t seed, std::vector<Choice> choices) : seed_(seed), choices_(std::move(choices)) {
    violation_ = words_of_violation([&] { return property(*this); });
    choices_.resize(drawn_.size());
  }

  const Violation& violation() const { return violation_; }
  const std::vector<Choice>& choices() const { return choices_; }
  std::size_t simpler_than(std::size_t i) const { return drawn_[i].simpler(drawn_[i].value).size(); }

 private:
  struct Drawn {
    std::any value;
    std::function<std::vector<std::any>(const std::any&)> simpler;
  };

  std::any next(const Generator<std::any>& generator) override {
    const std::size_t i = drawn_.size();
    if (i == choices_.size()) choices_.push_back({split_mix(seed_, i), {}});
    std::any value = generator.draw(choices_[i].seed);
    std::vector<std::size_t>& steps = choices_[i].steps;
    for (std::size_t step = 0; step < steps.size(); ++step) {
      std::vector<std::any> values = generator.simpler(value);
      if (steps[step] < values.size())
        value = std::move(values[steps[step]]);
      else
        steps.resize(step);  // the value that they simplified was another one
    }
    drawn_.push_back({value, generator.simpler});
    return value;
  }

  std::uint64_t seed_;
  std::vector<Choice> choices_;
  std::vector<Drawn> drawn_;
  Violation violation_;
};

// The simplest case that fails on the way from one that does: value by value, the first simpler one with which the case fails,
// as long as there is one.
Case simplest(const Property& property, std::uint64_t seed, Case failed) {
  int left = kSimplerCases;
  for (bool is_simpler = true; is_simpler;) {
    is_simpler = false;
    for (std::size_t i = 0; i < failed.choices().size(); ++i) {
      std::size_t count = failed.simpler_than(i);
      for (std::size_t step = 0; step < count; ++step) {
        if (left-- == 0) return failed;
        std::vector<Choice> choices = failed.choices();
        choices[i].steps.push_back(step);
        Case simpler(property, seed, std::move(choices));
        if (!simpler.violation()) continue;
        failed = std::move(simpler);
        is_simpler = true;
        if (i >= failed.choices().size()) break;  // it draws less when it is asked again
        count = failed.simpler_than(i);
        step = static_cast<std::size_t>(-1);
      }
    }
  }
  return failed;
}

}  // namespace

Violation words_of_violation(const std::function<Violation()>& check) {
  try {
    return check();
  } catch (const RendererThrew& error) {
    return error.what();
  } catch (...) {
    return "an exception is thrown: " + current_exception_words();
  }
}

Generator<int> integers(int low, int high) {
  if (low > high)
    throw std::invalid_argument("integers: expected a range, got " + std::to_string(low) + " to " + std::to_string(high));
  const std::int64_t first = low, values = std::int64_t{high} - first + 1, nearest = std::clamp<std::int64_t>(0, first, high);
  const auto draw = [=](std::uint64_t seed) {
    return static_cast<int>(first + static_cast<std::int64_t>(seed % static_cast<std::uint64_t>(values)));
  };
  const auto simpler = [=](const int& value) {
    std::vector<int> nearer;
    for (std::int64_t away = value - nearest; away != 0; away /= 2) nearer.push_back(static_cast<int>(value - away));
    return nearer;
  };
  return {draw, simpler};
}

PropertyResult run_property(const std::string& name, int cases, std::uint64_t seed, const Property& property) {
  const ExactArithmetic with_all_bits;
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(std::max(cases, 0)); ++i) {
    const std::uint64_t its = split_mix(seed, i);
    Case one(property, its, {});
    if (!one.violation()) continue;
    const Case failed = simplest(property, its, std::move(one));
    const Case again(property, its, failed.choices());
    if (again.violation()) return {name, i + 1, false, *again.violation()};
    return {name, i + 1, false,
            *failed.violation() +
                "; the same case held when it was tried again, so the answers depend on chance or on what was asked before"};
  }
  return {name, static_cast<std::uint64_t>(std::max(cases, 0)), true, ""};
}

}  // namespace forceshade::properties
