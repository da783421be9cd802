#pragma once

#include <cstdint>
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

/// What is kept under a name beside the measurements.
enum class DocumentKind : std::uint8_t { Uncertainty, GaugeInUse };

/// A document as it was written.
struct NamedDocument {
  std::string name;
  std::string text;  ///< JSON, checked when it was stored
  Timestamp modified_at;
};

/// Uncertainty budgets and gauges in use. Nothing blocks; `done` comes exactly once, on a storage
/// thread or, when refused at once, on the caller's. Thread-safe.
class DocumentService {
 public:
  template <class T>
  using Done = std::function<void(Result<T>)>;
  /// Decides on the current text, none where there is no document, whether a change is made; called
  /// in the transaction that makes it. An empty one allows every change.
  using Precondition = std::function<bool(std::optional<std::string_view> text)>;

  /// What is written, and under which condition.
  struct Change {
    DocumentKind kind = DocumentKind::Uncertainty;
    std::string name{};
    std::string text{};
    std::optional<std::string> caller{};
    std::optional<std::string> uncertainty{};  ///< a budget that must be there
    Precondition precondition{};
  };

  DocumentService(store::Database& database, const Clock& clock)
      : database_(database), clock_(clock) {}

  /// Gives whether the name is new. @errors UncertaintyUnknown: of `uncertainty`;
  ///   PreconditionFailed, StorageUnavailable, StorageBusy.
  void write(Change change, Done<bool> done);
  /// @errors UncertaintyUnknown, GaugeUnknown, StorageUnavailable.
  void read(DocumentKind kind, std::string name, Done<NamedDocument> done);
  /// @errors UncertaintyUnknown, GaugeUnknown, PreconditionFailed, StorageUnavailable, StorageBusy.
  void remove(DocumentKind kind, std::string name, Precondition precondition, Done<bool> done);
  void list(DocumentKind kind, Done<std::vector<NamedDocument>> done);  ///< by name

 private:
  store::Database& database_;
  const Clock& clock_;
};

}  // namespace fitgauge::app
