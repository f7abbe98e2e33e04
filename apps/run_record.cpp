// SPDX-License-Identifier: BSD-3-Clause
#include "apps/run_record.h"

#include <stdlib.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "files/output_file.h"
#include "recorder/export.h"

namespace forceshade::apps {
namespace {

namespace fs = std::filesystem;

// A new directory: beside the table, or where temporary files go if that is no file of its own (-, a pipe, /dev/null).
fs::path new_directory(const std::string& table) {
  const bool beside = !files::is_written_directly(table);
  std::string name = beside ? table + ".partial-XXXXXX" : (fs::temp_directory_path() / "forceshade-XXXXXX").string();
  if (!::mkdtemp(name.data())) throw files::OutputError(table + ": cannot write: " + std::generic_category().message(errno));
  return name;
}

// With what SQLite keeps beside it.
void remove_recording(const std::string& path) {
  std::error_code ignored;
  for (const char* suffix : {"", "-wal", "-shm"}) fs::remove(path + suffix, ignored);
}

}  // namespace

RunRecord::RunRecord(std::string path, recorder::Metadata metadata, bool paced, bool replaces) : path_(std::move(path)) {
  if (is_table())
    directory_ = new_directory(path_);
  else if (replaces)
    remove_recording(path_);
  try {
    recorder_.emplace(recording(), std::move(metadata), recorder::Recorder::Options{.waits = !paced});
  } catch (...) {  // no destructor follows
    std::error_code ignored;
    if (is_table()) fs::remove_all(directory_, ignored);
    throw;
  }
}

RunRecord::~RunRecord() {
  recorder_.reset();
  std::error_code ignored;
  if (is_table() && !kept_) fs::remove_all(directory_, ignored);
  if (!is_table() && !closed_) remove_recording(path_);
}

bool RunRecord::close(const std::string& end_reason) {
  closed_ = true;
  const auto [written, lost, error] = recorder_->close(end_reason);
  const bool whole = lost == 0 && error.empty();
  if (!whole)
    std::fprintf(stderr, "forceshade: %s; recorded %llu samples, lost %llu\n",
                 error.empty() ? (recording() + ": the disk was too slow").c_str() : error.c_str(),
                 static_cast<unsigned long long>(written), static_cast<unsigned long long>(lost));
  if (!is_table()) return whole;
  try {
    recorder::Recording finished(recording());
    recorder::export_table(finished, path_);
    return whole;
  } catch (const std::exception& failure) {
    kept_ = true;
    std::fprintf(stderr, "forceshade: %s; the ticks are in %s: forceshade recording export\n", failure.what(),
                 recording().c_str());
    return false;
  }
}

}  // namespace forceshade::apps
