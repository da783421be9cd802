#pragma once

#include "base/json/json_value.hpp"
#include "db/store/stores.hpp"
#include "service/storage.hpp"

// Changes of configuration: tables, plans, budgets, gauges, calibrations, studies, setups,
// catalogues, connections and keys. Each is logged in the job that makes it.

namespace fitgauge::app {

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
