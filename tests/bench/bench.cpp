// SPDX-License-Identifier: BSD-3-Clause
// Times every law: the batch call beside the naive loop and a plain copy, the scalar call, building. After Google Benchmark's
// own output comes one table with the requirements each law meets or misses.
//
// Shared machines are noisy, so fast, naive and copy are repeated in random order in one run, and the least CPU time of the
// repetitions counts: what disturbs a run only ever adds to it.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "forceshade/fast.h"
#include "properties/law_claims.h"
#include "tests/bench/naive.h"

namespace forceshade::bench {
namespace {

using fast::InstructionSet;

// The thesis's bump.
constexpr Parameters kParameters{15.24F, 25.4F, 0.5F};

constexpr std::size_t kInCache = 1024;     // positions: 16 KiB in four arrays
constexpr std::size_t kCacheMultiple = 8;  // out of cache: as many bytes as this many last-level caches, or more
constexpr std::size_t kFewestOutOfCache = std::size_t{1} << 24;  // positions: 256 MiB in four arrays

// Limits for each law on one core; the first applies to AVX-512 alone, the third to every vector set and kind of law.
constexpr double kMostNanoseconds = 2.5;
constexpr double kMostTimesCopy = 1.8;
double most_times_naive(std::string_view law) {
  if (law.ends_with("cylinder")) return 4;
  if (law.ends_with("shaded")) return 2.2;
  return law == "wall" || law == "bump-1p" ? 1.3 : 2.5;
}
constexpr double kMostScalarNanoseconds = 25;
constexpr double kMostBuildNanoseconds = 2000;

std::size_t out_of_cache_count() {
  std::size_t largest = 0;  // bytes
  for (const auto& cache : benchmark::CPUInfo::Get().caches)
    if (cache.size > 0) largest = std::max(largest, static_cast<std::size_t>(cache.size));
  const std::size_t fewest = std::max(kFewestOutOfCache, kCacheMultiple * largest / (4 * sizeof(float)));
  return (fewest + kInCache - 1) / kInCache * kInCache;
}

// Positions and room for forces, each array on its own cache lines.
class Arrays {
 public:
  explicit Arrays(std::size_t count) : x(allocate(count)), z(allocate(count)), fx(allocate(count)), fz(allocate(count)) {}

  // A stroke over the bump and the plane beside it: x in ±0.6 w, z from 2 mm below the surface to 1 mm above. The two
  // coordinates step by an additive sequence (powers of 1/1.3247…), which covers the region evenly and lets no branch
  // predictor learn it: the scalar call is timed at its worst.
  void fill(LawId id) {
    if (filled == id) return;
    filled = id;
    const properties::LawClaims shape(std::get<reference::Law>(reference::Law::build(id, kParameters)));
    double u = 0.5, v = 0.5;
    for (std::size_t i = 0; i < x.size(); ++i) {
      u += 0.7548776662466927;
      v += 0.5698402909980532;
      u -= std::floor(u);
      v -= std::floor(v);
      x[i] = static_cast<float>(0.6 * static_cast<double>(kParameters.width) * (2 * u - 1));
      z[i] = static_cast<float>(static_cast<double>(shape.surface(static_cast<long double>(x[i]))) + 1 - 3 * v);
    }
  }

 private:
  static constexpr std::align_val_t kLine{64};
  struct Free {
    void operator()(float* memory) const { ::operator delete[](memory, kLine); }
  };
  std::vector<std::unique_ptr<float[], Free>> memory_;

  std::span<float> allocate(std::size_t count) {
    memory_.emplace_back(new (kLine) float[count]());
    return {memory_.back().get(), count};
  }

  std::optional<LawId> filled;

 public:
  std::span<float> x, z, fx, fz;
};

struct Size {
  const char* name;
  std::size_t count;
  std::unique_ptr<Arrays> arrays = nullptr;

