// SPDX-License-Identifier: BSD-3-Clause
#include "device/kinds.h"

#include <algorithm>
#include <array>
#include <vector>

#include "device/command/command.h"
#include "device/dhd/dhd.h"
#include "device/haply/haply.h"
#include "device/null.h"
#include "device/phantom/phantom.h"
#include "device/simulated/simulated.h"
#include "files/suggestion.h"
#include "text/joined.h"

namespace forceshade::device {
namespace {

constexpr std::array kKinds{
    Kind{"null", "", "at rest, feels nothing",
         [](const std::string&, Attendant&, Forces) -> std::unique_ptr<Device> { return std::make_unique<Null>(); }},
    Kind{"replay", ":FILE.csv", "a recorded hand (columns t_s, x_mm, y_mm, z_mm), whatever the force",
         [](const std::string& file, Attendant&, Forces) -> std::unique_ptr<Device> {
           return std::make_unique<Replay>(Replay::load(file));
         }},
    Kind{"simulated", "[:MODEL[:FILE.csv]]", "a simulated PHANToM in a simulated hand that strokes, or means to go as recorded",
         [](const std::string& rest, Attendant& attendant, Forces) { return open_simulated(rest, attendant); }, nullptr, true},
    Kind{"mouse", "[:MODEL]", "a simulated PHANToM whose hand goes where the mouse points over a window that shows the surface",
         [](const std::string& model, Attendant& attendant, Forces) { return open_mouse(model, attendant); }, nullptr, true},
    Kind{"phantom", "[:NAME]", "a real PHANToM (Premium, Omni, Touch) through the vendor's driver", open_phantom,
         phantom_checks, false, true},
    Kind{"command", ":PROGRAM", "a program of yours, which answers forces with positions in lines of JSON", open_command,
         nullptr, false, true},
    Kind{"haply", "[:ID]", "a Haply Inverse3 through Haply's Inverse Service", open_haply, haply_checks, false, true},
    Kind{"dhd", "[:SERIAL]",
         "a Force Dimension omega, delta, sigma or lambda, or a Novint Falcon (dhd:#INDEX), through the vendor's library",
         open_dhd, dhd_checks, false, true},
};

// True if a device may have this name, which begins with the kind's.
bool is_well_formed(const Kind& kind, std::string_view name) {
  const bool has_rest = name.size() > kind.name.size() + 1;
  return has_rest ? !kind.rest.empty() : name == kind.name && !kind.rest.starts_with(':');
}

std::string kind_of(const std::string& name) {
  return name.substr(0, name.find(':'));
}

std::string rest_of(const std::string& name) {
  return name.substr(std::min(name.size(), kind_of(name).size() + 1));
}

}  // namespace

std::span<const Kind> kinds() {
  return kKinds;
}

std::vector<Check> checks_before_opening(const std::string& name) {
  for (const Kind& kind : kKinds)
    if (kind.name == kind_of(name) && kind.checks) return kind.checks(rest_of(name));
  return {};
}

bool is_simulated(const std::string& name) {
  return std::ranges::any_of(kKinds, [&](const Kind& kind) { return kind.is_simulated && kind.name == kind_of(name); });
}

bool is_untried(const std::string& name) {
  return std::ranges::any_of(kKinds, [&](const Kind& kind) { return kind.is_untried && kind.name == kind_of(name); });
}

std::unique_ptr<Device> open_device(const std::string& name, Attendant& attendant, Forces forces) {
  const std::string first = kind_of(name);
  std::vector<std::string> names;
  for (const Kind& kind : kKinds) {
    if (kind.name == first && is_well_formed(kind, name)) return kind.open(rest_of(name), attendant, forces);
    names.emplace_back(kind.name);
  }
  throw Error("unknown device \"" + name + "\": expected " + joined(kKinds, ", ", &Kind::form, " or ") +
              files::suggestion(first, names));
}

std::unique_ptr<Device> open_device(const std::string& name) {
  static Attendant nobody;
  return open_device(name, nobody);
}

}  // namespace forceshade::device
