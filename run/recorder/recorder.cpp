// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <cerrno>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include "forceshade/recording.h"
#include "run/recorder/checksum.h"
#include "run/recorder/layout.h"
#include "run/recorder/sqlite.h"
#include "system/system.h"

namespace forceshade::recorder {
namespace {

Error cannot_make(const std::string& path) {
  return Error(path + ": cannot make the recording: " + std::generic_category().message(errno));
}

// The new metadata, and the digest of these and those before, at once.
void insert(Database& database, Metadata& metadata, const Metadata& more) {
  metadata.insert(more.begin(), more.end());
  Statement statement = database.prepare("INSERT INTO metadata VALUES(?, ?)");
  for (const auto& [key, value] : more) statement.bind(0, key).bind(1, value).run();
  Statement replace = database.prepare("INSERT OR REPLACE INTO metadata VALUES(?, ?)");
  replace.bind(0, kDigestKey).bind(1, digest_of(metadata, kDigestKey)).run();
}

void remove_all(const std::string& path) noexcept {
  for (const char* suffix : {"", "-wal", "-shm", "-journal"}) ::unlink((path + suffix).c_str());
}

// Makes a whole recording without samples, or no file: it is made under another name, so that a death leaves no file that only
// looks like a recording.
void make_file(const std::string& path, Metadata& metadata) {
  const std::string made = path + "-new-" + std::to_string(::getpid());
  const int descriptor = ::open(made.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor < 0) throw cannot_make(path);
  ::close(descriptor);
  try {
    {
      Database database(path, Database::Access::write, made);
      if (database.text("PRAGMA journal_mode = WAL") != "wal")
        throw Error(path + ": cannot make the recording: SQLite has no write-ahead log on this file system");
      database.execute("BEGIN; PRAGMA application_id = " + std::to_string(kApplicationId) + "; PRAGMA user_version = " +
                       std::to_string(metadata.contains(kDampingKey) ? kFormatOfDamping : kFormatVersion));
      for (const std::string_view table : kTables) database.execute(std::string(table));
      insert(database, metadata, std::exchange(metadata, {}));
      database.execute("COMMIT; PRAGMA wal_checkpoint(TRUNCATE)");
    }
    if (::renameat2(AT_FDCWD, made.c_str(), AT_FDCWD, path.c_str(), RENAME_NOREPLACE) != 0) throw cannot_make(path);
  } catch (...) {
    remove_all(made);
    throw;
  }
}

// Adds what it writes to the metadata.
Database make_database(const std::string& path, Metadata& metadata) {
  metadata["layout"] = layout();
  make_file(path, metadata);
  try {
    Database database(path, Database::Access::write);
    // Nothing waits for the disk while the loop runs: a commit is a write into the kernel's cache, which outlives the process,
    // and the log is moved into the file, which needs two fsyncs, only by close().
    database.execute("PRAGMA synchronous = NORMAL; PRAGMA wal_autocheckpoint = 0");
    // The first commit to an empty log waits for the disk: here, not with samples behind it.
    database.execute("BEGIN");
    insert(database, metadata, {{"started", system::date()}});
    database.execute("COMMIT");
    return database;
  } catch (...) {
    remove_all(path);
    throw;
  }
}

}  // namespace

class Recorder::Writer {
 public:
  Writer(const std::string& path, Metadata metadata, const Options& options)
      : metadata_(std::move(metadata)),
        database_(make_database(path, metadata_)),
        insert_chunk_(
            database_.prepare("INSERT INTO chunk(first_tick, last_tick, samples, sha256, data) VALUES(?, ?, ?, ?, ?)")),
        interval_(options.interval),
        waits_(options.waits),
        ring_(options.ring) {
    // No page of the ring is met for the first time in the loop.
    while (ring_.push(device::Sample{})) {
    }
    ring_.reset();
    chunk_.reserve(kLongestChunk);
    thread_ = system::Thread("recorder", [this] { work(); });
  }

  ~Writer() { stop(); }

