// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/simulators/simulator_process.h"

#include <algorithm>
#include <limits>

#include "files/json_line.h"
#include "properties/conformance/doors/dialogue.h"

namespace forceshade::conformance::simulators {
namespace {

using Json = nlohmann::ordered_json;
using Reports = SimulatorCapabilities::Reports;

constexpr const char *kWhose = "simulator", *kHello = "the simulator's hello";

bool is_list_of_numbers(const Json& list, std::size_t size) {
  return list.is_array() && list.size() == size &&
         std::ranges::all_of(list, [](const Json& one) { return one.is_number() || one.is_null(); });
}

// null stands for what is no finite number.
double number_of(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

State state_of(const Json& step, std::size_t k, SimulatorCapabilities::Reports reports, const Simulation& scene) {
  const double units = scene.units_per_metre;
  const Json none;
  const auto list = [&](const char* key, std::size_t size, const char* expected) -> const Json& {
    const Json& found = step.is_object() && step.contains(key) ? step.at(key) : none;
    if (!(size > 0 ? is_list_of_numbers(found, size) : found.is_array()))
      throw files::ProcessFailed("the simulator's " + std::string(key) + " of step " + std::to_string(k) + " is " +
                                 files::shown_json(found) + "; expected " + expected);
    return found;
  };
  const auto vector = [&](const Json& numbers) {
    return Eigen::Vector3d(number_of(numbers[0]), number_of(numbers[1]), number_of(numbers[2]));
  };
  State state{vector(list("position", 3, "a list of three numbers")) / units,
              vector(list("velocity", 3, "a list of three numbers")) / units};
  for (const Json& contact : list("contacts", 0, "a list of contacts")) {
    if (!is_list_of_numbers(contact, 4))
      throw files::ProcessFailed("the simulator's contact in step " + std::to_string(k) + " is " + files::shown_json(contact) +
                                 "; expected a list of four numbers, a normal and its force or impulse");
    if (reports == Reports::nothing) continue;
    state.contacts.push_back({vector(contact), number_of(contact[3]) / units * (reports == Reports::impulse ? scene.rate : 1)});
  }
  return state;
}

class ProcessSimulator final : public SimulatorUnderTest {
 public:
  ProcessSimulator(const std::string& command, const Simulation& scene, const files::ProcessLimits& limits)
      : scene_(scene), dialogue_(command, limits, kWhose), its_(capabilities_of(dialogue_.open(json_of(scene)))) {}

  const SimulatorCapabilities& capabilities() const override { return its_; }

  Motion apply(std::span<const Eigen::Vector3d> forces, bool is_reset) override {
    Json asked;
    if (is_reset) asked["reset"] = true;
    asked["applied"] = Json::array();
    for (const Eigen::Vector3d& force : forces)
      asked["applied"].push_back(json_of(Eigen::Vector3d(scene_.units_per_metre * force)));
    return motion_in(dialogue_.ask(asked.dump()), its_.reports, scene_, forces.size());
  }

  void say_goodbye() override { dialogue_.say_goodbye(); }

 private:
  Simulation scene_;
  Dialogue dialogue_;
  SimulatorCapabilities its_;
};

}  // namespace

SimulatorCapabilities capabilities_of(const Json& hello) {
  constexpr double kMost = std::numeric_limits<double>::max();
  const files::KeyReader said(hello, kHello);
  SimulatorCapabilities its;
  said.word("kind", {"simulator"});
  its.name = said.text("name");
  its.version = said.text("version");
  its.refusal = said.refusal();
  if (its.refusal) return its;
  its.reports = static_cast<Reports>(said.word("reports", {"force", "impulse", "nothing"}));
  its.constraint = static_cast<SimulatorCapabilities::Constraint>(said.word("constraint", {"hard", "soft", "penalty"}));
  its.smallest_radius = said.number("smallest_radius_m", 0, kMost, "the smallest radius of a sphere in m, 0 or more");
  its.speed_cap = said.number_or_null("speed_cap_m_per_s", 0, kMost,
                                      "the largest speed in m/s that a body can have, or null where there is none");
  its.settings = said.text("settings");
  said.word("sides", {"one", "two"});
  if (const Json& binary = said.value("binary", "32 or 64"); binary != 32 && binary != 64)
    said.refuse("binary", binary, "32 or 64");
  for (const char* key : {"reports", "constraint", "binary", "sides", "smallest_radius_m", "speed_cap_m_per_s", "settings"})
    its.declared[key] = hello.at(key);
  return its;
}

Motion motion_in(const Json& said, SimulatorCapabilities::Reports reports, const Simulation& scene, std::size_t count) {
  if (const auto refusal = files::KeyReader(said, kHello).refusal()) return {{}, refusal};
  Motion motion;
  for (const Json& step : list_in(said, "motion", count, "forces", kWhose))
    motion.states.push_back(state_of(step, motion.states.size(), reports, scene));
  return motion;
}

OpenSimulator simulator_process(const std::string& command, const files::ProcessLimits& limits) {
  return [=](const Simulation& scene) { return std::make_unique<ProcessSimulator>(command, scene, limits); };
}

}  // namespace forceshade::conformance::simulators
