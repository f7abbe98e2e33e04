// SPDX-License-Identifier: BSD-3-Clause
// The functions of system/process.h in the simulated world, where all processes are groups of fibers: what one has made before
// another begins is common to both, and they must treat it as the copy that a process has.

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "tests/world/threads.h"

namespace forceshade::world {
namespace {

constexpr int kKilled = 128 + SIGKILL, kCrashed = 128 + SIGSEGV;

}  // namespace

int World::process() const noexcept {
  return running_ < 0 ? 0 : threads_[static_cast<std::size_t>(running_)]->process;
}

std::optional<int> World::exit_code(int process) const noexcept {
  const auto number = static_cast<std::size_t>(process);
  return number < processes_.size() ? processes_[number]->code : std::nullopt;
}

void World::end_process(int process, int code) noexcept {
  Process& ended = *processes_[static_cast<std::size_t>(process)];
  if (ended.code) return;
  ended.code = code;
  for (const auto& it : threads_)
    if (it->process == process && it->state != Thread::State::over) it->state = Thread::State::dead;
  for (const auto& it : processes_) {
    if (it.get() != &ended && it->parent != process) continue;
    it->closed[it.get() == &ended ? 1 : 0] = true;
    wake_all(it.get());
  }
  if (on_process_end) on_process_end(process);
}

void World::kill_process(int process) noexcept {
  end_process(process, kKilled);
}

void World::stop_process(int process) noexcept {
  for (int thread = 0; thread < threads(); ++thread) {
    Thread& it = *threads_[static_cast<std::size_t>(thread)];
    if (it.process != process) continue;
    it.is_stopped = true;
    hold(thread, 60 * system::kSecond);
  }
}

void World::resume_process(int process) noexcept {
  for (const auto& it : threads_)
    if (it->process == process && std::exchange(it->is_stopped, false)) it->held_until = held_until_ = now_;
}

void World::crash() noexcept {
  Process& its = *processes_[static_cast<std::size_t>(self().process)];
  if (its.act) its.act->let_go();
  end_process(self().process, kCrashed);
}

void World::be_stuck() noexcept {
  for (;;) wait(system::kForever, nullptr, -1);
}

void World::be_interrupted() noexcept {
  Thread& it = self();
  if (!it.allows_interrupt || !std::exchange(it.is_interrupted, false)) return;
  system::LastAct* const act = processes_[static_cast<std::size_t>(it.process)]->act;
  if (act && act->interrupted()) be_stuck();
}

struct ProcessCalls {
  static World& world() noexcept { return *current(); }
  static World::Process& of(int end) noexcept { return *world().processes_[static_cast<std::size_t>(end / 2)]; }
  static World::Process& own() noexcept { return *world().processes_[static_cast<std::size_t>(world().self().process)]; }
  static void step() noexcept { world().step(); }

  static bool send(int end, const void* message, std::size_t size) {
    step();
    World::Process& it = of(end);
    const auto other = static_cast<std::size_t>(1 - end % 2);
    if (it.closed[other]) return false;
    const auto* bytes = static_cast<const std::byte*>(message);
    acquire(&it);
    it.received[other].emplace_back(bytes, bytes + size);
    release(&it);
    world().wake_all(&it);
    step();
    return true;
  }
  // Waits for a message, if asked to, or for the other end to be closed; false when the time is over.
  static bool waits(int end, std::int64_t deadline, bool for_message) {
    World::Process& it = of(end);
    const auto own = static_cast<std::size_t>(end % 2);
    step();
    for (;;) {
      if ((for_message && !it.received[own].empty()) || it.closed[1 - own]) return true;
      if (world().now() >= deadline) return false;
      world().wait(deadline, &it, -1);
    }
  }
  static system::Packets::Received receive(int end, void* message, std::size_t size, std::int64_t deadline) {
    using Received = system::Packets::Received;
    if (!waits(end, deadline, true)) return Received::nothing_yet;
    acquire(&of(end));
    auto& received = of(end).received[static_cast<std::size_t>(end % 2)];
    if (received.empty() || received.front().size() != size) return Received::closed;
    std::memcpy(message, received.front().data(), size);
    received.pop_front();
    release(&of(end));
    return Received::message;
  }
  static void close(int end) {
    step();
    of(end).closed[static_cast<std::size_t>(end % 2)] = true;
    world().wake_all(&of(end));
  }

