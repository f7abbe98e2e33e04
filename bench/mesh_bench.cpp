// SPDX-License-Identifier: BSD-3-Clause
// The god-object's time for a tick, beside that of a naive binary32 one on the same path: forceshade_mesh_bench
// [MOST_TRIANGLES [LEAST_TRIANGLES]].

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <numeric>
#include <random>
#include <string>
#include <variant>

#include "forceshade/bench/mesh_workloads.h"
#include "forceshade/bench/naive_mesh.h"
#include "forceshade/fast/meshes/large_pages.h"
#include "forceshade/fast/meshes/session.h"

namespace {
std::atomic<std::size_t> allocations{0};
}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* place = std::malloc(size)) return place;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto to = static_cast<std::size_t>(alignment);
  if (void* place = std::aligned_alloc(to, (size + to - 1) / to * to)) return place;
  throw std::bad_alloc();
}
void operator delete(void* place) noexcept {
  std::free(place);
}
void operator delete(void* place, std::size_t) noexcept {
  std::free(place);
}
void operator delete(void* place, std::align_val_t) noexcept {
  std::free(place);
}
void operator delete(void* place, std::size_t, std::align_val_t) noexcept {
  std::free(place);
}

namespace forceshade::bench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

#if defined(__x86_64__)
inline std::uint64_t now() {
  unsigned processor = 0;
  const std::uint64_t count = __builtin_ia32_rdtscp(&processor);
  __builtin_ia32_lfence();
  return count;
}
#else
inline std::uint64_t now() {
  return static_cast<std::uint64_t>(Clock::now().time_since_epoch().count());
}
#endif

// Of now(), against the steady clock; and what reading it takes.
struct Scale {
  double microseconds_per_count, counts_to_read;
};
Scale scale() {
  const auto start = Clock::now();
  const std::uint64_t first = now();
  while (seconds_since(start) < 0.05) continue;
  const double per_count = 1e6 * seconds_since(start) / static_cast<double>(now() - first);
  std::vector<std::uint64_t> idle(2001);
  for (std::uint64_t& one : idle) {
    const std::uint64_t before = now();
    one = now() - before;
  }
  std::ranges::nth_element(idle, idle.begin() + 1000);
  return {per_count, static_cast<double>(idle[1000])};
}

struct Times {
  double median, most_of_1000, longest;  // µs; 999 of 1000 ticks are no longer than the second
  std::size_t allocations;
};

template <class Step>
double time_of(const Scale& scale, const Step& step) {
  const std::uint64_t before = now();
  step();
  return std::max(0.0, (static_cast<double>(now() - before) - scale.counts_to_read) * scale.microseconds_per_count);
}

// times: those of the path's ticks, in order.
template <class Step>
Times measure(const std::vector<std::array<float, 3>>& path, const Scale& scale, std::vector<double>& times, const Step& step) {
  times.clear();
  times.reserve(path.size());
  const std::size_t before = allocations;
  for (const auto& p : path) times.push_back(time_of(scale, [&] { step(p); }));
  const std::size_t allocated = allocations - before;
  std::vector<double> sorted(times);
  std::ranges::sort(sorted);
  return {sorted[sorted.size() / 2], sorted[sorted.size() * 999 / 1000], sorted.back(), allocated};
}
constexpr Times kNone{HUGE_VAL, HUGE_VAL, HUGE_VAL, 0};
Times least(const Times& a, const Times& b) {
  return {std::min(a.median, b.median), std::min(a.most_of_1000, b.most_of_1000), std::min(a.longest, b.longest),
          a.allocations + b.allocations};
}

