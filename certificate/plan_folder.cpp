// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/plan_folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <iterator>
#include <system_error>

#include "files/output_file.h"
#include "files/written_once.h"
#include "forceshade/certificate.h"
#include "rendering/identity/digest.h"
#include "text/number_text.h"

namespace forceshade::properties {
namespace {

namespace fs = std::filesystem;

constexpr const char *kPlan = "plan.json", *kResults = "results", *kClaims = "claims", *kRuns = "runs", *kDiffers = ".differs-";

std::string with_sum(const std::string& text) {
  return text + "\nsha256 " + digest_of_text(text) + '\n';
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  // Over NFS a folder that another machine has made can be missing and there in the same moment.
  if (error && error != std::errc::file_exists) throw files::output_failure(path, "make the folder", error.value());
}

// The number that a name is in front of this ending.
std::optional<std::uint64_t> number_of(std::string_view name, std::string_view ending) {
  if (!name.ends_with(ending)) return std::nullopt;
  return number_in<std::uint64_t>(name.substr(0, name.size() - ending.size()));
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code missing;
  for (fs::directory_iterator entry(folder, missing), end; !missing && entry != end; entry.increment(missing))
    names.push_back(entry->path().filename().string());
  return names;
}

struct Seen {
  ino_t file;
  double time;  // s: when it was last touched
};

// Opened, because only then NFS gives what is so, and not what it had.
std::optional<Seen> seen(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return std::nullopt;
  struct stat about {};
  const bool is_known = ::fstat(descriptor, &about) == 0;
  ::close(descriptor);
  if (!is_known) return std::nullopt;
  return Seen{about.st_ino, static_cast<double>(about.st_mtim.tv_sec) + 1e-9 * static_cast<double>(about.st_mtim.tv_nsec)};
}

// By the clock of the file server, which no other has to agree with.
void touch(const fs::path& path) {
  ::utimensat(AT_FDCWD, path.c_str(), nullptr, 0);
}

}  // namespace

void PlanFolder::create(const fs::path& path, const std::string& plan) {
  if (fs::exists(path / kPlan)) throw Error((path / kPlan).string() + ": is there already; expected a new folder");
  for (const char* folder : {kResults, kClaims, kRuns}) make_folder(path / folder);
  if (files::write_once(path / kPlan, plan) == files::Written::differs)
    throw Error((path / kPlan).string() + ": another plan came first; expected a new folder");
}

fs::path PlanFolder::result_file(std::uint64_t unit) const {
  return path_ / kResults / std::to_string(unit / kUnitsOfAFolder) / (std::to_string(unit) + ".json");
}

std::vector<bool> PlanFolder::done(std::uint64_t folder) const {
  const std::uint64_t first = folder * kUnitsOfAFolder;
  std::vector<bool> done(std::min(kUnitsOfAFolder, units_ - first));
  for (const std::string& name : names_in(path_ / kResults / std::to_string(folder)))
    if (const auto unit = number_of(name, ".json"); unit && *unit >= first && *unit - first < done.size())
      done[*unit - first] = true;
  return done;
}

bool PlanFolder::is_done(std::uint64_t unit) const {
  return seen(result_file(unit)).has_value();
}

std::vector<fs::path> PlanFolder::alarms() const {
  std::vector<fs::path> all;
  for (std::uint64_t folder = 0; folder < folders(); ++folder) {
    const fs::path place = path_ / kResults / std::to_string(folder);
    for (const std::string& name : names_in(place))
      if (!name.starts_with(".") && name.find(kDiffers) != std::string::npos) all.push_back(place / name);
  }
  std::sort(all.begin(), all.end());
  return all;
}

bool PlanFolder::keep(std::uint64_t unit, const std::string& text) const {
  const fs::path file = result_file(unit);
  make_folder(file.parent_path());
  const std::string whole = with_sum(text);
  if (files::write_once(file, whole) != files::Written::differs) return true;
  files::write_once(file.parent_path() / (std::to_string(unit) + kDiffers + digest_of_text(whole).substr(0, 16) + ".json"),
                    whole);
  return false;
}

std::string PlanFolder::kept(std::uint64_t unit) const {
  const fs::path file = result_file(unit);
  std::ifstream stream(file, std::ios::binary);
  const std::string whole(std::istreambuf_iterator<char>(stream), {});
  const std::size_t line = whole.find('\n');
  std::string text = whole.substr(0, line);
  if (line == std::string::npos || with_sum(text) != whole)
    throw Error(file.string() + ": is damaged, its sum is not that of its bytes; remove it and do the unit again");
  return text;
}

std::set<std::uint64_t> PlanFolder::taken() const {
  std::set<std::uint64_t> all;
  for (const std::string& name : names_in(path_ / kClaims))
    if (const auto unit = number_of(name, "")) all.insert(*unit);
  return all;
}

std::vector<std::pair<std::uint64_t, double>> PlanFolder::claims() const {
  const fs::path probe = files::partial_name((path_ / kClaims / ".now").string());
  std::vector<std::pair<std::uint64_t, double>> all;
  { std::ofstream stream(probe); }
  if (const auto now = seen(probe))
    for (const std::string& name : names_in(path_ / kClaims))
      if (const auto unit = number_of(name, ""); unit)
        if (const auto claim = seen(path_ / kClaims / name)) all.emplace_back(*unit, now->time - claim->time);
  ::unlink(probe.c_str());
  std::sort(all.begin(), all.end());
  return all;
}

Claims::Claims(const PlanFolder& folder, double lease, const std::string& about)
    : folder_(folder.path() / kClaims), lease_(lease) {
  do {
    token_ = files::partial_name("").substr(std::string(".partial-").size());
    own_ = folder_ / ("worker-" + token_);
  } while (files::write_once(own_, about + ' ' + token_ + '\n') != files::Written::now);
  touching_ = std::thread([this] { touch_until_the_end(); });
}

Claims::~Claims() {
  {
    const std::lock_guard lock(mutex_);
    has_ended_ = true;
  }
  ends_.notify_all();
  touching_.join();
  for (const std::uint64_t unit : taken_) ::unlink(name_of(unit).c_str());
  ::unlink(own_.c_str());
}

void Claims::touch_until_the_end() {
  std::unique_lock lock(mutex_);
  while (!ends_.wait_for(lock, std::chrono::duration<double>(lease_ / 4), [&] { return has_ended_; })) touch(own_);
}

bool Claims::take(std::uint64_t unit) {
  {
    const std::lock_guard lock(mutex_);
    if (!taken_.insert(unit).second) return false;  // by another thread
  }
  const fs::path claim = name_of(unit);
  if (::link(own_.c_str(), claim.c_str()) == 0) return true;
  const int reason = errno;
  // Over NFS the answer to a link that was made may be lost.
  if (files::is_same_file(own_, claim)) return true;
  const std::lock_guard lock(mutex_);
  taken_.erase(unit);
  if (reason != EEXIST) throw files::output_failure(claim, "link", reason);
  return false;
}

bool Claims::take_over(std::uint64_t unit) {
  const fs::path claim = name_of(unit);
  touch(own_);
  const auto now = seen(own_);
  const auto its = seen(claim);
  if (!now || !its || now->time - its->time < lease_) return take(unit);
  // One of several takes it away; whoever takes away a new one puts it back.
  const fs::path away = files::partial_name((folder_ / ("." + std::to_string(unit))).string());
  if (::rename(claim.c_str(), away.c_str()) != 0) return false;
  if (const auto moved = seen(away); moved && moved->file != its->file) {
    ::link(away.c_str(), claim.c_str());
    ::unlink(away.c_str());
    return false;
  }
  ::unlink(away.c_str());
  return take(unit);
}

void Claims::give_back(std::uint64_t unit) {
  // A unit whose lease ran out may be another's by now.
  if (files::is_same_file(own_, name_of(unit))) ::unlink(name_of(unit).c_str());
  const std::lock_guard lock(mutex_);
  taken_.erase(unit);
}

}  // namespace forceshade::properties
