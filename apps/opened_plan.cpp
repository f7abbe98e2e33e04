// SPDX-License-Identifier: BSD-3-Clause
#include "apps/opened_plan.h"

#include <filesystem>
#include <utility>

#include "apps/command.h"
#include "apps/signals.h"
#include "forceshade/checks.h"
#include "rendering/identity/digest.h"
#include "rendering/subjects/read.h"

namespace forceshade::apps {
namespace {

namespace fs = std::filesystem;

std::string absolute(const std::string& file) {
  return fs::absolute(file).lexically_normal();
}

}  // namespace

std::vector<std::pair<std::string, std::string>> planned_words(const subjects::Options& named) {
  constexpr std::string_view kTexture = "texture:";
  std::vector<std::pair<std::string, std::string>> words;
  for (const subjects::Option& option : named) {
    std::string value = option.value;
    if (option.key == "height-map" || option.key == "mesh" || option.key == "scene" || option.key == "materials")
      value = absolute(value);
    if (option.key == "shading" && value.starts_with(kTexture))
      value = std::string(kTexture) + absolute(value.substr(kTexture.size()));
    words.emplace_back(option.key, value);
  }
  return words;
}

OpenedPlan built(properties::Plan plan, std::string digest) {
  OpenedPlan opened{std::move(plan), std::move(digest), {}, {}, {}};
  const properties::Plan& its = opened.plan;
  if (its.has_sweeps()) {
    opened.sweeps = properties::planned(its.sweeps);
    return opened;
  }
  for (const auto& [key, value] : its.subject) opened.named.add({key, value});
  opened.what.points = its.points;
  opened.what.cases = static_cast<int>(its.cases);
  opened.what.seed = its.seed;
  for (const Description& one : subjects::read(opened.named, Monitor([](double) {}, interrupted())))
    opened.what.subjects.push_back(properties::subject_of(one));
  for (std::size_t i = 0; i < opened.what.subjects.size() && !its.identities.empty(); ++i) {
    const std::string line = properties::identity_line(opened.what.subjects[i]->identity());
    if (i >= its.identities.size() || its.identities[i] != line)
      throw BadInput("the subject is no longer the one that was planned: expected " +
                     (i < its.identities.size() ? its.identities[i] : "none") + ", got " + line);
  }
  return opened;
}

OpenedPlan opened(const std::string& folder, bool works) {
  const std::string file = fs::path(folder) / "plan.json";
  const std::string text = properties::read_certificate(file);
  properties::Plan plan = properties::plan_from_json(text, file);
  properties::Build here = properties::current_build();
  if (!works) here.instruction_set = plan.build.instruction_set;
  if (const std::string why = properties::refusal_of_build(plan, here); !why.empty()) throw BadInput(file + ": " + why);
  return built(std::move(plan), digest_of_text(text));
}

}  // namespace forceshade::apps
