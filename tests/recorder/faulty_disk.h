// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A disk of a test's own: everything SQLite opens while one of these lives can be made slow, full, or gone.

#include <sqlite3.h>

#include <atomic>
#include <chrono>
#include <map>
#include <stdexcept>

#include "system/system.h"

namespace forceshade::tests {

class FaultyDisk {
 public:
  static inline std::atomic<int> write_ms = 0, sync_ms = 0;  // the time that each call takes
  static inline std::atomic<bool> full = false;              // each write fails as on a full disk
  static inline std::atomic<bool> unplugged = false;         // each write and sync fails as on a disk that is gone
  static inline std::atomic<int> writes = 0, refused_writes = 0, syncs = 0;  // a write has two halves

  FaultyDisk() {
    write_ms = sync_ms = writes = refused_writes = syncs = 0;
    full = unplugged = false;
    static sqlite3_vfs faulty = [] {
      sqlite3_vfs vfs = *real();
      vfs.zName = "faulty";
      vfs.xOpen = open;
      vfs.xDelete = [](sqlite3_vfs*, const char* name, int) { return real()->xDelete(real(), name, 0); };
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
    sqlite3_io_methods& methods = kinds.try_emplace(file->pMethods, *file->pMethods).first->second;
    methods.xWrite = [](sqlite3_file* self, const void* bytes, int count, sqlite3_int64 offset) {
      system::sleep_for(std::chrono::milliseconds(write_ms));
      if (full) return ++refused_writes, SQLITE_FULL;
      if (unplugged) return ++refused_writes, SQLITE_IOERR_WRITE;
      // A process can die between two pages of a write.
      const int half = count / 2;
      ++writes;
      if (const int code = real_write(self, bytes, half, offset); code != SQLITE_OK) return code;
      system::step();
      ++writes;
      return real_write(self, static_cast<const char*>(bytes) + half, count - half, offset + half);
    };
    // No machine loses its power here, so that nothing has to reach the real disk.
    methods.xSync = [](sqlite3_file*, int) {
      ++syncs;
      system::sleep_for(std::chrono::milliseconds(sync_ms));
      return unplugged ? SQLITE_IOERR_FSYNC : SQLITE_OK;
    };
    file->pMethods = &methods;
    return SQLITE_OK;
  }
};

}  // namespace forceshade::tests