  // Allocated at the first use, so that a filtered run does not need the large ones.
  Arrays& filled(LawId id) {
    if (!arrays) arrays = std::make_unique<Arrays>(count);
    arrays->fill(id);
    return *arrays;
  }
};

struct Measured {
  InstructionSet set;
  const NaiveTable& naive;
};

const std::array kMeasured {
  Measured{InstructionSet::scalar, kNaive},
#if defined(__x86_64__)
      Measured{InstructionSet::avx2, kNaiveAvx2}, Measured{InstructionSet::avx512, kNaiveAvx512},
#endif
};

fast::Law build(LawId id) {
  return std::get<fast::Law>(fast::Law::build(id, kParameters));
}

std::string joined(std::initializer_list<std::string_view> words) {
  std::string name;
  for (const std::string_view word : words) {
    if (!name.empty()) name += '/';
    name += word;
  }
  return name;
}

// `answer` is called with the filled arrays once per iteration.
template <class Answer>
void add(const std::string& name, LawId id, Size& size, Answer answer) {
  benchmark::RegisterBenchmark(name.c_str(), [id, &size, answer](benchmark::State& state) {
    Arrays& arrays = size.filled(id);
    for (auto _ : state) {
      answer(arrays);
      benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(size.count));
  });
}

void add_all(std::span<Size> sizes) {
  for (Size& size : sizes) {
    add(joined({"copy", size.name}), LawId::wall, size, [](Arrays& a) {
      std::memcpy(a.fx.data(), a.x.data(), a.x.size_bytes());
      benchmark::ClobberMemory();
      std::memcpy(a.fz.data(), a.z.data(), a.z.size_bytes());
    });
  }
  for (const LawName& name : kLaws) {
    const fast::Law law = build(name.id);
    const NaiveBump bump = naive_bump(kParameters);
    for (const Measured& measured : kMeasured) {
      if (!fast::is_available(measured.set)) continue;
      const NaiveLoop naive = measured.naive[static_cast<std::size_t>(name.id)];
      for (Size& size : sizes) {
        add(joined({name.name, name_of(measured.set), "fast", size.name}), name.id, size,
            [law, set = measured.set](Arrays& a) { benchmark::DoNotOptimize(law.force(a.x, a.z, a.fx, a.fz, set).invalid); });
        add(joined({name.name, name_of(measured.set), "naive", size.name}), name.id, size,
            [bump, naive](Arrays& a) { naive(bump, a.x.size(), a.x.data(), a.z.data(), a.fx.data(), a.fz.data()); });
      }
    }
    add(joined({name.name, "scalar_call"}), name.id, sizes.front(), [law](Arrays& a) {
      for (std::size_t i = 0; i < a.x.size(); ++i) benchmark::DoNotOptimize(law.force(Eigen::Vector3f(a.x[i], 0, a.z[i])));
    });
    benchmark::RegisterBenchmark(joined({name.name, "build"}).c_str(), [id = name.id](benchmark::State& state) {
      Parameters parameters = kParameters;
      for (auto _ : state) {
        benchmark::DoNotOptimize(parameters);
        benchmark::DoNotOptimize(fast::Law::build(id, parameters));
      }
      state.SetItemsProcessed(state.iterations());
    });
  }
}

// Google Benchmark's console output (of the aggregates alone), and the least time per item of each benchmark.
class Collector : public benchmark::ConsoleReporter {
 public:
  using ConsoleReporter::ConsoleReporter;

  void ReportRuns(const std::vector<Run>& runs) override {
    std::vector<Run> aggregates;
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Aggregate) aggregates.push_back(run);
      const auto rate = run.counters.find("items_per_second");
      if (run.run_type != Run::RT_Iteration || rate == run.counters.end()) continue;
      const double nanoseconds = 1e9 / rate->second.value;
      const auto [entry, is_new] = least_.try_emplace(run.run_name.function_name, nanoseconds);
      if (!is_new) entry->second = std::min(entry->second, nanoseconds);
    }
    ConsoleReporter::ReportRuns(aggregates);
  }

  // ns per item; NaN if it did not run.
  double least(const std::string& name) const {
    const auto found = least_.find(name);
    return found == least_.end() ? std::nan("") : found->second;
  }

 private:
  std::map<std::string, double> least_;
};

// One requirement over all laws: its misses, and how many figures there were.
struct Requirement {
  std::string text;
  double most;
  int met = 0;
  std::string misses = {};

