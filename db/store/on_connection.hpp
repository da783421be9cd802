#pragma once

namespace fitgauge::store {

namespace sql {
class Connection;
}

/// The prepared statements of a store: `StatementsOf<NotesStore>` is defined with its functions.
template <class Store>
struct StatementsOf;

/// Base of each store: `class NotesStore : public OnConnection<NotesStore>`. The connection
/// outlives it. The members of a store's rows are the columns in their order: sql::row_of reads
/// them so.
template <class Store>
class OnConnection {
 public:
  OnConnection(sql::Connection& connection)  // NOLINT(google-explicit-constructor)
      : connection_(connection) {}

 protected:
  /// Made at their first use; db/sql/statement.hpp defines it.
  StatementsOf<Store>& statements() const;

 private:
  sql::Connection& connection_;
  mutable std::shared_ptr<StatementsOf<Store>> statements_;
};

}  // namespace fitgauge::store
