// SPDX-License-Identifier: BSD-3-Clause
#include "bindings/c/errors.h"

#include <algorithm>
#include <array>
#include <exception>
#include <new>

#include "files/output_file.h"
#include "forceshade/error.h"
#include "rendering/left_out.h"

namespace forceshade::c {
namespace {

thread_local std::array<char, 4096> message{};

}  // namespace

forceshade_result fail(forceshade_result result, std::string_view words) noexcept {
  std::size_t length = std::min(words.size(), message.size() - 1);
  // Not in the middle of a character.
  while (length < words.size() && length > 0 && (static_cast<unsigned char>(words[length]) & 0xC0U) == 0x80U) --length;
  std::copy_n(words.begin(), length, message.begin());
  message[length] = '\0';
  return result;
}

forceshade_result fail_with_exception() noexcept {
  try {
    throw;
  } catch (const LeftOut& error) {
    return fail(FORCESHADE_LEFT_OUT, error.what());
  } catch (const files::OutputError& error) {
    return fail(FORCESHADE_FAILED, error.what());
  } catch (const Error& error) {
    return fail(FORCESHADE_BAD_INPUT, error.what());
  } catch (const std::bad_alloc&) {
    return fail(FORCESHADE_NO_MEMORY, "there is not enough memory");
  } catch (const std::exception& error) {
    return fail(FORCESHADE_FAILED, error.what());
  } catch (...) {
    return fail(FORCESHADE_FAILED, "an exception that says nothing");
  }
}

const char* last_message() noexcept {
  return message.data();
}

}  // namespace forceshade::c