// Memory that no cache of this machine holds.
class Memory {
 public:
  // A ring through all lines in random order.
  Memory() : lines_(kLines) {
    std::vector<std::uint32_t> order(kLines);
    std::iota(order.begin(), order.end(), 0U);
    std::shuffle(order.begin(), order.end(), std::mt19937(1));
    for (std::size_t i = 0; i < kLines; ++i) lines_[order[i]].next = order[(i + 1) % kLines];
  }
  // µs that one load takes which depends on the one before.
  double latency(const Scale& scale) {
    constexpr int kLoads = 500, kTries = 200;
    std::vector<double> times;
    for (int i = 0; i < kTries; ++i)
      times.push_back(time_of(scale, [&] {
        for (int k = 0; k < kLoads; ++k) at_ = lines_[at_].next;
      }));
    std::ranges::sort(times);
    return times[kTries / 2] / kLoads;
  }
  // Reads enough of it that nothing else is left in the caches.
  void flush_caches() {
    std::uint32_t sum = 0;
    for (std::size_t i = 0; i < kFlush; ++i) sum += lines_[i].next;
    sum_ = sum;
  }

 private:
  struct alignas(64) Line {
    std::uint32_t next;
  };
  static constexpr std::size_t kLines = std::size_t{1} << 22, kFlush = std::size_t{1} << 20;  // 256 MB, 64 MB
  std::vector<Line, fast::LargePages<Line>> lines_;
  std::uint32_t at_ = 0;
  volatile std::uint32_t sum_ = 0;
};

// Notes how many decisions each stage has taken.
struct CountedStages {
  static constexpr bool kFilter = true;
  int* in_binary64;
  int* in_integers;
  bool sure(bool is_proved) const noexcept {
    ++(is_proved ? *in_binary64 : *in_integers);
    return is_proved;
  }
};

void print(const char* what, const Times& times) {
  std::printf("  %-28s p50 %6.3f  p99.9 %6.3f  longest %8.3f us, %zu allocations\n", what, times.median, times.most_of_1000,
              times.longest, times.allocations);
}

