#include "service/revisions/revision_feed.hpp"

#include "db/store/database.hpp"
#include "record/origins.hpp"
#include "record/record.hpp"
#include "service/measurements/mapping.hpp"
#include "service/tables/table_catalog.hpp"

namespace fitgauge::app {
namespace {

constexpr std::int64_t kMostRevisions = 500;
constexpr std::size_t kMostBytes = std::size_t{4} << 20;

constexpr std::pair<RevisionKind, std::string_view> kKinds[] = {
    {RevisionKind::Tables, "tables"},         {RevisionKind::Key, "key"},
    {RevisionKind::Setup, "setup"},           {RevisionKind::Plan, "plan"},
    {RevisionKind::Correction, "correction"}, {RevisionKind::Catalogue, "catalogue"}};

void fill_tables(const Stores& stores, Revision& revision) {
  const auto latest = stores.tables.load_latest();
  if (!latest) return;
  revision.id = latest->revision.id;
  auto data = from_store({.cells = {}, .custom = latest->content.custom});
  if (data) revision.columns = std::move(data->custom_columns);
}

void fill_key(const Stores& stores, Revision& revision) {
  const auto key = stores.keys.newest(revision.name);
  revision.is_removed = !key || key->revoked_at_ns.has_value();
  if (!key) return;
  revision.role = key->role;
  revision.token_hash = key->token_hash;
  if (key->expires_at_ns) revision.expires_at = Timestamp{*key->expires_at_ns};
}

void fill_document(const Stores& stores, Revision& revision) {
  // A document and its revisions have the same codes.
  auto document =
      stores.documents.find(static_cast<store::DocumentKind>(revision.kind), revision.name);
  revision.is_removed = !document;
  if (document) revision.text = std::move(document->text);
}

}  // namespace

std::string_view word(RevisionKind kind) {
  return std::ranges::find(kKinds, kind, &std::pair<RevisionKind, std::string_view>::first)->second;
}

std::optional<RevisionKind> revision_kind_from_word(std::string_view text) {
  for (const auto& [kind, name] : kKinds) {
    if (text == name) return kind;
  }
  return std::nullopt;
}

void RevisionFeed::read(std::string_view station, std::string position, Done done) const {
  database_.readers().submit([this, station = std::string(station), position = std::move(position)](
                                 const Stores& stores) { return page(stores, station, position); },
                             std::move(done));
}

Result<RevisionPage> RevisionFeed::page(const Stores& stores, std::string_view station,
                                        std::string_view position) const {
  const auto origin = stores.origins.find(station);
  const auto listed = stores.revisions.list(stores.revisions.number_of(position).value_or(0),
                                            origin ? origin->number : 0, kMostRevisions);
  RevisionPage page{.position = stores.revisions.newest_position(),
                    .more = false,
                    .origin = std::string(origins_.own()),
                    .size = origin ? origin->size : 0,
                    .notes = origin ? stores.notes.newest_of(origin->number) : 0,
                    .is_branched = origin && stores.origins.is_base(origin->number)};
  std::size_t bytes = 0;
  for (const auto& [number, kind, name] : listed) {
    if (bytes > kMostBytes) {
      page.more = true;
      break;
    }
    Revision revision{.number = number, .kind = kind};
    if (!fill(stores, name, revision)) continue;
    bytes += revision.text.size();
    page.revisions.push_back(std::move(revision));
  }
  page.more = page.more || listed.size() == static_cast<std::size_t>(kMostRevisions);
  if (page.more) page.position = stores.revisions.position(page.revisions.back().number);
  return page;
}

/// @returns false: it has nothing to send.
bool RevisionFeed::fill(const Stores& stores, const std::string& name, Revision& revision) const {
  if (revision.kind == RevisionKind::Correction) {
    std::int64_t row = 0;
    std::from_chars(name.data(), name.data() + name.size(), row);
    const RowNames names = row_names(tables_, origins_);
    return stores.measurements.find(row, [&](const MeasurementRow& found) {
      append_record(revision.text, from_store(found, names));
      revision.place = found.place_in_log();
    });
  }
  revision.name = name;
  switch (revision.kind) {
    case RevisionKind::Tables: fill_tables(stores, revision); break;
    case RevisionKind::Key: fill_key(stores, revision); break;
    default: fill_document(stores, revision);
  }
  return true;
}

}  // namespace fitgauge::app
