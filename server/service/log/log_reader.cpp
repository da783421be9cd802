#include "service/log/log_reader.hpp"

#include "record/record.hpp"
#include "service/log/changes.hpp"

namespace fitgauge::app {

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

}  // namespace fitgauge::app
