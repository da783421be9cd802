#include "plant/centre/forwarder.hpp"

#include "base/gzip.hpp"
#include "base/regular_file.hpp"
#include "base/text.hpp"
#include "service/log/revisions_text.hpp"

namespace fitgauge::forwarder {
namespace {

constexpr std::chrono::seconds kTimeout{60};
constexpr std::size_t kLongestAnswer = std::size_t{64} << 10;
constexpr std::size_t kLongestPage = std::size_t{64} << 20;

/// The first line of the file. @returns false when it cannot be read.
bool read_key(const std::string& file, std::string& key) {
  const auto text = read_regular(file);
  if (text) key = trim(text->substr(0, text->find('\n')));
  return !key.empty();
}

using std::chrono::minutes;
using std::chrono::seconds;

constexpr seconds kBetweenQuestions{5};
/// After a revision could not be stored: the cause may be gone.
constexpr minutes kBetweenBeginnings{10};

constexpr long kAnswered = 200;

}  // namespace

CentreLink::HttpAnswer CentreLink::call(http_client::HttpCall call, const std::string& path,
                                        const GoesOn& goes_on) {
  if (!options_.key_file.empty()) {
    std::string key;
    if (!read_key(options_.key_file, key)) {
      return {.failure = fmt::format("cannot read a key from {}", options_.key_file)};
    }
    call.headers.push_back("Authorization: Bearer " + key);
  }
  call.url = options_.url + path;
  call.timeout = kTimeout;
  return client_.call(call, goes_on);
}

CentreLink::HttpAnswer CentreLink::put(const std::string& path, std::string_view ndjson,
                                       const GoesOn& goes_on) {
  const std::string body = gzip(ndjson);
  return call({.method = "PUT",
               .headers = {"Content-Type: application/x-ndjson", "Content-Encoding: gzip"},
               .body = body,
               .longest_answer = kLongestAnswer},
              path, goes_on);
}

CentreLink::HttpAnswer CentreLink::get(const std::string& path, const GoesOn& goes_on) {
  return call({.method = "GET", .longest_answer = kLongestPage}, path, goes_on);
}

std::optional<Follower::Heard> Follower::look(CentreLink& link, const CentreLink::GoesOn& goes_on) {
  const auto now = Steady::now();
  if (now < due_) return std::nullopt;
  heard_.reset();
  due_ = now + kBetweenQuestions;
  if (refused_ && now > begun_ + kBetweenBeginnings) position_.clear();
  if (position_.empty()) {
    begun_ = now;
    refused_ = false;
  }
  while (take_page(link, goes_on)) {
  }
  return heard_;
}

/// @returns whether there is more.
bool Follower::take_page(CentreLink& link, const CentreLink::GoesOn& goes_on) {
  const std::string_view station = station_();
  const http_client::HttpAnswer answer =
      link.get(fmt::format("/v1/log/revisions?station={}&after={}", station, position_), goes_on);
  if (answer.status == 0) return failed(answer.failure);
  if (answer.status != kAnswered) return failed(fmt::format("it answers {}", answer.status));
  const auto read = api::read_revisions(answer.body);
  if (!read) return failed(read.error().message);
  const auto taken = intake_.take((*read)->page);
  if (!taken) return failed(taken.error().message);
  failure_.clear();
  refused_ = refused_ || taken->refused > 0;
  position_ = (*read)->page.position;
  heard_ = {.history = station,
            .centre = (*read)->page.origin,
            .size = (*read)->page.size,
            .notes = (*read)->page.notes};
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
