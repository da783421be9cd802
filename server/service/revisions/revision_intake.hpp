#pragma once

#include <functional>
#include <set>
#include <string>
#include <string_view>

#include "base/result.hpp"
#include "service/revisions/revision_feed.hpp"

namespace fitgauge::store {
class Database;
}

namespace fitgauge::app {

class Origins;
class TableCatalog;

/// Takes at a station what its centre hands on. What the centre gives takes the place of what is
/// here under its name; what this folder has made itself is kept under another name, and a key of
/// this folder stays. What the centre does not name stays as it is. For one thread.
class RevisionIntake {
 public:
  /// The event's name and a sentence, for the log of the service.
  using Tell = std::function<void(std::string_view event, const std::string& detail)>;

  RevisionIntake(store::Database& database, TableCatalog& tables, Origins& origins,
                 const Clock& clock, Tell tell)
      : database_(database),
        tables_(tables),
        origins_(origins),
        clock_(clock),
        tell_(std::move(tell)) {}

  struct Outcome {
    int taken = 0;    ///< that were new here
    int refused = 0;  ///< that cannot be taken as things are here; told, each once
  };
  /// All of a page, in one transaction. The same again changes nothing. Blocks.
  /// @errors those of storage.
  Result<Outcome> take(const RevisionPage& page);

 private:
  struct Job;

  Result<void> prepare(const RevisionPage& page);
  void tell_once(std::string_view event, const std::string& detail);

  store::Database& database_;
  TableCatalog& tables_;
  Origins& origins_;
  const Clock& clock_;
  const Tell tell_;
  std::set<std::string> told_{};
};

}  // namespace fitgauge::app
