#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "base/clock.hpp"
#include "base/length.hpp"
#include "base/result.hpp"
#include "base/snapshot.hpp"

namespace fitgauge::app {
class DocumentService;
}

namespace fitgauge::api {

/// What a gauge in use says of the measurements that name it.
struct GaugeInUse {
  std::string budget{};  ///< its name; empty: none
  /// Of the budget, whose figures are in µm, rounded up to the nanometre; none where there is no
  /// such budget any more.
  std::optional<Length> standard_uncertainty{};
  std::string calibration_due{};  ///< as it was given
  Timestamp due{};                ///< the same; a date lasts to its end in UTC

  bool is_overdue(Timestamp at) const { return due < at; }
};

/// The gauges in use, by name.
using GaugeBook = std::map<std::string, GaugeInUse, std::less<>>;

/// When a calibration is due: a date to its end in UTC, or an RFC 3339 time. None for other texts.
std::optional<Timestamp> parse_due(std::string_view text);

/// A standard uncertainty in µm as measurements have it: rounded up to the nanometre. None where it
/// is no length.
std::optional<Length> rounded_up(double micrometres);

/// The gauges in use with what their budgets come to, as the stored documents have them.
/// Thread-safe.
class GaugesInUse {
 public:
  explicit GaugesInUse(app::DocumentService& documents) : documents_(documents) {}

  std::shared_ptr<const GaugeBook> book() const { return book_.get(); }

  /// Reads them again after a change. `done` comes when book() has that change, on a storage
  /// thread.
  /// @errors StorageUnavailable, StorageBusy.
  void reload(std::function<void(Result<void>)> done);
  /// The same for a thread that may wait.
  Result<void> load();

 private:
  void show(std::uint64_t number, GaugeBook book);

  app::DocumentService& documents_;
  Snapshot<GaugeBook> book_{std::make_shared<const GaugeBook>()};
  std::mutex mutex_;
  std::uint64_t begun_ = 0;  ///< reloads; a later one has seen all that an earlier one has
  std::uint64_t shown_ = 0;
};

}  // namespace fitgauge::api
