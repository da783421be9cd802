#include "api/wire/response_cache.hpp"

namespace fitgauge::api {
namespace {

/// A target is at most 8 KiB: long ones are not worth a place.
constexpr std::size_t kLongestKey = 256;
constexpr std::size_t kMostAnswers = 4096;

/// The path, the query and the form together name an answer.
void make_key(const http::Request& request, std::string& key) {
  key.assign(request.path());
  key += '?';
  key += request.query();
  key += ' ';
  key += request.response_type();
}

}  // namespace

http::SyncHandler ResponseCache::cached(std::shared_ptr<ResponseCache> cache, TableHandler make) {
  return [cache = std::move(cache),
          make = std::move(make)](const http::Request& request) -> Result<http::Response> {
    const auto state = cache->tables_.state();
    if (auto found = cache->find(request, state.get())) return http::Response(std::move(found));
    if (state->tables == nullptr) return cache->tables_.tables().error();
    Result<http::Response> made = make(request, *state->tables);
    if (!made || made->status != 200 || made->prepared) return made;
    Prepared prepared = http::prepare(*made);
    cache->keep(request, state, prepared);
    return http::Response(std::move(prepared));
  };
}

ResponseCache::Prepared ResponseCache::find(const http::Request& request,
                                            const app::TableState* state) {
  const std::lock_guard lock(mutex_);
  if (state_.get() != state) return nullptr;
  make_key(request, key_);
  const auto found = answers_.find(key_);
  return found == answers_.end() ? nullptr : found->second;
}

void ResponseCache::keep(const http::Request& request, std::shared_ptr<const app::TableState> state,
                         Prepared response) {
  const std::lock_guard lock(mutex_);
  if (state_ != state || answers_.size() >= kMostAnswers) {
    answers_.clear();
    state_ = std::move(state);
  }
  make_key(request, key_);
  if (key_.size() <= kLongestKey) answers_.insert_or_assign(key_, std::move(response));
}

}  // namespace fitgauge::api
