// SPDX-License-Identifier: BSD-3-Clause
// patient haply|dhd|command:PROGRAM: drives a wall, as forceshade drive does but with patient options, until SIGINT, SIGTERM or
// SIGHUP, and records it in run.fsr. Exit code 3 and words where the device fails.

#include "tests/device/patient.h"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <string>

#include "device/command/command.h"
#include "device/dhd/dhd.h"
#include "device/haply/haply.h"
#include "forceshade/fast.h"
#include "forceshade/recording.h"
#include "forceshade/servo_loop.h"

namespace {

using namespace forceshade;

std::atomic<bool> stop = false;

std::unique_ptr<device::Device> opened(const std::string& name) {
  static device::Attendant nobody;
  if (name == "haply") return device::open_haply("", device::kPatient, nobody);
  if (name == "dhd") return device::open_dhd("", device::kPatient, nobody);
  return device::open_command(name.substr(name.find(':') + 1), device::kPatient, nobody);
}

}  // namespace

int main(int, char** words) try {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, [](int) { stop = true; });
  const auto arm = opened(words[1]);
  const auto law = std::get<fast::Law>(fast::Law::build(LawId::wall, {.stiffness = 0.5F}));
  recorder::Recorder recorder("run.fsr", {});
  device::ServoOptions options = device::patient_loop();
  options.sinks = {&recorder};
  const device::ServoResult run = run_servo_loop(*arm, law, options, stop);
  recorder.close(std::string(name_of(run.end_reason)));
  if (run.end_reason == device::EndReason::stopped) return 0;
  std::fprintf(stderr, "%s %s\n", name_of(run.end_reason).data(), run.fault);
  return 3;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 3;
}
