#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/clock.hpp"
#include "base/result.hpp"

namespace fitgauge::store {
class Database;
}

namespace fitgauge::app {

/// A named machine setup as it was written.
struct NamedSetup {
  std::string name;
  std::string text;  ///< JSON, checked when it was stored
  Timestamp modified_at;
};

/// Named machine setups. Nothing but `wait_for` blocks; `done` comes exactly once, on a storage
/// thread or, when refused at once, on the caller's. Thread-safe.
class SetupService {
 public:
  template <class T>
  using Done = std::function<void(Result<T>)>;

  SetupService(store::Database& database, const Clock& clock)
      : database_(database), clock_(clock) {}

  /// Decides on the current text, none where there is no setup, whether a change is made; called in
  /// the transaction that makes it. An empty one allows every change.
  using Precondition = std::function<bool(std::optional<std::string_view> text)>;

  /// Gives whether the name is new. @errors PreconditionFailed, StorageUnavailable, StorageBusy.
  void write(std::string name, std::string text, std::optional<std::string> caller,
             Precondition precondition, Done<bool> done);
  /// @errors SetupUnknown, StorageUnavailable.
  void read(std::string name, Done<NamedSetup> done);
  /// @errors SetupUnknown, PreconditionFailed, StorageUnavailable, StorageBusy.
  void remove(std::string name, Precondition precondition, Done<bool> done);
  void list(Done<std::vector<NamedSetup>> done);  ///< by name

  /// As read, for threads that may wait.
  Result<NamedSetup> wait_for(const std::string& name);

 private:
  store::Database& database_;
  const Clock& clock_;
};

}  // namespace fitgauge::app
