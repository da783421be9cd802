#pragma once

#include "db/store/database.hpp"
#include "service/log/leaf.hpp"
#include "service/log/log_service.hpp"
#include "service/measurements/mapping.hpp"

namespace fitgauge::app {

/// The finding for a measurement whose record does not match its leaf.
std::string altered_finding();

/// Rebuilds a log of this folder or of a station from its records in their order, and compares it
/// with stored hashes and signatures.
class LogCheck {
 public:
  /// Returns the stored hash of a node of level 8, 16, …; none if it is absent. Not set: no nodes
  /// are stored.
  using KeptNodes = std::function<std::optional<tlog::Hash>(const tlog::Node&)>;

  LogCheck(LogService::Facts facts, RowNames names, KeptNodes kept)
      : facts_(std::move(facts)),
        names_(std::move(names)),
        kept_(std::move(kept)),
        frontier_(facts_.base) {}

  /// Adds a checkpoint to compare with. @param place its name in findings.
  void expect(const std::string& place, std::string_view note);

  /// The finding for the next measurement of this log, if any.
  std::optional<std::string> add(const MeasurementRow& row);

  /// Adds all changes instead of measurements: each must have its leaf.
  /// @returns whether it could read all of them, and there are some.
  bool add_changes(Database& database);

  /// The finding for the whole log, after the last measurement.
  std::vector<std::string> finish();

  /// Returns size and root of the log, for people, and the checkpoints that do not cover it.
  std::string head_text();

 private:
  struct Expected {
    std::string place;
    tlog::Checkpoint checkpoint;
  };
  void append(const tlog::Hash& leaf, std::int64_t id);
  void compare_nodes(unsigned completed);

  const LogService::Facts facts_;
  const RowNames names_;
  const KeptNodes kept_;
  LeafMaker leaf_;
  std::int64_t partial_rows_ = 0;
  tlog::Frontier frontier_;
  std::multimap<std::uint64_t, Expected> expected_;  ///< by size
  std::vector<std::string> findings_;
  std::vector<std::string> empty_;  ///< checkpoints that cover no leaf
  bool whole_ = true;               ///< no row was missing so far
};

}  // namespace fitgauge::app
