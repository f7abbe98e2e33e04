// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/case_file.h"

#include <array>
#include <bit>
#include <cstring>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

#include "files/csv.h"
#include "files/npy.h"
#include "forceshade/error.h"
#include "properties/conformance/strokes.h"
#include "text/letters.h"
#include "text/number_text.h"

namespace forceshade::conformance {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are read and written as they are in memory");

const std::vector<std::string> kNumbers{"x_mm", "y_mm", "z_mm", "fx_N", "fy_N", "fz_N"};
constexpr std::size_t kReset = 6, kAim = 7, kPeriods = 8;  // after the numbers
const std::vector<std::string> kOthers{"reset", "aim", "periods"};
constexpr std::size_t kAimBytes = 12;
constexpr std::string_view kLayout = "[('x_mm', '<f4'), ('y_mm', '<f4'), ('z_mm', '<f4'), ('reset', '|u1'), ('aim', '|S12')",
                           kLayoutOfPeriods = ", ('periods', '<u4')";

void put(Case& its, std::size_t i, float number) {
  (i < 3 ? its.position : its.force)[static_cast<Eigen::Index>(i % 3)] = number;
}

std::uint32_t periods_in(const files::Reader& rows) {
  if (const auto periods = number_in<std::uint32_t>(rows.text(kPeriods))) return *periods;
  throw rows.unexpected(kPeriods, "a whole number from 0 to 4294967295");
}

std::uint64_t read_csv(std::istream& in, const std::string& file, const std::function<void(const Case&)>& each) {
  files::Reader rows(in, file, kNumbers, kOthers);
  std::uint64_t count = 0;
  for (; rows.next(); ++count) {
    Case its;
    for (std::size_t i = 0; i < kNumbers.size(); ++i) put(its, i, rows.binary32(i));
    if (rows.has(kReset)) {
      if (rows.text(kReset) != "0" && rows.text(kReset) != "1") throw rows.unexpected(kReset, "0 or 1");
      its.is_reset = rows.text(kReset) == "1";
    }
    if (rows.has(kAim)) its.aim = rows.text(kAim);
    if (rows.has(kPeriods)) its.periods = periods_in(rows);
    its.place = file + ':' + std::to_string(rows.line());
    each(its);
  }
  return count;
}

files::NpyHead head_of(std::istream& in, const std::string& file) try {
  return files::read_npy_head(in);
} catch (const Error& fault) {
  throw Error(file + ": " + fault.what());
}

// A field of a record: where it lies, and its type without the character of the byte order.
struct Field {
  std::size_t offset = 0, bytes = 0;
  std::string type;
};

struct Record {
  std::map<std::string, Field> fields;
  std::size_t bytes = 0;
};

// [('x_mm', '<f4'), ('reset', '|u1'), ...]: names and types in quotes, in turn. Nothing where it is something else.
std::optional<Record> record_of(std::string_view list) {
  std::vector<std::string> words;
  for (std::size_t at = list.find('\''); at != std::string_view::npos; at = list.find('\'', at)) {
    const std::size_t end = list.find('\'', at + 1);
    if (end == std::string_view::npos) return std::nullopt;
    words.emplace_back(list.substr(at + 1, end - at - 1));
    at = end + 1;
  }
  Record record;
  if (words.size() % 2 != 0) return std::nullopt;
  // Reset is read as reset, as in CSV.
  for (std::size_t i = 0; i < words.size(); i += 2)
    for (const std::string& other : kOthers)
      if (small_letters(words[i]) == other) words[i] = other;
  for (std::size_t i = 0; i < words.size(); i += 2) {
    const std::string& type = words[i + 1];
    if (type.size() < 3 || type.find_first_not_of("0123456789", 2) != std::string::npos || type.size() > 6) return std::nullopt;
    Field field{record.bytes, std::stoul(type.substr(2)), type};
    if (type[1] == 'U') field.bytes *= 4;
    record.bytes += field.bytes;
    // NumPy fills a gap between fields with one that has no name.
    if (!words[i].empty() && !record.fields.emplace(words[i], field).second) return std::nullopt;
  }
  return record;
}

// The record that a file has to have, or what is wrong with this one.
Record expected_record(const files::NpyHead& head, const std::string& file) {
  if (!head.type.starts_with('[')) {
    if (head.type != "<f4" || head.shape.size() != 2 || head.shape[1] != 6 || head.is_by_column)
      throw Error(
          file + ": holds an array of type " + head.type + " and shape (" + head.shape_text +
          "); expected records with the fields x_mm, y_mm, z_mm, fx_N, fy_N and fz_N, or numbers of type <f4 (float32), "
          "row by row, of shape (n, 6)");
    Record record;
    for (const std::string& name : kNumbers) record.fields[name] = {4 * record.fields.size(), 4, "<f4"};
    record.bytes = 24;
    return record;
  }
  const auto record = record_of(head.type);
  if (!record || head.shape.size() != 1)
    throw Error(file + ": holds records " + head.type + " of shape (" + head.shape_text +
                "); expected one dimension, and fields that are numbers or texts");
  const auto fault = [&](const std::string& words) { return Error(file + ": " + words); };
  for (const std::string& name : kNumbers) {
    const auto found = record->fields.find(name);
    if (found == record->fields.end()) throw fault("has no field " + name + "; expected x_mm, y_mm, z_mm, fx_N, fy_N and fz_N");
    if (found->second.type != "<f4")
      throw fault("field " + name + " is of type " + found->second.type + "; expected <f4 (float32)");
  }
  if (const auto reset = record->fields.find("reset");
      reset != record->fields.end() && reset->second.type != "|u1" && reset->second.type != "|b1")
    throw Error(file + ": field reset is of type " + reset->second.type + "; expected |u1 (uint8) or |b1 (bool)");
  if (const auto periods = record->fields.find("periods"); periods != record->fields.end() && periods->second.type != "<u4")
    throw fault("field periods is of type " + periods->second.type + "; expected <u4 (uint32)");
  return *record;
}

// A text of bytes or of UTF-32, as NumPy keeps it, in which what is no ASCII is a question mark.
std::string text_in(const char* bytes, const Field& field) {
  std::string text;
  const std::size_t step = field.type[1] == 'U' ? 4 : 1;
  for (std::size_t i = 0; i < field.bytes && bytes[i] != 0; i += step)
    text += bytes[i] > 0x1F && bytes[i] < 0x7F ? bytes[i] : '?';
  return text;
}

std::uint64_t read_npy(std::istream& in, const std::string& file, const std::function<void(const Case&)>& each) {
  const files::NpyHead head = head_of(in, file);
  const Record record = expected_record(head, file);
  std::array<const Field*, 9> fields{};
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const auto found = record.fields.find(i < kNumbers.size() ? kNumbers[i] : kOthers[i - kReset]);
    if (found != record.fields.end()) fields[i] = &found->second;
  }
  std::string bytes(record.bytes, '\0');
  for (std::uint64_t row = 0; row < head.shape[0]; ++row) {
    if (!in.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
      throw Error(file + ": is truncated: expected " + std::to_string(head.shape[0]) + " rows, got " + std::to_string(row));
    Case its;
    for (std::size_t i = 0; i < kNumbers.size(); ++i) {
      float number = 0;
      std::memcpy(&number, &bytes[fields[i]->offset], sizeof number);
      put(its, i, number);
    }
    if (fields[kReset] != nullptr) {
      const int reset = static_cast<unsigned char>(bytes[fields[kReset]->offset]);
      if (reset > 1)
        throw Error(file + ", row " + std::to_string(row) + ": reset: expected 0 or 1, got " + std::to_string(reset));
      its.is_reset = reset == 1;
    }
    if (fields[kAim] != nullptr && (fields[kAim]->type[1] == 'S' || fields[kAim]->type[1] == 'U'))
      its.aim = text_in(&bytes[fields[kAim]->offset], *fields[kAim]);
    if (fields[kPeriods] != nullptr) std::memcpy(&its.periods, &bytes[fields[kPeriods]->offset], sizeof its.periods);
    its.place = file + ", row " + std::to_string(row);
    each(its);
  }
  if (in.peek() != std::char_traits<char>::eof()) throw Error(file + ": goes on after its last row");
  return head.shape[0];
}

}  // namespace

