// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The part of SQLite that a recording needs.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "forceshade/recording.h"

struct sqlite3;
struct sqlite3_stmt;

namespace forceshade::recorder {

class Statement;

class Database {
 public:
  enum class Access { read, write };

  // Opens a file. For reading, nothing in it is trusted: no view, no trigger and no function of its schema is run, nothing
  // longer than a chunk is taken into memory, and a statement that takes more steps than a file of its size needs is stopped.
  // made_as: the file's name until it gets its own, which messages have in any case.
  Database(std::string path, Access access, const std::string& made_as = {});

  // Throws Error with SQLite's words, as all below.
  void execute(const std::string& sql);
  Statement prepare(const std::string& sql);
  std::int64_t integer(const std::string& sql);
  std::string text(const std::string& sql);

  const std::string& path() const noexcept { return path_; }
  Error error() const;

 private:
  struct Close {
    void operator()(sqlite3* handle) const noexcept;
  };
  void distrust();

  std::string path_;
  std::unique_ptr<std::int64_t> steps_left_;  // its address stays when the database is moved
  std::unique_ptr<sqlite3, Close> handle_;
};

// Must not outlive its database. Columns and parameters count from 0; what text() and blob() give lives until the next step().
class Statement {
 public:
  Statement(const Database& database, sqlite3_stmt* handle) : database_(&database), handle_(handle) {}

  // All are copied or used up before run() or step() returns.
  Statement& bind(int parameter, std::int64_t value);
  Statement& bind(int parameter, std::string_view text);
  Statement& bind(int parameter, std::span<const std::byte> blob);

  // Executes a statement that returns no row, and makes it ready to be bound and run again, also when it throws.
  void run();

  // Goes to the next row; false after the last one.
  bool step();

  std::int64_t integer(int column) const;
  std::string text(int column) const;
  std::span<const std::byte> blob(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* handle) const noexcept;
  };
  void check(int code) const;

  const Database* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> handle_;
};

}  // namespace forceshade::recorder
