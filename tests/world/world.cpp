// SPDX-License-Identifier: BSD-3-Clause
#include "tests/world/world.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "tests/world/threads.h"

namespace forceshade::world {
namespace {

constexpr Ns kStep = 300;            // that a step takes
constexpr Ns kRelease = 20'000'000;  // a thread that is held for steps of others goes on where none of them has any to make

World* the_world = nullptr;

}  // namespace

World* current() noexcept {
  return the_world;
}

std::string Entry::words() const {
  char text[96];
  switch (kind) {
    case Kind::hold:
      std::snprintf(text, sizeof text, "step %ld: the thread is held up for %.6f ms", step, static_cast<double>(value) * 1e-6);
      break;
    case Kind::change: std::snprintf(text, sizeof text, "step %ld: another thread goes on", step); break;
    case Kind::first:
      std::snprintf(text, sizeof text, "step %ld: thread %lld goes on", step, static_cast<long long>(value));
      break;
  }
  return text;
}

World::World(Schedule schedule)
    : schedule_(std::move(schedule)), state_(schedule_.seed * 0x2545F4914F6CDD1DULL + 0x9e3779b97f4a7c15ULL) {
  if (the_world != nullptr) std::abort();
  the_world = this;
  processes_.push_back(std::make_unique<Process>());
}

// A thread that is not over never gives back what it holds, as where a process ends.
World::~World() {
  the_world = nullptr;
  static auto& left = *new std::vector<std::unique_ptr<Thread>>;
  for (auto& it : threads_)
    if (it->state != Thread::State::over) left.push_back(std::move(it));
}

std::uint64_t World::random() noexcept {  // splitmix64
  std::uint64_t z = state_ += 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

bool World::happens(double chance) noexcept {
  return chance > 0 && static_cast<double>(random() >> 11U) * 0x1p-53 < chance;
}

const Entry* World::listed(Entry::Kind kind) const noexcept {
  const auto found =
      std::ranges::find_if(*schedule_.list, [&](const Entry& it) { return it.step == steps_ && it.kind == kind; });
  return found == schedule_.list->end() ? nullptr : &*found;
}

int World::begin(const char* name, std::function<void()> body) {
  const int number = threads();
  threads_.push_back(std::make_unique<Thread>(name, [this, number, its = std::move(body)]() mutable {
    its();
    its = nullptr;  // a thread destroys what it has run
    Thread& self = *threads_[static_cast<std::size_t>(number)];
    self.state = Thread::State::over;
    release(&self.fiber);
    for (const auto& other : threads_)
      if (other->joined == number) other->due = now_;
    go(choose(), true);
  }));
  threads_.back()->process = process();
  release(&threads_.back()->fiber);
  return number;
}

World::End World::run(std::function<void()> body, Ns longest) {
  return run_until_over(begin("first", std::move(body)), longest);
}

World::End World::run_until_over(int thread, Ns longest) {
  target_ = thread;
  limit_ = now_ + longest;
  is_late_ = false;
  if (const int next = choose(); next >= 0) go(next);
  const Thread& its = *threads_[static_cast<std::size_t>(thread)];
  if (its.state == Thread::State::over) return End::over;
  return is_late_ ? End::never : End::dead;
}

const std::string& World::name(int thread) const noexcept {
  return threads_[static_cast<std::size_t>(thread)]->name;
}

int World::thread(std::string_view name) const noexcept {
  const auto found = std::ranges::find_if(threads_, [&](const auto& it) { return it->name == name; });
  return found == threads_.end() ? -1 : static_cast<int>(found - threads_.begin());
}

bool World::is_over(int thread) const noexcept {
  const auto state = threads_[static_cast<std::size_t>(thread)]->state;
  return state == Thread::State::over || state == Thread::State::dead;
}

bool World::can_go_on(const Thread& thread) const noexcept {
  if (thread.held_until > now_ || thread.held_steps > 0) return false;
  return thread.state == Thread::State::ready || (thread.state == Thread::State::waiting && thread.due <= now_);
}

// The thread that goes on; -1: the outside. Where none can, time goes on to when the first one can.
int World::choose() noexcept {
  for (;;) {
    if (is_over(target_)) return -1;
    is_late_ = now_ > limit_;
    if (is_late_) return -1;
    std::vector<int> able;
    Ns first = system::kForever;
    bool is_held = false;
    for (int i = 0; i < threads(); ++i) {
      const Thread& it = *threads_[static_cast<std::size_t>(i)];
      if (can_go_on(it)) able.push_back(i);
      if (is_over(i)) continue;
      is_held = is_held || it.held_steps > 0;
      if (it.held_steps == 0) first = std::min(first, std::max(it.state == Thread::State::ready ? 0 : it.due, it.held_until));
    }
    if (!able.empty()) {
      if (schedule_.list) {
        const Entry* entry = listed(Entry::Kind::first);
        const bool is_able = entry != nullptr && std::ranges::find(able, static_cast<int>(entry->value)) != able.end();
        return is_able ? static_cast<int>(entry->value) : able.front();
      }
      if (able.size() == 1 || schedule_.seed == 0) return able.front();
      const int chosen = able[random() % able.size()];
      if (chosen != able.front()) decisions_.push_back({steps_, Entry::Kind::first, chosen});
      return chosen;
    }
    if (is_held && first > now_ + kRelease) {
      for (const auto& it : threads_) it->held_steps = 0;
      held_until_ = now_;
      continue;
    }
    is_late_ = first == system::kForever;
    if (is_late_) return -1;
    now_ = std::max(now_, first);
  }
}

void World::go(int to, bool last) noexcept {
  const int from = std::exchange(running_, to);
  if (from == to) return;
  const auto fiber_of = [this](int thread) -> Fiber& {
    return thread < 0 ? outside_ : threads_[static_cast<std::size_t>(thread)]->fiber;
  };
  fiber_of(from).go_to(fiber_of(to), last);
}

void World::wait(Ns due, const void* number, int joined) noexcept {
  Thread& it = self();
  it.state = Thread::State::waiting;
  it.due = due;
  it.number = number;
  it.joined = joined;
  go(choose());
  it.state = Thread::State::ready;
  it.number = nullptr;
  it.joined = -1;
  be_interrupted();
}

void World::wake_all(const void* number) noexcept {
  for (const auto& it : threads_)
    if (it->number == number) it->due = now_;
}

void World::step() noexcept {
  if (running_ < 0) return;
  make_step();
  be_interrupted();
}

void World::make_step() noexcept {
  now_ += kStep;
  Thread& it = self();
  it.computed += kStep;
  if (at_step) at_step(steps_);
  for (int i = 0; i < threads(); ++i) {
    Thread& other = *threads_[static_cast<std::size_t>(i)];
    if (&other == &it || other.held_steps == 0 || --other.held_steps > 0 || !can_go_on(other)) continue;
    ++steps_;
    held_until_ = now_;
    return go(i);
  }
  bool changes = false;
  if (schedule_.list) {
    if (const Entry* entry = listed(Entry::Kind::hold)) hold(running_, entry->value);
    changes = listed(Entry::Kind::change) != nullptr;
  } else {
    if (happens(schedule_.holds)) {
      const Ns most = schedule_.longest_hold >> (random() % 12);
      const Ns time = static_cast<Ns>(random() % static_cast<std::uint64_t>(most + 1));
      decisions_.push_back({steps_, Entry::Kind::hold, time});
      hold(running_, time);
    }
    changes = happens(schedule_.changes);
    if (changes) decisions_.push_back({steps_, Entry::Kind::change, 0});
  }
  ++steps_;
  if (changes || !can_go_on(it) || now_ > limit_) go(choose());
}

void World::kill(int thread) noexcept {
  if (thread >= threads()) return;
  threads_[static_cast<std::size_t>(thread)]->state = Thread::State::dead;
}

void World::hold(int thread, Ns time) noexcept {
  if (thread >= threads()) return;
  Ns& until = threads_[static_cast<std::size_t>(thread)]->held_until;
  until = std::max(until, now_ + time);
  held_until_ = std::max(held_until_, until);
}

void World::hold_for_steps(int thread, long steps_of_others) noexcept {
  threads_[static_cast<std::size_t>(thread)]->held_steps = steps_of_others;
}

Ns World::held_until() const noexcept {
  const bool is_held = std::ranges::any_of(threads_, [](const auto& it) { return it->held_steps > 0; });
  return is_held ? std::max(now_, held_until_) : held_until_;
}

void World::stand_still(Ns time, bool clock_goes_on) noexcept {
  (clock_goes_on ? now_ : stopped_) += time;
  if (clock_goes_on) stood_still_ += time;
  held_until_ = std::max(held_until_, now_);
}

void World::compute(double milliseconds) noexcept {
  pass(milliseconds);
  (running_ < 0 ? computed_ : self().computed) += static_cast<Ns>(milliseconds * 1e6);
}

// The functions of system/ in the world that there is.
struct Calls {
  static World& world() noexcept {
    if (the_world == nullptr) std::abort();  // a test that links the world makes one before it calls what it tests
    return *the_world;
  }
  static bool is_outside() noexcept { return world().running_ < 0; }
  static void step() noexcept { world().step(); }
  static Ns now() noexcept {
    world().step();
    return world().now_;
  }
  static Ns processor_time() noexcept { return is_outside() ? world().computed_ : world().self().computed; }
  static bool sleep_until(Ns due) noexcept {
    World& w = world();
    w.step();
    if (w.interruptions_ > 0) return --w.interruptions_ < 0;
    const Ns until = std::max(w.now_, due) + static_cast<Ns>(std::exchange(w.oversleep_, 0) * 1e6);
    if (is_outside())
      w.now_ = until;
    else
      w.wait(until, nullptr, -1);
    return true;
  }
  static void wait_for_change(const system::Number& number, std::uint32_t seen, Ns deadline) noexcept {
    World& w = world();
    w.step();
    if (number != seen) return;
    if (is_outside())
      w.now_ = std::max(w.now_, deadline);
    else
      w.wait(deadline, &number, -1);
  }
  static void wake(const system::Number& number) noexcept {
    World& w = world();
    const auto waiting = std::ranges::find_if(w.threads_, [&](const auto& it) { return it->number == &number; });
    if (waiting != w.threads_.end()) (*waiting)->due = w.now_;
    w.step();
  }
  static int begin(const char* name, std::function<void()> body) { return world().begin(name, std::move(body)); }
  static void join(int thread) noexcept {
    World& w = world();
    w.step();
    if (!w.is_over(thread)) {
      if (is_outside())
        w.run_until_over(thread, system::kForever - w.now_);
      else
        w.wait(system::kForever, nullptr, thread);
    }
    acquire(&w.threads_[static_cast<std::size_t>(thread)]->fiber);
  }
};

}  // namespace forceshade::world

namespace forceshade::system {

using world::Calls;

std::int64_t now() noexcept {
  return Calls::now();
}

std::int64_t processor_time() noexcept {
  return Calls::processor_time();
}

std::string date(const char*) {
  return "2026-01-31T23:59:59Z";
}

std::uint32_t random() {
  return static_cast<std::uint32_t>(Calls::world().random());
}

bool sleep_until(std::int64_t due) noexcept {
  return Calls::sleep_until(due);
}

void wait_for_change(const Number& number, std::uint32_t seen, std::int64_t deadline) noexcept {
  Calls::wait_for_change(number, seen, deadline);
}

void wake(const Number& number) noexcept {
  Calls::wake(number);
}

void step() noexcept {
  Calls::step();
}

struct Thread::Implementation {
  int number;
};

Thread::Thread() noexcept = default;
Thread::Thread(Thread&& other) noexcept = default;
Thread& Thread::operator=(Thread&& other) noexcept = default;
Thread::~Thread() = default;

Thread::Thread(const char* name, std::function<void()> body)
    : it_(std::make_unique<Implementation>(Implementation{Calls::begin(name, std::move(body))})) {}

void Thread::join() noexcept {
  Calls::join(it_->number);
  it_.reset();
}

void Thread::leave() noexcept {
  it_.reset();
}

RealTime::RealTime(std::optional<int>, int) noexcept {}
RealTime::~RealTime() = default;

std::optional<int> processor_before_last() noexcept {
  return std::nullopt;
}

}  // namespace forceshade::system
