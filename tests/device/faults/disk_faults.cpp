// SPDX-License-Identifier: BSD-3-Clause
// Faults of the disk that the recording is written to. They must not change the force.

#include <chrono>
#include <filesystem>

#include "forceshade/recording.h"
#include "tests/device/faults/press.h"
#include "tests/recorder/faulty_disk.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::faults {
namespace {

using tests::FaultyDisk;

// The most that may be lost: the samples after the fault, and those that were not written yet.
constexpr std::size_t kRest = kEnd + 1 - kResting + 25;

Fault disk(std::string what, std::string reaction, std::size_t lost, std::function<void(const std::string& recording)> at_fault,
           recorder::Recorder::Options options = {}, Wrong wrong = {}) {
  return {.kind = Kind::disk,
          .what = std::move(what),
          .reaction = std::move(reaction),
          .to_zero = std::nullopt,
          .lost = lost,
          .run = [=](const Bench& bench) {
            const FaultyDisk disk;
            return press(wrong, bench, {.recorder = options, .at_fault = at_fault});
          }};
}

// A recording that cannot be begun: there is no run, and nothing is left behind.
Fault no_recording(std::string what, std::string reaction, std::function<std::string(const tests::TemporaryDirectory&)> path) {
  return {.kind = Kind::disk,
          .what = std::move(what),
          .reaction = std::move(reaction),
          .to_zero = 0,
          .under_force = false,
          .run = [=](const Bench&) {
            const FaultyDisk disk;
            const tests::TemporaryDirectory directory;
            const std::string file = path(directory);
            const auto entries = directory.entries();
            Outcome outcome{.took_effect = true, .to_zero = 0};
            try {
              const recorder::Recorder recorder(file, {});
              outcome.reaction = "recorded";
            } catch (const Error& error) {
              outcome.reaction = std::string("refused: ") + error.what();
            }
            if (directory.entries() != entries) outcome.reaction += "; a file is left";
            return outcome;
          }};
}

}  // namespace

std::vector<Fault> disk_faults() {
  using Directory = tests::TemporaryDirectory;
  using std::chrono::hours;
  return {
      disk("the disk gets full", "goes on, same forces ... database or disk is full; counted as lost", kRest,
           [](const auto&) { FaultyDisk::full = true; }),
      disk("the disk gets full and has room again", "goes on, same forces", 0, [](const auto&) { FaultyDisk::full = true; }, {},
           {.read =
                [](device::ReadResult& result, Wrong::Since since) {
                  if (since != 100) return;
                  if (FaultyDisk::refused_writes == 0) result = device::Fault{"nothing was written meanwhile"};
                  FaultyDisk::full = false;
                }}),
      disk("the disk is unplugged", "goes on, same forces ... disk I/O error; counted as lost", kRest,
           [](const auto&) { FaultyDisk::unplugged = true; }),
      disk("each write takes 20 ms, each sync 200 ms", "goes on, same forces", 0,
           [](const auto&) {
             FaultyDisk::write_ms = 20;
             FaultyDisk::sync_ms = 200;
           }),
      // Nothing is written in this run but at its end.
      disk("the ring of the recorder is full after 100 samples", "goes on, same forces; counted as lost: 1101", kEnd + 1 - 100,
           [](const auto&) {}, {.ring = 100, .interval = hours(1)}),
      disk("the recording is deleted while it is made", "goes on, same forces ... was deleted while it was made", kEnd + 1,
           [](const auto& path) {
             for (const char* suffix : {"", "-wal", "-shm"}) std::filesystem::remove(path + suffix);
           }),
      no_recording("a recording of that name exists", "refused ... File exists",
                   [](const Directory& d) { return d.write("run.fsr", "x"); }),
      no_recording("the recording's directory is missing", "refused ... No such file or directory",
                   [](const Directory& d) { return d.file("absent/run.fsr"); }),
      no_recording("the recording's directory is a file", "refused ... Not a directory",
                   [](const Directory& d) { return d.write("file", "x") + "/run.fsr"; }),
      no_recording("the disk is full from the start", "refused ... database or disk is full",
                   [](const Directory& d) {
                     FaultyDisk::full = true;
                     return d.file("run.fsr");
                   }),
  };
}

}  // namespace forceshade::faults
