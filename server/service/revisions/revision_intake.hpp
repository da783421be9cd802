#pragma once

#include "base/result.hpp"
#include "service/revisions/revision_feed.hpp"
#include "service/storage.hpp"

namespace fitgauge::app {

/// Stores revisions of the centre at a station. They replace documents of the same name here;
/// documents that this folder has made are renamed, and a key of this folder stays. Other documents
/// do not change. Used by one thread.
class RevisionIntake {
 public:
  /// The event's name and a sentence, for the log of the service.
  using Tell = std::function<void(std::string_view event, const std::string& detail)>;

  RevisionIntake(Database& database, TableCatalog& tables, Origins& origins, const Clock& clock,
                 Tell tell)
      : database_(database),
        tables_(tables),
        origins_(origins),
        clock_(clock),
        tell_(std::move(tell)) {}

  struct Outcome {
    int taken = 0;    ///< that were new here
    int refused = 0;  ///< that cannot be stored here; reported, each once
  };
  /// Stores all of a page in one transaction. A repeated page changes nothing. Blocks.
  /// @errors those of storage.
  Result<Outcome> take(const RevisionPage& page);

 private:
  struct Job;

  Result<void> prepare(const RevisionPage& page);
  void tell_once(std::string_view event, const std::string& detail);

  Database& database_;
  TableCatalog& tables_;
  Origins& origins_;
  const Clock& clock_;
  const Tell tell_;
  std::set<std::string> told_{};
};

}  // namespace fitgauge::app
