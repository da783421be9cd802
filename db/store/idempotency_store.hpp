#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "base/clock.hpp"
#include "base/digest.hpp"
#include "base/result.hpp"

namespace fitgauge::store {

namespace sql {
class Connection;
}

/// A request that carries an Idempotency-Key. Caller, method and path are the key's scope.
struct IdempotentRequest {
  std::string caller{};
  std::string method{};
  std::string path{};
  std::string key{};
  Digest body{};                  ///< of the raw body
  bool is_kept_for_ever = false;  ///< else for the retention
};

/// An answer as it is kept and replayed.
struct StoredAnswer {
  int status = 200;
  std::string content_type{};
  std::string location{};  ///< empty: no Location
  std::string body{};
  bool replayed = false;  ///< set on an answer that came from the store
};

/// The answers of requests with an Idempotency-Key. An answer counts until the writer's maintenance
/// purges it after it has expired.
class IdempotencyStore {
 public:
  IdempotencyStore(sql::Connection& connection, const Clock& clock, std::chrono::hours retention);
  ~IdempotencyStore();

  /// The kept answer, none when the key is new. Looked at before the body is parsed: what was once
  /// answered is answered so again, whatever the body would give now.
  /// @errors IdempotencyKeyReused when the key was used with another body.
  Result<std::optional<StoredAnswer>> find(const IdempotentRequest& request) const;

  /// The kept answer, or that of `work`, which is kept when its status is 2xx.
  /// @errors IdempotencyKeyReused; those of `work`.
  Result<StoredAnswer> once(const IdempotentRequest& request,
                            const std::function<Result<StoredAnswer>()>& work);

  /// An answer that was kept where a row was stored, on its way with it.
  struct Forwarded {
    IdempotentRequest request{};
    StoredAnswer answer{};
    std::int64_t expires_at_ns = std::numeric_limits<std::int64_t>::max();

    /// None if it is kept for ever.
    std::optional<Timestamp> expires_at() const {
      const bool for_ever = expires_at_ns == std::numeric_limits<std::int64_t>::max();
      return for_ever ? std::nullopt : std::optional(Timestamp{expires_at_ns});
    }
  };
  /// Visits the answers of measurements (a path from `/v1/measurements` on) kept while the newest
  /// one was one of these ids.
  using Visitor = std::function<void(const Forwarded&)>;
  void visit_forwarded(std::int64_t first, std::int64_t last, const Visitor& visit) const;
  /// Keeps an answer from elsewhere, unless there is one of that key already.
  void keep(const Forwarded& forwarded);

  /// Deletes up to `limit` answers that have expired by `now`. @returns how many.
  std::int64_t purge(Timestamp now, std::int64_t limit);

 private:
  struct Statements;
  std::unique_ptr<Statements> statements_;
};

}  // namespace fitgauge::store
