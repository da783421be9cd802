#include "plant/centre/follower.hpp"

#include <fmt/format.h>

#include "service/log/revisions_text.hpp"

namespace fitgauge::forwarder {
namespace {

using std::chrono::minutes;
using std::chrono::seconds;

constexpr seconds kBetweenQuestions{5};
/// After what the centre gives could not be taken: somebody may have cleared the way.
constexpr minutes kBetweenBeginnings{10};

constexpr long kAnswered = 200;

}  // namespace

std::optional<std::int64_t> Follower::look(CentreLink& link, const CentreLink::GoesOn& goes_on) {
  const auto now = Steady::now();
  if (now < due_) return std::nullopt;
  size_at_centre_.reset();
  due_ = now + kBetweenQuestions;
  if (refused_ && now > begun_ + kBetweenBeginnings) position_.clear();
  if (position_.empty()) {
    begun_ = now;
    refused_ = false;
  }
  while (take_page(link, goes_on)) {
  }
  return size_at_centre_;
}

/// @returns whether there is more.
bool Follower::take_page(CentreLink& link, const CentreLink::GoesOn& goes_on) {
  const http_client::HttpAnswer answer = link.get(
      fmt::format("/v1/log/revisions?station={}&after={}", station_(), position_), goes_on);
  if (answer.status == 0) return failed(answer.failure);
  if (answer.status != kAnswered) return failed(fmt::format("it answers {}", answer.status));
  const auto read = api::read_revisions(answer.body);
  if (!read) return failed(read.error().message);
  const auto taken = intake_.take((*read)->page);
  if (!taken) return failed(taken.error().message);
  failure_.clear();
  refused_ = refused_ || taken->refused > 0;
  position_ = (*read)->page.position;
  size_at_centre_ = (*read)->page.size;
  if (taken->taken > 0) {
    tell_("revisions_taken", fmt::format("{} up to {}", taken->taken, position_));
  }
  return (*read)->page.more;
}

bool Follower::failed(const std::string& why) {
  if (why != failure_) tell_("revisions_failed", why);
  failure_ = why;
  return false;
}

}  // namespace fitgauge::forwarder
