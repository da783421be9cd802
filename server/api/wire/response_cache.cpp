#include "api/wire/response_cache.hpp"

#include "api/services.hpp"

namespace fitgauge::api {
namespace {

constexpr std::size_t kMostBytes = std::size_t{4} << 20;
/// A longer response is sent in place, and a few of them would fill the cache.
constexpr std::size_t kLongestAnswer = std::size_t{64} << 10;
/// Bytes of an entry in addition to its texts.
constexpr std::size_t kOverhead = 256;

}  // namespace

void tables_of(app::TableCatalog& catalog, const Request& request,
               app::Done<app::TableCatalog::Tables> done) {
  const auto revision = request.text("revision");
  if (!revision) return done(catalog.tables());
  catalog.at_revision(std::string(*revision), std::move(done));
}

bool asks_for_revision_alone(const Request& request) {
  const std::string_view query = request.query();
  return query.starts_with("revision=") && query.find('&') == std::string_view::npos;
}

Parameter revision_parameter() {
  return query("revision", "Answers from an older revision of the tables");
}

http::EitherHandler of_revision(app::TableCatalog& tables, http::SyncHandler current,
                                TableHandler make) {
  return {.has_to_wait =
              [](const Request& request) {
                return !request.query().empty() && request.has("revision");
              },
          .now = std::move(current),
          .later =
              [&tables, make](const Request& request, Responder responder) {
                tables_of(tables, request,
                          [&request, make,
                           answer = answer_by(share(std::move(responder)))](const auto& found) {
                            answer(found ? make(request, **found) : found.error());
                          });
              }};
}

http::SyncHandler ResponseCache::cached(std::shared_ptr<ResponseCache> cache, TableHandler make) {
  return [cache = std::move(cache),
          make = std::move(make)](const Request& request) -> Result<Response> {
    if (auto found = cache->find(request)) return found;
    const auto state = cache->tables_.state();
    if (state->tables == nullptr) return cache->tables_.tables().error();
    Result<Response> made = make(request, *state->tables);
    if (!made || made->status != 200 || made->prepared) return made;
    Prepared prepared = http::prepare(*made);
    cache->keep(request, state, prepared);
    return prepared;
  };
}

ResponseCache::Prepared ResponseCache::find(const Request& request) {
  const std::lock_guard lock(mutex_);
  if (!tables_.is_in_use(state_.get())) return nullptr;
  key_.clear();
  request.append_identity(key_);
  const auto found = answers_.find(key_);
  return found == answers_.end() ? nullptr : found->second;
}

void ResponseCache::keep(const Request& request, std::shared_ptr<const app::TableState> state,
                         Prepared response) {
  const std::size_t size = http::size_in_memory(*response);
  if (size > kLongestAnswer) return;
  const std::lock_guard lock(mutex_);
  key_.clear();
  request.append_identity(key_);
  const std::size_t cost = size + key_.size() + kOverhead;
  if (state_ != state || bytes_ + cost > kMostBytes) {
    answers_.clear();
    bytes_ = 0;
    state_ = std::move(state);
  }
  if (answers_.insert_or_assign(key_, std::move(response)).second) bytes_ += cost;
}

}  // namespace fitgauge::api