  void judge(std::string_view law, std::string_view set, double figure) {
    if (std::isnan(figure)) return;
    if (figure <= most) {
      ++met;
      return;
    }
    char number[32];
    std::snprintf(number, sizeof number, " %.2f", figure);
    misses += (misses.empty() ? "" : "; ") + std::string(law) + " " + std::string(set) + number;
  }

  void print() const {
    const char* verdict = !misses.empty() ? "MISSED" : met > 0 ? "met" : "not run";
    std::printf("%-44s %s%s%s\n", text.c_str(), verdict, misses.empty() ? "" : ": ", misses.c_str());
  }
};

std::string figure(double value, int decimals) {
  if (std::isnan(value)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

void print_table(const Collector& times) {
  const InstructionSet best = fast::best_instruction_set();
  Requirement in_cache{"in cache, avx512 (ns/eval): at most 2.5", kMostNanoseconds};
  Requirement out_of_cache{"out of cache, best set (x copy): at most 1.8", kMostTimesCopy};
  Requirement naive{"in cache, parts of its goal (x naive): at most 1", 1};
  Requirement scalar{"scalar call (ns): at most 25", kMostScalarNanoseconds};
  Requirement building{"build (ns): at most 2000", kMostBuildNanoseconds};

  std::printf("\nR = %g mm, w = %g mm, K = %g N/mm; copy: %s ns in cache, %s ns out of cache; ns per position, one core\n",
              static_cast<double>(kParameters.radius), static_cast<double>(kParameters.width),
              static_cast<double>(kParameters.stiffness), figure(times.least("copy/in_cache"), 3).c_str(),
              figure(times.least("copy/out_of_cache"), 3).c_str());
  std::printf("%-15s %-7s %9s %8s %13s %8s %9s %9s\n", "law", "set", "in cache", "x naive", "out of cache", "x copy",
              "scalar ns", "build ns");
  for (const LawName& law : kLaws) {
    const double call = times.least(joined({law.name, "scalar_call"}));
    const double build = times.least(joined({law.name, "build"}));
    scalar.judge(law.name, "", call);
    building.judge(law.name, "", build);
    for (const Measured& measured : kMeasured) {
      const std::string_view set = name_of(measured.set);
      const double near = times.least(joined({law.name, set, "fast", "in_cache"}));
      const double far = times.least(joined({law.name, set, "fast", "out_of_cache"}));
      const double times_naive = near / times.least(joined({law.name, set, "naive", "in_cache"}));
      const double times_copy = far / times.least("copy/out_of_cache");
      if (measured.set == InstructionSet::avx512) in_cache.judge(law.name, set, near);
      if (measured.set != InstructionSet::scalar) naive.judge(law.name, set, times_naive / most_times_naive(law.name));
      if (measured.set == best) out_of_cache.judge(law.name, set, times_copy);
      std::printf("%-15s %-7s %9s %8s %13s %8s %9s %9s\n", law.name.data(), set.data(), figure(near, 3).c_str(),
                  figure(times_naive, 2).c_str(), figure(far, 3).c_str(), figure(times_copy, 2).c_str(),
                  figure(call, 1).c_str(), figure(build, 0).c_str());
    }
  }
  std::printf("\n");
  for (const Requirement* requirement : {&in_cache, &out_of_cache, &naive, &scalar, &building}) requirement->print();
}

}  // namespace
}  // namespace forceshade::bench

int main(int argc, char** argv) {
  using namespace forceshade::bench;
  // Defaults; a flag on the command line, being later, wins.
  std::vector<std::string> arguments{argv[0], "--benchmark_repetitions=9", "--benchmark_min_time=0.02",
                                     "--benchmark_enable_random_interleaving=true"};
  arguments.insert(arguments.end(), argv + 1, argv + argc);
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  int count = static_cast<int>(pointers.size());
  benchmark::Initialize(&count, pointers.data());
  if (benchmark::ReportUnrecognizedArguments(count, pointers.data())) return 2;

  std::array sizes{Size{"in_cache", kInCache}, Size{"out_of_cache", out_of_cache_count()}};
  add_all(sizes);
  Collector times;
  benchmark::RunSpecifiedBenchmarks(&times);
  print_table(times);
  benchmark::Shutdown();
  return 0;
}
