#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/digest.hpp"

namespace fitgauge::store {

namespace sql {
class Connection;
}

/// The codes are stored: never change one, never use one again. Setup, Plan and
/// Catalogue are those of documents.
enum class RevisionKind : std::uint8_t {
  Tables = 1,
  Key = 2,
  Setup = 3,
  Plan = 4,
  Correction = 5,
  Catalogue = 7
};
constexpr RevisionKind last_of(RevisionKind) { return RevisionKind::Catalogue; }

/// What a centre has changed, for its stations; and what a station has of its centre. Changes of
/// tables, keys, setups, plans and catalogues number themselves; corrections are numbered by
/// MeasurementsStore::append().
class RevisionsStore {
 public:
  explicit RevisionsStore(sql::Connection& connection);
  ~RevisionsStore();

  struct Revision {
    std::int64_t number = 0;
    RevisionKind kind = RevisionKind::Tables;
    std::string name{};  ///< of a correction: the id of its row
  };
  /// Up to `limit` of those behind `after` that are for this station, the last of each thing alone.
  std::vector<Revision> list(std::int64_t after, std::int64_t station, std::int64_t limit) const;

  /// `17-5f0c9a3e77d21b40`, the number and its random tag; `0` before the first.
  std::string newest_position() const;
  std::string position(std::int64_t number) const;
  /// The number of a position; none where this folder has not given it out.
  std::optional<std::int64_t> number_of(std::string_view position) const;

  struct Received {
    std::int64_t number = 0;
    Digest digest{};  ///< of the content as it was written here
  };
  std::optional<Received> received(RevisionKind kind, std::string_view name) const;
  void set_received(RevisionKind kind, std::string_view name, const Received& received);
  void forget_received(RevisionKind kind, std::string_view name);

 private:
  struct Statements;
  std::unique_ptr<Statements> statements_;
};

}  // namespace fitgauge::store
