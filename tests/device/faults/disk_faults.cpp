// SPDX-License-Identifier: BSD-3-Clause
// What the recording is written to. The force must not know.

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <new>
#include <thread>

#include "forceshade/device.h"
#include "forceshade/fast.h"
#include "forceshade/recording.h"
#include "tests/device/faults/press.h"
#include "tests/recorder/faulty_disk.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/wait_until.h"

namespace forceshade::faults {
namespace {

using tests::FaultyDisk;

// Samples that come after the fault: the ticks to the end and the zero.
constexpr double kRest = kEnd + 1 - kResting;

// `at_fault` is called once all samples before it are in the file.
Fault disk(std::string what, std::string reaction, double lost, std::function<void(const std::string& recording)> at_fault,
           recorder::Recorder::Options options = {}, Wrong wrong = {}) {
  return {.kind = Kind::disk,
          .what = std::move(what),
          .reaction = std::move(reaction),
          .to_zero = std::nullopt,
          .lost = lost,
          .run = [=](const Bench& bench) {
            const FaultyDisk disk;
            const auto begin = [&](const std::string& path) {
              const std::size_t pushed = bench.records_all ? kResting : kResting - kResting / 100;
              if (options.ring >= kEnd) tests::wait_until([&] { return recorder::Recording(path).extent().samples == pushed; });
              at_fault(path);
            };
            return press(wrong, bench, {.recorder = options, .at_fault = begin});
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
            } catch (const recorder::RecordingError& error) {
              outcome.reaction = std::string("refused: ") + error.what();
            }
            if (directory.entries() != entries) outcome.reaction += "; a file is left";
            return outcome;
          }};
}

// The whole program dies, its threads with it.
struct Shared {
  std::atomic<std::uint64_t> pushed;
  std::atomic<float> force;
  std::int64_t pushed_at[60'000];  // ns
};

std::int64_t now() {
  return std::chrono::steady_clock::now().time_since_epoch().count();
}

class ToParent final : public device::SampleSink {
 public:
  explicit ToParent(Shared& shared) : shared_(shared) {}
  void push(const device::Sample& sample) noexcept override {
    shared_.pushed_at[sample.tick] = now();
    shared_.force = sample.force[2];
    shared_.pushed = sample.tick + 1;
    // The loop below is not paced, so that a busy machine is no fault of its own.
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

 private:
  Shared& shared_;
};

Outcome killed(int signal) {
  const tests::TemporaryDirectory directory;
  const std::string path = directory.file("run.fsr");
  void* memory = mmap(nullptr, sizeof(Shared), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  auto& shared = *new (memory) Shared;
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGSEGV, SIG_DFL);  // a sanitizer has its own
    const auto device = device::open_device("simulated");
    const auto law = std::get<fast::Law>(fast::Law::build(LawId::wall, {.stiffness = 0.5F}));
    recorder::Recorder recorder(path, {});
    ToParent told(shared);
    run_servo_loop(*device, law, {.max_seconds = 50, .paced = false, .sinks = {&told, &recorder}}, std::atomic<bool>(false));
    _exit(0);
  }
  Outcome outcome;
  tests::wait_until([&] { return shared.force > 0.2F; });
  outcome.took_effect = true;
  outcome.before = outcome.highest = static_cast<double>(shared.force);
  ::kill(child, signal);
  const std::int64_t killed_at = now();
  int status = 0;
  waitpid(child, &status, 0);
  recorder::Recording recording(path);
  const auto samples = recording.extent().samples;
  outcome.reaction = recording.ended() ? "recording ended" : "cut off";
  outcome.to_zero = 0;
  outcome.lost = samples == shared.pushed ? 0 : static_cast<double>(killed_at - shared.pushed_at[samples]) / 1e6;
  munmap(memory, sizeof(Shared));
  return outcome;
}

Fault death(std::string what, int signal) {
  return {.kind = Kind::disk,
          .what = std::move(what),
          .reaction = "cut off",
          .to_zero = 0,
          .lost = 100,
          .lost_unit = "ms",
          .is_timed = true,
          .run = [=](const Bench&) { return killed(signal); }};
}

}  // namespace

std::vector<Fault> disk_faults() {
  using Directory = tests::TemporaryDirectory;
  using std::chrono::hours;
  return {
      disk("the disk gets full", "goes on, same forces ... database or disk is full; counted as lost: 501", kRest,
           [](const auto&) { FaultyDisk::full = true; }),
      disk("the disk gets full and has room again", "goes on, same forces", 0, [](const auto&) { FaultyDisk::full = true; }, {},
           {.read =
                [](device::ReadResult&, Wrong::Since since) {
                  if (since != 100) return;
                  tests::wait_until([] { return FaultyDisk::refused_writes > 0; });
                  FaultyDisk::full = false;
                }}),
      disk("the disk is unplugged", "goes on, same forces ... disk I/O error; counted as lost: 501", kRest,
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
      death("kill -9 in contact", SIGKILL),
      death("a crash in contact (SIGSEGV)", SIGSEGV),
  };
}

}  // namespace forceshade::faults
