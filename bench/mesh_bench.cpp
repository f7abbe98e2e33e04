// SPDX-License-Identifier: BSD-3-Clause
// The god-object's time for a tick, beside that of a naive binary32 one on the same path: forceshade_mesh_bench
// [MOST_TRIANGLES].

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <string>
#include <variant>

#include "forceshade/bench/mesh_workloads.h"
#include "forceshade/bench/naive_mesh.h"
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
};

template <class Step>
Times measure(const std::vector<std::array<float, 3>>& path, const Scale& scale, const Step& step) {
  std::vector<double> times;
  times.reserve(path.size());
  for (const auto& p : path) {
    const std::uint64_t before = now();
    step(p);
    times.push_back(std::max(0.0, (static_cast<double>(now() - before) - scale.counts_to_read) * scale.microseconds_per_count));
  }
  std::ranges::sort(times);
  return {times[times.size() / 2], times[times.size() * 999 / 1000], times.back()};
}

void print(const char* what, const Times& times) {
  std::printf("  %-28s p50 %6.3f  p99.9 %6.3f  longest %8.3f us\n", what, times.median, times.most_of_1000, times.longest);
}

template <class Value>
void keep(const Value& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

void run(const MeshWorkload& workload, const Scale& scale) {
  const auto start = Clock::now();
  auto built = fast::Mesh::build(workload.mesh, {}, mesh::Sides::front);
  const double seconds = seconds_since(start);
  if (const auto* message = std::get_if<std::string>(&built)) {
    std::printf("%s: %s\n", workload.name.c_str(), message->c_str());
    std::exit(1);
  }
  const auto shared = std::make_shared<const fast::Mesh>(std::get<fast::Mesh>(std::move(built)));
  const auto triangles = static_cast<double>(workload.mesh.triangles.size());
  std::printf("%s: %.0f triangles, built in %.3f s, %.1f bytes a triangle\n", workload.name.c_str(), triangles, seconds,
              static_cast<double>(shared->bytes()) / triangles);
  // The steps are timed one by one; the second pass finds the branches and the caches as a repeated path leaves them.
  for (const bool is_proved : {true, false}) {
    NaiveGodObject naive(is_proved ? mesh::TriangleMesh{} : workload.mesh, static_cast<float>(kMeshStiffness));
    fast::MeshSession session(shared, static_cast<float>(kMeshStiffness), mesh::Shading::none);
    std::size_t touching = 0, moves = 0;
    const auto step = [&](const std::array<float, 3>& p) {
      if (is_proved) {
        const mesh::Tick tick = session.step(p);
        touching += tick.status == mesh::TickStatus::touching;
        moves += tick.moves;
        keep(tick);
      } else {
        const Eigen::Vector3f force = naive.step(Eigen::Vector3f(p.data()));
        touching += force.squaredNorm() > 0;
        keep(force);
      }
    };
    for (const auto& p : workload.approach) step(p);
    touching = moves = 0;
    const std::size_t before = allocations;
    std::size_t own = 0;  // the times' own vector
    const Times contact = measure(workload.contact, scale, step);
    ++own;
    const std::size_t in_contact = touching;
    const double moves_a_tick = static_cast<double>(moves) / static_cast<double>(workload.contact.size());
    step(workload.free.front());
    const Times free = measure(workload.free, scale, step);
    ++own;
    const std::size_t allocated = allocations - before - own;
    print(is_proved ? "exact, contact" : "naive, contact", contact);
    print(is_proved ? "exact, free" : "naive, free", free);
    std::printf("  %zu of %zu ticks in contact, %zu allocations", in_contact, workload.contact.size(), allocated);
    if (is_proved) std::printf(", %.2f moves a tick", moves_a_tick);
    std::printf("\n");
  }
}

}  // namespace
}  // namespace forceshade::bench

int main(int argc, char** argv) {
  using namespace forceshade::bench;
  const double most = argc > 1 ? std::atof(argv[1]) : 1.1e6;
  constexpr std::size_t kContact = 200000, kFree = 20000;
  const Scale clock = scale();
  for (const int f : {7, 22, 71, 224, 707})
    if (20.0 * f * f <= most) run(sphere_workload(f, kContact, kFree), clock);
  for (const int n : {22, 71, 224, 707, 2236})
    if (2.0 * n * n <= most) run(bump_workload(n, kContact, kFree), clock);
}
