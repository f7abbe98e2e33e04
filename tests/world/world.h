// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A simulated world for code that asks system/ for time, waiting and threads: link forceshade_world, and the same objects that
// ship run in it. Threads are fibers of one thread of the system; time is a number that goes on where everyone waits; who goes
// on at a step, and who is held up, comes from a schedule. A session is therefore the same to the bit in every run, in every
// build and on every machine, whatever else the machine does.
//
//   World world({.seed = 7, .holds = 0.02});
//   const auto end = world.run([&] { result = run_servo_loop(device, session, options, stop); }, 20 * system::kSecond);
//
// Without run(), a World is a clock of the test's own: nothing takes time there but what pass() and compute() say.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "system/system.h"
#include "tests/world/fiber.h"

namespace forceshade::world {

using Ns = std::int64_t;

// One decision of a schedule, which makes a session fail or not. A list of them is replayed, shrunk and pasted into a test.
struct Entry {
  enum class Kind {
    hold,    // the thread that makes this step is held up for `value` ns
    change,  // another one goes on
    first,   // of those that can go on where the last one waits, number `value` does
  };
  long step;
  Kind kind;
  std::int64_t value;

  std::string words() const;
};

struct Schedule {
  std::uint64_t seed = 0;
  double holds = 0, changes = 0;                // the chance of each at a step
  Ns longest_hold = 1'200'000;                  // a hold has any magnitude up to this
  std::optional<std::vector<Entry>> list = {};  // replayed instead, whatever the chances are
};

class World {
 public:
  explicit World(Schedule schedule = {});
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  enum class End { over, dead, never };  // never: not by the time that was given, or everyone waits for ever
  // Runs this as thread 0 until it is over; every thread that it begins gets the next number.
  End run(std::function<void()> body, Ns longest);
  // Goes on until this thread is over, too.
  End run_until_over(int thread, Ns longest);

  // The machine's clock, and that of what is outside the machine, which goes on while the machine stands still.
  Ns now() const noexcept { return now_; }
  Ns outside_now() const noexcept { return now_ + stopped_; }
  long steps() const noexcept { return steps_; }
  int threads() const noexcept { return static_cast<int>(threads_.size()); }
  int running() const noexcept { return running_; }
  int process() const noexcept;  // of the thread that runs
  bool is_over(int thread) const noexcept;
  const std::string& name(int thread) const noexcept;
  // The first one of this name; -1: there is none.
  int thread(std::string_view name) const noexcept;
  int processes() const noexcept { return static_cast<int>(processes_.size()); }
  // The time at which whatever a schedule or a fault has held up could go on again; now, where that is not known yet.
  Ns held_until() const noexcept;
  // The time for which the whole machine has stood still while its clock went on.
  Ns stood_still() const noexcept { return stood_still_; }
  const std::vector<Entry>& decisions() const noexcept { return decisions_; }

  // Called at each step of a thread, before it goes on: judges, places faults. The number is that of the step.
  std::function<void(long)> at_step;
  // Called when a process has ended, in whatever way.
  std::function<void(int)> on_process_end;

  // Faults. A thread that was not begun yet has none. A thread that is killed stops where it is, as when its process ends or a
  // call never returns.
  void kill(int thread) noexcept;
  // All threads of this process stop, and its ends of packets are closed. That of run() is the first, 0; each other has the
  // next number.
  void kill_process(int process) noexcept;
  // For a minute, unless it is resumed.
  void stop_process(int process) noexcept;
  void resume_process(int process) noexcept;
  // The thread that makes the step crashes: its process does its last act, and is killed.
  void crash() noexcept;
  // The exit code of a process, 128 and more after it was killed; none while it goes on.
  std::optional<int> exit_code(int process) const noexcept;
  // The thread that calls goes no further, unless it is interrupted.
  void be_stuck() noexcept;
  void hold(int thread, Ns time) noexcept;
  void hold_for_steps(int thread, long steps_of_others) noexcept;
  // The whole machine stands still: its clock goes on meanwhile, or it stands still, too, as in a virtual machine.
  void stand_still(Ns time, bool clock_goes_on = true) noexcept;

  // Time passes for the thread that calls, and with compute() it is its own work.
  void pass(double milliseconds) noexcept { now_ += static_cast<Ns>(milliseconds * 1e6); }
  void compute(double milliseconds) noexcept;
  // The next sleep ends so much too late; so many sleeps are cut short by a signal at their beginning.
  void oversleep(double milliseconds) noexcept { oversleep_ = milliseconds; }
  void interrupt(int times) noexcept { interruptions_ = times; }

  std::uint64_t random() noexcept;

 private:
  friend struct Calls;         // world.cpp: the functions of system/
  friend struct ProcessCalls;  // processes.cpp: those of its processes
  struct Thread;
  struct Process;

  int begin(const char* name, std::function<void()> body);
  void step() noexcept;
  void make_step() noexcept;
  void go(int to, bool last = false) noexcept;
  int choose() noexcept;
  bool can_go_on(const Thread& thread) const noexcept;
  void wait(Ns due, const void* number, int joined) noexcept;
  void wake_all(const void* number) noexcept;
  void be_interrupted() noexcept;
  void end_process(int process, int code) noexcept;
  const Entry* listed(Entry::Kind kind) const noexcept;
  bool happens(double chance) noexcept;
  Thread& self() noexcept { return *threads_[static_cast<std::size_t>(running_)]; }

  Schedule schedule_;
  std::vector<std::unique_ptr<Thread>> threads_;
  std::vector<std::unique_ptr<Process>> processes_;
  std::vector<std::unique_ptr<std::uint64_t[]>> mapped_;  // by several processes
  Fiber outside_;
  int running_ = -1, target_ = -1;  // threads; the first is -1 outside
  Ns now_ = system::kSecond, stopped_ = 0, stood_still_ = 0, limit_ = 0, held_until_ = 0, computed_ = system::kSecond;
  bool is_late_ = false;
  long steps_ = 0;
  std::uint64_t state_ = 0;
  std::vector<Entry> decisions_;
  double oversleep_ = 0;  // ms
  int interruptions_ = 0;
};

// The one that there is, or null.
World* current() noexcept;

}  // namespace forceshade::world