  // Its number.
  static int begin(const char* name, const std::function<int(system::Packets&)>& body) {
    World& w = world();
    const auto number = static_cast<int>(w.processes_.size());
    w.processes_.push_back(std::make_unique<World::Process>());
    w.processes_.back()->parent = w.self().process;
    const int thread = w.begin(name, [body, number] {
      system::Packets packets(2 * number + 1, 0);
      end(body(packets));
    });
    w.threads_[static_cast<std::size_t>(thread)]->process = number;
    step();
    return number;
  }
  [[noreturn]] static void end(int code) noexcept {
    World& w = world();
    w.end_process(w.self().process, code);
    w.go(w.choose(), true);
    std::abort();
  }
  static std::optional<int> ended(int process, std::int64_t deadline) {
    World& w = world();
    World::Process& it = *w.processes_[static_cast<std::size_t>(process)];
    for (step(); !it.code; w.wait(deadline, &it, -1))
      if (w.now() >= deadline) return std::nullopt;
    return it.code;
  }
  static void before_end(system::LastAct& act) noexcept { own().act = &act; }
  static int this_thread() noexcept { return world().running_; }
  static void allow_interrupt() noexcept { world().self().allows_interrupt = true; }
  static void interrupt(int thread) noexcept {
    if (thread < 0) return;
    World::Thread& it = *world().threads_[static_cast<std::size_t>(thread)];
    it.is_interrupted = true;
    if (it.allows_interrupt) it.due = world().now();
    step();
  }
  // Kept until the world's end, as memory is that another process has mapped, too.
  static void* map(std::size_t size) {
    world().mapped_.push_back(std::make_unique<std::uint64_t[]>((size + 7) / 8));
    return world().mapped_.back().get();
  }
};

}  // namespace forceshade::world

namespace forceshade::system {

using world::ProcessCalls;

bool Packets::send(const void* message, std::size_t size) noexcept {
  return ProcessCalls::send(end_, message, size);
}

Packets::Received Packets::receive(void* message, std::size_t size, std::int64_t deadline) noexcept {
  return ProcessCalls::receive(end_, message, size, deadline);
}

bool Packets::is_alone(std::int64_t deadline) noexcept {
  return ProcessCalls::waits(end_, deadline, false);
}

KilledFirst::KilledFirst() noexcept = default;
KilledFirst::~KilledFirst() = default;

Process::Process(const char* name, const std::function<int(Packets&)>& body)
    : id_(ProcessCalls::begin(name, body)), packets_(2 * id_, 0) {}

Process::~Process() {
  close();
}

void Process::close() noexcept {
  if (packets_.end() >= 0) ProcessCalls::close(packets_.end());
  packets_ = {-1, 0};
}

std::optional<Process::Ended> Process::ended(std::int64_t deadline) noexcept {
  const std::optional<int> code = ProcessCalls::ended(id_, deadline);
  if (!code) return std::nullopt;
  return *code > 128 ? Ended{.signal = *code - 128} : Ended{.code = *code};
}

void Process::resume() noexcept {
  world::current()->resume_process(id_);
}

void Process::kill() noexcept {
  world::current()->kill_process(id_);
}

void before_end(LastAct& act) noexcept {
  ProcessCalls::before_end(act);
}

void end(int code) noexcept {
  ProcessCalls::end(code);
}

int this_thread() noexcept {
  return ProcessCalls::this_thread();
}

void allow_interrupt() noexcept {
  ProcessCalls::allow_interrupt();
}

void interrupt(int thread) noexcept {
  ProcessCalls::interrupt(thread);
}

void* map_shared(std::size_t size) {
  return ProcessCalls::map(size);
}

void unmap_shared(void*, std::size_t) noexcept {}

}  // namespace forceshade::system
