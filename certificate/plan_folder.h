// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The folder of a plan, which workers on many machines share: which units are taken, and what they found. Nothing here is about
// forces. It needs of the file system that link() and rename() are atomic and that a file which was closed is seen whole by who
// opens it then (close-to-open), as NFS gives; no locks. Whatever else is seen late costs time and nothing else.
//
//   plan.json                  what is to be done
//   results/12/12345.json      what unit 12345 found; results/12/ has the units from 12000 on
//   results/12/12345.differs-SHA.json   other bytes for the same unit: an alarm
//   claims/12345               the unit is taken: a second name of the file of the worker that took it
//   claims/worker-TOKEN        a worker, which touches this file while it works
//   runs/TOKEN.json            what a run knows of itself

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace forceshade::properties {

inline constexpr std::uint64_t kUnitsOfAFolder = 1000;

class PlanFolder {
 public:
  PlanFolder(std::filesystem::path path, std::uint64_t units) : path_(std::move(path)), units_(units) {}

  // Makes the folders and, last, the plan's file. Throws files::OutputError, and Error where there is a plan.
  static void create(const std::filesystem::path& path, const std::string& plan);

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path result_file(std::uint64_t unit) const;
  std::uint64_t units() const { return units_; }
  std::uint64_t folders() const { return (units_ + kUnitsOfAFolder - 1) / kUnitsOfAFolder; }

  // True for each unit from kUnitsOfAFolder * folder on that has a result: one listing, not a question for each.
  std::vector<bool> done(std::uint64_t folder) const;
  bool is_done(std::uint64_t unit) const;

  // Files that hold other bytes for a unit that has a result.
  std::vector<std::filesystem::path> alarms() const;

  // Keeps a result, which is on disk when this returns, and its sum behind it. Of several equal ones the first is kept; one
  // that differs is kept beside it. Returns whether that was so. Throws files::OutputError.
  [[nodiscard]] bool keep(std::uint64_t unit, const std::string& text) const;

  // The text that was kept. Throws Error where the file is damaged.
  std::string kept(std::uint64_t unit) const;

  // The units that are taken, by one listing.
  std::set<std::uint64_t> taken() const;

  // Ages (s) of claims by unit, by the clock of the file server.
  std::vector<std::pair<std::uint64_t, double>> claims() const;

 private:
  std::filesystem::path path_;
  std::uint64_t units_;
};

// The units that one process claims. Its lease holds as long as it is alive: a thread touches its file.
class Claims {
 public:
  // lease: s. about: what the file says for people. Throws files::OutputError.
  Claims(const PlanFolder& folder, double lease, const std::string& about);
  ~Claims();  // gives back what is left
  Claims(const Claims&) = delete;
  Claims& operator=(const Claims&) = delete;

  // True for one process, unless a lease has run out: then for several, one after the other. Throws files::OutputError.
  bool take(std::uint64_t unit);
  // The same where another has taken it, whose lease has run out by the clock of the file server.
  bool take_over(std::uint64_t unit);
  void give_back(std::uint64_t unit);

  const std::string& token() const { return token_; }

 private:
  std::filesystem::path name_of(std::uint64_t unit) const { return folder_ / std::to_string(unit); }
  void touch_until_the_end();

  std::filesystem::path folder_;
  double lease_;
  std::string token_;
  std::filesystem::path own_;
  std::mutex mutex_;
  std::condition_variable ends_;
  bool has_ended_ = false;
  std::set<std::uint64_t> taken_;
  std::thread touching_;
};

}  // namespace forceshade::properties
