// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// DHD's functions as a test sets them, each call written down; and the stand-in's library, loaded anew.

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "device/dhd/dhd_library.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::device::dhd {

// The answers of a fake device, and the calls that it got. One a test.
struct Fake {
  std::vector<std::string> calls;
  int status[17] = {1, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0};
  int count = 1, available = 1, type = 33, position_result = 0, force_result = 0, status_result = 0, watchdog_result = 0;
  int error = 2;
  unsigned short serial = 1234;
  double position[3] = {0.001, 0.002, 0.003};  // m
  unsigned buttons = 5;
  bool switches_on = true;  // dhdEnableForce sets the status
};
inline Fake fake;

template <class... Values>
void wrote(const char* name, Values... values) {
  std::ostringstream words;
  words << name;
  ((words << ' ' << values), ...);
  fake.calls.push_back(words.str());
}

inline Functions fake_functions() {
  fake = Fake{};
  Functions its{};
  its.dhdGetDeviceCount = [] { return fake.count; };
  its.dhdGetAvailableCount = [] { return fake.available; };
  its.dhdOpenID = [](Id index) { return wrote("open", static_cast<int>(index)), static_cast<int>(index); };
  its.dhdOpenSerial = [](int serial) { return wrote("open serial", serial), serial == fake.serial ? 0 : -1; };
  its.dhdClose = [](Id) { return wrote("close"), 0; };
  its.dhdStop = [](Id) { return wrote("stop"), 0; };
  its.dhdGetSerialNumber = [](unsigned short* serial, Id) { return *serial = fake.serial, 0; };
  its.dhdGetSystemType = [](Id) { return fake.type; };
  its.dhdGetSystemName = [](Id) { return "its name"; };
  its.dhdIsLeftHanded = [](Id) { return false; };
  its.dhdHasGripper = [](Id) { return true; };
  its.dhdGetGripperGap = [](double* gap, Id) { return *gap = 0.0125, 0; };
  its.dhdGetStatus = [](int* status, Id) { return std::copy_n(fake.status, 17, status), fake.status_result; };
  its.dhdEnableForce = [](unsigned char on, Id) {
    wrote("enable", int{on});
    if (fake.switches_on) fake.status[kForce] = on;
    return 0;
  };
  its.dhdSetBrakes = [](int on, Id) { return wrote("brakes", on), 0; };
  its.dhdSetGravityCompensation = [](int on, Id) { return wrote("gravity", on), 0; };
  its.dhdSetMaxForce = [](double most, Id) { return wrote("max", most), 0; };
  its.dhdGetPosition = [](double* x, double* y, double* z, Id) {
    *x = fake.position[0];
    *y = fake.position[1];
    *z = fake.position[2];
    return fake.position_result;
  };
  its.dhdSetForce = [](double x, double y, double z, Id) { return wrote("force", x + 0, y + 0, z + 0), fake.force_result; };
  its.dhdGetButtonMask = [](Id) { return fake.buttons; };
  its.dhdEnableExpertMode = [] { return wrote("expert"), 0; };
  its.dhdSetWatchdog = [](unsigned char units, Id) { return wrote("watchdog", int{units}), fake.watchdog_result; };
  its.dhdErrorGetLast = [] { return fake.error; };
  its.dhdErrorGetLastStr = [] { return "their words"; };
  return its;
}

// A library of its own, which a device that is opened from now on loads.
class StandIn {
 public:
  // Takes the values of --assume and --event, separated by commas.
  explicit StandIn(const std::string& settings) {
    const std::string library = here_.file("libdhd.so.3");
    std::filesystem::copy_file(STAND_IN_DHD, library);
    std::filesystem::copy_file(STAND_IN_DHD, here_.file("judge.so"));
    ::setenv("FORCESHADE_DHD_LIBRARY", library.c_str(), 1);
    ::setenv("FORCESHADE_STANDIN_DHD", settings.c_str(), 1);
    ::setenv("FORCESHADE_STANDIN_JOURNAL", here_.file("journal").c_str(), 1);
  }

  // Once the device is closed.
  nlohmann::json verdict() {
    void* const judge = dlopen(here_.file("judge.so").c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!judge) throw std::runtime_error(dlerror());
    const auto write = reinterpret_cast<int (*)(const char*, const char*)>(dlsym(judge, "forceshade_stand_in_verdict"));
    const int kinds = write(here_.file("journal").c_str(), here_.file("report").c_str());
    auto report = nlohmann::json::parse(here_.read("report"));
    report["kinds"] = kinds;
    return report;
  }

 private:
  tests::TemporaryDirectory here_;
};

}  // namespace forceshade::device::dhd
