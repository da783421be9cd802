#include "service/log/log_check.hpp"

#include "db/store/database.hpp"
#include "service/log/changes.hpp"
#include "service/log/log_reader.hpp"

namespace fitgauge::app {
namespace {

constexpr unsigned kKeptLevels = 8;
constexpr std::int64_t kChangesAtATime = 1000;

}  // namespace

std::string altered_finding() { return "was altered: it does not match its hash in the log"; }

void LogCheck::expect(const std::string& place, std::string_view note) {
  const auto checkpoint = tlog::open_checkpoint(note, facts_.keys);
  if (!checkpoint) {
    findings_.push_back(
        fmt::format("{} is not a checkpoint of this log: {}", place, checkpoint.error().message));
    return;
  }
  const auto former = facts_.former.find(checkpoint->origin);
  const bool is_former = former != facts_.former.end();
  if (!is_former && checkpoint->origin != facts_.name) {
    findings_.push_back(
        fmt::format("{} belongs to the log {}, not to {}", place, checkpoint->origin, facts_.name));
  } else if (is_former && checkpoint->size > former->second) {
    findings_.push_back(fmt::format(
        "{} has signed {} {} of {}, but only {} of them continue in {}: an older copy was restored",
        place, checkpoint->size, facts_.leaves, checkpoint->origin, former->second, facts_.name));
  } else if (checkpoint->size == 0) {
    empty_.push_back(place);  // every log begins so
  } else {
    expected_.emplace(checkpoint->size, Expected{place, *checkpoint});
  }
}

std::optional<std::string> LogCheck::add(const MeasurementRow& row) {
  const Measurement measurement = from_store(row, names_);
  const tlog::Hash leaf = leaf_(measurement);
  if (facts_.is_partial) {
    ++partial_rows_;
    return leaf == row.hash ? std::nullopt : std::optional(altered_finding());
  }
  const auto expected = static_cast<std::int64_t>(frontier_.size()) + 1;
  if (whole_ && row.place_in_log() != expected) {
    whole_ = false;
    // If its place is its id, the gap before it is reported by the id.
    if (row.origin || row.seq) {
      return fmt::format("is at {} in the log {}, but {} comes next", row.place_in_log(),
                         facts_.name, expected);
    }
  }
  if (whole_) append(leaf, row.id);
  return leaf == row.hash ? std::nullopt : std::optional(altered_finding());
}

bool LogCheck::add_changes(Database& database) {
  std::int64_t after = 0;
  const auto add_page = [&](const Stores& stores) -> Result<bool> {
    const auto page = stores.changes.list({}, after, kChangesAtATime);
    const auto count = static_cast<std::int64_t>(page.changes.size());
    const auto leaves = LogReader(stores, names_, LogReader::kChanges).leaves(after, count);
    if (leaves.size() != page.changes.size()) {
      return Error{ErrorCode::StorageCorrupt, fmt::format("changes after {} are missing", after)};
    }
    for (const store::Change& change : page.changes) {
      const tlog::Hash leaf = tlog::leaf_hash(change_entry(change));
      append(leaf, change.id);
      if (leaf != leaves.at(static_cast<std::size_t>(change.id - after - 1))) {
        findings_.push_back(fmt::format("change {} {}", change.id, altered_finding()));
      }
    }
    after += count;
    return page.has_more;
  };
  for (auto more = Result<bool>(true); more && *more && whole_;) {
    more = database.readers().wait(add_page);
    whole_ = more.has_value();
    if (!whole_) findings_.push_back(more.error().message);
  }
  return whole_ && after > 0;
}

void LogCheck::append(const tlog::Hash& leaf, std::int64_t id) {
  compare_nodes(frontier_.append(leaf));
  const auto [first, last] = expected_.equal_range(frontier_.size());
  for (auto at = first; at != last; ++at) {
    if (at->second.checkpoint.root == frontier_.root()) continue;
    findings_.push_back(fmt::format("{} up to {} differ from the ones that {} has signed",
                                    facts_.leaves, id, at->second.place));
  }
}

/// A record that was altered together with its leaf shows in the nodes above.
void LogCheck::compare_nodes(unsigned completed) {
  for (unsigned level = kKeptLevels; kept_ && level < completed; level += kKeptLevels) {
    const tlog::Node node{.level = level, .index = (frontier_.size() >> level) - 1};
    if (((node.index + 1) << level) > static_cast<std::uint64_t>(facts_.size)) continue;
    const auto kept = kept_(node);
    if (kept && *kept == frontier_.completed(level)) continue;
    findings_.push_back(fmt::format("measurements {} to {} do not match the hashes of the log",
                                    (node.index << level) + 1, frontier_.size()));
  }
}

std::vector<std::string> LogCheck::finish() {
  if (!whole_) return std::move(findings_);  // the rows that are missing have been named
  const std::uint64_t size = frontier_.size();
  if (size < static_cast<std::uint64_t>(facts_.size)) {
    findings_.push_back(
        fmt::format("the log has {} {}, but only {} are stored: the newest are missing",
                    facts_.size, facts_.leaves, size));
  }
  for (auto at = expected_.upper_bound(size); at != expected_.end(); ++at) {
    findings_.push_back(
        fmt::format("{} has signed {} {}, but only {} are stored: the newest are missing, or an "
                    "older copy was restored",
                    at->second.place, at->first, facts_.leaves, size));
  }
  return std::move(findings_);
}

std::string LogCheck::head_text() {
  if (facts_.is_partial) {
    return fmt::format("{}: {} corrections by the centre, which has its log", facts_.name,
                       partial_rows_);
  }
  std::string text = fmt::format("{}: {} {}, root {}", facts_.name, frontier_.size(), facts_.leaves,
                                 tlog::to_base64(frontier_.root()));
  if (frontier_.size() == 0) return text;
  for (const std::string& place : empty_) {
    text += fmt::format("\n{} covers 0 of them: it proves nothing", place);
  }
  return text;
}

}  // namespace fitgauge::app
