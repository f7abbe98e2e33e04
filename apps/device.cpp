// SPDX-License-Identifier: BSD-3-Clause
// forceshade device: which devices there are; its other parts are in device_check.cpp and device_try.cpp.

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/output_options.h"
#include "device/kinds.h"
#include "device/phantom/driver_folder.h"
#include "device/simulated/model.h"
#include "files/printable.h"

namespace forceshade::apps {
namespace {

nlohmann::ordered_json described(const device::DriverFolder& folder) {
  nlohmann::ordered_json kinds = nlohmann::ordered_json::array(), models = nlohmann::ordered_json::array();
  for (const device::Kind& kind : device::kinds()) kinds.push_back({{"device", kind.form()}, {"what", kind.words()}});
  for (const auto& make : device::kModels) models.push_back(make().name);
  return {{"kinds", kinds},
          {"models", models},
          {"folder", folder.path.string()},
          {"problem", folder.problem},
          {"names", folder.names}};
}

int list(const std::string& json) {
  const device::DriverFolder folder = device::driver_folder();
  write_json(json, described(folder));
  if (json == "-") return kHeld;
  std::printf("Kinds of device, for --device:\n");
  for (const device::Kind& kind : device::kinds()) std::printf("  %-30s %s\n", kind.form().c_str(), kind.words().c_str());
  std::printf("Models that can be simulated:");
  for (const auto& make : device::kModels) std::printf(" %s", make().name.data());
  const std::string path = files::printable(folder.path.string());
  if (!folder.problem.empty())
    std::printf("\nNo device is set up for the vendor's driver: %s\n", files::printable(folder.problem).c_str());
  else if (folder.names.empty())
    std::printf("\nNo device is set up for the vendor's driver: %s is empty\n", path.c_str());
  else
    std::printf("\nDevices that are set up for the vendor's driver, in %s:\n", path.c_str());
  for (const std::string& name : folder.names) std::printf("  \"phantom:%s\"\n", files::printable(name).c_str());
  return kHeld;
}

}  // namespace

void add_device(CLI::App& app, int& result) {
  const auto json = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("device",
                                         "List the kinds of device, and the devices that are set up for the vendor's driver; "
                                         "check one, and try one for the first time");
  add_json(*command, *json, "the list");
  add_device_check(*command, result);
  add_device_try(*command, result);
  command->callback([json, command, &result] {
    if (command->get_subcommands().empty()) result = list(*json);
  });
}

}  // namespace forceshade::apps
