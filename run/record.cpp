// SPDX-License-Identifier: BSD-3-Clause
#include "run/record.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "files/output_file.h"
#include "files/temporary_folder.h"
#include "forceshade/recording.h"
#include "run/recorder/loss.h"

namespace forceshade::run {
namespace {

namespace fs = std::filesystem;

// A new directory: beside the table, or where temporary files go if that is no file of its own (-, a pipe, /dev/null).
fs::path new_directory(const std::string& table) {
  if (files::is_written_directly(table)) return files::new_temporary_folder();
  std::string name = files::with_ending(table, ".partial-XXXXXX");
  if (!::mkdtemp(name.data())) throw files::OutputError(table + ": cannot write: " + std::generic_category().message(errno));
  return name;
}

// With what SQLite keeps beside it.
void remove_recording(const std::string& path) {
  std::error_code ignored;
  for (const char* suffix : {"", "-wal", "-shm"}) fs::remove(path + suffix, ignored);
}

bool has_ended(const std::string& path) {
  try {
    return recorder::Recording(path).ended();
  } catch (const std::exception&) {  // no recording
    return true;
  }
}

// The process that writes a recording, by the lock that SQLite holds for as long; 0: no process writes it.
pid_t writer_of(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return 0;
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  const bool is_known = ::fcntl(file, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  ::close(file);
  return is_known && !has_ended(path) ? lock.l_pid : 0;
}

// Replaces the name of the recording behind a table by that of the table, the file that was asked for.
std::string said_of(const std::string& table, std::string words, const std::string& recording) {
  const std::size_t at = words.find(recording);
  return at == std::string::npos ? words : words.replace(at, recording.size(), table);
}

}  // namespace

Record::Record(std::string path, recorder::Metadata metadata, bool paced, bool replaces) : path_(files::followed(path)) {
  if (is_table()) {
    directory_ = new_directory(path_);
  } else if (replaces) {
    if (const pid_t writer = writer_of(path_); writer != 0)
      throw Error(path_ + ": cannot replace the recording: the process " + std::to_string(writer) + " writes it");
    remove_recording(path_);
  }
  try {
    recorder_.emplace(recording(), std::move(metadata), recorder::Recorder::Options{.waits = !paced});
  } catch (const std::exception& failure) {  // no destructor follows
    if (!is_table()) throw;
    std::error_code ignored;
    fs::remove_all(directory_, ignored);
    throw Error(said_of(path_, failure.what(), recording()));
  }
}

Record::~Record() {
  recorder_.reset();
  std::error_code ignored;
  if (is_table() && !kept_) fs::remove_all(directory_, ignored);
  if (!is_table() && !closed_) remove_recording(path_);
}

std::vector<std::string> Record::close(const std::string& end_reason) {
  closed_ = true;
  std::vector<std::string> faults;
  if (const std::string words = recorder::words_of_loss(recording(), recorder_->close(end_reason)); !words.empty())
    faults.push_back(said_of(path_, words, recording()));
  if (!is_table()) return faults;
  try {
    recorder::Recording finished(recording());
    recorder::export_table(finished, path_);
  } catch (const std::exception& failure) {
    kept_ = true;
    faults.push_back(failure.what() + ("; the ticks are in " + recording()) + ": forceshade recording export");
  }
  return faults;
}

}  // namespace forceshade::run
