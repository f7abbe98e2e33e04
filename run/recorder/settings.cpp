// SPDX-License-Identifier: BSD-3-Clause
#include "run/recorder/settings.h"

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>

#include "device/passivity_controller.h"
#include "files/csv.h"
#include "forceshade/fast.h"
#include "forceshade/servo_loop.h"
#include "run/recorder/layout.h"
#include "text/beginning.h"
#include "text/number_text.h"

namespace forceshade::recorder {
namespace {

constexpr const char *kSupervised = "supervised", *kController = "passivity", *kRate = "rate_hz", *kDeadMan = "dead_man_button",
                     *kLatency = "passivity_latency", *kHeld = "supervisor_held_ticks",
                     *kActsOnLateness = "supervisor_acts_on_lateness", *kNobody = "none";

// Every number of the settings with its key; `visit(key, number)`.
template <class Settings, class Visit>
void for_each_number(Settings& settings, Visit visit) {
  auto& limits = settings.limits;
  auto& passivity = settings.passivity_settings;
  visit("supervisor_peak_force_N", limits.peak_force);
  visit("supervisor_continuous_force_N", limits.continuous_force);
  visit("supervisor_slew_N_per_s", limits.slew);
  constexpr std::array kAxes{"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    visit(std::string("supervisor_workspace_low_") + kAxes[i] + "_mm", limits.workspace_low[axis]);
    visit(std::string("supervisor_workspace_high_") + kAxes[i] + "_mm", limits.workspace_high[axis]);
  }
  visit("supervisor_workspace_margin_mm", limits.workspace_margin);
  visit("supervisor_resolution_mm", limits.resolution);
  visit("supervisor_speed_under_force_mm_per_s", limits.speed_under_force);
  visit("supervisor_speed_mm_per_s", limits.speed);
  visit("supervisor_frozen_s", limits.frozen);
  visit("supervisor_frozen_speed_mm_per_s", limits.frozen_speed);
  visit("supervisor_frozen_force_N", limits.frozen_force);
  visit("supervisor_forgiven_mJ", limits.energy);
  visit("supervisor_ramp_down_s", limits.ramp_down);
  visit("supervisor_patience_s", limits.watchdog_timeout);
  visit("supervisor_felt_free_s", limits.felt_free);
  visit("supervisor_ramp_up_s", limits.ramp_up);
  visit("passivity_longest_step_mm", passivity.longest_step);
  visit("passivity_epsilon_mJ", passivity.epsilon);
  visit("passivity_friction_N", passivity.friction);
  visit("passivity_period_s", passivity.period);
}

// The same of a damping; the key of the rate is that by which a recording is known to be of a damped run.
template <class Parameters, class Visit>
void for_each_parameter(Parameters& damping, Visit visit) {
  visit(kDampingKey, damping.rate);
  visit("damping_share", damping.share);
  visit("damping_N_s_per_mm", damping.damping);
  visit("damping_most", damping.most);
  visit("damping_drag_N_s_per_mm", damping.drag);
  visit("damping_full_at_N", damping.full_at);
}

class Reader {
 public:
  Reader(const Metadata& metadata, const std::string& path) : metadata_(metadata), path_(path) {}

  const std::string& text(const std::string& key) const {
    const auto found = metadata_.find(key);
    if (found == metadata_.end()) throw Error(path_ + ": " + key + " is not recorded");
    return found->second;
  }
  template <class Number>
  Number number(const std::string& key) const {
    const auto number = number_in<Number>(text(key));
    if (!number || std::isnan(static_cast<double>(*number))) refuse(key, "a number");
    return *number;
  }
  bool truth(const std::string& key) const {
    const std::string& words = text(key);
    if (words != "yes" && words != "no") refuse(key, "yes or no");
    return words == "yes";
  }
  [[noreturn]] void refuse(const std::string& key, const std::string& expected) const {
    throw Error(path_ + ": " + key + " is " + std::string(beginning_of(text(key), 100)) + "; expected " + expected);
  }

 private:
  const Metadata& metadata_;
  const std::string& path_;
};

}  // namespace

Metadata metadata_of(const device::SafetySettings& settings) {
  Metadata metadata{{kRate, shortest(settings.rate_hz)},
                    {kSupervised, settings.supervised ? "yes" : "no"},
                    {kController, std::string(name_of(settings.passivity))},
                    {kLatency, settings.passivity_settings.latency ? "yes" : "no"},
                    {kHeld, std::to_string(settings.limits.held_ticks)},
                    {kActsOnLateness, settings.limits.acts_on_lateness ? "yes" : "no"}};
  const auto& button = settings.limits.dead_man_button;
  metadata[kDeadMan] = button ? std::to_string(*button) : kNobody;
  for_each_number(settings, [&](const std::string& key, auto number) { metadata[key] = shortest(number); });
  return metadata;
}

std::optional<device::SafetySettings> safety_settings_in(const Metadata& metadata, const std::string& path) {
  using Kind = device::Passivity;
  if (!metadata.contains(kSupervised)) return std::nullopt;
  const Reader read(metadata, path);
  device::SafetySettings settings{.rate_hz = read.number<double>(kRate)};
  settings.supervised = read.truth(kSupervised);
  settings.passivity_settings.latency = read.truth(kLatency);
  settings.limits.held_ticks = read.number<int>(kHeld);
  // Recordings of earlier versions lack it: every late tick was acted on.
  settings.limits.acts_on_lateness = !metadata.contains(kActsOnLateness) || read.truth(kActsOnLateness);
  if (read.text(kDeadMan) != kNobody) {
    const int button = read.number<int>(kDeadMan);
    if (button < 0 || button >= std::numeric_limits<decltype(device::Sample::buttons)>::digits)
      read.refuse(kDeadMan, "none, or a button from 0 to 15");
    settings.limits.dead_man_button = button;
  }
  for_each_number(settings, [&](const std::string& key, auto& number) {
    number = read.number<std::remove_reference_t<decltype(number)>>(key);
  });
  if (!(settings.rate_hz >= device::kLowestRateHz && settings.rate_hz <= device::kHighestRateHz))
    read.refuse(kRate, "100 to 10000");
  for (const Kind kind : {Kind::observer, Kind::tank, Kind::damping}) {
    settings.passivity = kind;
    if (read.text(kController) == name_of(kind)) return settings;
  }
  read.refuse(kController, "observer, tank or damping");
}

Metadata metadata_of(const damping::Parameters& damping) {
  Metadata metadata;
  if (!damping.is_off()) for_each_parameter(damping, [&](const char* key, float number) { metadata[key] = shortest(number); });
  return metadata;
}

std::optional<damping::Parameters> damping_in(const Metadata& metadata, const std::string& path) {
  if (!metadata.contains(kDampingKey)) return std::nullopt;
  damping::Parameters damping;
  const Reader read(metadata, path);
  for_each_parameter(damping, [&](const char* key, float& number) { number = read.number<float>(key); });
  if (const auto rate = static_cast<float>(read.number<double>(kRate)); damping.rate != rate)
    read.refuse(kDampingKey, "the rate of the run, " + shortest(rate));
  const auto built = fast::Damping::build(damping);
  if (const auto* error = std::get_if<ParameterError>(&built)) throw Error(path + ": damping: " + error->message());
  return damping;
}

}  // namespace forceshade::recorder
