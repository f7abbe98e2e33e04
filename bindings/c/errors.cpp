// SPDX-License-Identifier: BSD-3-Clause
#include "bindings/c/errors.h"

#include <algorithm>
#include <array>
#include <exception>
#include <new>

#include "files/output_file.h"
#include "forceshade/error.h"
#include "rendering/left_out.h"
#include "text/beginning.h"

namespace forceshade::c {
namespace {

thread_local std::array<char, 4096> message{};

}  // namespace

forceshade_result fail(forceshade_result result, std::string_view words) noexcept {
  const std::string_view kept = beginning_of(words.substr(0, words.find_last_not_of('\n') + 1), message.size() - 1);
  *std::copy(kept.begin(), kept.end(), message.begin()) = '\0';
  return result;
}

forceshade_result fail_with_exception() noexcept {
  try {
    throw;
  } catch (const Refused& refused) {
    return refused.result;
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
