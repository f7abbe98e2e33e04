// SPDX-License-Identifier: BSD-3-Clause
// Drives a device with a certified bump for two seconds and keeps a recording: drive CERTIFICATE DEVICE RECORD.
#include <forceshade/device.h>
#include <forceshade/run.h>

#include <cstdio>

using namespace forceshade;

int main(int argc, char** argv) {
  if (argc != 4) return std::puts("usage: drive CERTIFICATE DEVICE RECORD"), 2;
  const Rendering bump = std::get<Rendering>(rendering_of(LawId::bump_2p, {15.24F, 25.4F, 0.5F}));  // mm, mm, N/mm
  const run::Certified covered = run::certified(argv[1], bump.identity);
  if (!covered.digest) return std::printf("refused: %s\n", covered.why_not.c_str()), 1;
  const auto device = device::open_device(argv[2]);
  const std::atomic<bool> stop = false;
  const run::Plan plan{.device = argv[2], .digest = covered.digest, .record = argv[3], .servo = {.max_seconds = 2}};
  const run::Outcome outcome = run::run(*device, bump, plan, stop);
  std::printf("%zu ticks, peak force %.3f N\n", outcome.result.ticks, outcome.result.peak_force_N);
  return run::has_failed(outcome.result) || !outcome.record_faults.empty() ? 3 : 0;
}
