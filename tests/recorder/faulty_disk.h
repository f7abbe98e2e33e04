// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A disk of a test's own: everything SQLite opens while one of these lives can be made slow, full, or gone.

#include <sqlite3.h>

#include <atomic>
#include <chrono>
#include <map>
#include <stdexcept>
#include <thread>

namespace forceshade::tests {

class FaultyDisk {
 public:
  static inline std::atomic<int> write_ms = 0, sync_ms = 0;  // how long each call takes
  static inline std::atomic<bool> stands_still = false;      // each write waits until it is no more
  static inline std::atomic<int> waiting = 0;                // writes that have had to
  static inline std::atomic<bool> full = false;              // each write fails as on a full disk
  static inline std::atomic<bool> unplugged = false;         // each write and sync fails as on a disk that is gone
  static inline std::atomic<int> refused_writes = 0, syncs = 0;

  FaultyDisk() {
    write_ms = sync_ms = refused_writes = syncs = waiting = 0;
    full = unplugged = stands_still = false;
    static sqlite3_vfs faulty = [] {
      sqlite3_vfs vfs = *real();
      vfs.zName = "faulty";
      vfs.xOpen = open;
      return vfs;
    }();
    real();
    if (sqlite3_vfs_register(&faulty, 1) != SQLITE_OK) throw std::runtime_error("cannot register the faulty disk");
  }
  ~FaultyDisk() { sqlite3_vfs_register(real(), 1); }
  FaultyDisk(const FaultyDisk&) = delete;
  FaultyDisk& operator=(const FaultyDisk&) = delete;

 private:
  static sqlite3_vfs* real() {
    static sqlite3_vfs* vfs = sqlite3_vfs_find("unix");
    return vfs;
  }
  // A file of the real kind, but for two of its methods. A database and its log differ in the others.
  static int open(sqlite3_vfs*, const char* name, sqlite3_file* file, int flags, int* flags_out) {
    const int code = real()->xOpen(real(), name, file, flags, flags_out);
    if (code != SQLITE_OK) return code;
    static std::map<const sqlite3_io_methods*, sqlite3_io_methods> kinds;
    static const auto real_write = file->pMethods->xWrite;
    static const auto real_sync = file->pMethods->xSync;
    sqlite3_io_methods& methods = kinds.try_emplace(file->pMethods, *file->pMethods).first->second;
    methods.xWrite = [](sqlite3_file* self, const void* bytes, int count, sqlite3_int64 offset) {
      std::this_thread::sleep_for(std::chrono::milliseconds(write_ms));
      if (stands_still) ++waiting;
      while (stands_still) std::this_thread::yield();
      if (full) return ++refused_writes, SQLITE_FULL;
      if (unplugged) return ++refused_writes, SQLITE_IOERR_WRITE;
      return real_write(self, bytes, count, offset);
    };
    methods.xSync = [](sqlite3_file* self, int how) {
      ++syncs;
      std::this_thread::sleep_for(std::chrono::milliseconds(sync_ms));
      if (unplugged) return SQLITE_IOERR_FSYNC;
      return real_sync(self, how);
    };
    file->pMethods = &methods;
    return SQLITE_OK;
  }
};

}  // namespace forceshade::tests
