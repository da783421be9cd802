#include "service/log/log_reader.hpp"

#include "db/store/database.hpp"
#include "record/record.hpp"
#include "service/log/leaves.hpp"

namespace fitgauge::app {
namespace {

constexpr unsigned kKeptLevels = 8;
constexpr std::int64_t kChangesAtATime = 1000;

}  // namespace

void append_leaf(tlog::Frontier& tree, const tlog::Hash& leaf,
                 std::vector<store::LogStore::Node>& nodes) {
  const unsigned completed = tree.append(leaf);
  for (unsigned level = tlog::kTileHeight; level < completed; level += tlog::kTileHeight) {
    nodes.push_back({.level = static_cast<int>(level / tlog::kTileHeight),
                     .index = static_cast<std::int64_t>((tree.size() >> level) - 1),
                     .hash = tree.completed(level)});
  }
}

std::vector<tlog::Hash> LogReader::leaves(std::int64_t after, std::int64_t count) {
  std::vector<tlog::Hash> leaves;
  leaves.reserve(static_cast<std::size_t>(count));
  if (base_ && after < base_->size) {
    const std::int64_t below = std::min(count, base_->size - after);
    leaves = LogReader(stores_, names_, base_->origin).leaves(after, below);
    after += below;
    count -= below;
    if (count == 0) return leaves;
  }
  const auto take = [&](const Digest& leaf) { leaves.push_back(leaf); };
  if (origin_ == kChanges) {
    stores_.changes.leaves(after, count, take);
  } else {
    stores_.measurements.log_hashes(origin_, after, count, take);
  }
  return leaves;
}

std::vector<std::string> LogReader::records(std::int64_t after, std::int64_t count) const {
  std::vector<std::string> records;
  if (origin_ == kChanges) {
    for (bool has_more = true; has_more && count > 0;) {
      const auto page = stores_.changes.list({}, after, count);
      for (const store::Change& change : page.changes) records.push_back(change_entry(change));
      after += static_cast<std::int64_t>(page.changes.size());
      count -= static_cast<std::int64_t>(page.changes.size());
      has_more = page.has_more;
    }
    return records;
  }
  stores_.measurements.list_log(origin_, after, count, [&](const MeasurementRow& row) {
    append_record(records.emplace_back(), from_store(row, names_));
  });
  return records;
}

std::vector<tlog::Hash> LogReader::hashes(unsigned tile_level, std::uint64_t first,
                                          std::uint64_t count) {
  auto begin = static_cast<std::int64_t>(first);
  auto many = static_cast<std::int64_t>(count);
  std::vector<tlog::Hash> hashes;
  if (tile_level == 0) {
    hashes = leaves(begin, many);
  } else if (origin_ == kChanges) {  // few, so that no nodes are kept
    for (std::uint64_t index = first; index < first + count; ++index) {
      hashes.push_back(
          root_of(this->hashes(tile_level - 1, index * tlog::kTileWidth, tlog::kTileWidth)));
    }
  } else {
    // Nodes that are complete below the branch are stored there.
    const std::int64_t below =
        std::min(many, (base_ ? base_->size >> (tile_level * tlog::kTileHeight) : 0) - begin);
    if (below > 0) {
      hashes = LogReader(stores_, names_, base_->origin)
                   .hashes(tile_level, first, static_cast<std::uint64_t>(below));
      begin += below;
      many -= below;
    }
    const auto take = [&](const Digest& hash) { hashes.push_back(hash); };
    const int level = static_cast<int>(tile_level);
    if (origin_ == 0) {
      stores_.log.nodes(level, begin, many, take);
    } else {
      stores_.origins.nodes(origin_, level, begin, many, take);
    }
  }
  if (hashes.size() != count) {
    throw store::StorageFailure(
        {ErrorCode::StorageCorrupt,
         fmt::format("the log lacks hashes from {} on at level {}: restore a backup", first,
                     tile_level * tlog::kTileHeight)});
  }
  return hashes;
}

tlog::Hash LogReader::node(const tlog::Node& node) {
  const unsigned above = node.level % tlog::kTileHeight;
  return root_of(
      hashes(node.level / tlog::kTileHeight, node.index << above, std::uint64_t{1} << above));
}

tlog::Hash LogReader::root_of(std::vector<tlog::Hash> level) {
  for (; level.size() > 1; level.resize(level.size() / 2)) {
    for (std::size_t i = 0; i < level.size() / 2; ++i) {
      level[i] = hasher_.node(level[2 * i], level[2 * i + 1]);
    }
  }
  return level.front();
}

tlog::Frontier LogReader::frontier(std::uint64_t size) {
  std::vector<tlog::Hash> roots;
  for (const tlog::Node& each : tlog::subtrees(0, size)) roots.push_back(node(each));
  return {size, std::move(roots)};
}

std::string LogReader::tile(const tlog::Tile& tile) {
  std::string bytes;
  if (tile.kind == tlog::Tile::Kind::Hashes) {
    for (const tlog::Hash& hash : hashes(tile.level, tile.begin(), tile.width)) {
      bytes.append(reinterpret_cast<const char*>(hash.data()), hash.size());
    }
    return bytes;
  }
  for (const std::string& record : records(static_cast<std::int64_t>(tile.begin()), tile.width)) {
    bytes += static_cast<char>(record.size() >> 8U);
    bytes += static_cast<char>(record.size() & 0xFFU);
    bytes += record;
  }
  return bytes;
}

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
    return fmt::format("{}: {} corrections, each compared with its own hash: their log is not here",
                       facts_.name, partial_rows_);
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