void write_positions(std::ostream& out, bool is_npy, const properties::Subject& subject, std::uint64_t count,
                     std::uint64_t seed, bool has_damping, const Monitor& monitor) {
  if (is_npy)
    out << files::npy_header(std::string(kLayout).append(has_damping ? kLayoutOfPeriods : "") + ']', count);
  else
    out << "x_mm,y_mm,z_mm,reset,aim" << (has_damping ? ",periods\n" : "\n");
  Strokes ticks(subject.positions(seed), has_damping, seed);
  for (std::uint64_t i = 0; i < count; ++i) {
    if (i % kPathLength == 0) monitor.at(static_cast<double>(i) / static_cast<double>(count));
    const auto [aimed, periods] = ticks.next();
    const bool is_reset = i % kPathLength == 0;
    const std::string aim(properties::name_of(aimed.aim));
    if (is_npy) {
      std::array<char, kAimBytes> padded{};
      aim.copy(padded.data(), padded.size());
      out.write(reinterpret_cast<const char*>(aimed.position.data()), 3 * sizeof(float));
      out.put(is_reset ? 1 : 0).write(padded.data(), padded.size());
      if (has_damping) out.write(reinterpret_cast<const char*>(&periods), sizeof periods);
      continue;
    }
    for (const float coordinate : aimed.position) out << shortest(coordinate) << ',';
    out << (is_reset ? 1 : 0) << ',' << aim;
    if (has_damping) out << ',' << periods;
    out << '\n';
  }
}

void read_cases(std::istream& in, const std::string& file, const std::function<void(const Case&)>& each) {
  if ((files::is_named_npy(file) ? read_npy : read_csv)(in, file, each) == 0)
    throw Error(file + ": expected positions with forces, got none");
}

}  // namespace forceshade::conformance
