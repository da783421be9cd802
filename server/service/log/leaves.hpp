#pragma once

#include "base/json/json_value.hpp"
#include "db/store/stores.hpp"
#include "proof/frontier.hpp"
#include "record/measurement.hpp"
#include "service/storage.hpp"

namespace fitgauge::app {

/// Makes the leaves of the log: SHA-256(0x00 || the record as its POST answers it). The records are
/// written once, for the leaves and for the answer. Not thread-safe.
class LeafMaker {
 public:
  /// @param measurements with their ids. @returns a leaf for each, valid until the next call.
  std::span<const tlog::Hash> operator()(std::span<const Measurement> measurements);
  tlog::Hash operator()(const Measurement& measurement) {
    return (*this)({&measurement, 1}).front();
  }
  /// The records of the last call, with commas between them; valid until the next.
  std::string_view records() const { return records_; }
  /// Leaves of some of its measurements.
  std::string_view records(std::size_t first, std::size_t count) const {
    return records().substr(begins_[first], begins_[first + count] - 1 - begins_[first]);
  }

 private:
  std::string records_;
  std::vector<std::size_t> begins_;  ///< of each record, and of the next one
  std::vector<tlog::Hash> leaves_;
  tlog::TreeHasher hasher_;
};

/// Returns why a record of another folder cannot be stored; empty: it can. This version must read
/// all of it and write the same text again.
/// @param text the record of `measurement`.
std::string_view finding_in(const Measurement& measurement, std::string_view text);

// Changes of configuration: tables, plans, budgets, gauges, calibrations, studies, setups,
// catalogues, connections and keys. Each is logged in the job that makes it.

/// Logs a change under the next id, as created, replaced, deleted or (a key) revoked.
/// @param change without id and action; its texts are JSON. Nothing is logged if they are equal.
void log_change(Stores& stores, store::Change change);

/// Stores or removes a document and logs it, a connection without its secrets.
/// @returns whether it is new, or was there.
bool put_document(Stores& stores, const store::Document& document);
bool remove_document(Stores& stores, store::DocumentKind kind, const std::string& name,
                     std::int64_t at_ns, const std::optional<std::string>& caller);

/// Returns the settings of a connection that may be shown: the number of secrets, whether there is
/// a password, and the names of headers.
JsonValue without_secrets(JsonValue settings);

/// A change as /v1/changes answers it.
/// @param id cNUMBER-DIGITS of its history.
std::string change_json(const store::Change& change, const std::string& id);

/// Returns the leaf of a change in the tree of changes: the change with its number as id, and with
/// the SHA-256 of its texts if it would be longer than an entry of a tile.
std::string change_entry(const store::Change& change);

}  // namespace fitgauge::app
