// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/worker.h"

#include <algorithm>
#include <chrono>
#include <exception>
#include <mutex>
#include <random>
#include <set>
#include <thread>
#include <vector>

namespace forceshade::properties {
namespace {

// Claims of others that a pass looks at: all of thousands of workers that wait for the last units may not look at all.
constexpr int kLooks = 16;

constexpr double kFirstPause = 0.05, kLongestPause = 30;  // s: between passes that find nothing to do

// One thread of a worker. It begins at a place that is drawn, so that workers seldom meet; what is drawn changes no result.
class Searcher {
 public:
  Searcher(const PlanFolder& folder, Claims& claims) : folder_(folder), claims_(claims), is_whole_(folder.folders()) {}

  // Offers each unit that has no result and is free to `does`, which returns false to stop. expired: those that are taken, a
  // few of them in each pass, if their lease has run out. Returns how many units were taken.
  template <class Does>
  std::uint64_t pass(bool expired, const Does& does) {
    const std::set<std::uint64_t> taken = folder_.taken();
    const std::uint64_t begin = random_() % std::max<std::uint64_t>(1, folder_.folders()), within = random_() % kUnitsOfAFolder;
    std::uint64_t count = 0;
    int looks = kLooks;
    for (std::uint64_t i = 0; i < folder_.folders(); ++i) {
      const std::uint64_t at = (begin + i) % folder_.folders();
      if (is_whole_[at]) continue;
      const std::vector<bool> done = folder_.done(at);
      is_whole_[at] = std::find(done.begin(), done.end(), false) == done.end();
      for (std::uint64_t k = 0; k < done.size(); ++k) {
        const std::uint64_t in = (k + within) % done.size(), unit = at * kUnitsOfAFolder + in;
        if (done[in] || taken.contains(unit) != expired) continue;
        if (expired && looks-- <= 0) return count;
        if (!(expired ? claims_.take_over(unit) : claims_.take(unit))) continue;
        ++count;
        const bool goes_on = does(unit);
        claims_.give_back(unit);
        if (!goes_on) return count;
      }
    }
    return count;
  }

  bool is_complete() const { return std::find(is_whole_.begin(), is_whole_.end(), false) == is_whole_.end(); }

 private:
  const PlanFolder& folder_;
  Claims& claims_;
  std::vector<bool> is_whole_;  // folders of which every unit has a result
  std::random_device random_;
};

void sleep(double seconds, const std::atomic<bool>& stop) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!stop && std::chrono::steady_clock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

}  // namespace

Worked work_through(const PlanFolder& folder, Claims& claims, const WorkerOptions& options,
                    const std::function<std::string(std::uint64_t)>& result, const std::function<void(const Worked&)>& progress,
                    const std::atomic<bool>& stop) {
  std::mutex mutex;
  Worked all;
  std::exception_ptr thrown;
  std::atomic<bool> failed = false;
  const auto does = [&](std::uint64_t unit) {
    if (folder.is_done(unit)) return true;  // since its folder was listed
    const std::string text = result(unit);
    if (stop || failed) return false;
    const bool fits = folder.keep(unit, text);
    const std::lock_guard lock(mutex);
    ++all.units;
    all.alarms += fits ? 0 : 1;
    progress(all);
    return true;
  };
  const auto share = [&] {
    try {
      Searcher searcher(folder, claims);
      double pause = kFirstPause;
      while (!stop && !failed) {
        const bool took = searcher.pass(false, does) > 0 || searcher.pass(true, does) > 0;
        if (searcher.is_complete()) break;
        if (took) pause = kFirstPause;
        if (took) continue;
        if (!options.waits) return;
        sleep(pause, stop);
        pause = std::min({2 * pause, options.lease / 8, kLongestPause});
      }
      const std::lock_guard lock(mutex);
      all.is_complete = all.is_complete || searcher.is_complete();
    } catch (...) {
      const std::lock_guard lock(mutex);
      thrown = std::current_exception();
      failed = true;
    }
  };
  std::vector<std::thread> helpers;
  for (unsigned i = 1; i < options.threads; ++i) helpers.emplace_back(share);
  share();
  for (std::thread& helper : helpers) helper.join();
  if (thrown) std::rethrow_exception(thrown);
  return all;
}

}  // namespace forceshade::properties