template <class Value>
void keep(const Value& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

constexpr auto kStiffness = static_cast<float>(kMeshStiffness);
constexpr int kPasses = 5;

// Every pass goes along the same path; the least of each percentile counts, since other programs disturb some of them.
void run_exact(const MeshWorkload& workload, const std::shared_ptr<const fast::Mesh>& mesh, const Scale& scale,
               Memory& memory) {
  std::size_t touching = 0, moves = 0, in_contact = 0, moves_in_contact = 0;
  Times contact = kNone, free = kNone;
  std::vector<double> times, shortest(workload.contact.size(), HUGE_VAL);
  for (int pass = 0; pass < kPasses; ++pass) {
    fast::MeshSession session(mesh, kStiffness, mesh::Shading::none);
    const auto step = [&](const std::array<float, 3>& p) {
      const mesh::Tick tick = session.step(p);
      touching += tick.status == mesh::TickStatus::touching;
      moves += tick.moves;
      keep(tick);
    };
    for (const auto& p : workload.approach) session.step(p);
    touching = moves = 0;
    contact = least(contact, measure(workload.contact, scale, times, step));
    for (std::size_t i = 0; i < times.size(); ++i) shortest[i] = std::min(shortest[i], times[i]);
    in_contact = touching;
    moves_in_contact = moves;
    session.step(workload.free.front());
    free = least(free, measure(workload.free, scale, times, step));
  }
  const auto ticks = static_cast<double>(workload.contact.size());
  print("exact, contact", contact);
  print("exact, free", free);
  std::printf("  %zu of %zu ticks in contact, %.2f moves a tick\n", in_contact, workload.contact.size(),
              static_cast<double>(moves_in_contact) / ticks);

  std::vector<mesh::GodObject> states;  // before each tick in contact
  fast::MeshSession session(mesh, kStiffness, mesh::Shading::none);
  for (const auto& p : workload.approach) session.step(p);
  for (const auto& p : workload.contact) {
    states.push_back(session.state());
    session.step(p);
  }
  // As a loop of 1 kHz meets it when other programs have used the caches since the last tick.
  std::vector<double> cold;
  for (std::size_t i = 0; i < workload.contact.size(); i += workload.contact.size() / 300) {
    session.resume(states[i]);
    memory.flush_caches();
    cold.push_back(time_of(scale, [&] { keep(session.step(workload.contact[i])); }));
  }
  std::ranges::sort(cold);
  std::printf("  %-28s p50 %6.3f  p99   %6.3f us; a load from memory %.3f us\n", "exact, contact, cold caches",
              cold[cold.size() / 2], cold[cold.size() * 99 / 100], memory.latency(scale));

  // The tick that took longest even in its shortest pass; not one of the first, which find other caches than the rest.
  constexpr std::ptrdiff_t kFirst = 100;
  const auto worst = static_cast<std::size_t>(std::max_element(shortest.begin() + kFirst, shortest.end()) - shortest.begin());
  int in_binary64 = 0, in_integers = 0;
  const mesh::Tick tick = fast::step(*mesh, states[worst], workload.contact[worst], kStiffness, mesh::Shading::none,
                                     CountedStages{&in_binary64, &in_integers});
  std::printf(
      "  the longest tick, in its shortest pass: tick %zu, %.3f us, %d moves, %d decisions in binary64, %d in integers, "
      "from %s to %s\n",
      worst, shortest[worst], int{tick.moves}, in_binary64, in_integers,
      mesh::kPlaceNames[static_cast<std::size_t>(states[worst].place)].data(),
      mesh::kPlaceNames[static_cast<std::size_t>(tick.after.place)].data());
}

void run_naive(const MeshWorkload& workload, const Scale& scale) {
  NaiveGodObject naive(workload.mesh, kStiffness);
  const auto step = [&](const std::array<float, 3>& p) { keep(naive.step(Eigen::Vector3f(p.data()))); };
  Times contact = kNone, free = kNone;
  std::vector<double> times;
  for (int pass = 0; pass < kPasses; ++pass) {
    for (const auto& p : workload.approach) step(p);
    contact = least(contact, measure(workload.contact, scale, times, step));
    step(workload.free.front());
    free = least(free, measure(workload.free, scale, times, step));
  }
  print("naive, contact", contact);
  print("naive, free", free);
}

void run(const MeshWorkload& workload, const Scale& scale, Memory& memory) {
  double seconds = HUGE_VAL;
  std::shared_ptr<const fast::Mesh> mesh;
  for (int i = 0; i < 3; ++i) {
    const auto start = Clock::now();
    auto built = fast::Mesh::build(workload.mesh, {}, mesh::Sides::front);
    seconds = std::min(seconds, seconds_since(start));
    if (const auto* message = std::get_if<std::string>(&built)) {
      std::printf("%s: %s\n", workload.name.c_str(), message->c_str());
      std::exit(1);
    }
    mesh = std::make_shared<const fast::Mesh>(std::get<fast::Mesh>(std::move(built)));
  }
  const auto triangles = static_cast<double>(workload.mesh.triangles.size());
  std::printf("%s: %.0f triangles, built in %.3f s, %.1f bytes a triangle\n", workload.name.c_str(), triangles, seconds,
              static_cast<double>(mesh->bytes()) / triangles);
  run_exact(workload, mesh, scale, memory);
  run_naive(workload, scale);
}

}  // namespace
}  // namespace forceshade::bench

int main(int argc, char** argv) {
  using namespace forceshade::bench;
  const double most = argc > 1 ? std::atof(argv[1]) : 1.1e6, fewest = argc > 2 ? std::atof(argv[2]) : 0;
  constexpr std::size_t kContact = 200000, kFree = 20000;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  const Scale clock = scale();
  Memory memory;
  const auto is_in_range = [&](double triangles) { return triangles >= fewest && triangles <= most; };
  for (const int f : {7, 22, 71, 224, 707})
    if (is_in_range(20.0 * f * f)) run(sphere_workload(f, kContact, kFree), clock, memory);
  for (const int n : {22, 71, 224, 707, 2236})
    if (is_in_range(2.0 * n * n)) run(bump_workload(n, kContact, kFree), clock, memory);
}
