// SPDX-License-Identifier: BSD-3-Clause
#include "run/recorder/sqlite.h"

#include <sqlite3.h>

#include <filesystem>
#include <system_error>
#include <utility>

namespace forceshade::recorder {
namespace {

// The longest time for which a reader and the writer of one recording wait for each other.
constexpr int kBusyTimeoutMs = 1000;

// SQLite calls back every so many steps of its machine; a call that returns anything but 0 ends the statement.
constexpr int kSteps = 1000;
int count_down(void* left) {
  return --*static_cast<std::int64_t*>(left) < 0 ? 1 : 0;
}

// The steps, in thousands, that reading a recording of this size may take in all. Its tables have some ten rows of metadata and
// a row for each chunk of at least 128 bytes; SQLite takes some 20 steps for a row, and its integrity check some 100.
std::int64_t steps_for(const std::string& path) {
  std::uintmax_t bytes = 0;
  for (const char* suffix : {"", "-wal"}) {
    std::error_code none;
    const std::uintmax_t size = std::filesystem::file_size(path + suffix, none);
    if (!none) bytes += size;
  }
  return 1000 + static_cast<std::int64_t>(bytes / 128);
}

}  // namespace

void Database::Close::operator()(sqlite3* handle) const noexcept {
  sqlite3_close(handle);
}

Database::Database(std::string path, Access access, const std::string& made_as) : path_(std::move(path)) {
  const int flags = access == Access::read ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE;
  sqlite3* handle = nullptr;
  const int code = sqlite3_open_v2((made_as.empty() ? path_ : made_as).c_str(), &handle, flags, nullptr);
  handle_.reset(handle);
  if (code != SQLITE_OK) throw error();
  sqlite3_busy_timeout(handle, kBusyTimeoutMs);
  if (access == Access::read) distrust();
}

void Database::distrust() {
  sqlite3* handle = handle_.get();
  for (const auto& [option, value] : {std::pair{SQLITE_DBCONFIG_DEFENSIVE, 1},
                                      {SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0},
                                      {SQLITE_DBCONFIG_ENABLE_VIEW, 0},
                                      {SQLITE_DBCONFIG_ENABLE_TRIGGER, 0},
                                      {SQLITE_DBCONFIG_DQS_DDL, 0},
                                      {SQLITE_DBCONFIG_DQS_DML, 0}})
    if (sqlite3_db_config(handle, option, value, nullptr) != SQLITE_OK) throw error();
  for (const auto& [limit, value] : {std::pair{SQLITE_LIMIT_LENGTH, 1 << 20},
                                     {SQLITE_LIMIT_SQL_LENGTH, 10'000},
                                     {SQLITE_LIMIT_COLUMN, 16},
                                     {SQLITE_LIMIT_EXPR_DEPTH, 10},
                                     {SQLITE_LIMIT_COMPOUND_SELECT, 2},
                                     {SQLITE_LIMIT_ATTACHED, 0},
                                     {SQLITE_LIMIT_TRIGGER_DEPTH, 1},
                                     {SQLITE_LIMIT_WORKER_THREADS, 0}})
    sqlite3_limit(handle, limit, value);
  steps_left_ = std::make_unique<std::int64_t>(steps_for(path_));
  sqlite3_progress_handler(handle, kSteps, &count_down, steps_left_.get());
}

Error Database::error() const {
  if (steps_left_ && *steps_left_ < 0) return Error(path_ + ": reading it takes more steps than a recording of its size needs");
  return Error(path_ + ": " + sqlite3_errmsg(handle_.get()));
}

void Database::execute(const std::string& sql) {
  if (sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) throw error();
}

Statement Database::prepare(const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(handle_.get(), sql.c_str(), static_cast<int>(sql.size()), &statement, nullptr) != SQLITE_OK)
    throw error();
  return {*this, statement};
}

std::int64_t Database::integer(const std::string& sql) {
  Statement statement = prepare(sql);
  return statement.step() ? statement.integer(0) : 0;
}

std::string Database::text(const std::string& sql) {
  Statement statement = prepare(sql);
  return statement.step() ? statement.text(0) : "";
}

void Statement::Finalize::operator()(sqlite3_stmt* handle) const noexcept {
  sqlite3_finalize(handle);
}

void Statement::check(int code) const {
  if (code != SQLITE_OK) throw database_->error();
}

Statement& Statement::bind(int parameter, std::int64_t value) {
  check(sqlite3_bind_int64(handle_.get(), parameter + 1, value));
  return *this;
}

Statement& Statement::bind(int parameter, std::string_view text) {
  check(sqlite3_bind_text64(handle_.get(), parameter + 1, text.data(), text.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
  return *this;
}

Statement& Statement::bind(int parameter, std::span<const std::byte> blob) {
  check(sqlite3_bind_blob64(handle_.get(), parameter + 1, blob.data(), blob.size(), SQLITE_TRANSIENT));
  return *this;
}

void Statement::run() {
  sqlite3_step(handle_.get());
  check(sqlite3_reset(handle_.get()));
}

bool Statement::step() {
  const int code = sqlite3_step(handle_.get());
  if (code != SQLITE_ROW && code != SQLITE_DONE) throw database_->error();
  return code == SQLITE_ROW;
}

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(handle_.get(), column);
}

std::string Statement::text(int column) const {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(handle_.get(), column));
  return text ? std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column))) : "";
}

std::span<const std::byte> Statement::blob(int column) const {
  const auto* bytes = static_cast<const std::byte*>(sqlite3_column_blob(handle_.get(), column));
  return {bytes, static_cast<std::size_t>(sqlite3_column_bytes(handle_.get(), column))};
}

}  // namespace forceshade::recorder
