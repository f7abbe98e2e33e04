// SPDX-License-Identifier: BSD-3-Clause
// Preloaded into a worker, it makes a local folder as late as one of NFS: what stat() and access() say of a name, also that it
// is missing, and what a listing has, stays as it was first seen for LATE_MS milliseconds, unless this process changes the name
// itself. open() sees what is so, as NFS promises (close-to-open). One link in four is made and then reported as refused, as
// when the server's answer is lost and the request comes twice.

#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <string>

namespace {

using Clock = std::chrono::steady_clock;

struct Answer {
  Clock::time_point until;
  int result, reason;
  struct stat about;
};

std::mutex mutex;
std::map<std::string, Answer> answers;
unsigned links = 0;

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

bool is_of_plan(const char* path) {
  return std::strstr(path, "/results/") != nullptr || std::strstr(path, "/claims/") != nullptr;
}

Clock::duration late() {
  const char* text = std::getenv("LATE_MS");
  return std::chrono::milliseconds(text == nullptr ? 0 : std::atoi(text));
}

int remembered(const char* path, struct stat* about) {
  const std::lock_guard lock(mutex);
  auto found = answers.find(path);
  if (found == answers.end() || found->second.until < Clock::now()) {
    Answer answer{Clock::now() + late(), 0, 0, {}};
    answer.result = next<int (*)(const char*, struct stat*)>("stat")(path, &answer.about);
    answer.reason = errno;
    found = answers.insert_or_assign(path, answer).first;
  }
  *about = found->second.about;
  if (found->second.result != 0) errno = found->second.reason;
  return found->second.result;
}

void forget(const char* path) {
  const std::lock_guard lock(mutex);
  answers.erase(path);
}

}  // namespace

extern "C" {

int stat(const char* path, struct stat* about) {
  if (!is_of_plan(path)) return next<int (*)(const char*, struct stat*)>("stat")(path, about);
  return remembered(path, about);
}

int access(const char* path, int mode) {
  if (!is_of_plan(path)) return next<int (*)(const char*, int)>("access")(path, mode);
  struct stat about;
  return remembered(path, &about);
}

int link(const char* from, const char* to) {
  const int result = next<int (*)(const char*, const char*)>("link")(from, to);
  const int reason = errno;
  forget(from);
  forget(to);
  if (result == 0) {
    const std::lock_guard lock(mutex);
    if (++links % 4 == 0) {
      errno = EEXIST;
      return -1;
    }
  }
  errno = reason;
  return result;
}

int unlink(const char* path) {
  forget(path);
  return next<int (*)(const char*)>("unlink")(path);
}

int rename(const char* from, const char* to) {
  forget(from);
  forget(to);
  return next<int (*)(const char*, const char*)>("rename")(from, to);
}

// A listing lacks the results of the last LATE_MS milliseconds.
struct dirent* readdir(DIR* folder) {
  const auto real = next<struct dirent* (*)(DIR*)>("readdir");
  for (struct dirent* entry = real(folder); entry != nullptr; entry = real(folder)) {
    struct stat about;
    if (std::strstr(entry->d_name, ".json") == nullptr || fstatat(dirfd(folder), entry->d_name, &about, 0) != 0) return entry;
    const auto age = std::chrono::system_clock::now().time_since_epoch() -
                     (std::chrono::seconds(about.st_mtim.tv_sec) + std::chrono::nanoseconds(about.st_mtim.tv_nsec));
    if (age > late()) return entry;
  }
  return nullptr;
}
}
