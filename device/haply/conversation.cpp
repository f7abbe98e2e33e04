// SPDX-License-Identifier: BSD-3-Clause
#include "device/haply/conversation.h"

#include "system/system.h"

namespace forceshade::device::haply {
namespace {

constexpr int kMostUnasked = 100;  // in a row

}  // namespace

void Conversation::was_closed(const std::string& why) {
  if (!is_closed()) why_ = why.empty() ? "without a reason" : why;
  is_sending_ = false;
}

Answer Conversation::next(std::int64_t until) {
  message_.reset();
  do wait(until);
  while (!message_ && !is_closed() && system::now() < until);
  if (message_) return {Answer::Kind::message, *message_};
  return {is_closed() ? Answer::Kind::closed : Answer::Kind::late, {}};
}

Answer Conversation::receive(Time timeout) {
  return next(system::now() + system::in_ns(timeout));
}

Answer Conversation::ask(std::string_view text, Time timeout) {
  const std::int64_t until = system::now() + system::in_ns(timeout);
  for (int i = 0; i < kMostUnasked && next(0).kind == Answer::Kind::message; ++i) ++unasked_;
  if (is_closed()) return {Answer::Kind::closed, {}};
  if (is_sending_) return {Answer::Kind::late, {}};  // an earlier message is still unsent
  is_sending_ = true;
  send(text);
  while (is_sending_ && system::now() < until) wait(until);
  if (is_sending_) return {Answer::Kind::late, {}};
  return is_closed() ? Answer{Answer::Kind::closed, {}} : message_ ? Answer{Answer::Kind::message, *message_} : next(until);
}

}  // namespace forceshade::device::haply
