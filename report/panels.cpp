// SPDX-License-Identifier: BSD-3-Clause
#include "report/panels.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "properties/binary32.h"
#include "report/gnuplot.h"

namespace forceshade::properties {
namespace {

template <class L>
L built(LawId id, const Parameters& parameters) {
  auto law = L::build(id, parameters);
  if (const auto* error = std::get_if<ParameterError>(&law)) throw Error(std::string(name_of(id)) + ": " + error->message());
  return std::get<L>(law);
}

}  // namespace

Drawn::Drawn(LawId its_id, const Parameters& its_parameters, Findings its_findings)
    : id(its_id),
      parameters(its_parameters),
      findings(std::move(its_findings)),
      law(built<fast::Law>(id, parameters)),
      reference(built<reference::Law>(id, parameters)),
      shape(reference) {}

// Not a number of few bits: on a grid made from one the force would need no rounding, and the error map would show none.
double Drawn::reach() const {
  return shape.R > 0 ? std::min(0.65 * static_cast<double>(shape.w), 1e4) : 9.7;
}

std::vector<Drawn> drawn(const Certificate& certificate) {
  std::vector<Drawn> laws;
  for (const SubjectResult& result : certificate.subjects) {
    const auto its = law_of(result.identity);
    if (!its) continue;
    const auto is_same = [&](const Drawn& other) { return other.id == its->law; };
    if (std::none_of(laws.begin(), laws.end(), is_same)) laws.emplace_back(its->law, its->parameters, result);
  }
  return laws;
}

bool contains(const std::vector<Drawn>& laws, std::initializer_list<LawId> ids) {
  return std::any_of(laws.begin(), laws.end(),
                     [&](const Drawn& drawn) { return std::find(ids.begin(), ids.end(), drawn.id) != ids.end(); });
}

bool are_one_size(const std::vector<Drawn>& laws) {
  const Drawn* first = nullptr;
  for (const Drawn& law : laws) {
    if (law.parameters.stiffness != laws.front().parameters.stiffness) return false;
    if (law.shape.R == 0) continue;
    if (first != nullptr && !(first->parameters == law.parameters)) return false;
    first = &law;
  }
  return true;
}

Heights heights(const Drawn& drawn) {
  const auto w = static_cast<double>(drawn.shape.w), h = static_cast<double>(drawn.shape.h);
  return drawn.shape.R > 0 ? Heights{-0.21 * w, h + 0.06 * w} : Heights{-4.7, 1.3};
}

std::vector<Sample> across(const Drawn& drawn) {
  constexpr int kSteps = 240;
  std::vector<Sample> samples;
  for (int i = 0; i <= kSteps; ++i) samples.push_back({static_cast<float>(drawn.reach() * (2.0 * i / kSteps - 1)), false});
  for (const JumpLine& line : drawn.shape.jump_lines) {
    for (const long double x : {line.x, -line.x}) {
      const auto nearest = static_cast<float>(x);
      samples.push_back({nearest == 0 ? -1e-6F : neighbour(nearest, -2), false});
      samples.push_back({nearest == 0 ? 0.0F : neighbour(nearest, 2), true});
      if (line.x == 0) break;
    }
  }
  std::erase_if(samples, [&](const Sample& sample) { return std::fabs(static_cast<double>(sample.x)) > drawn.reach(); });
  std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.x < b.x; });
  return samples;
}

}  // namespace forceshade::properties