  void push(const device::Sample& sample) noexcept {
    system::step();
    bool taken = ring_.push(sample);
    while (!taken && waits_ && !failing_) {
      system::sleep_for(interval_ / 10);
      taken = ring_.push(sample);
    }
    if (!taken) dropped_.fetch_add(1, std::memory_order_relaxed);
  }

  bool failing() const noexcept { return failing_; }

  Result close(const std::string& end_reason) {
    stop();
    Result result{written_, dropped_ + chunk_.size() + ring_.read_available(), error_};
    if (!result.error.empty()) return result;
    // Deleting a file that is being written gives no error, not even in SQLite.
    if (::access(database_.path().c_str(), F_OK) != 0) {
      result = {0, result.written + result.lost, database_.path() + ": the recording was deleted while it was made"};
      return result;
    }
    try {
      database_.execute("BEGIN");
      insert(database_, metadata_,
             {{"ended", system::date()},
              {"end_reason", end_reason},
              {"samples", std::to_string(result.written)},
              {"lost", std::to_string(result.lost)}});
      database_.execute("COMMIT");
    } catch (const Error& error) {
      result.error = error.what();
      return result;
    }
    try {
      // Without a journal on the disk: one that a death leaves there must be rolled back by the next reader, which only
      // reads. Nothing but the first 100 bytes of the file changes, in one sector.
      database_.execute("PRAGMA journal_mode = MEMORY");
    } catch (const Error&) {
      // Someone is reading, or there is no room for a copy: all is there, in two files instead of one.
    }
    return result;
  }

 private:
  void stop() {
    if (!thread_.is_joinable()) return;
    stopping_ = 1;
    system::wake(stopping_);
    thread_.join();
  }

  void work() {
    for (bool last = false; !last;) {
      system::wait_for_change(stopping_, 0, system::now() + system::in_ns(interval_));
      system::step();
      last = stopping_ != 0;
      empty_ring();
    }
  }

  // Into the file, chunk by chunk, each a transaction. What the disk refuses stays in chunk_ until the next time.
  void empty_ring() {
    for (;;) {
      system::step();
      if (chunk_.empty()) {
        chunk_.resize(std::min(ring_.read_available(), kLongestChunk));
        chunk_.resize(ring_.pop(chunk_.data(), chunk_.size()));
        if (chunk_.empty()) return;
      }
      try {
        write_chunk();
        error_.clear();
      } catch (const Error& error) {
        error_ = error.what();
      }
      failing_ = !error_.empty();
      if (failing_) return;
      written_ += chunk_.size();
      chunk_.clear();
    }
  }

  void write_chunk() {
    const auto data = std::as_bytes(std::span(chunk_));
    insert_chunk_.bind(0, static_cast<std::int64_t>(chunk_.front().tick))
        .bind(1, static_cast<std::int64_t>(chunk_.back().tick))
        .bind(2, static_cast<std::int64_t>(chunk_.size()))
        .bind(3, sha256(data))
        .bind(4, data)
        .run();
  }

  Metadata metadata_;  // as it is in the file
  Database database_;
  Statement insert_chunk_;
  std::chrono::milliseconds interval_;
  bool waits_;
  boost::lockfree::spsc_queue<device::Sample> ring_;
  std::atomic<std::uint64_t> dropped_{0};
  std::atomic<bool> failing_{false};
  system::Number stopping_ = 0;

  // The thread's until it has stopped.
  std::vector<device::Sample> chunk_;
  std::uint64_t written_ = 0;
  std::string error_;
  system::Thread thread_;
};

Recorder::Recorder(const std::string& path, Metadata metadata, const Options& options)
    : writer_(std::make_unique<Writer>(path, std::move(metadata), options)) {}

Recorder::~Recorder() = default;

void Recorder::push(const device::Sample& sample) noexcept {
  writer_->push(sample);
}

bool Recorder::failing() const noexcept {
  return writer_->failing();
}

Recorder::Result Recorder::close(const std::string& end_reason) {
  return writer_->close(end_reason);
}

}  // namespace forceshade::recorder
